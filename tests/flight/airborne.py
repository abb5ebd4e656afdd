"""The aircraft in the air with its engines running, at attitudes held by its own loops."""

import math
from pathlib import Path
from typing import NamedTuple

import jsbsim

FT, KT, KG, DEG = 0.3048, 0.514444, 1 / 0.45359237, math.pi / 180
INTEGRATORS = {
    "rate/rotational": 3,
    "rate/translational": 3,
    "position/rotational": 7,
    "position/translational": 4,
}


class Condition(NamedTuple):
    name: str
    altitude: float  # m
    speed: dict[str, float]  # initial condition of JSBSim
    mass: float  # kg
    flap: float
    pitch: float  # deg, near trim
    lever: float


CONDITIONS = [
    Condition("approach", 500, {"vc-kts": 120}, 95e3, 1.0, 2.0, 0.32),
    Condition("light, slow", 500, {"vc-kts": 100}, 81e3, 1.0, 4.0, 0.30),
    Condition("take-off flap", 300, {"vc-kts": 140}, 141e3, 0.5, 7.9, 0.55),
    Condition("circuit", 1000, {"vc-kts": 180}, 100e3, 0.0, 4.0, 0.33),
    Condition("fast and low", 300, {"vc-kts": 305}, 110e3, 0.0, -2.0, 0.55),
    Condition("FL230", 7010, {"mach": 0.40}, 110e3, 0.0, 6.2, 0.44),
    Condition("FL370", 11278, {"mach": 0.60}, 85e3, 0.0, 2.2, 0.72),
]


class Flight:
    """The aircraft in the air, engines running, held at an attitude."""

    def __init__(self, root: Path, condition: Condition, rate: int = 120):
        fdm = self.fdm = jsbsim.FGFDMExec(str(root))
        fdm.set_debug_level(0)
        fdm.set_dt(1 / rate)
        assert fdm.load_model("gta")
        for tank in range(7):
            fdm[f"propulsion/tank[{tank}]/contents-lbs"] = 300 * KG
        fdm["inertia/pointmass-weight-lbs[0]"] = (condition.mass - 78600 - 2100) * KG
        fdm["ic/h-sl-ft"] = condition.altitude / FT
        fdm["ic/theta-deg"] = condition.pitch
        for name, value in condition.speed.items():
            fdm[f"ic/{name}"] = value
        fdm.run_ic()
        for name in ("fcs/flap-cmd-norm", "fcs/flap-pos-norm"):
            fdm[name] = condition.flap
        for name in ("gear/gear-cmd-norm", "gear/gear-pos-norm"):
            fdm[name] = float(condition.flap == 1)
        for engine in range(4):
            fdm[f"fcs/throttle-cmd-norm[{engine}]"] = condition.lever
        self.integrate(False)
        self.run(30)  # the engines run up while the aircraft stands still in the air
        self.integrate(True)
        fdm["ap/pitch-target-rad"] = condition.pitch * DEG
        for axis in ("pitch", "roll", "yaw"):
            fdm[f"ap/{axis}-mode"] = 1
        self.run(15)

    def integrate(self, on: bool) -> None:
        for name, kind in INTEGRATORS.items():
            self.fdm[f"simulation/integrator/{name}"] = kind if on else 0

    def run(self, seconds: float, *names: str) -> list[tuple[float, ...]]:
        """Fly on and give time and the named properties each frame."""
        history = []
        start = self.fdm.get_sim_time()
        while self.fdm.get_sim_time() < start + seconds:
            assert self.fdm.run()
            history.append((self.fdm.get_sim_time() - start, *(self.fdm[name] for name in names)))
        return history


def named(name: str) -> Condition:
    """The condition of that name."""
    return next(condition for condition in CONDITIONS if condition.name == name)
