"""What a diagram shows, as data: made where something is measured, drawn where matplotlib lives."""

from collections.abc import Sequence
from typing import NamedTuple

Values = Sequence[float]


class Curve(NamedTuple):
    """One line, or with `marker` the points alone."""

    label: str
    x: Values
    y: Values
    marker: str = ""


class Panel(NamedTuple):
    """One diagram: labels with units, and its curves. `marks` are values of y drawn across, with their labels."""

    x: str
    y: str
    curves: Sequence[Curve]
    marks: Sequence[tuple[str, float]] = ()
