"""Studies of real take-offs: the rows of `harness takeoff`, the same bytes however they are flown and whoever dies."""

import os
import random
import shutil
import signal
import sqlite3
import time
from contextlib import suppress
from math import cos, radians, sin
from pathlib import Path

import pytest
from study_help import begin, cluster, content, gone, journalled, rows, run, workers_of

from harness.navigation.database import load
from harness.studies.cases import Cases
from harness.studies.conduct import open_study
from harness.studies.guard import _Worker
from harness.studies.journal import JOURNAL
from harness.takeoff.case import TakeOff
from harness.takeoff.flight import fly_take_off
from harness.takeoff.rows import row
from harness.units import KT

OUTPUTS = ("liftoff_distance_m", "distance_35ft_m", "time_35m_s", "greatest_deviation_m", "flaps")


def written(folder: Path, *masses: int) -> Path:
    """A study of take-offs with these masses (t), on two days, in a wind from the left."""
    wind = {"wind-from": "200 deg true", "wind-speed": "10 kt"}
    path = folder / "t.xml"
    path.write_text(
        '<study name="t" of="circuit" kind="take-off">'
        + "".join(f'<set path="environment/{name}" value="{value}"/>' for name, value in wind.items())
        + '<factor path="loading/take-off-mass" name="mass">'
        + f'<values list="{", ".join(f"{mass} t" for mass in masses)}"/></factor>'
        + '<factor path="environment/isa-deviation" name="heat"><values list="0 K, 30 K"/></factor>'
        + "".join(f'<output name="{name}"/>' for name in OUTPUTS)
        + "</study>",
        "utf-8",
    )
    return path


def test_a_row_is_what_harness_takeoff_flies(tmp_path: Path) -> None:
    run(written(tmp_path, 110), tmp_path / "out", workers=2)
    runway = load().runway("EDDM", "26L")
    angle = radians(200.0) - runway.true_heading
    case = TakeOff(
        mass=110e3,
        isa_deviation=30.0,
        elevation=runway.elevation,
        slope=runway.slope,
        heading=runway.true_heading,
        headwind=10 * KT * cos(angle),
        crosswind=10 * KT * sin(angle),
    )
    flown = row(fly_take_off(case))
    cold, hot = rows(tmp_path / "out")
    assert (cold["status"], hot["status"], hot["heat_K"]) == ("ok", "ok", 30.0)
    assert {name: hot[name] for name in OUTPUTS} == {name: flown[name] for name in OUTPUTS}
    assert hot["distance_35ft_m"] > cold["distance_35ft_m"]


@pytest.mark.slow
def test_the_same_bytes_serial_on_two_workers_on_a_cluster_and_resumed(tmp_path: Path) -> None:
    study = written(tmp_path, 89, 103, 117)
    run(study, tmp_path / "serial", workers=1)
    run(study, tmp_path / "two", workers=2)
    with cluster(tmp_path) as found:
        run(study, tmp_path / "cluster", cluster=found.address)
    process = begin(study, tmp_path / "resumed", "--workers", "1")
    limit = time.monotonic() + 60
    while _journalled_meanwhile(tmp_path / "resumed") < 2:
        assert time.monotonic() < limit
        time.sleep(0.05)
    process.kill()
    process.communicate()
    assert gone(process.pid)
    assert 2 <= journalled(tmp_path / "resumed") < 6
    run(study, tmp_path / "resumed", resume=True, workers=2)
    assert [row["status"] for row in rows(tmp_path / "serial")] == ["ok"] * 6
    for other in ("two", "cluster", "resumed"):
        assert content(tmp_path / other) == content(tmp_path / "serial")


@pytest.mark.slow
def test_workers_and_parents_are_killed_in_the_middle_of_take_offs(tmp_path: Path) -> None:
    study = written(tmp_path, *range(88, 124, 3))
    run(study, tmp_path / "undisturbed", workers=2)
    chance = random.Random(1)
    workers = parents = 0
    for _ in range(4):
        process = begin(study, tmp_path / "out", "--resume", "--workers", "2")
        for _ in range(2):
            time.sleep(chance.uniform(1.0, 2.0))
            for worker in workers_of(process.pid)[:1]:
                with suppress(ProcessLookupError):
                    os.kill(worker, signal.SIGKILL)
                    workers += 1
        parents += process.poll() is None
        process.kill()
        process.communicate()
        assert gone(process.pid, 5)
    assert workers >= 2
    assert parents >= 1
    assert run(study, tmp_path / "out", resume=True, workers=2)["counts"] == {"ok": 24}
    assert journalled(tmp_path / "out") == 24
    assert content(tmp_path / "out") == content(tmp_path / "undisturbed")


@pytest.mark.slow
def test_a_worker_does_not_grow_with_the_take_offs_it_has_flown(tmp_path: Path) -> None:
    """An aircraft that is not taken down is 1 to 2 MB; the simulator's own leak is 17 kB a case."""
    cases = Cases(open_study(written(tmp_path, 89)))
    request = cases.request(next(iter(cases)))
    worker = _Worker()
    sizes = []
    try:
        for _ in range(20):
            worker.ask(request, 60)
            assert worker.ask(None, 60)["status"] == "ok"
            sizes.append(_resident(worker._process.pid))
    finally:
        worker.close()
    assert sizes[-1] - sizes[4] < 1e6


def _journalled_meanwhile(folder: Path) -> int:
    """How many results are in the journal of a study that runs, which has it locked: those in a copy."""
    copy = folder.with_name("copy")
    copy.mkdir(exist_ok=True)
    try:
        for name in (JOURNAL, f"{JOURNAL}-wal"):
            shutil.copyfile(folder / name, copy / name)
        return journalled(copy)
    except (OSError, sqlite3.Error):  # not there yet, or caught in the middle
        return 0


def _resident(process: int) -> float:
    """Memory of a process, bytes."""
    (line,) = [
        line for line in Path(f"/proc/{process}/status").read_text().splitlines() if line.startswith("VmRSS")
    ]
    return float(line.split()[1]) * 1024
