"""What a flight is held against."""

import json
from math import nan

import pytest

from harness import cli, validation
from harness.analysis.bars import Bar
from harness.validation import Trial, Verdict


@pytest.mark.parametrize(
    ("measured", "low", "high", "inside"),
    [
        (1.0, 0.0, 2.0, True),
        (2.0, None, 2.0, True),
        (2.1, None, 2.0, False),
        (-0.1, 0.0, None, False),
        (nan, 0.0, None, False),
        (nan, None, 2.0, False),
        (1e9, None, None, None),
    ],
)
def test_a_bar_is_met_on_its_bounds_and_never_by_what_was_not_measured(measured, low, high, inside):
    assert Bar("x", measured, "m", low, high).inside is inside


def verdict(*bars):
    return Verdict(Trial("circuit", ("environment/qnh=1000 hPa",)), list(bars))


def test_the_table_tells_what_is_outside():
    text = validation.table(
        verdict(
            Bar("sink at touchdown", 1.31, "m/s", None, 1.2),
            Bar("touchdown", 440.0, "m", 200.0, 700.0, "past the threshold"),
            Bar("localizer", 0.01, "dots"),
            Bar("gear speed", 12.0, "kt", 0.0),
        )
    )
    title, *rows = (line.split() for line in text.splitlines())
    assert title == ["circuit", "environment/qnh=1000", "hPa"]
    assert rows == [
        ["sink", "at", "touchdown", "1.310", "m/s", "at", "most", "1.2", "NO"],
        ["touchdown", "440.0", "m", "200", "to", "700", "yes", "past", "the", "threshold"],
        ["localizer", "0.010", "dots"],
        ["gear", "speed", "12.0", "kt", "at", "least", "0", "yes"],
    ]


def test_one_bar_not_met_is_a_flight_outside():
    good, bad = Bar("a", 1.0, "m", None, 2.0), Bar("b", 3.0, "m", None, 2.0)
    assert verdict(good, Bar("told", 9.0, "m")).inside
    assert not verdict(good, bad).inside


def test_a_verdict_is_data_that_json_can_hold():
    data = json.loads(json.dumps(validation.as_data(verdict(Bar("a", nan, "m", None, 2.0))), allow_nan=False))
    assert data["inside"] is False
    assert data["bars"] == [
        {
            "quantity": "a",
            "measured": None,
            "unit": "m",
            "low": None,
            "high": 2.0,
            "remark": "",
            "inside": False,
        }
    ]


def test_the_main_mission_brings_its_companions_along():
    assert validation.trials([]) == list(validation.SUITE)
    assert validation.trials(["hop"]) == [Trial("hop")]
    assert validation.trials(["circuit", "cologne-munich"]) == [
        Trial("circuit"),
        *(trial for trial in validation.SUITE if trial != Trial("circuit")),
    ]


@pytest.mark.parametrize(("measured", "code"), [(1.0, 0), (3.0, 1)])
def test_the_exit_code_tells_whether_all_is_inside(monkeypatch, capsys, measured, code):
    def flown(trial, session, progress):
        return Verdict(trial, [Bar("sink", measured, "m/s", None, 1.2)])

    monkeypatch.setattr(validation, "validate", flown)
    assert cli.main(["validate", "circuit", "--json"]) == code
    result = json.loads(capsys.readouterr().out)
    assert result["inside"] is (code == 0)
    assert [flight["mission"] for flight in result["flights"]] == ["circuit"]


def test_a_mission_that_is_not_there_is_refused_before_any_flight(monkeypatch, capsys):
    monkeypatch.setattr(validation, "validate", lambda *_: pytest.fail("flown"))
    assert cli.main(["validate", "circuit", "nowhere"]) == 2
    assert "nowhere" in capsys.readouterr().err
