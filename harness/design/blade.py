"""The propeller blade of the Generic Transport Aircraft: its shape, and the lift and drag of its sections."""

from __future__ import annotations

import csv
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLADE_FILE = Path(__file__).resolve().parents[2] / "engine" / "gta_blade.csv"
ROOT_CUT_OUT = 0.20
STATIONS = 24

LIFT_SLOPE = 0.95 * 2.0 * math.pi
"""Section lift slope, 1/rad: thin-aerofoil theory less 5 % for viscosity (Abbott and von Doenhoff, thin sections)."""
SKIN_FRICTION = 0.0035
"""Turbulent flat plate at the blade's Reynolds number of 3 to 6 million (Schlichting), erosion included."""
KORN_FACTOR = 0.94
"""Korn's technology factor; estimate: 0.87 is a NACA 6 section, 0.95 a supercritical wing."""


class Blade(NamedTuple):
    """The blade at the middle of each annulus: ratios to the radius or the diameter; rad."""

    radius: Array
    chord: Array
    twist: Array
    thickness: Array
    design_lift: Array
    sweep: Array


def read_blade(path: Path = BLADE_FILE, stations: int = STATIONS) -> Blade:
    """The blade of `path` at `stations` radii, closer together near the tip where the load falls off.

    Raises OSError when there is no such file, ValueError when it is not a blade.
    """
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    if not rows:
        raise ValueError(f"{path}: no blade stations")
    table = {name: np.array([float(row[name]) for row in rows]) for name in rows[0]}
    radius = middles(annulus_edges(stations))
    columns = ("chord_ratio", "twist", "thickness_ratio", "design_lift", "sweep")
    return Blade(radius, *(np.interp(radius, table["radius_ratio"], table[name]) for name in columns))


def annulus_edges(stations: int) -> Array:
    """Edges of the annuli as ratios to the radius, cosine-spaced towards the tip."""
    angle = np.linspace(0.0, 0.5 * math.pi, stations + 1)
    return np.asarray(ROOT_CUT_OUT + (1.0 - ROOT_CUT_OUT) * np.sin(angle), dtype=np.float64)


def middles(edges: Array) -> Array:
    """The middle of each interval."""
    return np.asarray(0.5 * (edges[1:] + edges[:-1]), dtype=np.float64)


def section(incidence: Array, mach: Array, chord_by_radius: Array, blade: Blade) -> tuple[Array, Array]:
    """Lift and drag coefficient of the sections at any incidence (rad) and Mach number.

    Attached flow: Prandtl-Glauert slope on the Mach number normal to the swept blade, friction and form drag,
    Korn's drag divergence with Lock's rise. Separated flow: flat plate normal force (Hoerner, Fluid-Dynamic Drag,
    ch. 3). Between the two a smooth step at the stalling angle, which rotation delays inboard (Snel, Houwink,
    Bosschers, ECN-C-93-052).
    """
    sweep = np.cos(blade.sweep)
    normal_mach = np.minimum(mach * sweep, 0.80)
    slope = LIFT_SLOPE / np.sqrt(1.0 - normal_mach**2)
    zero_lift = -blade.design_lift / LIFT_SLOPE
    from_zero_lift = np.arctan2(np.sin(incidence - zero_lift), np.cos(incidence - zero_lift))

    # estimate: cambered propeller sections of the ARA-D class; 1.70 puts the static thrust of 112 kN near the public
    # methods (PropFan map 104 kN, Hamilton Standard CR-2066 98 to 110 kN, other blade-element results 124 kN).
    highest_lift = 1.70 - 0.5 * normal_mach + 0.3 * np.sign(from_zero_lift) * blade.design_lift
    stall = highest_lift / slope
    beyond = np.abs(from_zero_lift) - stall - 0.03
    # The stall spreads over 0.03 rad, and over 0.10 rad beyond it at positive lift: fitted so that static thrust falls
    # about with the density once the blades stall, as Hamilton Standard's charts of static thrust go on, instead of
    # twice as fast (docs/assumptions.md).
    soft = (beyond > 0.0) & (from_zero_lift > 0.0)
    separated = 1.0 / (1.0 + np.exp(-beyond / np.where(soft, 0.10, 0.03)))

    attached_lift = slope * from_zero_lift
    plate_lift = 1.05 * np.sin(2.0 * incidence)
    lift = (1.0 - separated) * attached_lift + separated * plate_lift
    usable_lift = np.clip(attached_lift, -2.5, 2.5)
    delay = np.minimum(3.0 * chord_by_radius**2, 1.0) * np.cos(incidence) ** 2
    lift = lift + delay * separated * np.where(np.cos(from_zero_lift) > 0.0, usable_lift - lift, 0.0)

    form = 1.0 + 2.0 * blade.thickness + 60.0 * blade.thickness**4
    bounded = np.clip(attached_lift, -1.6, 1.6)
    divergence = (KORN_FACTOR - blade.thickness / sweep - 0.1 * np.abs(bounded) / sweep**2) / sweep
    critical = divergence - (0.1 / 80.0) ** (1.0 / 3.0)
    rise = np.minimum(20.0 * np.maximum(mach - critical, 0.0) ** 4, 0.10)
    # Thin sections separate at the nose before they stall: 0.12 (c_l - 0.8)^2, fitted likewise.
    nose = 0.12 * np.maximum(np.abs(bounded) - 0.8, 0.0) ** 2
    attached_drag = 2.0 * SKIN_FRICTION * form + 0.010 * (bounded - blade.design_lift) ** 2 + nose + rise
    plate_drag = 0.02 + 1.9 * np.sin(incidence) ** 2
    return lift, (1.0 - separated) * attached_drag + separated * plate_drag
