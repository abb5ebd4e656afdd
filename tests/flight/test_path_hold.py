"""The pilot's law from flight path to pitch, in the simulator: what it asks for, and how the aircraft answers."""

from math import radians
from pathlib import Path

import pytest
from airborne import FT, Flight, named

from harness.manual import FlightManual, read_manual
from harness.plant.properties import PILOT_GAINS
from harness.world.atmosphere import GRAVITY

TURN = 1 / 30  # s, of the law at 120 frames a second


@pytest.fixture(scope="module")
def manual() -> FlightManual:
    return read_manual("gta")


@pytest.fixture
def flight(repository: Path, manual: FlightManual) -> Flight:
    aircraft = Flight(repository, named("circuit"))
    for gain, name in PILOT_GAINS.items():
        aircraft.fdm[name] = manual.gains[gain]
    return aircraft


def engage(flight: Flight) -> None:
    """Begin with the stick, and let the law take the attitude over."""
    flight.fdm["ap/pitch-mode"] = 0
    flight.fdm["path/attitude-target-rad"] = flight.fdm["attitude/theta-rad"]
    flight.fdm["path/mode"] = 1
    flight.run(TURN)
    flight.fdm["ap/pitch-mode"] = 1


def along(flight: Flight, path: float, law: float = 2.0) -> None:
    engage(flight)
    flight.run(2 * TURN)
    flight.fdm["path/target-rad"] = path
    flight.fdm["path/mode"] = law


def climb(flight: Flight) -> float:
    return flight.fdm["velocities/h-dot-fps"] / flight.fdm["velocities/vt-fps"]


def test_at_rest_it_leaves_the_attitude_to_others(flight: Flight) -> None:
    flight.fdm["ap/pitch-target-rad"] = 0.123
    flight.run(0.2)
    assert flight.fdm["ap/pitch-target-rad"] == 0.123


def test_engaging_does_not_kick(flight: Flight) -> None:
    """From an attitude being held, with the path and incidence of the moment."""
    along(flight, climb(flight))
    flight.run(TURN)
    assert flight.fdm["ap/pitch-target-rad"] == pytest.approx(flight.fdm["attitude/theta-rad"], abs=2e-4)


@pytest.mark.parametrize(
    ("law", "gain"), [(2.0, "path-load-factor-increment"), (3.0, "flare-load-factor-increment")]
)
def test_the_path_bends_no_faster_than_the_load_factor_increment(
    flight: Flight, manual: FlightManual, law: float, gain: str
) -> None:
    along(flight, climb(flight), law)
    flight.run(0.5)
    flight.fdm["path/target-rad"] += radians(8)
    before = flight.fdm["path/reference-rad"]
    flight.run(0.5)
    bend = (flight.fdm["path/reference-rad"] - before) / 0.5
    increment = bend * flight.fdm["velocities/vt-fps"] * FT / GRAVITY
    assert increment == pytest.approx(manual.gains[gain], rel=0.01)


def test_the_aircraft_follows_the_path(flight: Flight) -> None:
    """Lever and speed of the condition: what is left is the change of incidence that the filter has not seen yet."""
    for path in (radians(2), radians(-2)):
        along(flight, path)
        flight.run(12)
        assert climb(flight) == pytest.approx(path, abs=radians(0.15))


def test_the_attitude_goes_to_its_target_at_the_rate_of_the_manual(
    flight: Flight, manual: FlightManual
) -> None:
    engage(flight)
    begin = flight.fdm["ap/pitch-target-rad"]
    flight.fdm["path/attitude-target-rad"] = begin + radians(8)
    flight.run(1.0)
    moved = flight.fdm["ap/pitch-target-rad"] - begin
    assert moved == pytest.approx(manual.gains["pitch-rate"] * 1.0, abs=2 * TURN * manual.gains["pitch-rate"])
    flight.run(3.0)
    assert flight.fdm["ap/pitch-target-rad"] == begin + radians(8)


def test_a_stick_taken_over_is_followed(flight: Flight, manual: FlightManual) -> None:
    """So that the attitude begins where the stick left it."""
    engage(flight)
    flight.fdm["ap/pitch-mode"] = 0
    flight.fdm["fcs/elevator-cmd-norm"] = -0.1
    flight.run(1.0)
    assert flight.fdm["ap/pitch-target-rad"] == pytest.approx(flight.fdm["attitude/theta-rad"], abs=2e-3)


def test_it_flies_by_the_sensors_when_they_are_on(flight: Flight) -> None:
    """A vertical speed frozen while the aircraft climbs away is taken for the truth."""
    flight.fdm["sensor/active"] = 1
    flight.run(10.0)
    along(flight, 0.0)
    flight.fdm["failure/sensor-air-data"] = 1
    flight.run(2 * TURN)
    seen = flight.fdm["sensor/vertical-speed-fps"] / flight.fdm["sensor/tas-fps"]
    flight.fdm["path/target-rad"] = radians(2)
    flight.run(6.0)
    assert flight.fdm["path/angle-rad"] == pytest.approx(seen, rel=1e-9)
    assert climb(flight) - seen > radians(1)


def test_a_number_that_is_none_ends_the_simulation(flight: Flight) -> None:
    flight.fdm["inertia/pointmass-weight-lbs[0]"] = float("nan")
    assert not all(flight.fdm.run() for _ in range(5))
