"""NASA's check cases of the equations of motion, as JSBSim scripts through the replay.

They are held against what the simulations of NASA/TM-2015-218675 published, and against an integration of the same
definitions that shares nothing with JSBSim: Dormand-Prince of order 8 in inertial axes.
"""

import csv
from collections.abc import Callable
from math import asin, atan2, cos, degrees, hypot, radians, sin, sqrt
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from harness.replay.player import Choices, replay
from harness.units import FT
from harness.world.atmosphere import density, geopotential

HOME = Path(__file__).parents[1] / "check_cases"
END = 30.0  # s
QUANTITIES = (
    *("altitude", "latitude", "longitude", "v_north", "v_east", "v_down"),
    *("roll", "pitch", "yaw", "p", "q", "r"),
)

# The Earth of the report, table 73.
RADIUS, FLATTENING = 6_378_137.0, 1 / 298.257223563  # m
GRAVITATION, J2 = 3.986004418e14, 0.00108262982  # m3/s2
SPIN = np.array([0.0, 0.0, 7.292115e-5])  # rad/s
ECCENTRICITY2 = FLATTENING * (2 - FLATTENING)
SLUG = 14.593902937  # kg


class Body(NamedTuple):
    """Mass (kg), inertia (kg m2), drag area (m2), and the damping moments over density, speed and rates (m4)."""

    mass: float
    inertia: np.ndarray
    drag: float
    damping: np.ndarray


def brick(*, damped: bool) -> Body:
    lengths = np.array([0.33333, 0.66667, 0.33333]) * FT
    damping = 0.22222 * FT**2 * lengths**2 / 4 if damped else np.zeros(3)
    inertia = np.array([0.001894220, 0.006211019, 0.007194665]) * SLUG * FT**2
    return Body(0.155404754 * SLUG, inertia, 0.0, damping)


def sphere(*, drag: float = 0.1) -> Body:
    return Body(SLUG, np.full(3, 3.6) * SLUG * FT**2, drag * 0.1963495 * FT**2, np.zeros(3))


class Case(NamedTuple):
    """Altitude (ft), velocity over the Earth (north, east, down, ft/s), heading (deg), inertial rates (rad/s) at the
    start, and the wind from the west (ft/s) at an altitude in feet.
    """

    body: Body
    altitude: float = 30_000.0
    velocity: tuple[float, float, float] = (0.0, 0.0, 0.0)
    heading: float = 0.0
    rates: tuple[float, float, float] = (0.0, 0.0, 0.0)
    wind: Callable[[float], float] = lambda _: 0.0


TUMBLE = (radians(10), radians(20), radians(30))
CASES = {
    1: Case(sphere(drag=0.0)),
    2: Case(brick(damped=False), rates=TUMBLE),
    3: Case(brick(damped=True), rates=TUMBLE),
    6: Case(sphere()),
    7: Case(sphere(), wind=lambda _: 20.0),
    8: Case(sphere(), wind=lambda altitude: 0.003 * altitude - 20),
    9: Case(sphere(), 0.0, (0.0, 1000.0, -1000.0), 90.0, (0.0, -SPIN[2], 0.0)),
    10: Case(sphere(), 0.0, (1000.0, 0.0, -1000.0), 0.0, (SPIN[2], 0.0, 0.0)),
}


