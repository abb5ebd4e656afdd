"""A station beyond the horizon gives no guidance: the leg's course is flown by dead reckoning until it is received."""

from dataclasses import replace

import pytest

from harness.mission.model import Leg
from harness.mission.reader import read_mission
from harness.navigation.database import Ils, load
from harness.navigation.receivers import horizon
from harness.pilot.route import NavigationComputer
from harness.resources import missions
from harness.state import FIELDS, State
from harness.units import DEG, FT
from harness.world import earth

AWAY = 250e3  # m from the station


@pytest.fixture
def heard() -> list[tuple[str, bool]]:
    return []


@pytest.mark.parametrize("number", [0, 8])  # homing to COL, tracking to WLD
def test_what_is_below_the_horizon_is_not_followed(number: int, heard: list[tuple[str, bool]]) -> None:
    leg, *_ = legs = read_mission(missions()["cologne-munich"]).legs[number:]
    database = load()
    computer = NavigationComputer(
        legs, database.runway("EDDK", "13L"), Ils(database.runway("EDDM", "26L")), 101325.0, 25 * DEG
    )
    computer.on_reception = lambda leg, received: heard.append((leg.name, received))
    start = away_from(leg)
    low = replace(start, altitude=3000 * FT)
    assert horizon(low.altitude) + horizon(leg.fix.station.elevation if leg.fix.station else 0.0) < AWAY
    computer.update(low)
    assert heard == [(leg.name, False)]
    assert (computer.guidance.homing, computer.guidance.cross_track) == (False, 0.0)
    assert computer.guidance.course == pytest.approx(course_of(leg), abs=3 * DEG)
    computer.update(replace(start, altitude=30000 * FT))
    assert heard == [(leg.name, False), (leg.name, True)]
    assert computer.guidance.homing == (leg.mode == "homing")
    assert computer.waypoints_remaining == len(legs)


def course_of(leg: Leg) -> float:
    """The course towards the fix; a homing leg is flown from the west."""
    return 90 * DEG if leg.course_true is None else leg.course_true


def away_from(leg: Leg) -> State:
    """On the course to the fix."""
    back = course_of(leg) + 180 * DEG
    latitude, longitude = earth.direct(leg.fix.latitude, leg.fix.longitude, back, AWAY)
    state = State(*[0.0] * len(FIELDS))
    return replace(
        state, latitude=latitude, longitude=longitude, heading=course_of(leg), cas=120.0, velocity_east=120.0,
        pressure=90e3, temperature=280.0,
    )  # fmt: skip
