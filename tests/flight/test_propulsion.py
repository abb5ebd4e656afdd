"""The four engines, run on the aircraft with its motion frozen: an engine test stand at any speed and height."""

from pathlib import Path

import jsbsim
import pytest

ROOT = Path(__file__).resolve().parents[2]
MOTION = ("rate/rotational", "rate/translational", "position/rotational", "position/translational")
FT = 0.3048


class Stand:
    """The aircraft held still in moving air. Speeds m/s, heights m, thrust N."""

    def __init__(
        self,
        speed: float = 0.0,
        height: float = 0.0,
        *,
        on_wheels: bool = True,
        lever: float = 0.0,
        rate: int = 120,
    ) -> None:
        self.rate = rate
        self.fdm = jsbsim.FGFDMExec(str(ROOT))
        self.fdm.set_debug_level(0)
        self.fdm.set_dt(1.0 / rate)
        assert self.fdm.load_model("gta")
        self["ic/h-agl-ft" if on_wheels else "ic/h-sl-ft"] = (4.0 if on_wheels else height) / FT
        self["ic/u-fps"] = speed / FT
        self.levers(lever)
        assert self.fdm.run_ic()
        for name in MOTION:
            self[f"simulation/integrator/{name}"] = 0

    def __getitem__(self, name: str) -> float:
        return float(self.fdm[name])

    def __setitem__(self, name: str, value: float) -> None:
        self.fdm[name] = value

    def levers(self, position: float) -> None:
        for engine in range(4):
            self[f"fcs/throttle-cmd-norm[{engine}]"] = position

    def run(self, seconds: float) -> list[float]:
        """Run, and give the speed of the first propeller in each frame, rpm."""
        speeds = []
        for _ in range(round(seconds * self.rate)):
            self.fdm.run()
            speeds.append(self["propulsion/engine[0]/propeller-rpm"])
        return speeds


@pytest.fixture(scope="module", params=[120, 240])
def parked(request: pytest.FixtureRequest) -> Stand:
    stand = Stand(rate=request.param)
    stand.run(25.0)
    return stand


def test_the_engines_start_by_themselves(parked: Stand) -> None:
    assert 640.0 < parked["propulsion/slowest-propeller-rpm"] < 700.0


def test_ground_idle_lets_the_aircraft_taxi(parked: Stand) -> None:
    assert 5e3 < parked["propulsion/total-thrust-n"] < 15e3


def test_takeoff_thrust_in_flight_is_that_of_the_tables() -> None:
    stand = Stand(speed=72.0, on_wheels=False, lever=1.0)
    stand.run(40.0)
    assert stand["propulsion/total-thrust-n"] == pytest.approx(310e3, rel=0.05)
    assert stand["propulsion/engine-power-kw[0]"] == pytest.approx(7971.0, rel=1e-3)


def test_propeller_speed_stays_within_one_per_cent_after_a_step() -> None:
    stand = Stand(speed=100.0, height=3000.0, on_wheels=False, lever=0.5)
    stand.run(40.0)
    stand.levers(0.9)
    assert max(abs(speed - 842.0) for speed in stand.run(10.0)) < 8.5


def test_a_dead_engine_feathers_and_stops() -> None:
    stand = Stand(speed=72.0, on_wheels=False, lever=1.0)
    stand.run(40.0)
    stand["propulsion/engine-run[0]"] = 0.0
    stand.run(10.0)
    assert stand["propulsion/engine[0]/propeller-rpm"] < 5.0
    assert abs(stand["propulsion/engine[0]/thrust-lbs"]) < 100.0
    assert stand["propulsion/engine-fuel-flow-kgps[0]"] == 0.0


def test_cruise_power_and_fuel_are_the_point_performance() -> None:
    """V14 to V16: 77.7 kN at M 0.40, FL230 takes 2.8 to 3.0 MW and 2580 kg/h."""
    stand = Stand(speed=125.0, height=7010.0, on_wheels=False, lever=0.45)
    stand.run(40.0)
    share = 77.7e3 / stand["propulsion/total-thrust-n"]
    assert 0.85 < share < 1.15
    assert stand["propulsion/engine-power-kw[0]"] * share == pytest.approx(2900.0, rel=0.07)
    assert stand["propulsion/total-fuel-flow-kgps"] * 3600.0 * share == pytest.approx(2580.0, rel=0.08)


def test_no_fuel_is_lost_or_made_while_tanks_run_empty() -> None:
    stand = Stand(speed=125.0, height=7010.0, on_wheels=False, lever=0.9)
    for tank, mass in enumerate((40.0, 60.0, 20.0, 100.0, 30.0, 30.0, 100.0)):
        stand[f"propulsion/tank[{tank}]/contents-lbs"] = mass / 0.45359237
    stand.run(1.0)
    at_start = stand["inertia/total-fuel-kg"], stand["propulsion/fuel-burned-kg"]
    stand.run(400.0)
    burned = stand["propulsion/fuel-burned-kg"] - at_start[1]
    assert at_start[0] - stand["inertia/total-fuel-kg"] == pytest.approx(burned, abs=1e-6)
    assert stand["propulsion/engine[1]/propeller-rpm"] < 5.0  # ran dry
