"""The speeds of CS 25.103 to 25.107 for one take-off: minimum control speeds flown, the others from them."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import cache
from math import cos, isnan, nan, sin
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from harness.errors import FlightError, OverrunError
from harness.flight import fly
from harness.manual import FlightManual
from harness.mission.envelope import SLOWEST_DECISION
from harness.numerics import wrap
from harness.state import State
from harness.takeoff.case import Happening, TakeOff, fine, lightest
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import TIME_LIMIT, prepared
from harness.units import FT, TONNE

DEVIATION = 30 * FT  # CS 25.149(e): the most the path may leave the line, rudder alone
SLOWEST, START, FASTEST, UPWARDS = 30.0, 50.0, 85.0, 2.0  # m/s: VMCG lies between, looked for in these steps
BEGUN = 2.0  # m/s beyond the failure the path has left the line
ROLL_ON = 14.0  # m/s beyond it the path is parallel to the line again, or lost
TOLERANCE = 0.1  # m/s
HIGH = 100.0  # m: in the air, for VMCA
STEADY = 12.0  # s after full rudder; the first swing is not looked at
TURN_OVER = 1.0  # s
NO_SLOWER = 5.0  # s
V2_OVER_VMCA, VR_OVER_VMCA = 1.10, 1.05  # CS 25.107(b)(3), (e)(1)(ii)
V2_OVER_VSR = 1.08  # CS 25.107(b)(2)(i): turbo-propeller powered, more than three engines
PILOT_RATE = 24  # 1/s: as in a mission; minimum control speeds are told to a tenth of a metre a second
GAINED = 3.0  # m/s from VR to 35 ft with an engine failed; estimate, put right by flights (FieldFlights)


class ControlSpeeds(NamedTuple):
    """Minimum control speeds of a day, m/s CAS: one of each for every mass, as CS 25.149 wants them.

    They are flown at the lightest take-off mass, where both are greatest: there the wheels hold least on the ground,
    and in the air 5 deg of bank carry least of the rudder's side force. `vmca` is NaN when even there the aircraft
    flies straight down to the slowest speed it flies at all; `vmca_told` then says so.
    """

    vmcg: float
    vmca: float
    vmca_told: str


class Speeds(NamedTuple):
    """Speeds of one take-off, m/s CAS. `vmca` is NaN where `vmca_told` says why; then it limits nothing."""

    vs: float  # power-off 1-g stall speed, from the flight manual's lift coefficient: not flown
    vmcg: float
    vmca: float
    vmca_told: str
    v2_min: float
    v2: float
    vr_min: float
    vr: float


def control_speeds(case: TakeOff, manual: FlightManual, workers: int = 1) -> ControlSpeeds:
    """Fly for VMCG and VMCA of the day of `case`, in still air on a level dry runway. Raises FlightError."""
    light = replace(
        fine(case),
        mass=lightest(manual),
        vr=None,
        surface="dry",
        headwind=0.0,
        crosswind=0.0,
        slope=0.0,
        pilot_rate=PILOT_RATE,
    )
    ground, air = fly_all(_minimum, [(vmcg, light, manual), (vmca, light, manual)], workers, light)
    told = (
        ""
        if not isnan(air)
        else f"straight to the slowest it flies even at {light.mass / TONNE:.1f} t: limits nothing"
    )
    return ControlSpeeds(ground, air, told)


def _minimum(asked: tuple[Callable[[TakeOff, FlightManual], float], TakeOff, FlightManual]) -> float:
    find, case, manual = asked
    return find(case, manual)


def take_off_speeds(case: TakeOff, manual: FlightManual, control: ControlSpeeds) -> Speeds:
    """The speeds of a mass that follow from those of the day. VR is the case's, else a first guess of the least."""
    stall = manual.stall_speed(case.mass, case.flaps)
    v2_min = float(np.fmax(V2_OVER_VSR * stall, V2_OVER_VMCA * control.vmca))
    v2 = max(manual.speed("V2", case.mass), v2_min)
    vr_min = float(np.fmax(SLOWEST_DECISION * stall, VR_OVER_VMCA * control.vmca))
    vr = max(v2 - GAINED, vr_min) if case.vr is None else case.vr
    return Speeds(stall, *control, v2_min, v2, vr_min, vr)


