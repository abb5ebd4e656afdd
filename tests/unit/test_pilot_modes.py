"""The outer-loop controllers, flown against simple closed-form aircraft."""

from math import atan2, cos, hypot, pi, radians, sin, tan

import pytest

from harness.manual import FlightManual, read_manual
from harness.navigation.receivers import NeedleReading
from harness.pilot.modes.horizontal import HorizontalMode
from harness.pilot.modes.speed import SpeedMode
from harness.pilot.modes.vertical import VerticalMode
from harness.pilot.route import Guidance
from harness.state import FIELDS, State
from harness.units import FT, KT
from harness.world.atmosphere import GRAVITY

STEP = 1 / 24
LOOK = 24  # steps: the longest time between two turns of the outer loops
NO_SLOPE = NeedleReading(0.0, 0.0, received=False)


def state(**values: float) -> State:
    return State(**(dict.fromkeys(FIELDS, 0.0) | values))


@pytest.fixture(scope="module")
def manual() -> FlightManual:
    return read_manual("gta")


class Glider:
    """Pitch answers at once, the path follows with the lag of the lift: speed is constant."""

    def __init__(
        self, climb: float = 0.0, speed: float = 130.0, incidence: float = 0.05, lag: float = 1.5
    ) -> None:
        self.speed, self.incidence, self.lag = speed, incidence, lag
        self.climb, self.height = climb, 0.0

    def fly(self, pitch: float, dt: float) -> None:
        self.climb += (pitch - self.incidence - self.climb) * dt / self.lag
        self.height += self.speed * self.climb * dt

    def state(self) -> State:
        return state(
            tas=self.speed,
            cas=self.speed,
            vertical_speed=self.speed * self.climb,
            pitch=self.climb + self.incidence,
        )


def test_a_level_is_captured_without_overshoot_and_held(manual: FlightManual) -> None:
    """The path follows that of the mode as if the loops within were perfect but for a lag."""
    aircraft, mode, level = Glider(climb=0.1), VerticalMode(manual.gains), 600.0
    mode.select("NAV", aircraft.state())
    mode.guidance = "level"
    highest = 0.0
    for step in range(int(240 / STEP)):
        if step % LOOK == 0:
            mode.follow(aircraft.state(), LOOK * STEP)
            mode.aim(aircraft.state(), level - aircraft.height, NO_SLOPE, 0.0, 0.0)
        aircraft.fly(mode.path_angle + aircraft.incidence, STEP)
        highest = max(highest, aircraft.height)
    assert highest < level + 10 * FT
    assert aircraft.height == pytest.approx(level, abs=2.0)


def test_the_path_bends_no_faster_than_the_load_factor_increment(manual: FlightManual) -> None:
    aircraft, mode = Glider(), VerticalMode(manual.gains)
    mode.select("PATH", aircraft.state())
    mode.angle = radians(8)
    now = aircraft.state()
    mode.aim(now, 0.0, NO_SLOPE, 0.0, 0.0)
    before = mode.path_angle
    mode.follow(now, LOOK * STEP)
    increment = (mode.path_angle - before) / (LOOK * STEP) * aircraft.speed / GRAVITY
    assert increment == pytest.approx(manual.gains["path-load-factor-increment"], rel=1e-6)


class Turner:
    """A coordinated turn at constant airspeed in a steady wind; bank answers at once."""

    def __init__(self, heading: float, speed: float, wind: tuple[float, float] = (0.0, 0.0)) -> None:
        self.heading, self.speed, self.wind = heading, speed, wind
        self.north = self.east = 0.0

    def fly(self, bank: float, dt: float) -> None:
        self.heading += GRAVITY * tan(bank) / self.speed * dt
        north, east = self.velocity()
        self.north += north * dt
        self.east += east * dt

    def velocity(self) -> tuple[float, float]:
        return (
            self.speed * cos(self.heading) + self.wind[0],
            self.speed * sin(self.heading) + self.wind[1],
        )

    def state(self) -> State:
        north, east = self.velocity()
        return state(
            velocity_north=north, velocity_east=east, heading=self.heading % (2 * pi), tas=self.speed
        )


