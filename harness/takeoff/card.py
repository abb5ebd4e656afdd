"""The take-off card: what a runway asks of a take-off against what it has, and the most mass it lets go."""

from collections.abc import Sequence
from dataclasses import replace
from math import isnan
from typing import NamedTuple

from scipy.optimize import brentq

from harness.errors import FlightError, InputError
from harness.manual import FlightManual, read_manual
from harness.takeoff.case import TakeOff, check, lightest
from harness.takeoff.field import FIRST_SEGMENT, SECOND_SEGMENT, Field, FieldFlights, Runway
from harness.units import TONNE

MASS_TOLERANCE = 100.0  # kg: the brackets on the greatest mass stop here


class Need(NamedTuple):
    """One thing required against what is available: in SI; `margin` is relative, negative when it is not met.

    `kind` groups them: field, climb segment, VMCG, brake energy, tyre speed. `unit` is that of the pages.
    """

    name: str
    kind: str
    required: float
    available: float
    unit: str
    rule: str

    @property
    def margin(self) -> float:
        """What is left, as a share of what is available."""
        return (self.available - self.required) / self.available

    @property
    def met(self) -> bool:
        """Whether there is enough."""
        return self.required <= self.available


UNFLYABLE = Need("take-off", "flight", 2.0, 1.0, "", "")


class Card(NamedTuple):
    """A take-off from a runway. `greatest_mass` in kg, NaN if there is none, and what sets it."""

    case: TakeOff
    available: Runway
    field: Field
    needs: tuple[Need, ...]
    greatest_mass: float
    greatest_mass_set_by: str

    @property
    def limiting(self) -> Need:
        """What has the least to spare."""
        return min(self.needs, key=lambda need: need.margin)

    @property
    def met(self) -> bool:
        """Whether the take-off is possible."""
        return all(need.met for need in self.needs)


def card(
    case: TakeOff, available: Runway, manual: FlightManual | None = None, *, search: bool = True
) -> Card:
    """Fly what has to be flown for `case` on a runway of these distances, and search its greatest mass.

    Raises InputErrors, FlightError.
    """
    manual = manual or read_manual(case.aircraft)
    check(case, manual)
    field = FieldFlights(case, manual).field(available)
    mass, set_by = greatest_mass(case, available, manual, field.speeds.vmcg) if search else (float("nan"), "")
    return Card(case, available, field, tuple(needs(field, available)), mass, set_by)


def needs(field: Field, available: Runway) -> Sequence[Need]:
    """Each requirement against its limit."""
    wanted = [
        Need("take-off run", "field", field.take_off_run, available.run, "m", "CS 25.113(c)"),
        Need(
            "take-off distance",
            "field",
            field.take_off_distance,
            available.distance,
            "m",
            "CS 25.113(a), (b)",
        ),
        Need("accelerate-stop distance", "field", field.accelerate_stop, available.stop, "m", "CS 25.109"),
        Need(
            "first segment gradient",
            "climb segment",
            FIRST_SEGMENT,
            field.gradients.first,
            "%",
            "CS 25.121(a)",
        ),
        Need(
            "second segment gradient",
            "climb segment",
            SECOND_SEGMENT,
            field.gradients.second,
            "%",
            "CS 25.121(b)",
        ),
        Need("V1, for VMCG", "VMCG", field.slowest_v1, field.speeds.vr, "kt", "CS 25.107(a)(1), V1 up to VR"),
        Need("brake energy", "brake energy", field.brake_energy, 1.0, "%", "CS 25.735(f)"),
        Need("tyre speed", "tyre speed", field.tyre_speed, 1.0, "%", "CS 25.733"),
    ]
    return [need for need in wanted if not isnan(need.required)]


def greatest_mass(case: TakeOff, available: Runway, manual: FlightManual, vmcg: float) -> tuple[float, str]:
    """The greatest mass (kg) at which everything is met, by brackets on the least margin, and what sets it.

    `vmcg` (m/s) is taken to be that of every mass: it changes by 1 m/s from the lightest to the heaviest.
    """
    low, high = lightest(manual), manual.limits["maximum-take-off-mass"]
    least: dict[float, Need] = {}

    def margin(mass: float) -> float:
        try:
            field = FieldFlights(replace(case, mass=mass), manual, roughly=True, vmcg_known=vmcg).field(
                available
            )
        except (FlightError, InputError):  # so heavy that it does not fly, or VR is too slow for it
            least[mass] = UNFLYABLE
        else:
            least[mass] = min(needs(field, available), key=lambda need: need.margin)
        return max(least[mass].margin, -1.0)

    if margin(high) >= 0.0:
        return high, "maximum take-off mass"
    if margin(low) < 0.0:
        return float("nan"), f"{least[low].name} even at {low / TONNE:.1f} t"
    brentq(margin, low, high, xtol=MASS_TOLERANCE)
    mass = max(mass for mass, need in least.items() if need.met)
    nearest = min((mass for mass, need in least.items() if not need.met))
    return mass, least[nearest].kind
