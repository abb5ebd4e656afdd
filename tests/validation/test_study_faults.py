"""A study of a thousand cases under fire: workers and parents are killed, and no row is lost, doubled or changed."""

import os
import random
import signal
import time
from contextlib import suppress
from pathlib import Path

import pytest
from study_help import begin, content, finish, gone, rows, run, workers_of, write

pytestmark = pytest.mark.slow
THOUSAND = '<range from="5000 kg" to="5999 kg" step="1 kg"/>'


def test_fifty_workers_and_twenty_parents_are_killed(tmp_path: Path) -> None:
    study = write(tmp_path, spread=THOUSAND)
    run(study, tmp_path / "undisturbed", workers=2)
    chance = random.Random(1)
    killed = parents = 0
    while parents < 20:
        process = begin(study, tmp_path / "out", "--resume", "--workers", "2", delay=0.04)
        for _ in range(3):
            time.sleep(chance.uniform(0.3, 0.8))
            for worker in workers_of(process.pid)[:1]:
                with suppress(ProcessLookupError):
                    os.kill(worker, signal.SIGKILL)
                    killed += 1
        if process.poll() is None:
            process.kill()
            parents += 1
        process.communicate()
        assert gone(process.pid, 5)
        if process.returncode == 0:  # it was faster than the killing: begin another
            break
    while killed < 50:
        process = begin(study, tmp_path / "more", "--resume", "--workers", "2", delay=0.04)
        time.sleep(1)
        while process.poll() is None and killed < 50:
            for worker in workers_of(process.pid)[:1]:
                with suppress(ProcessLookupError):
                    os.kill(worker, signal.SIGKILL)
                    killed += 1
            time.sleep(chance.uniform(0.1, 0.4))
        assert finish(process)[0] in {0, 3}
    assert killed >= 50
    assert parents == 20
    for folder in ("out", "more"):
        finish(begin(study, tmp_path / folder, "--resume"))
        assert finish(begin(study, tmp_path / folder, "--resume"))[0] == 0
        assert [row["case"] for row in rows(tmp_path / folder)] == list(range(1000))
        assert content(tmp_path / folder) == content(tmp_path / "undisturbed")
