"""The fuel system on the test stand: nothing is lost or made, and no engine starves while fuel can reach it."""

import itertools

import pytest
from test_propulsion import Stand

from harness.loading.aircraft import read_stowage

KG = 1.0 / 0.45359237  # pounds
CAPACITY = (11434.310, 13457.255, 13384.250, 3032.455, 2269.435, 2269.435, 3032.455)
FULL, HALF, LOW, DRY = 1.0, 0.5, 0.004, 0.0


def stand(*shares: float, height: float = 7010.0, rate: int = 120) -> Stand:
    """Engines at work in cruise; each tank filled to this share of its capacity."""
    made = Stand(speed=125.0, height=height, on_wheels=False, lever=0.9, rate=rate)
    made["fuel/freeze"] = 1  # until the transfers have seen what was filled in
    made.run(0.1)
    for tank, (share, capacity) in enumerate(zip(shares, CAPACITY, strict=True)):
        made[f"propulsion/tank[{tank}]/contents-lbs"] = share * capacity * KG
    made.run(0.3)
    made["fuel/freeze"] = 0
    made.run(0.1)
    return made


def contents(of: Stand) -> list[float]:
    return [of[f"propulsion/tank[{tank}]/contents-lbs"] / KG for tank in range(7)]


def balance(of: Stand) -> float:
    """Kilograms in the tanks, burned and leaked: what must not change."""
    return sum(contents(of)) + of["propulsion/fuel-burned-kg"] + of["fuel/leaked-kg"]


def running(of: Stand) -> list[bool]:
    return [of[f"propulsion/engine-fuel-flow-kgps[{engine}]"] > 0.05 for engine in range(4)]


@pytest.mark.parametrize("rate", [120, 240])
@pytest.mark.parametrize(
    "shares",
    [
        (FULL,) * 7,
        (HALF, HALF, HALF, FULL, FULL, FULL, FULL),
        (FULL, DRY, DRY, DRY, DRY, LOW, LOW),
        (DRY, FULL, DRY, FULL, LOW, FULL, LOW),
        (LOW, LOW, LOW, LOW, LOW, LOW, LOW),
        (DRY, LOW, FULL, FULL, LOW, LOW, FULL),
    ],
)
def test_no_tank_state_loses_or_makes_fuel(shares: tuple[float, ...], rate: int) -> None:
    engines = stand(*shares, rate=rate)
    at_start = balance(engines)
    worst = 0.0
    for second in range(40):
        engines.levers(0.2 if second % 2 else 1.0)  # the flow into a full tank has to follow
        engines.run(1.0)
        worst = max(worst, abs(balance(engines) - at_start))
        assert all(0.0 <= mass <= most for mass, most in zip(contents(engines), CAPACITY, strict=True))
    assert engines["propulsion/fuel-burned-kg"] > 0.0
    assert worst < 1e-6


def test_leaks_crossfeed_and_pump_failures_together_lose_no_fuel() -> None:
    engines = stand(HALF, HALF, HALF, HALF, LOW, FULL, FULL)
    at_start = balance(engines)
    for tank in range(7):
        engines[f"failure/fuel-leak-kgps[{tank}]"] = 3.0
    for engine in range(4):
        engines[f"fuel/crossfeed-open[{engine}]"] = 1
    for engine in range(4):
        engines[f"failure/feed-pump[{engine}]"] = 1
        engines.run(10.0)
        engines.levers(0.3 + 0.2 * engine)
    for tank in range(7):
        engines[f"failure/fuel-leak-kgps[{tank}]"] = 0.0
    engines.run(10.0)
    leaked = engines["fuel/leaked-kg"]
    assert leaked > 100.0
    engines.run(5.0)
    assert engines["fuel/leaked-kg"] == leaked
    assert balance(engines) == pytest.approx(at_start, abs=1e-6)


