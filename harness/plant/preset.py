"""Properties to put before the first frame, for flights that do not begin parked with cold engines."""

from math import cos, sin

from harness.units import G0, LB

ENGINES = 4
RUNNING_POWER = 4000.0  # kW of each engine in the first frame; see `lined_up`
FINE_PITCH = (
    16.0  # deg: the fine-pitch stop on the ground with the lever at take-off, systems/propulsion-fadec.xml
)


def lined_up(flap: float) -> dict[str, float]:
    """The aircraft at the runway, engines running and flaps at position `flap` (0 up .. 1 landing).

    JSBSim lets nobody set a propeller's speed, so the propellers start from rest with a moderate power on their
    shafts, which brings them to their governed speed within two seconds, with less than 115 % of it on the way.
    """
    engines = {
        "propulsion/core-norm[{}]": 1.0,
        "propulsion/engine-power-kw[{}]": RUNNING_POWER,
        "fadec/blade-angle-deg[{}]": FINE_PITCH,
        "fadec/governor-integral-deg[{}]": FINE_PITCH,
    }
    running = {name.format(i): value for name, value in engines.items() for i in range(ENGINES)}
    return {**running, "fcs/flap-pos-norm": flap}


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
