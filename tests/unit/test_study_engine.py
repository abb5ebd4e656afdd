"""Studies that are run: the same bytes however they are run, and nothing lost whatever happens to them."""

import csv
import json
import os
import resource
import signal
import sqlite3
import subprocess
import sys
from collections.abc import Callable
from contextlib import closing
from functools import partial
from pathlib import Path

import pytest
from stub_kind import BUG, CRASH, DELAY, EXIT, FAIL, HANG
from study_help import (
    TESTS,
    await_marks,
    begin,
    content,
    finish,
    gone,
    journalled,
    rows,
    run,
    workers_of,
    write,
)

import harness
from harness import cli
from harness.errors import InputError, OutputError
from harness.studies import guard, table
from harness.studies.worker import pick

Make = Callable[..., Path]


@pytest.fixture
def make(tmp_path: Path) -> Make:
    """Writes a study of the stub kind, whose cases have the amounts of fuel it is called with."""
    return partial(write, tmp_path)


def test_the_table_has_one_row_a_case_with_units(make: Make, tmp_path: Path) -> None:
    summary = run(make(6000, 7000, 8000), tmp_path / "out")
    assert [row["x"] for row in rows(tmp_path / "out")] == [6000, 7000, 8000]
    first = rows(tmp_path / "out")[0]
    assert list(first) == [
        "case",
        "key",
        "seed",
        "fuel_kg",
        "status",
        "reason",
        "double",
        "word",
        "noise",
        "x",
    ]
    assert (first["case"], first["fuel_kg"], first["status"], first["double"], first["word"]) == (
        0, 6000.0, "ok", 12000.0, "w6000",
    )  # fmt: skip
    assert table.read(tmp_path / "out" / table.TABLE).schema.field("fuel_kg").metadata == {b"unit": b"kg"}
    assert summary["statistics"]["x"] == {
        "n": 3, "mean": 7000.0, "standard_deviation": 1000.0, "minimum": 6000.0, "maximum": 8000.0,
        "p5": 6100.0, "p25": 6500.0, "p50": 7000.0, "p75": 7500.0, "p95": 7900.0,
    }  # fmt: skip


def test_the_same_bytes_with_one_worker_and_with_three(make: Make, tmp_path: Path) -> None:
    study = make(spread='<range from="5 t" to="9 t" step="100 kg"/>')
    run(study, tmp_path / "one", workers=1)
    run(study, tmp_path / "three", workers=3)
    assert content(tmp_path / "one") == content(tmp_path / "three")


def test_a_case_that_misbehaves_is_named_and_takes_nobody_along(make: Make, tmp_path: Path) -> None:
    study = make(6000, CRASH, 6001, HANG, 6002, FAIL, 6003, BUG, 6004, EXIT, 6005, limit="2 s")
    summary = run(study, tmp_path / "out", workers=2)
    found = {row["fuel_kg"]: (row["status"], row["reason"]) for row in rows(tmp_path / "out")}
    assert [found[6000.0 + i][0] for i in range(6)] == ["ok"] * 6
    assert found[CRASH] == ("crashed", "its process was ended by SIGABRT")
    assert found[EXIT] == ("crashed", "its process ended with exit code 3")
    assert found[HANG] == ("timeout", "stopped at its wall limit of 2 s")
    assert found[FAIL] == ("failed", "t=1.0 s, T/O.run: flown into a test")
    assert found[BUG] == ("error", "a bug: ZeroDivisionError: a mistake of ours")
    assert summary["counts"] == {"crashed": 2, "error": 1, "failed": 1, "ok": 6, "timeout": 1}
    with closing(sqlite3.connect(tmp_path / "out" / "journal.sqlite")) as database:
        ((detail,),) = database.execute("SELECT detail FROM results WHERE status = 'error'")
    assert "stub_kind.py" in detail


@pytest.mark.slow
def test_a_stopped_worker_is_ended_at_the_limit(make: Make, tmp_path: Path) -> None:
    process = begin(make(6000, 6001, 6002, limit="2 s"), tmp_path / "out", "--workers", "1", delay=0.5)
    await_marks(tmp_path / "out", 1)
    os.kill(workers_of(process.pid)[0], signal.SIGSTOP)
    assert finish(process)[0] == 3
    assert sorted(str(row["status"]) for row in rows(tmp_path / "out")) == ["ok", "ok", "timeout"]
    assert gone(process.pid)


