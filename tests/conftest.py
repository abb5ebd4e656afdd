"""Shared by all tests: where things are, and a command line to call."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

Command = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="session")
def repository() -> Path:
    """The root of the repository."""
    return Path(__file__).resolve().parents[1]


@pytest.fixture
def harness(tmp_path: Path, repository: Path) -> Command:
    """Runs `harness ARGS` in a process of its own, in an empty folder."""
    environment = {**os.environ, "PYTHONPATH": str(repository)}

    def run(*arguments: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [sys.executable, "-P", "-m", "harness", *arguments],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env=environment,
            check=False,
            timeout=600,
        )

    return run
