"""Pictures in files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from assur.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable


def save_figure(draw: Callable[[], Any], path: str) -> None:
    """Draw and write the picture."""
    try:
        from matplotlib import pyplot as plt
    except ImportError as error:
        message = "a picture needs matplotlib: pip install assur[plot]"
        raise InputError(message) from error
    figure = draw().figure
    try:
        figure.savefig(path, facecolor=figure.get_facecolor())
    except (OSError, ValueError) as error:
        message = f"{path}: the picture cannot be written ({error})"
        raise InputError(message) from error
    finally:
        plt.close(figure)
