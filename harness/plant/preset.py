"""Properties to put before the first frame, for flights that do not begin parked with cold engines."""

from math import cos, sin
from typing import NamedTuple

from harness.units import G0, LB

ENGINES = 4
INERTIA = 550.0  # kg m2 of a propeller and what turns with it, engine/gta_propeller.xml
SPEED = 88.2  # rad/s: 842 rpm, what the propellers are governed to in a take-off


class Running(NamedTuple):
    """An engine that has run for a while, standing at sea level on a standard day; elsewhere it settles in a second.

    What systems/propulsion-*.xml come to there: shaft power in kW, blade angle and the governor's share of it in deg.
    """

    power: float
    blade_angle: float
    governor_integral: float


TAKE_OFF = Running(7900.0, 27.0, 13.5)
IDLE = Running(260.0, -3.0, -6.0)


def lined_up(flap: float, engines: Running, rate: int) -> tuple[dict[str, float], dict[str, float]]:
    """The aircraft at the runway, engines running and flaps at position `flap` (0 up .. 1 landing).

    What to put before the first frame, and before the second; `rate` is frames a second. JSBSim lets nobody set a
    propeller's speed, and takes one at rest to turn with 1 rad/s: a power P for a frame of dt makes its speed P dt / I
    of the next. So the first frame has the power that brings it to SPEED at once.
    """
    states = {
        "propulsion/core-norm[{}]": 1.0,
        "propulsion/engine-power-kw[{}]": INERTIA * SPEED * rate / 1e3,
        "fadec/blade-angle-deg[{}]": engines.blade_angle,
        "fadec/governor-integral-deg[{}]": engines.governor_integral,
    }
    begun = {name.format(i): value for name, value in states.items() for i in range(ENGINES)}
    running = {f"propulsion/engine-power-kw[{i}]": engines.power for i in range(ENGINES)}
    return {**begun, "fcs/flap-pos-norm": flap}, running


def slope(rise: float, mass: float, heading: float) -> dict[str, float]:
    """A runway that rises by `rise` (m per m, positive uphill) towards `heading` (rad), for an aircraft of `mass` kg.

    JSBSim's ground is level. What a slope does to a take-off is to tilt gravity against the runway: this puts the
    component of the weight along the runway on the aircraft, as a force that stays for the whole flight. Heights are
    then heights above the plane of the runway. The component across, 1 - cos(slope), is 2e-4 at 2 %, and left out.
    """
    force = -mass * G0 * rise / (LB * G0)
    return {
        "external_reactions/slope/magnitude": force,
        "external_reactions/slope/x": cos(heading),
        "external_reactions/slope/y": sin(heading),
        "external_reactions/slope/z": 0.0,
    }
