"""The greatest mass a runway lets go: an inverse search on the flights of its take-off card."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import inf, isnan, nan
from typing import NamedTuple

import numpy as np

from harness.errors import FlightError, InputErrors
from harness.manual import FlightManual
from harness.takeoff.card import Card, Need, card
from harness.takeoff.case import TakeOff, check, lightest
from harness.takeoff.field import Field
from harness.takeoff.field_flights import Guess, Runway
from harness.takeoff.fleet import fly_all
from harness.takeoff.speeds import ControlSpeeds
from harness.units import TONNE

MASS_TOLERANCE = 100.0  # kg: the greatest mass is met, so much more is not
SPREAD = 0.025  # the first two masses are so far to either side of the first guess
ROUNDS = 5  # of guesses by what was flown; after them thirds of what is left
POWERS = {"field": 2.2, "brake energy": 2.2, "VMCG": 2.2, "tyre speed": 0.5}
"""How what is required grows with mass, for the first guess: distances with the square of VR and a little more, as the
acceleration falls; energy with the mass and the square of V1; the tyres' speed with VR."""
THRUST_OVER_WEIGHT = 0.2  # estimate: a climb gradient falls by this times the share of mass added
FAR = 1000.0  # kg: masses nearer to each other give no slope, half a metre would spoil it
AT_LIMIT = 0.01  # brakes for which V1 is lowered have so little left, whatever the mass

Tried = dict[float, Card | None]


class Greatest(NamedTuple):
    """The greatest mass, kg, and what sets it; NaN where none is possible, `set_by` says why.

    `inside` is the card there, `outside` that of the least mass tried beyond it: None where there is no such flight.
    """

    mass: float
    set_by: str
    inside: Card | None
    outside: Card | None


def greatest_mass(flown: Card, manual: FlightManual, workers: int = 1) -> Greatest:
    """Search from the card of one mass: two at a time, until one is possible and one at most a tolerance more is not.

    The first two are at both sides of where the powers of mass put the limit, the next where what was flown puts it.
    """
    low, high = lightest(manual), manual.limits["maximum-take-off-mass"]
    tried: Tried = {flown.case.mass: flown}
    turn = 0
    while True:
        inside = max((mass for mass, one in tried.items() if one and one.met), default=-inf)
        outside = min((mass for mass in tried if mass > inside), default=inf)
        if inside >= high:
            return Greatest(high, "maximum take-off mass", tried[high], None)
        if outside <= low:
            return Greatest(nan, f"{_kind(tried[low])} even at {low / TONNE:.1f} t", None, tried[low])
        if outside - inside <= MASS_TOLERANCE:
            return Greatest(inside, _kind(tried[outside]), tried[inside], tried[outside])
        bracket = max(inside, low), min(outside, high)
        third = (bracket[1] - bracket[0]) / 3.0
        pair = _guesses(tried, bracket) if turn < ROUNDS else [bracket[0] + third, bracket[1] - third]
        wanted = [mass for mass in dict.fromkeys(pair) if mass not in tried]
        inner = workers if len(wanted) == 1 else 1
        asked = [
            (
                replace(flown.case, mass=mass),
                flown.available,
                manual,
                flown.control,
                inner,
                _start(tried, mass),
            )
            for mass in wanted
        ]
        tried.update(zip(wanted, fly_all(_card, asked, workers, flown.case), strict=True))
        turn += 1


def _card(asked: tuple[TakeOff, Runway, FlightManual, ControlSpeeds, int, Guess]) -> Card | None:
    case, available, manual, control, workers, guess = asked
    try:
        check(case, manual)
    except InputErrors:  # the VR asked for is too slow for this mass
        return None
    try:
        return card(case, available, manual, control, workers=workers, guess=guess)
    except FlightError:  # so heavy that it does not fly
        return None


def _kind(found: Card | None) -> str:
    return "flight" if found is None else found.limiting.kind


