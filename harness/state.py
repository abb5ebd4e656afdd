"""What crosses between pilot and plant: `State` one way, `Commands` the other. SI and radians throughout."""

from typing import NamedTuple


class State(NamedTuple):
    """The aircraft as the pilot sees it at one instant.

    Angles are in radians, headings and tracks true and in [0, 2 pi). Heights and altitudes in metres. Well above the
    ground a plant may renew the fields from `altitude` on less often than at every pilot step, at least at 8 Hz.
    """

    time: float  # simulated time since the first frame, s
    height: float  # of the main wheels above the ground, aircraft level: 0 on the runway
    cas: float  # m/s
    tas: float
    vertical_speed: float  # up
    pitch: float  # nose up
    main_on_ground: float  # 0 or 1
    altitude: float  # above mean sea level (the chart's height)
    pressure_altitude: float  # ISA altitude of the static pressure, geopotential
    latitude: float  # geodetic, WGS84
    longitude: float
    velocity_north: float
    velocity_east: float
    heading: float  # true
    roll: float  # right wing down
    roll_rate: float  # body axes, rad/s
    pitch_rate: float
    yaw_rate: float
    alpha: float
    beta: float
    load_factor: float  # normal, 1 in level flight
    mach: float
    nose_on_ground: float
    flap: float  # 0 up .. 1 landing
    gear: float  # 0 up .. 1 down
    stall_warning: float  # 0 or 1
    mass: float  # kg
    fuel: float  # kg
    fuel_flow: float  # kg/s, all engines
    thrust: float  # N, all engines
    propeller_speed: float  # of the slowest propeller, rad/s
    pressure: float  # static, Pa
    temperature: float  # static, K


FAST_FIELDS = State._fields[: State._fields.index("altitude")]
"""The fields that are renewed at every pilot step."""


class Commands(NamedTuple):
    """What the pilot asks of the aircraft.

    `pitch` and `bank` are followed when the matching `*_hold` is 1 (the aircraft's attitude loops); otherwise the
    stick deflections `elevator` and `aileron` (-1..1, positive: nose down, right wing down) go to the surfaces.
    """

    throttle: float = 0.0  # thrust levers, -1 full reverse .. 0 idle .. 1 take-off
    pitch: float = 0.0  # rad
    bank: float = 0.0  # rad
    rudder: float = 0.0  # pedals, -1..1, positive: nose right
    steer: float = 0.0  # nose wheel, -1..1, positive: nose right
    brake: float = 1.0  # both sides
    pitch_hold: float = 0.0
    elevator: float = 0.0
    bank_hold: float = 0.0
    aileron: float = 0.0
    coordinate: float = 0.0  # 1: the aircraft keeps sideslip at zero; 0: pedals reach the rudder
    flap: float = 0.0
    gear: float = 1.0
    speedbrake: float = 0.0
    spoiler: float = 0.0  # ground spoilers
