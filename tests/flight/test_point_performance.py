"""Thrust of the flown engines against drag of the collected polar: cruise, climb and ceilings of the validation points.

Thrust, power and fuel come from the aircraft in JSBSim with its motion frozen; the drag is not the aircraft's own but
C_D = 0.0211 + dC_D(M) + C_L^2 / (pi 8.1 0.80) of facts.csv, computed here. V24 is calibrated (the power rating), V16
and V18 partly (the fuel law); the rest was fitted to nothing here.
"""

import math
from pathlib import Path
from typing import NamedTuple

import jsbsim
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
MOTION = ("rate/rotational", "rate/translational", "position/rotational", "position/translational")
FT, AREA, GRAVITY = 0.3048, 221.5, 9.80665
MACH_DRAG = ((0.60, 0.65, 0.68, 0.72, 0.76), (0.0, 0.0005, 0.0012, 0.0035, 0.0100))


class Point(NamedTuple):
    """What the engines give at a flight condition: m/s, -, Pa, N, kW of one engine, kg/h of all."""

    speed: float
    mach: float
    dynamic_pressure: float
    thrust: float
    power: float
    fuel: float

    def drag(self, mass: float) -> float:
        """Drag in level flight, N."""
        lift = mass * GRAVITY / (self.dynamic_pressure * AREA)
        coefficient = 0.0211 + np.interp(self.mach, *MACH_DRAG) + lift**2 / (math.pi * 8.1 * 0.80)
        return float(self.dynamic_pressure * AREA * coefficient)

    def climb(self, mass: float) -> float:
        """Excess power over weight, m/s: the rate of climb at constant true airspeed."""
        return (self.thrust - self.drag(mass)) * self.speed / (mass * GRAVITY)


class Bench:
    """The aircraft held still at one flight condition after the other."""

    def __init__(self) -> None:
        self.fdm = jsbsim.FGFDMExec(str(ROOT))
        self.fdm.set_debug_level(0)
        self.fdm.set_dt(1.0 / 120.0)
        assert self.fdm.load_model("gta")
        self.fdm["gear/gear-cmd-norm"] = self.fdm["gear/gear-pos-norm"] = 0
        self.fdm["ic/h-sl-ft"], self.fdm["ic/vc-kts"] = 1000, 160
        self.fdm.run_ic()
        for engine in range(4):
            self.fdm[f"propulsion/core-norm[{engine}]"] = 1
            self.fdm[f"fadec/blade-angle-deg[{engine}]"] = 30
            self.fdm[f"fadec/governor-integral-deg[{engine}]"] = 30
        for name in MOTION:
            self.fdm[f"simulation/integrator/{name}"] = 0

    def at(self, feet: float, lever: float = 1.0, seconds: float = 3.0, **speed: float) -> Point:
        fdm = self.fdm
        fdm["ic/h-sl-ft"] = feet
        for name, value in speed.items():
            fdm[f"ic/{name.replace('_', '-')}"] = value
        fdm["ic/gamma-deg"] = fdm["ic/alpha-deg"] = 0
        fdm.run_ic()
        for engine in range(4):
            fdm[f"fcs/throttle-cmd-norm[{engine}]"] = lever
        for _ in range(round(seconds * 120)):
            fdm.run()
        return Point(
            fdm["velocities/u-aero-fps"] * FT,
            fdm["velocities/mach"],
            fdm["aero/qbar-psf"] * 47.880259,
            fdm["propulsion/total-thrust-n"],
            fdm["propulsion/engine-power-kw[0]"],
            fdm["propulsion/total-fuel-flow-kgps"] * 3600.0,
        )

    def level(self, feet: float, mass: float, **speed: float) -> Point:
        """Level flight: the lever at which thrust is drag."""
        low, high = 0.1, 1.0
        for _ in range(9):
            lever = 0.5 * (low + high)
            point = self.at(feet, lever, 4.0, **speed)
            low, high = (low, lever) if point.thrust > point.drag(mass) else (lever, high)
        return point


@pytest.fixture(scope="module")
def bench() -> Bench:
    return Bench()


@pytest.mark.parametrize(
    ("mass", "thrust", "power", "fuel"), [(110e3, 77.7, 2900, 2580), (89e3, 58.3, 2100, 1950)]
)
def test_cruise_at_fl230(bench: Bench, mass: float, thrust: float, power: float, fuel: float) -> None:
    """V14, V15, V16."""
    point = bench.level(23e3, mass, mach=0.40)
    assert point.thrust / 1e3 == pytest.approx(thrust, rel=0.05)
    assert point.power == pytest.approx(power, rel=0.07)
    assert point.fuel == pytest.approx(fuel, rel=0.08)


def test_fast_cruise_at_fl310(bench: Bench) -> None:
    """V17, V18."""
    point = bench.level(31e3, 120e3, mach=0.68)
    assert point.thrust == pytest.approx(79.0e3, rel=0.05)
    assert 120e3 * GRAVITY / point.drag(120e3) == pytest.approx(14.9, rel=0.05)
    assert point.power == pytest.approx(4700.0, rel=0.07)
    assert point.fuel == pytest.approx(4070.0, rel=0.07)


@pytest.mark.parametrize(
    ("feet", "knots", "mass", "climb"),
    [(0, 160, 124e3, 13.1), (0, 160, 89e3, 21.8), (15e3, 200, 124e3, 13.1)],
)
def test_rate_of_climb(bench: Bench, feet: float, knots: float, mass: float, climb: float) -> None:
    """V20, V21 (there 10 %), as they were computed: at constant true airspeed."""
    assert bench.at(feet, vc_kts=knots).climb(mass) == pytest.approx(climb, rel=0.08)


@pytest.mark.parametrize(("mass", "ceiling"), [(89e3, 40.8), (100e3, 38.4), (124e3, 33.0), (141e3, 30.0)])
def test_ceiling(bench: Bench, mass: float, ceiling: float) -> None:
    """V22: 300 ft/min at the best of some Mach numbers, within 1,500 ft."""
    for above, climbs in ((-1.5, True), (1.5, False)):
        rates = [
            bench.at((ceiling + above) * 1e3, 1.0, 1.5, mach=mach).climb(mass) for mach in (0.52, 0.57, 0.62)
        ]
        assert (max(rates) > 300.0 * FT / 60.0) == climbs


def test_time_to_fl230(bench: Bench) -> None:
    """V23: 9.8 min from 1,500 ft at 200 kt CAS with 124 t, with what the acceleration takes (troposphere)."""
    heights = np.linspace(1500.0, 23e3, 9)
    slowness = []
    for feet in heights:
        point = bench.at(feet, 1.0, 1.5, vc_kts=200)
        ram = 1.0 + 0.2 * point.mach**2
        acceleration = 1.0 + (ram**3.5 - 1.0) / ram**2.5 - 0.1332 * point.mach**2
        slowness.append(acceleration / point.climb(124e3))
    minutes = float(np.trapezoid(slowness, heights * FT)) / 60.0
    assert minutes == pytest.approx(9.8, rel=0.10)


def test_m072_at_fl370(bench: Bench) -> None:
    """V24: with 97 t at full power, and hardly more; calibrated."""
    point = bench.at(37e3, 1.0, 5.0, mach=0.72)
    assert point.thrust > point.drag(97e3)
    assert point.thrust < point.drag(101e3)
