"""Homing and tracking in wind: the nose kept on the station drifts downwind, a course held corrects for it.

Both fly the same leg of 40 km across a steady wind of 40 kt.
"""

from math import hypot

import numpy as np
import pytest

from harness.session import Session
from harness.units import KT, NM
from harness.world import earth

WIND = 40 * KT
TRACKING = (
    "route/waypoint[across]/mode=tracking",
    "route/waypoint[across]/course=353.5 deg true",
)


class UntilAcross:
    """Ends the flight when the leg has been flown: the landing is not of interest."""

    def __init__(self):
        self.over = False

    def see(self, state, commands, pilot):
        if self.over:
            raise KeyboardInterrupt

    def note(self, event):
        self.over = self.over or (event.kind, event.name) == ("waypoint", "across")


@pytest.fixture(scope="module")
def leg(repository):
    """Flies the leg; returns metres along and right of the straight line from its start to the station, and TAS."""

    def flown(*changes):
        session = Session(repository / "tests" / "data" / "crosswind.xml", changes)
        run, _ = session.fly(progress=UntilAcross())
        start, across = run.passages[-2:]
        history, station = run.history, session.mission.legs[-1].fix
        rows = (history["time"] >= start.time) & (history["time"] <= across.time)
        course, _, _ = earth.inverse(start.latitude, start.longitude, station.latitude, station.longitude)
        line = (start.latitude, start.longitude, course)
        along, right = earth.offsets(*line, history["latitude"][rows], history["longitude"][rows])
        return along, right, float(np.mean(history["tas"][rows])), across.closest

    return flown


def pursuit(distance, ratio):
    """The largest distance off the straight line of a pursuit curve begun `distance` away, square to the wind.

    y(x) = a/2 ((x/a)^(1-k) - (x/a)^(1+k)), with k the wind over the airspeed, x the distance still to go along the
    line and a at the beginning. Source: G. Boole, A Treatise on Differential Equations (1859), ch. XI: the boat that
    is rowed towards a point across a stream; its greatest y where dy/dx = 0.
    """
    x = ((1 - ratio) / (1 + ratio)) ** (1 / (2 * ratio))
    return 0.5 * distance * (x ** (1 - ratio) - x ** (1 + ratio))


def test_homing_drifts_downwind_on_the_pursuit_curve_and_still_arrives(leg):
    along, right, tas, closest = leg()
    expected = pursuit(hypot(along[-1], right[-1]), WIND / tas)
    assert expected > 1 * NM
    assert float(np.max(right)) == pytest.approx(expected, rel=0.03)  # the wind comes from the left
    assert float(np.min(right)) > -0.1 * NM
    assert closest <= 0.3 * NM


def test_tracking_corrects_for_the_wind(leg):
    _, right, _, closest = leg(*TRACKING)
    assert float(np.max(np.abs(right))) <= 0.3 * NM
    assert float(np.max(np.abs(right[len(right) // 2 :]))) <= 0.02 * NM
    assert closest <= 0.3 * NM
