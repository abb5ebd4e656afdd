"""The four engines, run on the aircraft with its motion frozen: an engine test stand at any speed and height."""

import math
from pathlib import Path

import jsbsim
import pytest

ROOT = Path(__file__).resolve().parents[2]
MOTION = ("rate/rotational", "rate/translational", "position/rotational", "position/translational")
FT = 0.3048


class Stand:
    """The aircraft held still in moving air. Speeds m/s, heights m, K hotter than standard, thrust N."""

    def __init__(
        self,
        speed: float = 0.0,
        height: float = 0.0,
        *,
        on_wheels: bool = True,
        lever: float = 0.0,
        rate: int = 120,
        hotter: float = 0.0,
    ) -> None:
        self.rate = rate
        self.fdm = jsbsim.FGFDMExec(str(ROOT))
        self.fdm.set_debug_level(0)
        self.fdm.set_dt(1.0 / rate)
        assert self.fdm.load_model("gta")
        self["atmosphere/delta-T"] = 1.8 * hotter
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

    def warm(self) -> None:
        """Start the engines at once instead of in 12 s."""
        for engine in range(4):
            self[f"propulsion/core-norm[{engine}]"] = 1.0
            self[f"fadec/blade-angle-deg[{engine}]"] = self[f"fadec/governor-integral-deg[{engine}]"] = 20.0
        self.run(10.0)

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


@pytest.mark.parametrize(
    ("stand", "lever"),
    [
        (Stand(lever=0.6), 1.0),
        (Stand(lever=0.6, rate=240), 1.0),
        (Stand(speed=100.0, height=3000.0, on_wheels=False, lever=0.5), 0.9),
        (Stand(speed=70.0, height=300.0, on_wheels=False), 1.0),
        (Stand(speed=125.0, height=7000.0, on_wheels=False, lever=1.0), 0.0),
    ],
    ids=["standstill", "standstill 240 Hz", "climb", "go-around", "chop"],
)
def test_propeller_speed_stays_within_one_per_cent_after_a_slam(stand: Stand, lever: float) -> None:
    stand.run(30.0)
    stand.levers(lever)
    assert max(abs(speed - 842.0) for speed in stand.run(8.0)) < 8.42


def test_from_low_power_at_standstill_the_propeller_settles_in_a_second_and_a_half() -> None:
    stand = Stand(lever=0.3)
    stand.run(30.0)
    stand.levers(1.0)
    speeds = stand.run(8.0)
    assert max(abs(speed - 842.0) for speed in speeds) < 0.02 * 842.0
    assert max(abs(speed - 842.0) for speed in speeds[round(1.5 * stand.rate) :]) < 8.42


@pytest.mark.parametrize("speed", [10.0, 30.0, 60.0])
def test_reverse_brakes_at_governed_speed_and_lets_go_without_pulling(speed: float) -> None:
    stand = Stand(speed=speed)
    stand.run(25.0)
    stand.levers(-1.0)
    assert (
        max(stand.run(4.0)) < 1.1 * 842.0
    )  # the air drives the propeller while the blades pass through flat
    stand.run(10.0)
    assert stand["propulsion/engine[0]/propeller-rpm"] == pytest.approx(842.0, rel=0.02)
    assert stand["propulsion/engine-power-kw[0]"] < 0.25 * 7971.0  # limited to what holds the speed
    assert stand["propulsion/total-thrust-n"] < -90e3
    stand.levers(0.0)
    pulls = []
    for _ in range(60):
        stand.run(0.1)
        pulls.append(stand["propulsion/total-thrust-n"])
    assert max(pulls) < 50e3  # it was 130 kN
    assert pulls[-1] < 0.0


def test_full_power_straight_out_of_reverse_waits_for_the_blades() -> None:
    stand = Stand(speed=30.0)
    stand.run(25.0)
    stand.levers(-1.0)
    stand.run(8.0)
    stand.levers(1.0)
    assert max(stand.run(10.0)) < 1.1 * 842.0
    assert stand["propulsion/total-thrust-n"] > 350e3


def test_the_low_propeller_speed_is_held_within_the_torque_of_the_gearbox() -> None:
    stand = Stand(speed=100.0, height=1000.0, on_wheels=False, lever=1.0)
    stand.run(30.0)
    stand["propulsion/propeller-speed-mode"] = 1.0
    stand.run(20.0)
    assert stand["propulsion/engine[0]/propeller-rpm"] == pytest.approx(655.0, rel=0.01)
    torque = 1e3 * stand["propulsion/engine-power-kw[0]"] / (655.0 * math.pi / 30.0)
    assert torque == pytest.approx(95e3, rel=0.01)
    stand["propulsion/propeller-speed-mode"] = 0.0
    assert max(stand.run(20.0)) < 850.0
    assert stand["propulsion/engine[0]/propeller-rpm"] == pytest.approx(842.0, rel=0.01)


