"""The JSBSim properties behind State and Commands: the only place where the simulator's names and units are known."""

from math import pi
from typing import NamedTuple

from harness.state import FIELDS, Commands
from harness.units import FT, LB
from harness.world.atmosphere import GRAVITY

PSF = LB * GRAVITY / FT**2  # pounds force per square foot
KELVIN = 1.0 / 1.8  # from degrees Rankine
PRESSURE_ALTITUDE = "atmosphere/pressure-altitude"


class Binding(NamedTuple):
    """A property, and what one of its units is in SI."""

    name: str
    factor: float = 1.0


_STATE = {
    "time": Binding("simulation/sim-time-sec"),
    "latitude": Binding("position/lat-geod-rad"),
    "longitude": Binding("position/long-gc-rad"),
    "altitude": Binding("position/h-sl-ft", FT),
    "pressure_altitude": Binding(PRESSURE_ALTITUDE, FT),
    "height": Binding("position/h-agl-ft", FT),
    "cas": Binding("velocities/vc-fps", FT),
    "tas": Binding("velocities/vt-fps", FT),
    "mach": Binding("velocities/mach"),
    "velocity_north": Binding("velocities/v-north-fps", FT),
    "velocity_east": Binding("velocities/v-east-fps", FT),
    "vertical_speed": Binding("velocities/h-dot-fps", FT),
    "roll": Binding("attitude/phi-rad"),
    "pitch": Binding("attitude/theta-rad"),
    "heading": Binding("attitude/psi-rad"),
    "roll_rate": Binding("velocities/p-rad_sec"),
    "pitch_rate": Binding("velocities/q-rad_sec"),
    "yaw_rate": Binding("velocities/r-rad_sec"),
    "alpha": Binding("aero/alpha-rad"),
    "beta": Binding("aero/beta-rad"),
    "load_factor": Binding("accelerations/Nz"),
    "main_on_ground": Binding("gear/main-wow"),
    "nose_on_ground": Binding("gear/nose-wow"),
    "engines_failed": Binding("propulsion/engines-failed"),
    "flap": Binding("fcs/flap-pos-norm"),
    "gear": Binding("gear/gear-pos-norm"),
    "stall_warning": Binding("aero/stall-warning"),
    "mass": Binding("inertia/mass-kg"),
    "fuel": Binding("inertia/total-fuel-kg"),
    "fuel_used": Binding("propulsion/fuel-burned-kg"),
    "fuel_flow": Binding("propulsion/total-fuel-flow-kgps"),
    "thrust": Binding("propulsion/total-thrust-n"),
    "propeller_speed": Binding("propulsion/slowest-propeller-rpm", 2.0 * pi / 60.0),
    "pressure": Binding("atmosphere/P-psf", PSF),
    "temperature": Binding("atmosphere/T-R", KELVIN),
    "centre_of_gravity": Binding("inertia/cg-x-in", FT / 12),
    "dropped": Binding("payload/dropped-kg"),
    "fuel_leaked": Binding("fuel/leaked-kg"),
    "greatest_load_factor": Binding("extreme/nz-max"),
    "least_load_factor": Binding("extreme/nz-min"),
    "greatest_bank": Binding("extreme/bank-max-rad"),
    "greatest_alpha": Binding("extreme/alpha-max-rad"),
    "stall_warned": Binding("extreme/stall-warning"),
}
STATE: tuple[Binding, ...] = tuple(_STATE[field] for field in FIELDS)

SENSED = {
    "atmosphere/pressure-altitude": "sensor/pressure-altitude-ft",
    "velocities/vc-fps": "sensor/cas-fps",
    "velocities/vt-fps": "sensor/tas-fps",
    "velocities/mach": "sensor/mach",
    "atmosphere/T-R": "sensor/temperature-r",
    "atmosphere/P-psf": "sensor/pressure-psf",
    "velocities/h-dot-fps": "sensor/vertical-speed-fps",
    "velocities/p-rad_sec": "sensor/roll-rate-rad_sec",
    "velocities/q-rad_sec": "sensor/pitch-rate-rad_sec",
    "velocities/r-rad_sec": "sensor/yaw-rate-rad_sec",
    "accelerations/Nz": "sensor/load-factor",
    "attitude/phi-rad": "sensor/bank-rad",
    "attitude/theta-rad": "sensor/pitch-rad",
    "attitude/psi-rad": "sensor/heading-rad",
    "position/lat-geod-rad": "sensor/latitude-rad",
    "position/long-gc-rad": "sensor/longitude-rad",
    "velocities/v-north-fps": "sensor/velocity-north-fps",
    "velocities/v-east-fps": "sensor/velocity-east-fps",
    "position/h-agl-ft": "sensor/height-ft",
}
"""What a pilot who flies by the aircraft's sensors (systems/sensors.xml) reads in place of what; the same units."""

_COMMANDS = {
    "path": "path/target-rad",
    "vertical": "path/mode",
    "pitch": "path/attitude-target-rad",
    "pitch_hold": "ap/pitch-mode",
    "elevator": "fcs/elevator-cmd-norm",
    "bank_hold": "ap/roll-mode",
    "bank": "ap/bank-target-rad",
    "aileron": "fcs/aileron-cmd-norm",
    "coordinate": "ap/yaw-mode",
    "rudder": "fcs/rudder-cmd-norm",
    "steer": "fcs/steer-cmd-norm",
    "flap": "fcs/flap-cmd-norm",
    "gear": "gear/gear-cmd-norm",
    "speedbrake": "fcs/speedbrake-cmd-norm",
    "spoiler": "fcs/spoiler-cmd-norm",
    "ramp": "payload/ramp-cmd-norm",
    "release": "payload/release",
}
PILOT_GAINS = {
    "path-gain": "path/gain",
    "path-load-factor-increment": "path/load-factor-increment",
    "flare-path-gain": "path/flare-gain",
    "flare-load-factor-increment": "path/flare-load-factor-increment",
    "incidence-filter": "path/incidence-filter-sec",
    "pitch-rate": "path/pitch-rate-rad_sec",
}
"""Gains of the flight manual that the pilot's law in systems/path-hold.xml needs, SI."""
BRAKES = ("fcs/left-brake-cmd-norm", "fcs/right-brake-cmd-norm")
CROSSFEED: tuple[str, ...] = tuple(f"fuel/crossfeed-open[{engine}]" for engine in range(4))
THROTTLES: tuple[str, ...] = tuple(f"fcs/throttle-cmd-norm[{engine}]" for engine in range(4))
FUEL_LEVERS: tuple[str, ...] = tuple(f"propulsion/engine-run[{engine}]" for engine in range(4))
_SEVERAL = {"throttle": THROTTLES, "brake": BRAKES, "crossfeed": CROSSFEED, "shut_down": FUEL_LEVERS}
COMMANDS: dict[str, tuple[str, ...]] = {
    field: _SEVERAL.get(field) or (_COMMANDS[field],) for field in Commands._fields
}
"""The properties that each command is written to."""