@pytest.fixture(scope="module")
def published() -> dict[int, dict[str, tuple[float, float]]]:
    spreads: dict[int, dict[str, tuple[float, float]]] = {case: {} for case in CASES}
    with (HOME / "published.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            spreads[int(row["case"])][row["quantity"]] = float(row["least"]), float(row["most"])
    return spreads


@pytest.mark.parametrize(
    "case", [case if case in (3, 8, 10) else pytest.param(case, marks=pytest.mark.slow) for case in CASES]
)
def test_a_replayed_check_case_is_inside_the_published_spread(
    case: int, published: dict[int, dict[str, tuple[float, float]]], tmp_path: Path
) -> None:
    replayed, integrated = replayed_end(case, tmp_path), integrated_end(CASES[case])
    assert len(published[case]) >= 4
    for quantity, (least, most) in published[case].items():
        assert least <= replayed[quantity] <= most, quantity
        assert replayed[quantity] == pytest.approx(integrated[quantity], rel=0, abs=most - least), quantity


def replayed_end(case: int, folder: Path) -> dict[str, float]:
    """The last row of the script's own output, in feet and degrees."""
    run, stopped, _ = replay(str(HOME / "scripts" / f"atmos_{case:02}.xml"), folder, Choices(root=HOME))
    assert stopped is None
    assert run.folder is not None
    with (run.folder / "states.csv").open(encoding="utf-8") as file:
        time, *values = (float(value) for value in list(csv.reader(file))[-1])
    assert time == END
    end = dict(zip(QUANTITIES, values, strict=True))
    return {**end, "yaw": (end["yaw"] + 180) % 360 - 180, **{name: degrees(end[name]) for name in "pqr"}}


def integrated_end(case: Case) -> dict[str, float]:
    """The same by our own integration, in the same units."""
    heading = radians(case.heading)
    position = np.array([RADIUS + case.altitude * FT, 0.0, 0.0])
    north, east, down = (speed * FT for speed in case.velocity)
    velocity = np.array([-down, east, north]) + np.cross(SPIN, position)
    # Body axes at the start, in inertial axes, on the equator and the prime meridian.
    north_east_down = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    turn = np.array([[cos(heading), sin(heading), 0], [-sin(heading), cos(heading), 0], [0, 0, 1]])
    axes = turn @ north_east_down
    start = np.concatenate([position, velocity, axes.ravel(), case.rates])
    solution = solve_ivp(_derivative, (0.0, END), start, method="DOP853", rtol=1e-12, atol=1e-9, args=(case,))
    position, velocity, axes, rates = _parts(solution.y[:, -1])
    latitude, longitude, altitude = _geodetic(_spun(END) @ position)
    local = _north_east_down(latitude, longitude) @ _spun(END)
    over_earth = local @ (velocity - np.cross(SPIN, position))
    attitude = axes @ local.T
    roll, pitch, yaw = (
        atan2(attitude[1, 2], attitude[2, 2]),
        -asin(attitude[0, 2]),
        atan2(attitude[0, 1], attitude[0, 0]),
    )
    angles = (degrees(angle) for angle in (roll, pitch, yaw, *rates))
    place = (altitude / FT, degrees(latitude), degrees(longitude), *(over_earth / FT))
    return dict(zip(QUANTITIES, (*place, *angles), strict=True))


def _derivative(time: float, state: np.ndarray, case: Case) -> np.ndarray:
    position, velocity, axes, rates = _parts(state)
    latitude, longitude, altitude = _geodetic(_spun(time) @ position)
    east = _spun(time).T @ _north_east_down(latitude, longitude)[1]
    airspeed = velocity - np.cross(SPIN, position) - case.wind(altitude / FT) * FT * east
    speed, air = float(np.linalg.norm(airspeed)), density(geopotential(altitude))
    body = case.body
    acceleration = _gravitation(position) - air / 2 * speed * body.drag / body.mass * airspeed
    moment = -air * speed * body.damping * (rates - axes @ SPIN)
    turning = (moment - np.cross(rates, body.inertia * rates)) / body.inertia
    skew = np.array([[0, rates[2], -rates[1]], [-rates[2], 0, rates[0]], [rates[1], -rates[0], 0]])
    return np.concatenate([velocity, acceleration, (skew @ axes).ravel(), turning])


def _parts(state: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Position, velocity, the rows of body axes, all in inertial axes, and the rates in body axes."""
    return state[:3], state[3:6], state[6:15].reshape(3, 3), state[15:]


def _gravitation(position: np.ndarray) -> np.ndarray:
    """With the oblateness of the Earth. Source: NASA/TM-2015-218675, equations 29 to 31."""
    distance = float(np.linalg.norm(position))
    z2 = (position[2] / distance) ** 2
    factor = 1.5 * J2 * (RADIUS / distance) ** 2 * (5 * z2 - np.array([1, 1, 3]))
    return -GRAVITATION / distance**3 * position * (1 - factor)


def _spun(time: float) -> np.ndarray:
    """Turns inertial axes into those of the Earth, which are the same at time 0."""
    angle = SPIN[2] * time
    return np.array([[cos(angle), sin(angle), 0], [-sin(angle), cos(angle), 0], [0, 0, 1]])


def _geodetic(position: np.ndarray) -> tuple[float, float, float]:
    """Latitude, longitude and height over the ellipsoid, by iteration on the latitude."""
    x, y, z = (float(value) for value in position)
    equatorial = hypot(x, y)
    latitude = atan2(z, equatorial * (1 - ECCENTRICITY2))
    for _ in range(5):
        normal = RADIUS / sqrt(1 - ECCENTRICITY2 * sin(latitude) ** 2)
        latitude = atan2(z + ECCENTRICITY2 * normal * sin(latitude), equatorial)
    normal = RADIUS / sqrt(1 - ECCENTRICITY2 * sin(latitude) ** 2)
    return latitude, atan2(y, x), equatorial / cos(latitude) - normal


def _north_east_down(latitude: float, longitude: float) -> np.ndarray:
    """The rows of the local axes, in those of the Earth."""
    sin_lat, cos_lat, sin_lon, cos_lon = sin(latitude), cos(latitude), sin(longitude), cos(longitude)
    return np.array(
        [
            [-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat],
            [-sin_lon, cos_lon, 0.0],
            [-cos_lat * cos_lon, -cos_lat * sin_lon, -sin_lat],
        ]
    )
