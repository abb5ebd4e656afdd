"""Cases of the kind "flight": the whole mission is flown, and its summary is what came out."""

from collections.abc import Mapping, Sequence
from typing import Any

from harness.analysis.rejected import RejectedTakeOff
from harness.log import FlightLog, Inputs, conclude
from harness.manual import FlightManual, read_manual
from harness.mission.check import check
from harness.mission.overrides import Override
from harness.mission.reader import read_mission
from harness.plant.hangar import park_again
from harness.session import Session
from harness.studies.model import Subject
from harness.vocabulary import PHASES

MACHINE = frozenset({"wall_time_s", "real_time_factor", "versions"})
"""What a summary says of the computer rather than of the flight."""
NESTED = frozenset({"rejected_take_off", "phases"})
IN_PHASE = ("start", "end", "fuel", "distance")
"""What a summary has of each phase."""


def run_case(subject: Subject, overrides: Sequence[Override], seed: int) -> Mapping[str, Any]:  # noqa: ARG001
    """Fly the mission with the overrides; returns its summary. A flight has nothing random: the seed is not used.

    Raises InputError when it is not fit to fly, FlightError when the flight cannot be completed.
    """
    mission = read_mission(subject.file, overrides, text=subject.text)
    manual: FlightManual = read_manual(mission.aircraft)
    check(mission, manual)
    run, stopped = Session.of(mission, manual).fly()
    if stopped is not None:
        raise stopped
    return run.summary


def probe(subject: Subject, overrides: Sequence[Override]) -> None:
    """Read the mission with the overrides. Raises InputError for those that lead nowhere or lack their unit."""
    mission = read_mission(subject.file, overrides, text=subject.text)
    if mission.properties:  # only the aircraft itself knows which it has
        from harness.flight import prepare

        prepare(mission, read_manual(mission.aircraft), rate=120)


def make_ready() -> None:
    """Have the aircraft loaded for the next case."""
    park_again()


def outputs() -> frozenset[str]:
    """The paths of what a summary may hold: its numbers and words, those of a rejected take-off and of each phase."""
    summary = conclude(
        FlightLog(),
        Inputs(),
        identity=dict.fromkeys(("mission", "aircraft", "frame_rate_hz")),
        fixes={},
        last_waypoint="",
        mission_text="",
        wall_time=0.0,
        outcome="stopped",
        reason="nothing was flown",
    ).summary
    rejected = {f"rejected_take_off.{name}" for name in RejectedTakeOff._fields}
    phases = {f"phases[{phase}].{name}" for phase in PHASES for name in IN_PHASE}
    return frozenset(summary.keys() - MACHINE - NESTED | rejected | phases)