def test_failed_cases_are_tried_again_by_resume(
    make: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study = make(6000, 6001, limit="1 s")
    monkeypatch.setenv(DELAY, "3")
    assert run(study, tmp_path / "out")["counts"] == {"timeout": 2}
    monkeypatch.setenv(DELAY, "0")
    assert run(study, tmp_path / "out", resume=True)["counts"] == {"ok": 2}
    run(study, tmp_path / "undisturbed")
    assert content(tmp_path / "out") == content(tmp_path / "undisturbed")


def test_a_finished_study_is_resumed_at_once(make: Make, tmp_path: Path) -> None:
    study = make(spread='<range from="5 t" to="9 t" step="10 kg"/>')
    summary = run(study, tmp_path / "out")
    before = content(tmp_path / "out")
    used = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    assert finish(begin(study, tmp_path / "out", "--resume")) == (0, "")
    # processor time, which another load does not lengthen: there is nothing it waits for
    assert sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]) - used < 1.0
    assert content(tmp_path / "out") == before
    assert run(study, tmp_path / "out", resume=True) == summary


def test_the_csv_has_the_numbers_of_the_table(make: Make, tmp_path: Path) -> None:
    study, out = make(6000, FAIL, 7000.1), tmp_path / "out"
    run(study, out)
    assert not (out / table.CSV).exists()
    run(study, out, resume=True, csv=True)
    with (out / table.CSV).open(encoding="utf-8", newline="") as file:
        found = list(csv.DictReader(file))
    assert [list(row) for row in found] == [list(row) for row in rows(out)]
    for text, row in zip(found, rows(out), strict=True):
        for name, value in row.items():
            read = float(text[name]) if isinstance(value, float) else text[name]
            assert read == ("" if value is None else value if isinstance(value, float) else str(value))
    assert (found[1]["status"], found[1]["double"], found[1]["word"]) == ("failed", "", "")
    (out / table.CSV).write_text("old", "utf-8")  # would be of another table: it is kept up with it
    run(study, out, resume=True)
    assert (out / table.CSV).read_text("utf-8").startswith('"case","key"')


def test_a_table_that_was_damaged_is_written_anew(make: Make, tmp_path: Path) -> None:
    study = make(6000, 7000)
    run(study, tmp_path / "out")
    before = content(tmp_path / "out")
    (tmp_path / "out" / table.TABLE).write_bytes(before[:100])
    with pytest.raises(InputError, match="damaged or cut short"):
        table.read(tmp_path / "out" / table.TABLE)
    run(study, tmp_path / "out", resume=True)
    assert content(tmp_path / "out") == before


def test_the_results_of_another_study_are_refused_and_kept(make: Make, tmp_path: Path) -> None:
    study = make(6000)
    run(study, tmp_path / "out")
    kept = {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()}
    with pytest.raises(InputError, match="continue it with --resume"):
        run(study, tmp_path / "out")
    with pytest.raises(InputError, match='the results of the study "s", not of "other"'):
        run(make(6000, name="other"), tmp_path / "out", resume=True)
    with pytest.raises(InputError, match="before its file or its mission was changed"):
        run(make(6000, 7000), tmp_path / "out", resume=True)
    assert {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()} == kept
    (tmp_path / "holiday").mkdir()
    (tmp_path / "holiday" / "picture.png").touch()
    with pytest.raises(OutputError, match="is not empty"):
        run(study, tmp_path / "holiday")
    assert [file.name for file in (tmp_path / "holiday").iterdir()] == ["picture.png"]


