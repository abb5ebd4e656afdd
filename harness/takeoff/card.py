"""The take-off card: what a runway asks of a take-off against what it has, and the most mass it lets go."""

from collections.abc import Sequence
from math import isnan
from typing import NamedTuple

from harness.manual import FlightManual, read_manual
from harness.takeoff.case import TakeOff, check
from harness.takeoff.climb import FIRST_SEGMENT, SECOND_SEGMENT
from harness.takeoff.field import Field, field_of
from harness.takeoff.field_flights import Guess, Runway
from harness.takeoff.speeds import ControlSpeeds, control_speeds


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


class Card(NamedTuple):
    """A take-off from a runway."""

    case: TakeOff
    available: Runway
    control: ControlSpeeds
    field: Field
    needs: tuple[Need, ...]

    @property
    def limiting(self) -> Need:
        """What has the least to spare; of what is not met, what is missed by most."""
        missed = [need for need in self.needs if not need.met]
        return min(missed or self.needs, key=lambda need: need.margin)

    @property
    def met(self) -> bool:
        """Whether the take-off is possible."""
        return all(need.met for need in self.needs)


def card(
    case: TakeOff,
    available: Runway,
    manual: FlightManual | None = None,
    control: ControlSpeeds | None = None,
    *,
    workers: int = 1,
    guess: Guess | None = None,
) -> Card:
    """Fly what has to be flown for `case` on a runway of these distances. Raises InputErrors, FlightError.

    `guess` as in `field_of`.
    """
    manual = manual or read_manual(case.aircraft)
    check(case, manual)
    control = control or control_speeds(case, manual, workers)
    field = field_of(case, available, manual, control, workers=workers, guess=guess)
    return Card(case, available, control, field, tuple(needs(field, available)))


def needs(field: Field, available: Runway) -> Sequence[Need]:
    """Each requirement against its limit."""
    # A stop that is too long from the slowest V1 there may be is VMCG's doing; a take-off that is too long because V1
    # had to be lowered for the brakes is theirs.
    stop_kind = "VMCG" if field.v1_set_by == "VMCG" else "field"
    go_kind = "brake energy" if field.v1_set_by == "brake energy" else "field"
    clearway = available.distance > available.run
    run = field.take_off_run if clearway else field.take_off_distance
    climbs = field.gradients
    wanted = [
        Need("take-off run", go_kind, run, available.run, "m", "CS 25.113(c)"),
        Need(
            "take-off distance",
            go_kind,
            field.take_off_distance,
            available.distance,
            "m",
            "CS 25.113(a), (b)",
        ),
        Need("accelerate-stop distance", stop_kind, field.accelerate_stop, available.stop, "m", "CS 25.109"),
        Need("first segment gradient", "climb segment", FIRST_SEGMENT, climbs.first, "%", "CS 25.121(a)"),
        Need("second segment gradient", "climb segment", SECOND_SEGMENT, climbs.second, "%", "CS 25.121(b)"),
        Need("V1, for VMCG", "VMCG", field.slowest_v1, field.speeds.vr, "kt", "CS 25.107(a)(1), V1 up to VR"),
        Need("brake energy", "brake energy", field.brake_energy, 1.0, "%", "CS 25.735(f)"),
        Need("tyre speed", "tyre speed", field.tyre_speed, 1.0, "%", "CS 25.733"),
    ]
    return [need for need in wanted if not isnan(need.required)]
