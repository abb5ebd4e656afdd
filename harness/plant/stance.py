"""How an aircraft stands on its wheels, from statics: within a millimetre of JSBSim's trim, which costs 300 frames."""

from collections.abc import Callable
from math import atan2, cos, sin
from typing import NamedTuple

from harness.units import FT, G0, LB

INCH = FT / 12


class Stance(NamedTuple):
    """Height of the centre of gravity above the ground, m, and pitch attitude, rad."""

    height: float
    pitch: float


def stance(read: Callable[[str], float]) -> Stance:
    """Two springs, the nose leg and the main legs together, bear the weight as the lever rule says.

    `read` reads a property; masses must be set. The pitch is small: the springs are taken as vertical.
    """
    weight = read("inertia/weight-lbs") * LB * G0
    x, z = read("inertia/cg-x-in") * INCH, read("inertia/cg-z-in") * INCH
    nose_x, nose_z = (read(f"gear/unit[0]/{axis}-position") * INCH for axis in "xz")
    main_x, main_z = (read(f"gear/unit[1]/{axis}-position") * INCH for axis in "xz")
    nose = weight * (main_x - x) / (main_x - nose_x)
    nose_z += nose / read("gear/nose-stiffness-npm")
    main_z += read("gear/contact-margin-ft") * FT + (weight - nose) / read("gear/main-stiffness-npm")
    pitch = atan2(main_z - nose_z, main_x - nose_x)
    # the ground, of the structural frame (x aft, z up), below the centre of gravity
    return Stance((z - main_z) * cos(pitch) + (main_x - x) * sin(pitch), pitch)