def test_a_tank_leaks_what_was_asked_while_it_has_it() -> None:
    engines = stand(HALF, HALF, HALF, FULL, FULL, FULL, FULL)
    engines["failure/fuel-leak-kgps[1]"] = 2.0
    engines.run(1.0)
    before = engines["fuel/leaked-kg"]
    engines.run(20.0)
    assert engines["fuel/leaked-kg"] - before == pytest.approx(40.0, abs=1e-6)


def test_tanks_empty_centre_first_then_wing_then_feed() -> None:
    engines = stand(0.01, 0.01, 0.01, FULL, FULL, FULL, FULL)
    gone = {}
    for second in itertools.count():
        engines.run(5.0)
        left = contents(engines)
        for name, group in (("centre", left[:1]), ("inner", left[1:3])):
            if max(group) < 20.0:
                gone.setdefault(name, second)
        if len(gone) == 2:
            break
        assert min(left[3:]) > 0.99 * 2269.0  # the feed tanks stay full meanwhile
        assert second < 200
    assert gone["centre"] < gone["inner"]


def test_burning_leaves_what_filling_less_would_have_put_in() -> None:
    """The fuel-management table is the order of use, backwards."""
    stowage = read_stowage("gta")
    whole = sum(CAPACITY) - CAPACITY[0] + 60.0
    engines = stand(*(item.mass / most for item, most in zip(stowage.fuel(whole), CAPACITY, strict=True)))
    engines.run(160.0)
    left = contents(engines)
    assert whole - sum(left) > 120.0
    filled = [item.mass for item in stowage.fuel(sum(left))]
    assert left == pytest.approx(filled, abs=20.0)  # a tank gives what the one before it lacks, 5 to 10 kg


def test_a_failed_pump_starves_its_engine_aloft_and_only_it() -> None:
    engines = stand(HALF, HALF, HALF, FULL, FULL, FULL, FULL)
    engines.run(20.0)
    assert all(running(engines))
    engines["failure/feed-pump[1]"] = 1
    engines.run(5.0)
    assert running(engines) == [True, False, True, True]
    assert engines["fuel/feed-wet[1]"] == 0.0


def test_gravity_feeds_below_its_ceiling() -> None:
    engines = stand(HALF, HALF, HALF, FULL, FULL, FULL, FULL, height=3000.0)
    engines.run(20.0)
    engines["failure/feed-pump[1]"] = 1
    engines.run(5.0)
    assert all(running(engines))


def test_crossfeed_saves_an_engine_and_takes_equal_parts() -> None:
    engines = stand(DRY, DRY, DRY, FULL, FULL, FULL, FULL)
    engines.run(20.0)
    engines["fuel/crossfeed-open[0]"] = 1
    engines["failure/feed-pump[0]"] = 1
    engines.run(5.0)
    assert all(running(engines))
    before, burned = contents(engines), engines["propulsion/fuel-burned-kg"]
    engines.run(20.0)
    spent = [was - now for was, now in zip(before, contents(engines), strict=True)]
    assert spent[3] == 0.0
    assert spent[4:] == pytest.approx([(engines["propulsion/fuel-burned-kg"] - burned) / 3.0] * 3, rel=1e-3)


def test_an_engine_runs_dry_with_its_tank_and_lights_again_with_crossfeed() -> None:
    engines = stand(DRY, DRY, DRY, DRY, FULL, FULL, FULL)
    engines.run(25.0)
    assert running(engines) == [False, True, True, True]
    engines["fuel/crossfeed-open[0]"] = 1
    engines.run(2.0)
    assert engines["fuel/feed-wet[0]"] == 1.0


def test_frozen_fuel_stays() -> None:
    engines = stand(HALF, HALF, HALF, HALF, FULL, FULL, FULL)
    engines["fuel/freeze"] = 1
    engines.run(1.0)
    before = contents(engines), engines["propulsion/fuel-burned-kg"]
    engines.run(5.0)
    assert (contents(engines), engines["propulsion/fuel-burned-kg"]) == before
    assert engines["propulsion/total-fuel-flow-kgps"] > 0.1
