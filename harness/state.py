"""What crosses between pilot and plant: `State` one way, `Commands` the other. SI and radians throughout."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from functools import partial
from math import ceil
from operator import attrgetter
from typing import NamedTuple


@dataclass(slots=True)
class Motion:
    """What of a State is renewed whenever the pilot's outer loops turn; the first four whenever the pilot looks."""

    time: float  # simulated time since the first frame, s
    vertical_speed: float  # m/s, up
    pitch: float  # nose up
    cas: float  # m/s
    height: float  # of the main wheels above the ground, aircraft level: 0 on the runway
    tas: float
    altitude: float  # above mean sea level (the chart's height)
    pressure_altitude: float  # ISA altitude of the static pressure, geopotential
    latitude: float  # geodetic, WGS84
    longitude: float
    velocity_north: float
    velocity_east: float
    heading: float  # true
    roll: float  # right wing down
    main_on_ground: float  # 0 or 1
    engines_failed: float  # without combustion: 1 for engine 1, 2, 4, 8 for the others, summed
    yaw_rate: float  # body axes, rad/s


@dataclass(slots=True)
class State(Motion):
    """The aircraft as the pilot sees it: live, renewed in place by the plant. What is to be kept must be copied.

    Angles are in radians, headings and tracks true and in [0, 2 pi). Heights and altitudes in metres. A plant renews
    time, vertical speed, pitch and CAS whenever it stops for the pilot, all of Motion `rest` steps after it did so, and
    the other fields twelve times a second on and just above the runway, once a second elsewhere.
    """

    load_factor: float  # normal, 1 in level flight
    stall_warning: float  # 0 or 1
    mass: float  # kg
    fuel: float  # kg
    fuel_used: float  # kg, the integral of the fuel flow over every frame
    nose_on_ground: float
    roll_rate: float
    pitch_rate: float
    alpha: float
    beta: float
    mach: float
    flap: float  # 0 up .. 1 landing
    gear: float  # 0 up .. 1 down
    fuel_flow: float  # kg/s, all engines
    thrust: float  # N, all engines
    propeller_speed: float  # of the slowest propeller, rad/s
    pressure: float  # static, Pa
    temperature: float  # static, K
    centre_of_gravity: float  # aft of the nose, m
    dropped: float  # kg of load gone over the ramp
    fuel_leaked: float  # kg
    greatest_load_factor: float  # since the first lift-off, airborne, as are the following: seen at 60 Hz
    least_load_factor: float
    greatest_bank: float  # rad, either way
    greatest_alpha: float  # rad
    stall_warned: float  # 1 once the stall warning has sounded


FIELDS: tuple[str, ...] = tuple(field.name for field in fields(State))
values: Callable[[State], tuple[float, ...]] = attrgetter(*FIELDS)
"""The numbers of a State, in the order of FIELDS."""
MOTION: tuple[str, ...] = tuple(field.name for field in fields(Motion))
MEDIUM_PERIOD = 12  # pilot steps: 2 Hz
SLOW_PERIOD = 24
WELL_CLEAR = 600.0  # m above the ground
STEADY_BANK = 0.02  # rad
LOW = 100.0  # m above the ground
BRISK = 15.0  # m/s: faster than taxiing
ROLLING = 1.0 / 12.0  # s between two turns of the outer loops on the runway and climbing away from it
EXACT = 1.0 / 60.0  # s
CLIMBING = 1.0  # m/s: the ground does not come nearer
ON_WHEELS = 1.0  # m: with the wheels on the ground, whatever the struts do
NOSE_UP = 0.02  # rad, attitude of the nose: level is up, standing is below level


def close_to_ground(height: float, cas: float) -> bool:
    """Whether the pilot looks, and the log records, many times a second: on and just above the runway."""
    return height < LOW and cas > BRISK


def rolling_period(step: float) -> int:
    """Pilot steps of `step` seconds in ROLLING, at least 1; 2 for who takes so short ones that he wants to be EXACT."""
    return 2 if step <= EXACT else max(ceil(ROLLING / step - 0.01), 1)


def rest(state: Motion, step: int, rolling: int) -> int:
    """Pilot steps from `step` until the outer loops turn and Motion is renewed again.

    To the next multiple of `rolling`, see `rolling_period`, on the runway and climbing away from it; of half of it
    while the ground comes nearer, a quarter while the nose is up and the wheels are about to leave it or have just
    touched; else to the next multiple of a second with wings level aloft, of half a second elsewhere.
    Multiples, because the log records on them: never an older position than its time.
    """
    period = MEDIUM_PERIOD
    if state.height < LOW:
        if state.cas > BRISK:
            if state.height < ON_WHEELS:
                period = rolling if state.pitch < NOSE_UP else max(rolling // 4, 1)
            else:
                period = rolling if state.vertical_speed > CLIMBING else max(rolling // 2, 1)
    elif state.height > WELL_CLEAR and -STEADY_BANK < state.roll < STEADY_BANK:
        period = SLOW_PERIOD
    return period - step % period


TO_ATTITUDE, ALONG_PATH, FLARING = 1.0, 2.0, 3.0
"""What `Commands.vertical` asks for: an attitude, a flight path, or one with the gains of the flare."""


class Commands(NamedTuple):
    """What the pilot asks of the aircraft.

    An attitude is followed when the matching `*_hold` is 1 (the aircraft's attitude loops); otherwise the
    stick deflections `elevator` and `aileron` (-1..1, positive: nose down, right wing down) go to the surfaces.
    The pitch attitude is that of `vertical`, one of the three below (systems/path-hold.xml).
    """

    throttle: float = 0.0  # thrust levers, -1 full reverse .. 0 idle .. 1 take-off
    path: float = 0.0  # climb over airspeed, rad
    bank: float = 0.0  # rad
    rudder: float = 0.0  # pedals, -1..1, positive: nose right
    steer: float = 0.0  # nose wheel, -1..1, positive: nose right
    brake: float = 1.0  # both sides
    coordinate: float = 0.0  # 1: the aircraft keeps sideslip at zero; 0: pedals reach the rudder
    vertical: float = TO_ATTITUDE
    pitch: float = 0.0  # the attitude to go to, rad
    pitch_hold: float = 0.0
    elevator: float = 0.0
    bank_hold: float = 0.0
    aileron: float = 0.0
    flap: float = 0.0
    gear: float = 1.0
    speedbrake: float = 0.0
    spoiler: float = 0.0  # ground spoilers
    crossfeed: float = 0.0  # 1: all crossfeed valves open
    ramp: float = 0.0  # 0 closed .. 1 open
    release: float = 0.0  # number of the load to go, in the order of `Mission.released`
    shut_down: float = 0.0  # engines whose fuel is cut: 1 for engine 1, 2, 4, 8 for the others, summed


new_commands: Callable[[Iterable[float]], Commands] = partial(tuple.__new__, Commands)
"""From all the values in order, without the keywords and defaults, which cost more than the rest."""
