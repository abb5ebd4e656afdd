"""How the take-off distance changes: derivatives with a check of their steps, and a carpet of mass, heat and height."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, NamedTuple

from harness.manual import FlightManual, read_manual
from harness.takeoff.case import TakeOff
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import CS25_SCREEN, fly_take_off
from harness.units import FT, KT, TONNE

EARLY = 10 * KT  # AMC 25.107(e)(4): all engines, VR so much or 7 % too early, whichever is less ...
EARLY_SHARE = 0.07
MOST_LONGER = 0.01  # ... must not lengthen the take-off distance by more than one per cent
SMOOTH = (
    0.1  # the derivative at half the step may differ by so much of itself, or by what `RESOLVED` makes of it
)
RESOLVED = (
    1.0  # m: two distances, each told to half a metre by the steps of the pilot, may be apart by so much
)

Change = Callable[[TakeOff, FlightManual, float], tuple[TakeOff, FlightManual]]


class Quantity(NamedTuple):
    """What is changed, its unit in SI, the step to each side, how, and the change people speak of."""

    name: str
    unit: str
    step: float
    change: Change
    usual: float
    told: str


class Sensitivity(NamedTuple):
    """d(distance)/d(quantity), SI, at the whole step and at half of it; `smooth` if the two agree.

    `usual_share` is the share of the distance that `usual_change` is about, by the derivative.
    """

    name: str
    unit: str
    step: float
    derivative: float
    at_half_step: float
    smooth: bool
    usual_change: str
    usual_share: float


def distance(case: TakeOff, manual: FlightManual) -> float:
    """Distance to 35 ft with all engines, m."""
    flown = fly_take_off(case, manual=manual)
    return flown.at(flown.at_height(CS25_SCREEN), "along")


def _field(name: str) -> Change:
    def change(case: TakeOff, manual: FlightManual, by: float) -> tuple[TakeOff, FlightManual]:
        return replace(case, **{name: getattr(case, name) + by}), manual

    return change


def _mass_with_vr(case: TakeOff, manual: FlightManual, by: float) -> tuple[TakeOff, FlightManual]:
    """VR goes with the stall speed, as it is scheduled."""
    assert case.vr is not None, "sensitivities() has put it in"
    return replace(case, mass=case.mass + by, vr=case.vr * (1.0 + by / case.mass) ** 0.5), manual


def _flap(case: TakeOff, manual: FlightManual, by: float) -> tuple[TakeOff, FlightManual]:
    flaps = tuple(
        one._replace(position=one.position + by) if one.name == case.flaps else one for one in manual.flaps
    )
    return case, replace(manual, flaps=flaps)


QUANTITIES = (
    Quantity("mass", "kg", 2000.0, _field("mass"), TONNE, "+1 t"),
    Quantity("mass with VR", "kg", 2000.0, _mass_with_vr, TONNE, "+1 t"),
    Quantity("temperature", "K", 8.0, _field("isa_deviation"), 10.0, "+10 K"),
    Quantity("elevation", "m", 300.0, _field("elevation"), 1000 * FT, "+1000 ft"),
    Quantity("headwind", "m/s", 2.0, _field("headwind"), 10 * KT, "+10 kt"),
    Quantity("slope", "1", 0.01, _field("slope"), 0.01, "+1 %"),
    Quantity("flap", "1", 0.1, _flap, 0.1, "+10 % of travel"),
    Quantity("VR", "m/s", 1.0, _field("vr"), KT, "+1 kt"),
    Quantity("friction", "1", 0.5, _field("friction"), 0.1, "+10 %"),
)


def sensitivities(case: TakeOff, workers: int = 1) -> list[Sensitivity]:
    """Central differences of the distance to 35 ft by each of QUANTITIES; VR stays but with `mass with VR`."""
    manual = read_manual(case.aircraft)
    case = replace(case, vr=case.rotation_speed(manual))
    steps = [one.step * share for one in QUANTITIES for share in (1.0, -1.0, 0.5, -0.5)]
    changed = [
        one.change(case, manual, step)
        for one, step in zip((one for one in QUANTITIES for _ in range(4)), steps, strict=True)
    ]
    here, *flown = fly_all(_distance, [(case, manual), *changed], workers, case)
    found = []
    for i, one in enumerate(QUANTITIES):
        up, down, half_up, half_down = flown[4 * i : 4 * i + 4]
        whole, half = (up - down) / (2.0 * one.step), (half_up - half_down) / one.step
        allowed = max(SMOOTH * abs(whole), RESOLVED / one.step)
        found.append(
            Sensitivity(
                one.name,
                one.unit,
                one.step,
                whole,
                half,
                abs(whole - half) <= allowed,
                one.told,
                whole * one.usual / here,
            )
        )
    return found


def _distance(asked: tuple[TakeOff, FlightManual]) -> float:
    return distance(*asked)


def early_rotation(case: TakeOff, workers: int = 1) -> dict[str, Any]:
    """How much longer the take-off distance gets when VR is 10 kt or 7 % early: AMC 25.107(e)(4)."""
    manual = read_manual(case.aircraft)
    vr = case.rotation_speed(manual)
    early = vr - min(EARLY, EARLY_SHARE * vr)
    asked = [(replace(case, vr=speed), manual) for speed in (vr, early)]
    right, wrong = fly_all(_distance, asked, workers, case)
    longer = wrong / right - 1.0
    return {"vr_mps": vr, "early_vr_mps": early, "longer": longer, "met": longer <= MOST_LONGER}


def carpet(
    case: TakeOff, masses: Sequence[float], warmths: Sequence[float], elevations: Sequence[float]
) -> list[TakeOff]:
    """The take-offs of a carpet, mass fastest."""
    return [
        replace(case, mass=mass, isa_deviation=warmth, elevation=elevation)
        for elevation, warmth, mass in product(elevations, warmths, masses)
    ]