@pytest.mark.parametrize("dead", [(0,), (0, 3), (1, 2, 3), (0, 1, 2, 3)])
def test_any_set_of_engines_fails_and_relights(dead: tuple[int, ...]) -> None:
    stand = Stand(speed=100.0, height=3000.0, on_wheels=False, lever=0.8)
    stand.run(30.0)
    power = stand["propulsion/engine-power-kw[0]"]
    for engine in dead:
        stand[f"failure/engine[{engine}]"] = 1.0
    stand.run(15.0)
    for engine in range(4):
        failed = engine in dead
        assert (stand[f"propulsion/engine[{engine}]/propeller-rpm"] < 5.0) == failed
        assert (stand[f"propulsion/engine-fuel-flow-kgps[{engine}]"] == 0.0) == failed
        assert (stand[f"propulsion/engine[{engine}]/thrust-lbs"] > 100.0) != failed
        if failed:
            assert stand[f"propulsion/jet-thrust-n[{engine}]"] < 0.0  # the drag of the feathered propeller
            stand[f"failure/engine[{engine}]"] = 0.0
    arms = (-12.3, -6.2, 6.2, 12.3)
    yaw = sum(-arm * stand[f"propulsion/jet-thrust-n[{engine}]"] for engine, arm in enumerate(arms))
    assert stand["propulsion/jet-yaw-nm"] == pytest.approx(yaw, abs=1e-6)
    assert max(stand.run(40.0)) < 1.1 * 842.0
    for engine in range(4):
        assert stand[f"propulsion/engine-power-kw[{engine}]"] == pytest.approx(power, rel=0.01)
        assert stand[f"propulsion/engine[{engine}]/propeller-rpm"] == pytest.approx(842.0, rel=0.01)


@pytest.mark.parametrize("autofeather_fails", [False, True])
@pytest.mark.parametrize(
    ("speed", "height"),
    [(55.0, 0.0), (72.0, 100.0), (110.0, 0.0), (125.0, 7000.0), (205.0, 9450.0), (210.0, 11000.0)],
)
def test_a_dead_engine_never_pulls(speed: float, height: float, autofeather_fails: bool) -> None:
    stand = Stand(speed=speed, height=height + 20.0, on_wheels=False, lever=1.0)
    stand.run(25.0)
    stand["failure/autofeather[0]"] = float(autofeather_fails)
    stand["propulsion/engine-run[0]"] = 0.0
    stand.run(15.0)
    thrust = stand["propulsion/engine[0]/thrust-lbs"] * 4.4482216 + stand["propulsion/jet-thrust-n[0]"]
    assert thrust < 0.0
    turning = stand["propulsion/engine[0]/propeller-rpm"]
    assert (turning > 300.0) == autofeather_fails
    assert turning < 1.05 * 842.0
    assert stand["propulsion/engine-power-kw[0]"] == pytest.approx(-0.0314159 * turning, abs=0.5)


def test_a_cold_aircraft_starts_idles_and_shuts_down() -> None:
    stand = Stand()
    for engine in range(4):
        stand[f"propulsion/engine-run[{engine}]"] = 0.0
    stand.run(5.0)
    assert stand["propulsion/total-thrust-n"] == pytest.approx(0.0, abs=1e-6)
    assert stand["propulsion/n1-percent[0]"] == 0.0
    assert stand["propulsion/itt-c[0]"] == pytest.approx(15.0, abs=0.5)
    for engine in range(4):
        stand[f"propulsion/engine-run[{engine}]"] = 1.0
    stand.run(25.0)
    assert 640.0 < stand["propulsion/slowest-propeller-rpm"] < 700.0
    assert 60.0 < stand["propulsion/n1-percent[0]"] < 75.0
    assert 350.0 < stand["propulsion/itt-c[0]"] < 550.0
    for engine in range(4):
        stand[f"propulsion/engine-run[{engine}]"] = 0.0
    stand.run(60.0)
    assert stand["propulsion/slowest-propeller-rpm"] < 5.0
    assert stand["propulsion/total-fuel-flow-kgps"] == 0.0


@pytest.mark.parametrize("rate", [120, 480])
def test_the_gearbox_balances_power_and_rotational_energy(rate: int) -> None:
    """Delivered less absorbed work is the change of I omega^2 / 2, through a run-up and a slam to reverse."""
    stand = Stand(rate=rate, lever=0.0)
    stand.warm()

    def energy() -> float:
        return 0.5 * 550.0 * (stand["propulsion/engine[0]/propeller-rpm"] * math.pi / 30.0) ** 2

    for lever, seconds in ((0.4, 2.0), (1.0, 1.0), (-1.0, 3.0)):
        stand.levers(lever)
        before, work, swing = energy(), 0.0, 0.0
        for _ in range(round(seconds * rate)):
            stand.fdm.run()
            absorbed = stand["propulsion/engine[0]/propeller-power-ftlbps"] * 1.3558179483
            work += (1e3 * stand["propulsion/engine-power-kw[0]"] - absorbed) / rate
            swing = max(swing, abs(energy() - before))
        assert energy() - before == pytest.approx(work, abs=0.01 * swing)


def test_power_is_flat_then_falls_with_height_and_on_a_hot_day() -> None:
    def maximum(**where: float) -> float:
        stand = Stand(on_wheels=False, lever=1.0, **where)  # type: ignore[arg-type]
        stand.run(1.0)
        return stand["propulsion/maximum-power-kw"]

    assert (
        maximum(speed=60.0)
        == maximum(speed=60.0, hotter=30.0)
        == maximum(speed=60.0, height=2000.0)
        == 7971.0
    )
    cold, hot = (maximum(speed=125.0, height=7010.0, hotter=kelvin) for kelvin in (0.0, 15.0))
    assert 0.87 < hot / cold < 0.95
    assert maximum(speed=150.0, height=7010.0) > cold  # ram
    assert maximum(speed=125.0, height=9000.0) < cold


def test_the_step_size_does_not_change_the_impulse_of_a_slam() -> None:
    impulses = []
    for rate in (120, 240, 480):
        stand = Stand(lever=0.5, rate=rate)
        stand.warm()
        stand.levers(1.0)
        impulse = 0.0
        for _ in range(5 * rate):
            stand.fdm.run()
            impulse += stand["propulsion/engine[0]/thrust-lbs"] / rate
        impulses.append(impulse)
    assert impulses == pytest.approx([impulses[-1]] * 3, rel=0.01)


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
