"""What a test guide may ask to be flown, by the names it uses."""

from collections.abc import Mapping
from types import MappingProxyType

from harness.qualify.manoeuvres import (
    bookkeeping,
    climb,
    cruise,
    engine,
    ground,
    handling,
    landing,
    payload,
    payload_range,
    stall,
    takeoff,
)
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
        "take-off": takeoff.take_off,
        "brake hold": ground.brake_hold,
        "coast-down": ground.coast_down,
        "wheel spin-up": ground.spin_up,
        "stopping by brakes": ground.stopping,
        "turn on the ground": ground.turn,
        "minimum control speed on the ground": takeoff.minimum_control_speed_ground,
        "landing": landing.landing,
        "airdrop": payload.airdrop,
        "longitudinal modes": handling.longitudinal,
        "lateral modes": handling.lateral,
        "bank change": handling.bank_change,
        "payload-range": payload_range.payload_range,
        "mass bookkeeping": bookkeeping.mass,
        "energy bookkeeping": bookkeeping.energy,
        "rotation bookkeeping": bookkeeping.rotation,
        "rating": engine.rating,
        "lever step": engine.lever_step,
    }
)
