"""What is remembered of a flight, and how it is kept."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from pyarrow import parquet

from harness.errors import InputError, OutputError
from harness.log import Event, FlightLog, Inputs, Run, RunFolder, conclude, read_run, write_run
from harness.log.run import UNITS
from harness.state import FIELDS, Commands, State

STEP = 1 / 24
SPEED = 80.0
FLOW = 0.5
RELEASE, LIFT_OFF, BOUNCED, TOUCHDOWN, END = 10.0, 40.0, 41.0, 300.0, 320.0


class Pilot:
    """Answers the log's questions."""

    def __init__(self) -> None:
        self.phase = "TXY.out"
        self.modes = {"SPD": "THR", "HP": "NAV", "VP": "PATH"}
        self.targets = {"cas": SPEED, "altitude": math.nan}
        self.waiting = ""


def state_at(time: float) -> State:
    airborne = LIFT_OFF <= time < TOUCHDOWN and not BOUNCED <= time < BOUNCED + 0.5
    values = dict.fromkeys(FIELDS, 0.0) | {
        "time": time,
        "latitude": time * SPEED / 6.4e6,
        "velocity_north": SPEED,
        "main_on_ground": float(not airborne),
        "mass": 100_000.0 - FLOW * time,
        "fuel": 12_000.0 - FLOW * time,
        "fuel_used": FLOW * time,
        "fuel_flow": FLOW,
        "cas": SPEED,
        "height": airborne * min(1000.0, 20.0 * (time - LIFT_OFF), 20.0 * (TOUCHDOWN - time)),
    }
    return State(**values)


def fly(log: FlightLog, end: float = END) -> None:
    pilot = Pilot()
    phases = {0.0: "TXY.out", 8.0: "T/O.run", LIFT_OFF: "DEP", TOUCHDOWN: "LDG.roll-out"}
    for step in range(round(end / STEP) + 1):
        time = step * STEP
        for begin in [begin for begin in phases if begin <= time]:
            pilot.phase = phases.pop(begin)
            log.note(Event(time, "phase", pilot.phase, pilot.phase, "because"))
        if step == round(100.0 / STEP):
            log.note(Event(time, "waypoint", "WP1", pilot.phase, "overhead"))
        brake = 0.0 if 2.0 < time < 7.0 or time >= RELEASE else 1.0
        log.see(state_at(time), Commands(brake=brake), pilot)


def run_of(log: FlightLog, failure: str = "") -> Run:
    fix = (100.0 * SPEED / 6.4e6, 0.0001)
    return conclude(
        log,
        Inputs(),
        identity={"mission": "test"},
        fixes={"WP1": fix},
        last_waypoint="WP1",
        mission_text="<mission/>\n",
        wall_time=2.0,
        outcome="stopped" if failure else "completed",
        reason=failure,
    )


@pytest.fixture
def run() -> Run:
    log = FlightLog()
    fly(log)
    return run_of(log)


def test_the_history_is_dense_on_the_runway_and_sparse_aloft_and_ends_with_the_last_step(run: Run) -> None:
    time = run.history["time"]
    aloft = (time > LIFT_OFF + 20.0) & (time < TOUCHDOWN - 20.0)
    assert np.diff(time[aloft]) == pytest.approx(1.0)
    assert np.diff(time[time < LIFT_OFF]) == pytest.approx(1 / 12)
    assert time[-1] == pytest.approx(END)


def test_every_number_in_the_history_has_a_unit() -> None:
    assert set(FIELDS) <= set(UNITS)


def test_words_and_targets_are_recorded(run: Run) -> None:
    assert set(run.history["phase"]) == {"TXY.out", "T/O.run", "DEP", "LDG.roll-out"}
    assert set(run.history["mode_SPD"]) == {"THR"}
    assert np.all(run.history["target_cas"] == SPEED)
    assert np.all(np.isnan(run.history["target_altitude"]))


def test_times_count_from_brake_release_in_the_take_off_run_to_touchdown(run: Run) -> None:
    summary = run.summary
    assert summary["brake_release_s"] == pytest.approx(RELEASE)
    assert summary["flight_time_s"] == pytest.approx(TOUCHDOWN - RELEASE)
    assert summary["block_time_s"] == pytest.approx(END - 2.0, abs=2 * STEP)
    assert summary["time_to_last_waypoint_s"] == pytest.approx(100.0 - RELEASE)


def test_a_bounce_is_not_a_touchdown(run: Run) -> None:
    assert run.summary["touchdown_s"] == pytest.approx(TOUCHDOWN)