@pytest.mark.parametrize(
    "damage", [lambda b: b"", lambda b: b[: len(b) // 2], lambda b: b[:100], lambda b: b"x" * 9000]
)
def test_a_damaged_journal_is_told(make: Make, tmp_path: Path, damage: Callable[[bytes], bytes]) -> None:
    study = make(spread='<range from="5 t" to="9 t" step="10 kg"/>')
    run(study, tmp_path / "out")
    journal = tmp_path / "out" / "journal.sqlite"
    damaged = damage(journal.read_bytes())
    journal.write_bytes(damaged)
    with pytest.raises(InputError, match="damaged or cut short") as caught:
        run(study, tmp_path / "out", resume=True)
    assert caught.value.file == str(journal)
    assert journal.read_bytes() == damaged


@pytest.mark.slow
def test_two_studies_in_one_folder_are_one_too_many(make: Make, tmp_path: Path) -> None:
    study = make(6000, 6001, 6002)
    process = begin(study, tmp_path / "out", "--workers", "1", delay=1.0)
    await_marks(tmp_path / "out", 1)
    with pytest.raises(InputError, match="is in use"):
        run(study, tmp_path / "out", resume=True)
    assert finish(process)[0] == 0


def test_many_cases_are_asked_about(make: Make, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    study = make(spread='<range from="5 t" to="9 t" step="1 g"/>'.replace("1 g", "0.004 kg"))
    code, said = finish(begin(study, tmp_path / "out"))
    assert code == 2
    assert "1,000,001 cases" in said
    assert "--yes" in said
    assert not (tmp_path / "out").exists()


def test_a_mistake_leaves_no_folder(make: Make, tmp_path: Path) -> None:
    study = make(6000)
    study.write_text(study.read_text("utf-8").replace("loading/fuel", "loading/fule"), "utf-8")
    code, said = finish(begin(study, tmp_path / "out"))
    assert code == 2
    assert "fule" in said
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("end", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_study_says_so_and_goes_on(make: Make, tmp_path: Path, end: signal.Signals) -> None:
    study = make(*range(6000, 6030))
    process = begin(study, tmp_path / "out", "--workers", "2", delay=0.3)
    await_marks(tmp_path / "out", 4)
    process.send_signal(end)
    code, said = finish(process, 20)
    assert (code, "--resume" in said) == (130, True), said
    assert gone(process.pid)
    assert 0 < journalled(tmp_path / "out") < 30
    assert finish(begin(study, tmp_path / "out", "--resume"))[0] == 0
    assert len(rows(tmp_path / "out")) == 30


def test_a_study_interrupted_before_it_began_says_so(
    make: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("harness.studies.conduct.run_study", interrupt)
    assert cli.main(["study", str(make(6000)), "--out", str(tmp_path / "out")]) == 130
    assert "nothing was begun" in capsys.readouterr().err


def test_no_worker_outlives_its_parent(make: Make, tmp_path: Path) -> None:
    process = begin(make(HANG, 6000, limit="500 s"), tmp_path / "out", "--workers", "2")
    await_marks(tmp_path / "out", 1)
    assert len(workers_of(process.pid)) == 2
    process.kill()
    process.communicate()
    assert gone(process.pid, 5)


def test_a_full_disk_loses_nothing(make: Make, tmp_path: Path) -> None:
    study = make(spread='<range from="5 t" to="7 t" step="10 kg"/>')
    command = [sys.executable, str(TESTS / "stub_study.py"), str(study), "--out", str(tmp_path / "out")]
    full = subprocess.run(
        command,
        env={**os.environ, "PYTHONPATH": str(TESTS.parent)},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000)),
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert full.returncode == 2, full.stderr
    assert "make room, then continue with --resume" in full.stderr
    assert "Traceback" not in full.stderr
    before = journalled(tmp_path / "out")
    assert before > 10
    summary = run(study, tmp_path / "out", resume=True)
    assert summary["counts"] == {"ok": 201}
    assert summary["cases_run"] == 201 - before
    run(study, tmp_path / "undisturbed")
    assert content(tmp_path / "out") == content(tmp_path / "undisturbed")


def test_what_is_kept_and_what_is_flown_again_is_told(
    make: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    study, out, told = make(6000, 7000, FAIL), tmp_path / "out", []
    run(study, out)
    with closing(sqlite3.connect(out / "journal.sqlite")) as database, database:
        database.execute("DELETE FROM results WHERE outputs LIKE '%w7000%'")
    assert run(study, out, resume=True, tell=told.append)["cases_run"] == 2
    counts = "1 not flown yet, 1 that did not succeed before"
    assert told.pop() == f"s: 1 of 3 rows are kept; to fly: {counts}"
    monkeypatch.setattr("harness.resources.fingerprint", lambda aircraft: "another aircraft")
    assert run(study, out, resume=True, tell=told.append)["cases_run"] == 3
    why = "3 not flown since the aircraft's files changed"
    assert told.pop() == f"s: 0 of 3 rows are kept; to fly: {why}"
    monkeypatch.undo()  # the rows of the aircraft as it was are there still
    assert run(study, out, resume=True, tell=told.append)["cases_run"] == 1
    assert told.pop() == "s: 2 of 3 rows are kept; to fly: 1 that did not succeed before"
    monkeypatch.setattr("harness.studies.cases.code_fingerprint", lambda: "other")
    # the workers really have the code that is there
    with pytest.raises(guard.WorkerError, match="another version"):
        run(study, out, resume=True, tell=told.append)
    why = "3 not flown since the harness or one of its libraries changed"
    assert told.pop() == f"s: 0 of 3 rows are kept; to fly: {why}"


def test_a_study_is_a_table_in_python(make: Make, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    seen: list[tuple[int, int, int]] = []
    study = make(6000, FAIL)
    found = harness.study(study, workers=1, progress=lambda *numbers: seen.append(numbers))
    assert found["double"].to_pylist() == [12000.0, None]
    assert seen[-1] == (2, 2, 1)
    assert harness.study(study)["status"].to_pylist() == ["ok", "failed"]
    assert {path.name for path in tmp_path.iterdir()} == {"s.xml"}


@pytest.mark.slow
def test_sobol_indices_of_a_function_that_is_known(make: Make, tmp_path: Path) -> None:
    study = make(
        spread='<range from="5 t" to="9 t"/>',
        design='<factor path="environment/qnh"><range from="990 hPa" to="1010 hPa"/></factor>'
        '<design kind="sobol" n="64" seed="1"/>',
    )
    summary = run(study, tmp_path / "out")
    assert summary["cases"] == 256
    found = summary["sobol"]["double"]  # 2 * fuel: all of it the fuel's, nothing the pressure's
    assert found["fuel_kg"]["first"] == pytest.approx(1.0, abs=0.05)
    assert found["fuel_kg"]["total"] == pytest.approx(1.0, abs=0.05)
    assert found["environment_qnh_Pa"]["total"] == pytest.approx(0.0, abs=1e-9)


def test_the_command_prints_a_table_or_data(
    make: Make, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    study = make(6000, FAIL)
    assert cli.main(["study", str(study), "--out", str(tmp_path / "out"), "--json"]) == 3
    data = json.loads(capsys.readouterr().out)
    assert data["counts"] == {"failed": 1, "ok": 1}
    assert cli.main(["study", str(study), "--out", str(tmp_path / "out"), "--resume"]) == 3
    out = capsys.readouterr().out
    assert "1 x failed: t=1.0 s, T/O.run: flown into a test" in out
    assert "double" in out


def test_wrong_numbers_of_workers_are_refused(make: Make, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="at least one worker"):
        run(make(6000), tmp_path / "out", workers=0)
    with pytest.raises(InputError, match="too many for"):
        run(make(6000), tmp_path / "out", workers=100_000)
    with pytest.raises(InputError, match="a cluster has its own workers"):
        run(make(6000), tmp_path / "out", workers=2, cluster="tcp://127.0.0.1:1")
    assert not (tmp_path / "out").exists()


def test_a_dotted_path_finds_its_way() -> None:
    found = {"a": {"b": 1.0}, "phases": [{"name": "T/O.run", "fuel": 2.0}, {"name": "T/O.run", "fuel": 3.0}]}
    assert pick(found, "a.b") == 1.0
    assert pick(found, "phases[T/O.run].fuel") == 2.0
    assert pick({"rejected_take_off": None}, "rejected_take_off.stop_s") is None
    assert pick(found, "phases[DEP].fuel") is None
    for path in ("a.c", "phases[T/O.run].fule"):
        with pytest.raises(LookupError, match="there is no"):
            pick(found, path)
