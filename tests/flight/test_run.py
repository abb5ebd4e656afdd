"""A whole flight through the command line: what it leaves behind, and that it can be had again."""

import json
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import Command
from pyarrow import parquet

import harness
from harness.log import Event, Reporter, read_run
from harness.session import Session
from harness.state import Commands, State

FILES = {
    "summary.json",
    "events.csv",
    "waypoints.csv",
    "history.parquet",
    "mission.xml",
    "route_map.png",
    "profile.png",
    "modes.png",
}
MISSION = "circuit"


@pytest.fixture(scope="module")
def flown(
    tmp_path_factory: pytest.TempPathFactory, repository: Path
) -> tuple[subprocess.CompletedProcess[str], Path]:
    out = tmp_path_factory.mktemp("out") / "new" / "runs"
    command = [sys.executable, "-m", "harness", "fly", MISSION, "--json", "--out", str(out)]
    return subprocess.run(command, cwd=repository, capture_output=True, text=True, check=False), out


def test_the_result_is_alone_on_standard_output(flown: tuple[subprocess.CompletedProcess[str], Path]) -> None:
    result, out = flown
    assert result.returncode == 0, result.stderr
    summary = json.loads(result.stdout)
    assert summary["completed"] is True
    assert summary["folder"] == str(out / "circuit-001")


def test_the_folder_holds_the_whole_run_and_nothing_else(
    flown: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    _, out = flown
    assert [path.name for path in out.iterdir()] == ["circuit-001"]
    assert {path.name for path in (out / "circuit-001").iterdir()} >= FILES
    assert len(read_run(out / "circuit-001").passages) > 0


def test_the_summary_closes_the_mass(flown: tuple[subprocess.CompletedProcess[str], Path]) -> None:
    summary = read_run(flown[1] / "circuit-001").summary
    assert abs(summary["mass_closure_kg"]) < 0.1
    assert summary["takeoff_mass_kg"] - summary["landing_mass_kg"] == pytest.approx(
        summary["fuel_burned_kg"], abs=0.1
    )


def test_the_same_flight_in_another_process_is_the_same_to_the_byte(
    flown: tuple[subprocess.CompletedProcess[str], Path], tmp_path: Path
) -> None:
    run = harness.fly(MISSION, out=tmp_path)
    assert run.folder is not None
    mine, theirs = (folder / "history.parquet" for folder in (run.folder, flown[1] / "circuit-001"))
    assert mine.read_bytes() == theirs.read_bytes()
    assert (run.folder / "events.csv").read_bytes() == (theirs.parent / "events.csv").read_bytes()


def test_every_number_of_the_history_has_its_unit_in_the_file(
    flown: tuple[subprocess.CompletedProcess[str], Path],
) -> None:
    for field in parquet.read_schema(flown[1] / "circuit-001" / "history.parquet"):
        assert (field.metadata is not None) == (str(field.type) == "double")


def test_the_mission_kept_flies_again(
    flown: tuple[subprocess.CompletedProcess[str], Path], harness: Command, tmp_path: Path
) -> None:
    shutil.copy(flown[1] / "circuit-001" / "mission.xml", tmp_path / "again.xml")
    result = harness("check", "again.xml", "--json")
    assert json.loads(result.stdout)["ok"] is True


class Impatient:
    """Presses Ctrl-C after a while."""

    def __init__(self, until: float) -> None:
        self.until = until

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        if state.time > self.until:
            raise KeyboardInterrupt

    def note(self, event: Event) -> None:
        pass


def test_an_interrupted_flight_is_kept(tmp_path: Path) -> None:
    with pytest.raises(KeyboardInterrupt):
        harness.fly(MISSION, out=tmp_path, progress=Impatient(10.0))
    run = read_run(tmp_path / "circuit-001")
    assert 10.0 < run.history["time"][-1] <= 10.5  # at the pilot's next look
    assert (run.summary["completed"], run.summary["reason"]) == (False, "interrupted from the keyboard")


def test_nothing_is_written_unless_asked(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    run, stopped = Session(MISSION).fly(progress=Impatient(1.0))
    assert isinstance(stopped, KeyboardInterrupt)
    assert run.folder is None
    assert list(tmp_path.iterdir()) == []


def test_real_time_is_no_faster_than_the_clock() -> None:
    begin = time.monotonic()
    Session(MISSION).fly(realtime=True, progress=Impatient(0.5))
    assert time.monotonic() - begin >= 0.5
