"""The picture of the take-offs: height over distance, one curve a mass, as Fig. 14 of the paper."""

import importlib
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from harness.takeoff.case import FIXED_VR, TakeOff
from harness.takeoff.flight import CS25_SCREEN, SCREEN, Flown
from harness.units import KT

PUBLISHED = {89e3: 972.0, 124e3: 1367.0}  # kg: m to 35 m; AIAA 2010-7777, Results B
OTHER_READING = 140 * KT  # what the paper's "140 m/s" may have been meant to say


def beside(cases: Sequence[TakeOff]) -> list[TakeOff]:
    """The lightest and the heaviest of the paper's study, rotating at 140 kt instead; of another study none."""
    ends = (cases[0], cases[-1]) if len(cases) > 1 else (cases[0],)
    return [replace(case, vr=OTHER_READING) for case in ends if case.vr == FIXED_VR]


def load_pictures() -> None:
    """Import what drawing takes: it is done while the aircraft fly."""
    importlib.import_module("harness.analysis.plots.takeoffs")


def draw(flown: Sequence[Flown], other: Sequence[Flown], path: Path) -> None:
    """Draw the take-offs, and those of the other reading dashed, into a PNG."""
    from harness.analysis.plots.takeoffs import Curve, Point, Screen, take_offs

    curves = [
        Curve(
            f"{one.case.mass / 1e3:.4g} t" + (f", VR {one.vr / KT:.0f} kt" if one in other else ""),
            one.along.tolist(),
            one.height.tolist(),
            one.at(one.liftoff, "along"),
            one in other,
        )
        for one in (*flown, *other)
    ]
    published = [
        Point(along, SCREEN, f"{along:.0f} m, {mass / 1e3:.0f} t")
        for mass, along in PUBLISHED.items()
        if _as_the_paper(flown, mass)
    ]
    speeds = sorted({one.vr for one in flown})
    vr = f"VR {speeds[0]:.1f}" + (f" to {speeds[-1]:.1f}" if len(speeds) > 1 else "") + " m/s"
    screens = [Screen(SCREEN, "35 m, the paper's screen"), Screen(CS25_SCREEN, "35 ft, CS-25")]
    take_offs(curves, screens, published, f"Take-off over mass, {vr}", path)


def _as_the_paper(flown: Sequence[Flown], mass: float) -> bool:
    """Whether one of these is the paper's take-off at that mass: standard day, no wind, level runway."""
    return any(one.case == TakeOff(mass) for one in flown)
