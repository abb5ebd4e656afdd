"""What is said of an aircraft that hit the ground. JSBSim itself would go on for ever."""

from math import degrees

from harness.errors import GroundImpactError
from harness.state import State
from harness.units import KT

IMPACT_SINK = 5.0  # m/s at the wheels: about twice the limit descent velocity of CS 25.473 (3.05 m/s)
EMPTY = 1.0  # kg of fuel


def impact(state: State, sink: float, *, struck: bool) -> GroundImpactError:
    """The error for wheels that touched at `sink` m/s, or for a structure that was `struck`."""
    if not struck:
        what = f"the wheels hit the ground at {sink:.1f} m/s"
    elif state.gear < 1.0:
        what = "the fuselage, a wing or a propeller touched the ground, with the gear not down"
    else:
        what = "the fuselage, a wing or a propeller touched the ground"
    return GroundImpactError(
        what,
        time=state.time,
        phase="in the simulator",
        required=f"wheels only, at most {IMPACT_SINK:.0f} m/s",
        achieved=f"{state.cas / KT:.0f} kt, sinking at {sink:.1f} m/s, pitch {degrees(state.pitch):.0f} deg",
        knob="the tanks are empty: load more fuel"
        if state.fuel < EMPTY
        else "look at the pitch, speeds and levels before this moment in the time history",
    )
