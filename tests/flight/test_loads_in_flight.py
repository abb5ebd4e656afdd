"""A mission that loses mass in every way there is: burned, leaked and dropped."""

from pathlib import Path

import pytest

from harness.log import Run
from harness.session import Session

DROP = 8000.0  # kg


@pytest.fixture(scope="module")
def flown(tmp_path_factory: pytest.TempPathFactory, repository: Path) -> Run:
    text = (repository / "missions/airdrop.xml").read_text("utf-8")
    leak = '<failures><failure name="fuel leak feed 2" phase="ENR.CRS"/></failures>'
    crossfeed = '<action name="crossfeed open" set="crossfeed" to="1"/>'
    text = text.replace("<departure ", f"{leak}<departure ", 1)
    text = text.replace('<action name="ramp open"', f'{crossfeed}<action name="ramp open"')
    path = tmp_path_factory.mktemp("missions") / "losses.xml"
    path.write_text(text, "utf-8")
    run, stopped = Session(path).fly()
    assert stopped is None, stopped
    return run


def test_take_off_mass_less_burned_leaked_and_dropped_is_the_landing_mass(flown: Run) -> None:
    summary = flown.summary
    assert summary["dropped_kg"] == pytest.approx(DROP)
    assert summary["fuel_leaked_kg"] > 400.0
    lost = summary["fuel_burned_kg"] + summary["fuel_leaked_kg"] + summary["dropped_kg"]
    assert summary["takeoff_mass_kg"] - summary["landing_mass_kg"] == pytest.approx(lost, abs=0.1)
    assert abs(summary["mass_closure_kg"]) < 0.1


def test_the_leak_and_the_release_are_named(flown: Run) -> None:
    told = {(event.kind, event.name) for event in flown.events}
    assert ("failure", "fuel leak feed 2") in told
    assert ("procedure", "vehicle away") in told


def test_the_pilot_holds_the_level_through_the_drop(flown: Run) -> None:
    time, dropped = flown.history["time"], flown.history["dropped"]
    at = time[dropped > 0][0]
    near = (time > at - 5.0) & (time < at + 30.0)
    altitude = flown.history["altitude"][near]
    assert max(altitude) - min(altitude) < 15.0
    assert max(flown.history["load_factor"][near]) > 1.02  # lighter all at once
    assert max(abs(flown.history["pitch"][near] - flown.history["pitch"][near][0])) < 0.05