def _guesses(tried: Tried, bracket: tuple[float, float]) -> list[float]:
    """Two masses around where the first need runs out, far apart at first; or one end of the bracket."""
    below, above = bracket
    known = {mass: one for mass, one in tried.items() if one is not None}
    if not known:
        return [below, 0.5 * (below + above)]
    guess = min(_runs_out(known, bracket), default=above)
    for end, beyond in ((above, guess >= above), (below, guess <= below)):
        if beyond and end not in tried:
            return [end]
    half = SPREAD * guess if len(tried) == 1 else 0.49 * MASS_TOLERANCE
    # At an end that was flown: a tolerance from it, which ends the search there, and a few.
    if below in tried and guess - half <= below and above - below > 3.0 * MASS_TOLERANCE:
        return [below + 0.98 * MASS_TOLERANCE, below + 2.9 * MASS_TOLERANCE]
    if above in tried and guess + half >= above and above - below > 3.0 * MASS_TOLERANCE:
        return [above - 2.9 * MASS_TOLERANCE, above - 0.98 * MASS_TOLERANCE]
    least = 0.02 * (above - below)  # away from what was flown
    return [min(max(mass, below + least), above - least) for mass in (guess - half, guess + half)]


def _runs_out(known: dict[float, Card], bracket: tuple[float, float]) -> list[float]:
    """For each need the mass at which nothing is left of it: by powers of mass, or through the masses flown."""
    near = min(known, key=lambda mass: min(abs(mass - end) for end in bracket))
    others = _apart(known, near)
    guesses = []
    for i, need in enumerate(known[near].needs):
        # The brakes' need stays at its limit where V1 is lowered for them: the others say where that ends.
        if need.name == "brake energy" and 0.0 <= need.margin < AT_LIMIT:
            continue
        missing = need.required - need.available
        slope = _first_slope(need) / near
        if others:
            masses = [near, *others]
            needed = [known[mass].needs[i] for mass in masses]
            lacks = [one.required - one.available for one in needed]
            curve = np.polynomial.Polynomial.fit(np.array(masses) - near, lacks, len(masses) - 1)
            growing = curve.deriv()
            slope = float(growing(0.0))
            real = [float(root.real) for root in curve.roots() if abs(root.imag) < 1.0]
            roots = [root + near for root in real if growing(root) > 0.0]
            within = [root for root in roots if bracket[0] <= root <= bracket[1]]
            if within:
                guesses.append(min(within, key=lambda root: abs(root - near)))
                continue
        if slope > 0.0:
            guesses.append(near - missing / slope)
    return guesses


def _apart(known: dict[float, Card], near: float) -> Sequence[float]:
    """Up to two masses flown, each far enough from the other and from `near`."""
    found: list[float] = []
    for mass in sorted(known, key=lambda mass: abs(mass - near)):
        if all(abs(mass - one) > FAR for one in (near, *found)):
            found.append(mass)
    return found[:2]


def _first_slope(need: Need) -> float:
    """How what is missing grows with the share of mass added."""
    if need.kind == "climb segment":
        return THRUST_OVER_WEIGHT
    return 0.0 if need.name == "V1, for VMCG" else POWERS[need.kind] * need.required


def _start(tried: Tried, mass: float) -> Guess:
    """VR and V1 as they were at the two masses flown that are nearest and apart, in proportion."""
    known = {one: found.field for one, found in tried.items() if found is not None}
    near = min(known, key=lambda one: abs(one - mass))
    far = min((one for one in known if abs(one - near) > FAR), key=lambda one: abs(one - mass), default=None)

    def of(value: Callable[[float], float]) -> float:
        if far is None:
            return value(near)
        return value(near) + (value(far) - value(near)) * (mass - near) / (far - near)

    return Guess(
        of(lambda one: known[one].speeds.v2 - known[one].speeds.vr),
        min(of(lambda one: known[one].v1 / known[one].speeds.vr), 1.0),
        min(of(lambda one: _dry_v1(known[one]) / known[one].speeds.vr), 1.0),
    )


def _dry_v1(field: Field) -> float:
    return field.v1 if isnan(field.dry_v1) else field.dry_v1
