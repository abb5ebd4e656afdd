"""The ground roll of a take-off against an independent integration, and what a slope does to it."""

from dataclasses import dataclass, field

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from harness.flight import fly
from harness.log import Reporter
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.state import Commands, State
from harness.takeoff.case import TakeOff
from harness.takeoff.flight import Flown, fly_take_off, prepared
from harness.units import G0, LB

LBF = LB * G0
SLOW, FAST = 20.0, 60.0  # m/s: between them power and attitude are steady; the nose comes up later


@dataclass
class Forces:
    """What pulls and holds on the ground roll, at each step of the pilot: SI, along and normal to the runway."""

    plant: JSBSimPlant
    rows: list[tuple[float, float, float, float, float, float]] = field(default_factory=list)

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        if commands.brake or state.cas < 16.0:
            return
        fdm = self.plant.fdm
        turned = np.exp(1j * state.pitch)  # from body axes to the runway's
        pull, aero = (
            sum(fdm[f"forces/fbx-{part}-lbs"] - 1j * fdm[f"forces/fbz-{part}-lbs"] for part in parts)
            * turned
            * LBF
            for parts in (("prop", "external"), ("aero",))
        )
        speed = float(np.hypot(state.velocity_north, state.velocity_east))
        self.rows.append((state.time, speed, pull.real, -aero.real, (pull + aero).imag, state.mass))

    def note(self, event: object) -> None:
        pass


def rolled(case: TakeOff) -> tuple[Flown, np.ndarray]:
    pilot, plant, track = prepared(case)
    forces = Forces(plant)
    fly(pilot, plant, observers=(track, forces), until=lambda state: state.tas > FAST + 2.0)
    return track.flown(case, case.vr), np.array(forces.rows)


def test_ground_roll_against_an_independent_integration():
    """Distance from SLOW to FAST in still air: a point mass with the same thrust, drag, lift and friction."""
    case = TakeOff(105e3)
    flown, rows = rolled(case)
    _, speed, thrust, drag, lift, mass = rows.T
    friction = rolling_friction(case)

    polynomials = [np.polynomial.Polynomial.fit(speed, column, 3) for column in (thrust, drag, lift)]

    def acceleration(v: float) -> float:
        pull, brake, up = (polynomial(v) for polynomial in polynomials)
        weight = mass.mean() * G0
        return float((pull - brake - friction * (weight - up)) / mass.mean())

    # The distance in closed form, ds = v dv / a(v), and by the equation of motion over time.
    distance = quad(lambda v: v / acceleration(v), SLOW, FAST)[0]
    motion = solve_ivp(
        lambda t, y: (y[1], acceleration(y[1])),
        (0.0, 60.0),
        (0.0, SLOW),
        events=lambda t, y: y[1] - FAST,
        rtol=1e-8,
        max_step=0.1,
    )
    index = [np.interp(v, flown.ground_speed, np.arange(len(flown.time))) for v in (SLOW, FAST)]
    measured = flown.at(index[1], "along") - flown.at(index[0], "along")
    assert motion.y_events[0][0][0] == pytest.approx(distance, rel=1e-3)
    assert measured == pytest.approx(distance, rel=0.01)


def rolling_friction(case: TakeOff) -> float:
    _, plant, _ = prepared(case)
    return plant.fdm["gear/unit[1]/rolling_friction_coeff"]


def acceleration_at(flown: Flown, speed: float) -> float:
    """Acceleration, m/s2, from the time and speed 5 m/s on either side."""
    low, high = (np.interp(v, flown.ground_speed, flown.time) for v in (speed - 5.0, speed + 5.0))
    return 10.0 / (high - low)


@pytest.mark.parametrize("speed", [25.0, 45.0])
def test_two_per_cent_of_slope(speed):
    """2 % uphill against level takes g * 0.02 off the acceleration, downhill adds it, within 2 %."""
    level, up, down = (
        acceleration_at(fly_take_off(TakeOff(105e3, slope=slope)), speed) for slope in (0.0, 0.02, -0.02)
    )
    assert level - up == pytest.approx(0.02 * G0, rel=0.02)
    assert down - level == pytest.approx(0.02 * G0, rel=0.02)


def test_wind_acts_by_airspeed_alone():
    """In a headwind the roll to an airspeed is that of a point mass with so much less ground speed."""
    still, windy = (fly_take_off(TakeOff(105e3, headwind=wind)) for wind in (0.0, 8.0))
    speed = still.cas
    roll = (still.ground_speed > 28.0) & (speed < 62.0)
    v = still.ground_speed[roll]
    a = np.gradient(v, still.time[roll])
    expected = np.trapezoid((v - 8.0) / a, v)
    index = [
        np.interp(cas, windy.cas, np.arange(len(windy.time))) for cas in (speed[roll][0], speed[roll][-1])
    ]
    assert windy.at(index[1], "along") - windy.at(index[0], "along") == pytest.approx(expected, rel=0.01)


def test_wheels_that_roll_freely_need_not_be_stepped_in_every_frame():
    case = TakeOff(96e3)
    pilot, plant, track = prepared(case)
    plant.fdm["gear/longest-step-sec"] = 0
    fly(pilot, plant, observers=(track,), until=lambda state: state.height > 15.0)
    every = track.flown(case, 62.5)
    flown = fly_take_off(case, height=12.0)
    for index, other in ((flown.liftoff, every.liftoff), (flown.at_height(10.0), every.at_height(10.0))):
        assert flown.at(index, "along") == pytest.approx(every.at(other, "along"), abs=0.5)
