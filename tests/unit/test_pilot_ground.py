"""Steering and speeds on the ground."""

from math import cos, hypot, radians, sin, tan

import pytest

from harness.errors import OverrunError
from harness.manual import read_manual
from harness.navigation.database import load
from harness.pilot.ground import Centreline, GroundSteering, TaxiPath
from harness.state import FIELDS, State
from harness.world.local import LocalFrame, filleted

ORIGIN = (radians(50.0), radians(7.0))


def at(north: float, east: float, heading: float, speed: float) -> State:
    values = dict.fromkeys(FIELDS, 0.0) | {
        "latitude": ORIGIN[0] + north / 6_365_000.0,
        "longitude": ORIGIN[1] + east / (6_390_700.0 * cos(ORIGIN[0])),
        "heading": heading % (2 * 3.141592653589793),
        "velocity_north": speed * cos(heading),
        "velocity_east": speed * sin(heading),
    }
    return State(**values)


def test_a_filleted_corner_is_an_arc_of_the_radius() -> None:
    path = filleted([(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)], 40.0)
    centre = (60.0, 40.0)
    arc = [hypot(n - centre[0], e - centre[1]) for n, e in path if n > 60.5 and e < 39.5]
    assert arc
    assert arc == pytest.approx([40.0] * len(arc), abs=0.05)


def test_the_taxi_speed_falls_in_a_turn_and_to_zero_at_the_end() -> None:
    path = TaxiPath(LocalFrame(*ORIGIN), [(0.0, 0.0), (200.0, 0.0), (200.0, 200.0)], 40.0, 8.0)
    straight = path.follow(at(20.0, 0.0, 0.0, 8.0), 15.0)[1]
    for north in range(40, 180, 20):  # an aircraft comes along the path, it does not jump
        path.follow(at(north, 0.0, 0.0, 8.0), 15.0)
    turn = path.follow(at(188.3, 11.7, 0.8, 5.0), 15.0)[1]
    for east in range(30, 200, 20):
        path.follow(at(200.0, east, 1.57, 5.0), 15.0)
    end = path.follow(at(200.0, 199.5, 1.57, 0.5), 15.0)[1]
    assert straight == 8.0
    assert turn == pytest.approx((0.6 * 40.0) ** 0.5, rel=0.05)
    assert end == 0.0


def test_an_aircraft_follows_the_taxi_path_within_three_metres() -> None:
    gains = read_manual("gta").gains
    path = TaxiPath(
        LocalFrame(*ORIGIN), [(0.0, 0.0), (200.0, 0.0), (200.0, 200.0)], gains["taxi-turn-radius"], 8.0
    )
    steering = GroundSteering(gains)
    north = east = heading = 0.0
    dt, worst = 0.25, 0.0
    centreline = filleted([(0.0, 0.0), (200.0, 0.0), (200.0, 200.0)], gains["taxi-turn-radius"])
    for _ in range(1000):
        state = at(north, east, heading, 5.0)
        error, allowed, _ = path.follow(state, gains["taxi-look-ahead"])
        if not allowed:
            break
        wheel = steering.pursue(state, error, gains["taxi-look-ahead"]) * radians(50.0)
        heading += 5.0 * tan(wheel) / gains["wheelbase"] * dt
        north += 5.0 * cos(heading) * dt
        east += 5.0 * sin(heading) * dt
        worst = max(worst, min(hypot(n - north, e - east) for n, e in centreline))
    assert hypot(north - 200.0, east - 200.0) < 6.0
    assert worst < 3.0


def test_leaving_the_runway_is_an_overrun() -> None:
    runway = load().runway("EDDM", "26L")
    line = Centreline(runway)
    latitude, longitude = runway.point(runway.length + 20.0)
    beyond = State(**(dict.fromkeys(FIELDS, 0.0) | {"latitude": latitude, "longitude": longitude}))
    with pytest.raises(OverrunError, match="the end of runway EDDM 26L"):
        line.check(beyond, "LDG.roll-out")
    latitude, longitude = runway.point(1000.0, 60.0)
    beside = State(**(dict.fromkeys(FIELDS, 0.0) | {"latitude": latitude, "longitude": longitude}))
    with pytest.raises(OverrunError, match="the side of runway"):
        line.check(beside, "T/O.run")
