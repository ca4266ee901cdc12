"""Pictures where matplotlib is not installed: what needs it says what to install."""

import subprocess
import sys
from pathlib import Path

# Whatever is drawn, each by its own module; pages and notebooks need no library.
SCRIPT = """
import sys
sys.modules["matplotlib"] = None  # as if it were not installed
import assur

mechanism = assur.FourBar(1.0, 3.0, 2.5, 3.0)
motion = mechanism.solve([0.0, 0.5, 1.0])
fit = assur.search({"P": [(0.0, 0.0), (1.0, 0.0)]}, joints=5, evaluations=1)[0]
front = assur.pareto(
    mechanism,
    [0.0, 1.0, 2.0],
    maximize={"a": assur.metric.span("rocker"), "b": assur.metric.min_transmission_angle("C")},
    bounds={"rocker.length": (2.4, 2.6)},
    population=4,
    generations=1,
)
front.to_html("front.html")
drawn = [
    fit.plot,
    front.plot,
    mechanism.plot,
    mechanism.assemblies(1.0).plot,
    mechanism.configuration_curve().plot,
    lambda: mechanism.to_drawing("m.dxf"),
    lambda: motion.plot("C"),
    lambda: motion.animate("m.gif"),
    lambda: motion.diagram("rocker"),
    lambda: motion.polygon("velocity"),
    lambda: assur.pictures.instant_centres(motion[0]),
    lambda: assur.crank_rocker.plot_least_angle(),
    lambda: assur.slider_crank.plot_contour(1.0, 0.1, 0.4),
]
for draw in drawn:
    try:
        draw()
    except ImportError as error:
        print(error)
print(mechanism._repr_svg_()[:4])
"""


def test_what_draws_says_what_to_install(tmp_path: Path) -> None:
    ran = subprocess.run(
        [sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True, cwd=tmp_path
    )
    *explained, svg = ran.stdout.splitlines()
    assert explained == ['drawing needs matplotlib: pip install "assur[plot]"'] * 13
    assert svg == "<svg"
