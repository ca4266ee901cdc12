"""The studio's view in a notebook: a widget whose kernel computes (``m.explore()``)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import anywidget
import traitlets

from assur.dynamics.machine import Machine
from assur.errors import AssurError, InputError
from assur.studio import document
from assur.studio.answers import answered, failed
from assur.studio.bundle import widget_script
from assur.studio.limits import EXPORT_SECONDS, SECONDS
from assur.studio.request import MalformedError, parse
from assur.studio.session import Deadline, Session

if TYPE_CHECKING:
    from assur.kinematics.mechanism import Mechanism

__all__ = ["Explorer"]

LEAST_HEIGHT = 320


class Explorer(anywidget.AnyWidget):
    """A mechanism that is played, dragged and changed in a cell of a notebook.

    Both ways: dragging or typing in the cell changes `mechanism`; setting `mechanism`
    draws that one. Made by `Mechanism.explore` and `Machine.explore`.

    Parameters
    ----------
    what : Mechanism or Machine
        What is shown first.
    height : int
        Height of the cell, px.

    Attributes
    ----------
    mechanism : Mechanism
        What the cell shows, the last one that moves. Assign another to draw it.
    machine : Machine or None
        With masses and loads, if there are any.
    q : float or list of float
        The driver's coordinate, rad or m; a list for several drivers.
        Assign to move it.
    document : dict
        The description as the page has it, also while it does not move. Observe it, with
        ``view.observe(f, "document")``, to hear of changes.

    Raises
    ------
    InputError
        A batch of designs.

    Examples
    --------
    >>> import assur
    >>> view = assur.FourBar(1.0, 3.0, 2.5, 3.0).explore()
    >>> view.mechanism = view.mechanism.with_dimensions({"coupler.length": 3.2})
    >>> float(view.mechanism.dimensions["coupler.length"])
    3.2
    """

    _esm = widget_script()

    document = traitlets.Dict().tag(sync=True)
    q = traitlets.Any(0.0).tag(sync=True)
    height = traitlets.Int(640).tag(sync=True)

    def __init__(self, what: Mechanism | Machine, height: int = 640) -> None:
        shown = self._shown = _shown(what)
        shown_document, place = document.document_of(what), _place(shown[0])
        super().__init__(document=shown_document, q=place, height=max(int(height), LEAST_HEIGHT))
        # Setting the document read it again.
        self._shown = shown
        self.on_msg(self._asked)

    @property
    def mechanism(self) -> Mechanism:
        """What the cell shows, the last one that moves."""
        return self._shown[0]

    @mechanism.setter
    def mechanism(self, what: Mechanism) -> None:
        self._show(what)

    @property
    def machine(self) -> Machine | None:
        """What the cell shows with its masses and loads, or None."""
        return self._shown[1]

    @machine.setter
    def machine(self, what: Machine) -> None:
        self._show(what)

    def _show(self, what: Mechanism | Machine) -> None:
        shown = _shown(what)
        with self.hold_trait_notifications():
            self.document = document.document_of(what)
            self.q = _place(shown[0])
        self._shown = shown

    @traitlets.observe("document")
    def _changed(self, change: Any) -> None:
        """Take what the page has; what does not move is not taken."""
        try:
            contents = document.read(change["new"])
        except AssurError:
            return
        self._shown = (contents.mechanism, contents.machine)

    def _asked(self, _: Any, content: Any, __: Any) -> None:
        """Answer a request of the page."""
        text = content.get("text") if isinstance(content, dict) else None
        try:
            request = parse(text if isinstance(text, str) else "")
        except MalformedError as error:
            frame = failed({"id": error.id, "rev": None, "kind": None}, error)
        else:
            seconds = EXPORT_SECONDS if request.kind == "export" else SECONDS
            frame = answered(request, Session(None, Deadline(seconds)))
        self.send({}, buffers=[frame])


def _shown(what: Any) -> tuple[Mechanism, Machine | None]:
    """Return the mechanism of one design, and its machine if it is one."""
    is_machine = isinstance(what, Machine)
    mechanism: Any = what.mechanism if is_machine else what
    shape = getattr(mechanism, "shape", None)
    if shape is None:
        message = f"explore shows a mechanism or a machine, not {type(what).__name__}"
        raise InputError(message)
    if shape:
        message = f"explore shows one design, this is a batch {shape}: take one with design(i)"
        raise InputError(message)
    return mechanism, what if is_machine else None


def _place(mechanism: Mechanism) -> Any:
    q0 = mechanism.q0_array
    return float(q0) if mechanism.driver_count == 1 else q0.tolist()