def test_brakes_already_off_when_the_run_begins_count_from_there() -> None:
    log, pilot = FlightLog(), Pilot()
    log.see(state_at(0.0), Commands(brake=0.0), pilot)
    pilot.phase = "T/O.run"
    log.note(Event(1.0, "phase", "T/O.run", "T/O.run"))
    log.see(state_at(1.0), Commands(brake=0.0), pilot)
    assert log.moments["brake release"].time == 1.0


def test_fuel_distance_and_mass_agree_with_the_flight(run: Run) -> None:
    summary = run.summary
    assert summary["fuel_burned_kg"] == pytest.approx(FLOW * (TOUCHDOWN - RELEASE))
    assert summary["mass_closure_kg"] == pytest.approx(0.0, abs=1e-9)
    assert summary["distance_km"] == pytest.approx(SPEED * (TOUCHDOWN - RELEASE) / 1000)
    assert [phase["name"] for phase in summary["phases"]] == ["TXY.out", "T/O.run", "DEP", "LDG.roll-out"]
    assert sum(phase["fuel"] for phase in summary["phases"]) == pytest.approx(FLOW * END, abs=FLOW * STEP)


def test_a_passage_tells_where_and_how_close(run: Run) -> None:
    (passage,) = run.passages
    assert passage.time == pytest.approx(100.0)
    assert passage.distance == pytest.approx(SPEED * 90.0, rel=1e-3)
    assert 600.0 < passage.closest < 700.0  # 0.0001 rad east, and the flat track of this test


def test_a_run_reads_back_as_it_was_written(run: Run, tmp_path: Path) -> None:
    write_run(run, tmp_path)
    again = read_run(tmp_path)
    assert again.summary == run.summary
    assert again.events[2] == run.events[2]._replace(time=round(run.events[2].time, 3))
    assert again.passages[0].time == pytest.approx(run.passages[0].time, abs=1e-3)
    assert again.units == run.units
    assert list(again.history) == list(run.history)
    for name, column in run.history.items():
        np.testing.assert_array_equal(again.history[name], column)


def test_the_history_is_the_same_to_the_byte_every_time(tmp_path: Path) -> None:
    for name in "ab":
        log = FlightLog()
        fly(log)
        (tmp_path / name).mkdir()
        write_run(run_of(log), tmp_path / name)
    a, b = ((tmp_path / name / "history.parquet").read_bytes() for name in "ab")
    assert a == b


def test_units_are_in_the_metadata_of_the_columns(run: Run, tmp_path: Path) -> None:
    write_run(run, tmp_path)
    schema = parquet.read_schema(tmp_path / "history.parquet")
    assert schema.field("altitude").metadata == {b"unit": b"m"}
    assert schema.field("command_bank").metadata == {b"unit": b"rad"}


def test_a_flight_cut_short_is_kept_with_its_reason(tmp_path: Path) -> None:
    log = FlightLog()
    fly(log, end=60.0)
    write_run(run_of(log, failure="lost"), tmp_path)
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert (summary["completed"], summary["reason"], summary["flight_time_s"]) == (False, "lost", None)


def test_a_flight_that_never_began_leaves_an_empty_history(tmp_path: Path) -> None:
    write_run(run_of(FlightLog(), failure="lost"), tmp_path)
    assert read_run(tmp_path).history["time"].size == 0


def test_numbers_that_are_not_finite_become_null_in_the_summary() -> None:
    log = FlightLog()
    log.see(replace(state_at(0.0), mass=math.nan), Commands(brake=0.0), Pilot())
    json.dumps(run_of(log, failure="not finite").summary, allow_nan=False)


def test_runs_are_numbered_and_never_overwritten(tmp_path: Path) -> None:
    names = []
    for _ in range(3):
        with RunFolder(tmp_path, "a mission/../x") as folder:
            (folder.path / "summary.json").write_text("{}")
            names.append(folder.keep().name)
    assert names == ["a-mission-x-001", "a-mission-x-002", "a-mission-x-003"]
    assert sorted(path.name for path in tmp_path.iterdir()) == names


def test_a_run_that_breaks_leaves_nothing_behind(tmp_path: Path) -> None:
    def broken() -> None:
        with RunFolder(tmp_path, "x") as folder:
            (folder.path / "half").write_text("")
            raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        broken()
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_cannot_be_written_is_refused(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match=r"file: cannot be written: .*\n.*--out"):
        RunFolder(tmp_path / "file", "x")
    with pytest.raises(OutputError):
        RunFolder(tmp_path / "nul\0", "x")


def test_a_folder_that_is_no_run_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is not the folder of a run"):
        read_run(tmp_path)
