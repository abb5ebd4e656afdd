"""The limits of the balance: how far forward, aft and sideways the centre of gravity may lie."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from harness.loading.balance import Body
from harness.units import show
from harness.xml_source import Element, Source, children


class Envelope(NamedTuple):
    """Limits of the centre of gravity, shares of the mean chord, over the aircraft's mass (kg, rising).

    The mean chord begins `leading_edge` m aft of the nose; `lateral` is the limit to either side, m.
    """

    leading_edge: float
    chord: float
    lateral: float
    masses: tuple[float, ...]
    forward: tuple[float, ...]
    aft: tuple[float, ...]

    def share(self, x: float) -> float:
        """A place x m aft of the nose as share of the mean chord."""
        return (x - self.leading_edge) / self.chord

    def limits(self, mass: float) -> tuple[float, float]:
        """The forward and the aft limit at `mass` kg, linear between the masses that are given."""
        forward, aft = (float(np.interp(mass, self.masses, limit)) for limit in (self.forward, self.aft))
        return forward, aft

    def faults(self, body: Body) -> Iterator[str]:
        """What is wrong with the balance of a body, with its numbers."""
        share, (forward, aft) = self.share(body.centre[0]), self.limits(body.mass)
        at = f"at {show(body.mass, 't', 1)}"
        if share < forward:
            yield f"the centre of gravity lies at {percent(share)}, forward of the limit of {percent(forward)} {at}"
        if share > aft:
            yield f"the centre of gravity lies at {percent(share)}, aft of the limit of {percent(aft)} {at}"
        if abs(body.centre[1]) > self.lateral:
            side = "right" if body.centre[1] > 0 else "left"
            yield (
                f"the centre of gravity lies {abs(body.centre[1]):.2f} m to the {side}, "
                f"beyond the limit of {self.lateral:.2f} m {at}"
            )


def percent(share: float) -> str:
    """A share of the mean chord as the field writes it."""
    return f"{100 * share:.1f} % MAC"


def read_envelope(source: Source, element: Element) -> Envelope:
    """The limits in a <balance> element, faults noted in `source`."""
    lines = list(children(element, "envelope"))
    masses = tuple(source.quantity(line, "mass", "mass") for line in lines)
    if list(masses) != sorted(set(masses)):
        source.fault("the masses of the envelope do not rise", element, remedy="lightest first")
    forward, aft = (
        tuple(source.quantity(line, name, "ratio") for line in lines) for name in ("forward", "aft")
    )
    for line, ahead, behind in zip(lines, forward, aft, strict=True):
        if ahead >= behind:
            source.fault("the forward limit is not forward of the aft limit", line)
    chord = source.quantity(element, "mean-chord", "length")
    if chord <= 0:
        source.fault("the mean chord has no length", element, "mean-chord")
    return Envelope(
        source.quantity(element, "leading-edge", "length"),
        chord,
        source.quantity(element, "lateral", "length"),
        masses,
        forward,
        aft,
    )
