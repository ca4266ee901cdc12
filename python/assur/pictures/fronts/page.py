"""The page of a front: a point of the picture, or a row of the table, opens its design."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING, Any

from assur._arrays import flag, short
from assur._files import checked_path, writing
from assur.errors import InputError
from assur.pictures.fronts.chart import front_svg
from assur.pictures.page.bundle import script
from assur.pictures.page.html import contents, css, document, theme
from assur.pictures.page.svg import svg_picture

if TYPE_CHECKING:
    from collections.abc import Sequence

    from assur._faces import Mechanism
    from assur.pictures.fronts.goal import Goal

STYLE = """\
html,body{height:100%;margin:0}
body{display:grid;grid-template:minmax(0,1fr)/minmax(300px,460px) minmax(0,1fr)}
@media (max-width:800px){body{grid-template:45% 55%/minmax(0,1fr)}}
.front{border-right:1px solid var(--edge)}
.front h1{margin:0;padding:11px 20px;font-size:16px;font-weight:600}
.front svg{display:block;width:100%;font-size:11px}
.front svg path{stroke:var(--grid)}
.front svg text{fill:var(--second)}
.front svg .x{text-anchor:middle}
.front svg .y{text-anchor:end}
.front circle{fill:var(--path);stroke:var(--canvas)}
.front a:is(:hover,:has(text)) circle{fill:var(--ink)}
.front a[aria-current] circle{fill:var(--driver);stroke:var(--driver);stroke-width:5px}
.front table{width:100%;border-collapse:collapse}
.front :is(th,td){padding:2px 20px;text-align:right;font-weight:400}
.front td a{color:var(--driver)}
.front tr:has([aria-current]){background:var(--hover)}
"""
# Another design is another page: loaded anew, nothing of the one before goes on playing.
START = """
const designs = JSON.parse(document.getElementById("assur-data").textContent);
const chosen = Number(location.hash.slice(1));
const shown = chosen in designs ? chosen : 0;
const [front, root] = document.querySelectorAll(".assur");
const links = front.querySelectorAll(`a[href="#${shown}"]`);
for (const link of links) link.setAttribute("aria-current", "true");
window.assurPage = mount(root, designs[shown]);
new MutationObserver(() => {
  front.dataset.theme = root.dataset.theme;
}).observe(root, { attributeFilter: ["data-theme"] });
addEventListener("hashchange", () => location.reload());
"""


def write_front_page(
    goals: Sequence[Goal], designs: Sequence[Mechanism], path: Any, title: Any, dark: Any
) -> None:
    """Write one self-contained page."""
    out = checked_path(path)
    if title is not None and not isinstance(title, str):
        message = f"title is {short(title)}: a text is needed"
        raise InputError(message)
    if dark is not None:
        dark = flag(dark, "dark")
    text = front_page(goals, designs, out.stem if title is None else title, dark)
    with writing(out):
        out.write_text(text, encoding="utf-8", newline="\n")


def front_page(
    goals: Sequence[Goal], designs: Sequence[Mechanism], title: str, dark: bool | None
) -> str:
    """Return the page; without scripts it has the picture of the first design."""
    played, data = [], []
    for index, design in enumerate(designs):
        of_design, numbers = contents(design)
        numbers["title"] = f"design {index}"
        played.append(of_design)
        data.append(numbers)
    body = f"""<nav class="assur front"{theme(dark)}>
<h1>{html.escape(title)}</h1>
{front_svg(goals)}
{_table(goals)}
</nav>
<main class="assur"{theme(dark)}>
{svg_picture(played[0], own_style=False)}
</main>"""
    return document(title, f"{STYLE}{css()}", body, data, f"{script()}{START}")


def _table(goals: Sequence[Goal]) -> str:
    """Return a row for each design."""
    heads = "".join(f"<th>{html.escape(goal.title)}</th>" for goal in goals)
    rows = [
        f'<tr><td><a href="#{index}">{index}</a></td>'
        + "".join(f"<td>{html.escape(text)}</td>" for text in texts)
        + "</tr>"
        for index, texts in enumerate(zip(*(goal.texts() for goal in goals), strict=True))
    ]
    return f"<table><tr><th>design</th>{heads}</tr>{''.join(rows)}</table>"