def test_tracking_corrects_for_the_wind(manual: FlightManual) -> None:
    aircraft, mode = Turner(heading=0.0, speed=130.0, wind=(0.0, 40 * KT)), HorizontalMode(manual.gains)
    mode.sub_mode, mode.guidance = "NAV", "route"
    for _ in range(int(300 / 0.5)):
        guidance = Guidance(homing=False, bearing_error=0.0, cross_track=aircraft.east, course=0.0)
        aircraft.fly(mode.update(aircraft.state(), guidance), 0.5)
    assert aircraft.east == pytest.approx(0.0, abs=5.0)
    assert aircraft.heading == pytest.approx(-0.159, abs=0.01)  # asin(20.6 / 130)


def test_homing_drifts_along_the_pursuit_curve(manual: FlightManual) -> None:
    """A nose kept on the station ends downwind of the straight line, as the curve of pursuit has it.

    Source: r(theta) of a pursuit at speed ratio k = wind / airspeed; the station is reached dead upwind.
    """
    distance, wind = 40_000.0, 40 * KT
    aircraft, mode = Turner(heading=0.0, speed=130.0, wind=(0.0, wind)), HorizontalMode(manual.gains)
    mode.sub_mode, mode.guidance = "NAV", "route"
    widest = 0.0
    while hypot(distance - aircraft.north, aircraft.east) > 500.0:
        bearing = atan2(-aircraft.east, distance - aircraft.north)
        error = (bearing - aircraft.heading + pi) % (2 * pi) - pi
        aircraft.fly(mode.update(aircraft.state(), Guidance(True, error, 0.0, 0.0)), 0.25)
        widest = max(widest, aircraft.east)
    # Closed form: with x = remaining distance along the wind-free line, y across, k = wind / airspeed,
    # y(x) = 0.5 x0 [(x/x0)^(1-k) - (x/x0)^(1+k)], greatest where (x/x0)^(2k) = (1-k)/(1+k).
    k = wind / 130.0
    ratio = ((1 - k) / (1 + k)) ** (1 / (2 * k))
    predicted = 0.5 * distance * (ratio ** (1 - k) - ratio ** (1 + k))
    assert widest == pytest.approx(predicted, rel=0.05)


def test_bank_never_exceeds_its_limit(manual: FlightManual) -> None:
    mode = HorizontalMode(manual.gains)
    mode.sub_mode, mode.guidance = "NAV", "route"
    for error in (-3.0, -1.0, 1.0, 3.0):
        bank = mode.update(Turner(0.0, 130.0).state(), Guidance(True, error, 0.0, 0.0))
        assert abs(bank) == pytest.approx(manual.gains["bank-limit"])


class Mass:
    """A point mass on a level path: thrust follows the lever with a lag, drag is constant."""

    def __init__(self, cas: float) -> None:
        self.cas, self.excess, self.thrust = cas, 0.0, 0.2

    def fly(self, lever: float, dt: float) -> None:
        self.thrust += (lever - self.thrust) * dt / 1.0
        self.cas += GRAVITY * (0.3 * self.thrust - 0.065) * dt

    def state(self) -> State:
        return state(cas=self.cas, tas=1.2 * self.cas)


def test_speed_by_thrust_settles_within_two_knots_and_the_lever_comes_to_rest(manual: FlightManual) -> None:
    aircraft, mode, target = Mass(110.0), SpeedMode(manual.gains), 130.0
    mode.lever = 0.2
    mode.select("THR")
    levers, speeds = [], []
    for _ in range(int(240 / 0.5)):
        now = aircraft.state()
        mode.observe(now, 0.5)
        mode.update(now, target, 0.0, 0.5)
        for _ in range(12):
            aircraft.fly(mode.lever, STEP)
        levers.append(mode.lever)
        speeds.append(aircraft.cas)
    assert max(speeds) < target + 2 * KT
    assert speeds[-1] == pytest.approx(target, abs=0.1 * KT)
    assert max(levers[-60:]) - min(levers[-60:]) < 0.002


def test_speed_by_pitch_never_dives_in_a_climb_nor_climbs_in_a_descent(manual: FlightManual) -> None:
    mode = SpeedMode(manual.gains)
    slow = state(cas=60.0, tas=60.0)
    mode.observe(slow, 0.5)
    mode.hand = 0.9
    assert mode.path(slow, 100.0) >= manual.gains["least-climb-angle"]
    mode.hand = 0.0
    assert mode.path(state(cas=150.0, tas=150.0), 80.0) <= -manual.gains["least-descent-angle"]
