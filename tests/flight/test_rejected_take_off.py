"""A take-off is rejected below V1, and only there; the aircraft stops on the centre line, and the numbers are told."""

import json
from pathlib import Path
from typing import Any

import pytest

from harness import cli, resources
from harness.session import Session
from harness.units import KT

EXPECTS = 'name="circuit" expects="rejected take-off"'
REJECT = """<phase name="T/O.run"><checklist to="RTO">
  <item name="engine failure" remove="yes"/><item name="reject" quantity="cas" at-least="100 kt"/>
</checklist></phase>"""
NO_REVERSE = """<phase name="RTO"><procedure>
  <step name="reverse thrust" remove="yes"/><step name="reverse thrust off" remove="yes"/>
</procedure></phase>"""


def failing(engine: int, speed: str) -> str:
    """An engine failure at a speed."""
    when = f'<when quantity="cas" at-least="{speed}"/>'
    return f'<failures><failure name="engine {engine}">{when}</failure></failures>'


def mission(folder: Path, *parts: str) -> Path:
    text = resources.missions()["circuit"].read_text("utf-8").replace('name="circuit"', EXPECTS)
    path = folder / "rejected.xml"
    path.write_text(text.replace("</mission>", "".join(parts) + "</mission>"), "utf-8")
    return path


def rejected(path: Path, *overrides: str) -> dict[str, Any]:
    run, stopped = Session(path, overrides).fly()
    assert stopped is None
    assert (run.summary["outcome"], run.summary["completed"]) == ("rejected take-off", False)
    found: dict[str, Any] = run.summary["rejected_take_off"]
    return found


@pytest.fixture(scope="module")
def at_100_kt(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    return rejected(mission(tmp_path_factory.mktemp("at 100 kt"), REJECT))


def test_an_engine_failure_below_v1_ends_in_a_stop_on_the_centreline(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = mission(tmp_path, failing(1, "100 kt"))
    assert cli.main(["fly", str(path), "--json", "--out", str(tmp_path)]) == 0
    summary = json.loads(capsys.readouterr().out)
    found = summary["rejected_take_off"]
    assert (summary["outcome"], summary["reason"]) == ("rejected take-off", "")
    assert 100 * KT < found["decision_cas_mps"] < 107 * KT
    assert found["brake_onset_s"] == found["decision_s"]
    assert found["centreline_deviation_m"] < 15.0
    assert found["accelerate_distance_m"] + found["braking_distance_m"] == pytest.approx(
        found["accelerate_stop_distance_m"]
    )


def test_the_stop_takes_the_distance_of_its_mean_deceleration(at_100_kt: dict[str, Any]) -> None:
    speed = at_100_kt["brake_onset_cas_mps"]  # still air at sea level, but for the height of the airport
    mean = speed / (at_100_kt["stop_s"] - at_100_kt["brake_onset_s"])
    assert mean < at_100_kt["peak_deceleration_mps2"] < 2.0 * mean
    assert at_100_kt["braking_distance_m"] == pytest.approx(0.5 * speed**2 / mean, rel=0.15)


def test_without_reverse_the_stop_is_longer(tmp_path: Path, at_100_kt: dict[str, Any]) -> None:
    found = rejected(mission(tmp_path, REJECT, NO_REVERSE))
    assert found["decision_s"] == at_100_kt["decision_s"]
    assert found["braking_distance_m"] > at_100_kt["braking_distance_m"] + 5.0


def test_the_lags_of_a_human_lengthen_the_way_from_v1_to_the_brakes(
    tmp_path: Path, at_100_kt: dict[str, Any]
) -> None:
    """Reaction moves the brakes by its time; the limbs' lag by its own, as a first-order lag does to a ramp's end."""
    path = mission(tmp_path, REJECT)
    slow = rejected(path, "aircraft/gain[reaction-time]/value=1 s")
    assert slow["decision_cas_mps"] == pytest.approx(at_100_kt["decision_cas_mps"], abs=0.1)
    assert slow["brake_onset_s"] == pytest.approx(slow["decision_s"] + 1.0, abs=0.05)
    assert slow["brake_onset_cas_mps"] > at_100_kt["brake_onset_cas_mps"] + 1.0
    longer = slow["accelerate_stop_distance_m"] - at_100_kt["accelerate_stop_distance_m"]
    assert 51.0 < longer < 150.0
    limp = rejected(path, "aircraft/gain[neuromuscular-lag]/value=0.3 s")
    longer = limp["accelerate_stop_distance_m"] - at_100_kt["accelerate_stop_distance_m"]
    assert 0.3 * 51.0 * 0.5 < longer < 0.3 * 51.0 * 3.0
