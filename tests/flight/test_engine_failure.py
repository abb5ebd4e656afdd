"""With an engine out the mission is flown to its end, in whichever phase it fails; above V1 the take-off goes on."""

from pathlib import Path

import numpy as np
import pytest

from harness import resources
from harness.analysis.metrics import roll_deviation
from harness.log import Run
from harness.navigation.database import load
from harness.session import Session
from harness.units import DEG, FT, KT


def flown(folder: Path, mission: str, failure: str) -> Run:
    text = resources.missions()[mission].read_text("utf-8")
    path = folder / "one-engine-out.xml"
    path.write_text(text.replace("</mission>", f"<failures>{failure}</failures></mission>"), "utf-8")
    run, stopped = Session(path).fly()
    assert stopped is None, stopped
    assert run.summary["completed"]
    return run


@pytest.fixture(scope="module")
def continued(tmp_path_factory: pytest.TempPathFactory) -> Run:
    failure = '<failure name="engine 1"><when quantity="cas" at-least="116 kt"/></failure>'
    return flown(tmp_path_factory.mktemp("continued"), "circuit", failure)


def test_above_v1_the_take_off_goes_on_with_the_recognition_time_in_between(continued: Run) -> None:
    (failure,) = [event for event in continued.events if event.kind == "failure"]
    (warning,) = [event for event in continued.events if event.kind == "warning"]
    assert warning.name == "engine 1 failed"
    assert 1.0 <= warning.time - failure.time < 1.2  # the engines turn at 20 Hz
    assert "RTO" not in [event.name for event in continued.events if event.kind == "phase"]


def test_the_feet_keep_the_runway_and_the_bank_the_track(continued: Run) -> None:
    runway = load().runway("EDDM", "26L")
    assert roll_deviation(continued, runway, "T/O") < 15.0  # half a narrow runway
    history = continued.history
    first_minute = (history["time"] > continued.summary["lift_off_s"]) & (history["height"] < 400 * FT)
    swing = (history["heading"][first_minute] - runway.true_heading + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(swing).max() < 6 * DEG
    assert np.abs(history["roll"][first_minute]).max() < 8 * DEG


def test_the_climb_is_flown_between_v2_and_ten_knots_more(continued: Run) -> None:
    manual = Session("circuit").manual
    v2 = manual.speed("V2", continued.summary["takeoff_mass_kg"])
    history = continued.history
    climb = (history["time"] > continued.summary["lift_off_s"]) & (history["height"] > 35 * FT)
    climb &= (history["height"] < 1400 * FT) & (history["phase"] == "DEP")
    climb &= history["time"] < continued.summary["lift_off_s"] + 60.0
    assert history["cas"][climb].min() > v2
    assert history["cas"][climb].max() < v2 + 10 * KT


def test_the_dead_engine_and_no_other_is_shut_down_at_400_ft(continued: Run) -> None:
    (shut,) = [event for event in continued.events if event.name == "shut the failed engine down"]
    assert continued.at("height", shut.time) >= 399 * FT
    assert set(continued.history["command_shut_down"]) == {0.0, 1.0}
    assert set(continued.history["engines_failed"]) == {0.0, 1.0}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mission", "engine", "phase", "when"),
    [
        ("hop", 1, "ENR.CLB", 'quantity="time-in-phase" at-least="30 s"'),
        ("hop", 2, "ENR.DES", 'quantity="time-in-phase" at-least="20 s"'),
        ("circuit", 4, "ENR.CRS", 'quantity="time-in-phase" at-least="30 s"'),
        ("circuit", 3, "APP.final", 'quantity="height" at-most="800 ft"'),
    ],
)
def test_an_engine_may_fail_in_any_phase(
    mission: str, engine: int, phase: str, when: str, tmp_path: Path
) -> None:
    run = flown(
        tmp_path, mission, f'<failure name="engine {engine}" phase="{phase}"><when {when}/></failure>'
    )
    landing = run.summary["touchdown_s"]
    assert run.at("engines_failed", landing) == 2 ** (engine - 1)
    assert roll_deviation(run, load().runway("EDDM", "26L"), "LDG") < 10.0
    assert run.history["stall_warned"][-1] == 0.0
