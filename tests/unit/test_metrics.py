"""The numbers of a flight, from logs made so that the right answer is known."""

from dataclasses import replace
from math import isnan

import numpy as np
import pytest

from harness.analysis import metrics
from harness.log import Passage, Run
from harness.mission.model import Fix, Leg, Stand
from harness.navigation import database
from harness.units import DEG, KT, Level, Speed
from harness.world import earth

NAV = database.load()
RUNWAY = NAV.runway("EDDM", "26L")
RID = NAV.station("RID")


def a_run(history, passages=(), **summary):
    return Run(
        {name: np.asarray(column) for name, column in history.items()}, (), tuple(passages), summary, ""
    )


def a_passage(name, time):
    return Passage(name, time, *([0.0] * 11))


@pytest.mark.parametrize("outbound", [True, False])
def test_a_tracked_leg_is_measured_in_its_last_half(outbound):
    course = 148 * DEG
    along = np.linspace(0, 60e3, 121) if outbound else np.linspace(-60e3, -500, 121)
    across = np.where(np.arange(121) < 60, 900.0, -120.0)
    points = []
    for x, y in zip(along, across, strict=True):
        foot = earth.direct(RID.latitude, RID.longitude, course, x)
        _, at_foot, distance = earth.inverse(RID.latitude, RID.longitude, *foot)
        heading = course if distance < 1 else at_foot + (0 if x > 0 else np.pi)
        points.append(earth.direct(*foot, heading + np.pi / 2, y))
    latitude, longitude = np.transpose(points)
    history = {
        "time": np.arange(121.0),
        "latitude": latitude,
        "longitude": longitude,
        "distance": np.linspace(0, 6e4, 121),
    }
    leg = Leg("X", Fix(0, 0, RID), "tracking", course, Speed("CAS", 1), Level("FL", 1), "fly-over", (), 1)
    flown, missed = metrics.flown_legs(a_run(history, [a_passage("X", 120.0)]), [leg, leg])
    assert flown.leg.name == "X"
    assert flown.cross_track == pytest.approx(120, rel=2e-3)
    assert missed.passage is None
    assert isnan(missed.cross_track)


def a_landing(across=2.0, sink=0.8):
    along = np.concatenate((np.linspace(-6000, 400, 81), np.linspace(420, 2000, 79)))
    time = np.arange(160.0)
    latitude, longitude = np.transpose([RUNWAY.point(x, across) for x in along])
    ground = along > 410
    history = {
        "time": time,
        "latitude": latitude,
        "longitude": longitude,
        "altitude": RUNWAY.elevation + np.maximum(-along * 0.052, 0),
        "vertical_speed": np.where(ground, 0.0, -sink),
        "main_on_ground": ground.astype(float),
        "tas": np.where(ground, np.linspace(160, 5, 160), 66),
        "phase": np.where(ground, "LDG.roll-out", np.where(along < 0, "APP.final", "LDG.flare")),
        "target_glide_slope_dots": np.where(along < -5900, 1.5, -0.2),
        "target_localizer_dots": np.full(160, 0.1),
    }
    return a_run(history, touchdown_s=80.5)


def test_a_touchdown_is_located_on_the_runway():
    found = metrics.touchdown(a_landing(), RUNWAY)
    assert found.distance == pytest.approx(410, abs=0.1)
    assert found.across == pytest.approx(2, abs=0.01)
    assert found.sink == 0.8


def test_a_landing_roll_is_measured_to_its_end_and_ends_on_the_runway():
    run = a_landing(across=-2.5)
    assert metrics.roll_deviation(run, RUNWAY, "LDG") == pytest.approx(2.5, abs=0.01)
    assert metrics.stopping_margin(run, RUNWAY) == pytest.approx(RUNWAY.length - 2000, abs=0.1)


def test_a_landing_roll_that_ends_beside_the_runway_did_not_stop_on_it():
    assert isnan(metrics.stopping_margin(a_landing(across=40.0), RUNWAY))


def test_the_end_is_held_against_the_stand():
    latitude, longitude = RUNWAY.point(2000.0, 100.0)
    stand = Stand(*RUNWAY.point(2003.0, 104.0), 1.0)
    position = {"latitude": [0.0, latitude], "longitude": [0.0, longitude], "heading": [0.0, 1.1]}
    run = a_run(position | {"velocity_north": [9.0, 0.3], "velocity_east": [9.0, 0.4]})
    found = metrics.parked(run, stand)
    assert found.distance == pytest.approx(5.0, abs=0.02)
    assert (found.heading_error, found.speed) == (pytest.approx(0.1), pytest.approx(0.5))
    assert isnan(metrics.parked(run, None).distance)


def test_the_approach_is_judged_below_1000_feet():
    assert metrics.approach_dots(a_landing(), RUNWAY) == (0.2, 0.1)


def test_what_was_not_flown_is_not_a_number():
    run = a_landing()
    run = replace(run, summary={"touchdown_s": None})
    assert all(isnan(number) for number in metrics.touchdown(run, RUNWAY))
    assert isnan(metrics.roll_deviation(run, RUNWAY, "T/O"))


class Manual:
    """As much of a flight manual as the envelope needs."""

    limits = {"VMO": 300 * KT, "MMO": 0.7, "VLO": 220 * KT}  # noqa: RUF012

    class Flap:
        def __init__(self, name, position, maximum_speed):
            self.name, self.position, self.maximum_speed = name, position, maximum_speed

    flaps = (Flap("up", 0.0, 300 * KT), Flap("take-off", 0.5, 200 * KT), Flap("landing", 1.0, 170 * KT))

    def stall_speed(self, mass, flaps):
        return {"up": 60.0, "take-off": 50.0, "landing": 40.0}[flaps] * np.sqrt(mass / 100e3)


def test_the_envelope_is_that_of_the_flight_in_the_air():
    history = {
        "time": np.arange(5.0),
        "main_on_ground": np.array([1.0, 0, 0, 0, 1]),
        "cas": np.array([290.0, 180 * KT, 250 * KT, 150 * KT, 10]),
        "mach": np.array([0.9, 0.3, 0.5, 0.25, 0.1]),
        "flap": np.array([0.5, 0.25, 0.0, 1.0, 1.0]),
        "gear": np.array([1.0, 0.5, 0.0, 1.0, 1.0]),
        "greatest_bank": np.array([0.0, 0.4, 0.4, 0.4, 0.4]),
        "least_load_factor": np.array([1.0, 0.9, 0.9, 0.9, 0.9]),
        "greatest_load_factor": np.array([1.0, 1.0, 1.2, 1.2, 1.2]),
        "mass": np.full(5, 100e3),
        "stall_warned": np.zeros(5),
    }
    found = metrics.envelope(a_run(history), Manual())
    assert found.bank == 0.4
    assert (found.load_factor_low, found.load_factor_high) == (0.9, 1.2)
    assert found.vmo_margin / KT == pytest.approx(50)
    assert found.mmo_margin == pytest.approx(0.2)
    assert found.flap_speed_margin / KT == pytest.approx(
        20
    )  # moving to take-off, or landing, whichever is closer
    assert found.gear_speed_margin / KT == pytest.approx(40)
    assert found.stall_ratio == pytest.approx(180 * KT / 55)
    assert not found.stall_warning
