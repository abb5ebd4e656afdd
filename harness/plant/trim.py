"""Trim with frozen motion: the aircraft is held still in moving air until engines and systems are steady, and Newton's
method looks for the incidence, controls and thrust with which nothing accelerates.

JSBSim's own trim does not run the control systems, so it cannot trim an aircraft whose engines live there.
"""

from collections.abc import Mapping, Sequence
from math import cos, radians, sin
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import root

from harness.errors import FlightError
from harness.plant.bench import Attitude, Bench

SCALE = {
    "alpha": radians(5.0),
    "beta": radians(3.0),
    "bank": radians(3.0),
    "path": radians(5.0),
    "elevator": 0.2,
    "aileron": 0.2,
    "rudder": 0.2,
    "throttle": 0.2,
}
"""What each unknown is measured in, so that Newton's steps are alike. Controls as commands -1..1."""
SETTLE = 2.0  # s of frozen time before forces are read: actuators, downwash, engines following the lever
ENGINE_SETTLE = 4.0  # s, while the lever is one of the unknowns
FORCES = ("forward acceleration", "downward acceleration", "pitch acceleration")
SIDES = ("side acceleration", "roll acceleration", "yaw acceleration")
STOPPED = 2.0  # m/s2 for the whole travel of the lever, about what it gives within
GOOD = 2e-3  # m/s2 and rad/s2 x 10: what is left may shift a flight by metres within half a minute


class NoTrimError(FlightError):
    """The aircraft cannot be balanced so: beyond its power, its lift or its controls."""


class Trim(NamedTuple):
    """A balanced flight condition; controls as commands."""

    attitude: Attitude
    controls: Mapping[str, float]


def trim(
    bench: Bench,
    altitude: float,
    attitude: Attitude,
    unknowns: Sequence[str] = ("alpha", "elevator", "throttle"),
    *,
    controls: Mapping[str, float] | None = None,
    growth: float = 0.0,
    heading: float = 0.0,
) -> Trim:
    """Balance the aircraft at a pressure altitude, starting from `attitude` and `controls`.

    Three unknowns balance the plane of symmetry, six everything. `growth` is the speed gained with height, 1/s,
    along the path (a climb at constant calibrated airspeed is not unaccelerated). Raises NoTrimError.
    """
    start = {"elevator": 0.0, "aileron": 0.0, "rudder": 0.0, "throttle": 0.5, **(controls or {})}
    settle = ENGINE_SETTLE if "throttle" in unknowns else SETTLE
    names = FORCES if len(unknowns) == len(FORCES) else FORCES + SIDES
    first = np.array([(attitude._asdict() | start)[name] / SCALE[name] for name in unknowns])
    bench.put("fuel/freeze", 1.0)
    fly_by_hand(bench)

    def settled(values: NDArray[np.float64]) -> tuple[Attitude, dict[str, float]]:
        chosen = {name: float(value) * SCALE[name] for name, value in zip(unknowns, values, strict=True)}
        now = attitude._replace(**{name: chosen[name] for name in chosen if name in Attitude._fields})
        moved = start | {name: chosen[name] for name in chosen if name not in Attitude._fields}
        bench.place(altitude, now, heading)
        bench.move(False)
        command(bench, moved)
        bench.run(settle)
        return now, moved

    def saturated(values: NDArray[np.float64]) -> float:
        """What a lever beyond its stops would still have to give, m/s2: keeps Newton's matrix regular there."""
        if "throttle" not in unknowns:
            return 0.0
        lever = float(values[unknowns.index("throttle")]) * SCALE["throttle"]
        return STOPPED * (max(0.0, lever - 1.0) + min(0.0, lever))

    def residual(values: NDArray[np.float64]) -> NDArray[np.float64]:
        now, _ = settled(values)
        gain = growth * now.tas * sin(now.path)
        wanted = {
            "forward acceleration": gain * cos(now.alpha),
            "downward acceleration": gain * sin(now.alpha),
        }
        wanted["forward acceleration"] -= saturated(values)
        return np.array(
            [
                (bench[name] - wanted.get(name, 0.0)) * (1.0 if name in wanted or "side" in name else 10.0)
                for name in names
            ]
        )

    bench.place(altitude, attitude, heading)
    command(bench, start)
    bench.run_up()
    found = root(
        residual, first, method="hybr", options={"eps": 1e-5, "xtol": 1e-6, "factor": 1.0, "maxfev": 40}
    )
    left = float(np.max(np.abs(residual(found.x))))
    now, moved = settled(found.x)
    beyond = [name for name, value in moved.items() if not -1.0 - 1e-6 <= value <= 1.0 + 1e-6]
    if not left <= GOOD or beyond:
        raise NoTrimError(
            "the aircraft cannot be balanced",
            time=0.0,
            phase="trim",
            required=f"accelerations below {GOOD:g} m/s2",
            achieved=f"{left:.2g} m/s2, {now}, {moved}",
        )
    return Trim(now, moved)


def fly_by_hand(bench: Bench) -> None:
    """All laws and dampers off: the stick moves the surfaces of the bare airframe."""
    bench.put("fcs/law", 1.0)
    bench.put("fcs/augmentation", 0.0)
    for axis in ("pitch", "roll", "yaw"):
        bench.put(f"ap/{axis}-mode", 0.0)


def command(bench: Bench, controls: Mapping[str, float]) -> None:
    """Move stick, pedals and thrust levers (those of failed engines too: they do not mind)."""
    for name, value in controls.items():
        if name == "throttle":
            bench.levers(value)
        else:
            bench.put(f"fcs/{name}-cmd-norm", value)


def release(bench: Bench) -> None:
    """Fly from where the trim holds the aircraft."""
    bench.put("fuel/freeze", 0.0)
    bench.move(True)