def vmcg(case: TakeOff, manual: FlightManual) -> float:
    """Minimum control speed on the ground, CS 25.149(e).

    Flown, with brackets on the failure speed: the outer engine fails, the nose wheel is free, the path leaves the
    line by 30 ft until it is parallel to it again. The rudder is the pilot's.
    """

    @cache
    def beyond(vef: float) -> float:
        return _deviation(vef, case, manual) - DEVIATION

    low = START
    while beyond(low) <= 0.0:
        low -= UPWARDS
        if low < SLOWEST:
            return SLOWEST
    # Upwards: a light aircraft, nearly carried by its wings, drifts again as much when it is faster.
    while beyond(low + UPWARDS) > 0.0:
        low += UPWARDS
        if low > FASTEST:
            raise FlightError(
                f"an outer engine failing at {FASTEST:.0f} m/s still takes it off the line by more than 30 ft",
                time=0.0,
                phase="VMCG",
            )
    return float(brentq(beyond, low, low + UPWARDS, xtol=TOLERANCE))


def _deviation(vef: float, case: TakeOff, manual: FlightManual) -> float:
    """The farthest the main wheels come off the line, m, capped where the runway is left."""
    fast = replace(case, vr=manual.flap(case.flaps).maximum_speed, crosswind=0.0)
    pilot, plant, track = prepared(fast, Happening(vef=vef, steering=False), manual)

    def over(state: State) -> bool:
        """Parallel to the line again (the engine on the left failed), or off the ground."""
        sideways = state.velocity_east * cos(case.heading) - state.velocity_north * sin(case.heading)
        return (
            (state.cas > vef + BEGUN and sideways >= 0.0) or state.cas > vef + ROLL_ON or state.height > 1.0
        )

    try:
        fly(pilot, plant, observers=(track,), time_limit=TIME_LIMIT, until=over)
    except OverrunError:
        return 2.0 * DEVIATION
    return min(float(abs(track.flown(fast, vef).across).max()), 2.0 * DEVIATION)


def vmca(case: TakeOff, manual: FlightManual) -> float:
    """Minimum control speed in the air, CS 25.149(b): the slowest straight flight with full rudder and 5 deg of bank.

    Flown: the outer engine fails in the take-off; once safely up the aircraft is banked towards the live engines with
    full rudder and slowed down by pitch at take-off power. Faster than VMCA it turns towards the live engines, slower
    towards the failed one. NaN when it stalls before, or gets no slower. Raises FlightError when that flight fails.
    """
    vr = 1.2 * manual.stall_speed(case.mass, case.flaps)
    climbing = replace(case, vr=vr, crosswind=0.0)
    pilot, plant, _ = prepared(climbing, Happening(vef=vr - 1.0, v2=1.1 * vr, slow_down=True), manual)
    seen: list[tuple[float, float, float]] = []  # time, speed, heading since full rudder was given

    def over(state: State) -> bool:
        if pilot.control.owners["rudder"] != "DIRECT" or state.height < HIGH:
            return False
        seen.append((state.time, state.cas, wrap(state.heading - case.heading)))
        if state.time < seen[0][0] + STEADY:
            return False
        return bool(state.stall_warning) or _turn(seen) < 0.0 or slowest()

    def slowest() -> bool:
        """No slower than some seconds ago: incidence is protected."""
        before = next(one for one in reversed(seen) if one[0] <= seen[-1][0] - NO_SLOWER)
        return seen[-1][1] > before[1] - 0.01 * NO_SLOWER

    fly(pilot, plant, time_limit=TIME_LIMIT, until=over)
    return nan if plant.state().stall_warning or _turn(seen) >= 0.0 else seen[-1][1]


def _turn(seen: Sequence[tuple[float, float, float]]) -> float:
    """The rate of turn over the last second, towards the live engines (right), rad/s."""
    now = seen[-1]
    before = next(one for one in reversed(seen) if one[0] <= now[0] - TURN_OVER)
    return (now[2] - before[2]) / (now[0] - before[0])
