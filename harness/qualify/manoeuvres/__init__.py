"""What a test guide may ask to be flown, by the names it uses."""

from collections.abc import Mapping
from types import MappingProxyType

from harness.qualify.manoeuvres import climb, cruise, engine, stall
from harness.qualify.outcome import Manoeuvre

MANOEUVRES: Mapping[str, Manoeuvre] = MappingProxyType(
    {
        "cruise": cruise.cruise,
        "heaviest at speed": cruise.heaviest,
        "sawtooth climb": climb.sawtooth,
        "climb to level": climb.climb_to_level,
        "ceiling": climb.ceiling,
        "engine-out climb": climb.engine_out_climb,
        "stall": stall.stall,
        "power-on stall": stall.power_on_stall,
        "minimum control speed in the air": stall.minimum_control_speed_air,
        "thrust at speed": engine.thrust_at_speed,
        "lever step": engine.lever_step,
    }
)
