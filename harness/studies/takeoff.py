"""Cases of the kind "take-off": the take-off alone of the mission is flown, as by `harness takeoff`.

Taken from the mission: aircraft, take-off mass, VR, the day, and heading, elevation and slope of the departure runway.
"""

from collections.abc import Mapping, Sequence
from math import cos, sin
from typing import Any

from harness.manual import FlightManual, read_manual
from harness.mission.overrides import Override
from harness.mission.reader import read_mission
from harness.navigation.database import load
from harness.plant.hangar import park_again
from harness.studies.model import Subject
from harness.takeoff.case import FIXED_VR, TakeOff
from harness.takeoff.flight import fly_take_off
from harness.takeoff.rows import COLUMNS, row


def run_case(subject: Subject, overrides: Sequence[Override], seed: int) -> Mapping[str, Any]:  # noqa: ARG001
    """Fly the take-off of the mission with the overrides; nothing in it is random: the seed is not used.

    Raises InputError when it cannot be flown, FlightError when it did not fly.
    """
    case, manual = _case(subject, overrides)
    return row(fly_take_off(case, manual=manual))


def probe(subject: Subject, overrides: Sequence[Override]) -> None:
    """Read the mission with the overrides. Raises InputError for those that lead nowhere or lack their unit."""
    _case(subject, overrides)


def make_ready() -> None:
    """Have the aircraft loaded for the next case."""
    park_again()


def outputs() -> frozenset[str]:
    """The columns of a take-off's row."""
    return COLUMNS


def _case(subject: Subject, overrides: Sequence[Override]) -> tuple[TakeOff, FlightManual]:
    mission = read_mission(subject.file, overrides, text=subject.text)
    manual: FlightManual = read_manual(mission.aircraft)
    runway = load().runway(mission.departure.airport, mission.departure.runway)
    day = mission.environment
    angle = day.wind_from - runway.true_heading
    vr = mission.speeds["VR"].value if "VR" in mission.speeds else FIXED_VR
    case = TakeOff(
        mass=mission.loading.total(manual.limits["operating-empty-mass"]),
        vr=vr,
        isa_deviation=day.isa_deviation,
        qnh=day.qnh,
        elevation=runway.elevation,
        headwind=day.wind_speed * cos(angle),
        crosswind=day.wind_speed * sin(angle),
        slope=runway.slope,
        heading=runway.true_heading,
        aircraft=mission.aircraft,
    )
    return case, manual
