#!/usr/bin/env python3
"""Set up what is missing, then do it.

`python3 run.py ARGS` is `harness ARGS`, `python3 run.py test` is what CI checks. Needs Python 3.11+ with pip
and nothing else. Everything is installed into `.venv` beside this file, at the versions in constraints.txt; the
system's Python is left alone.
"""

from __future__ import annotations  # so that an older Python gets as far as being told

import hashlib
import os
import re
import subprocess
import sys
import time
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent
ENVIRONMENT = ROOT / ".venv"
PYTHON = ENVIRONMENT / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
STAMP = ENVIRONMENT / "harness-stamp"
OLDEST_PYTHON = (3, 11)
OLDEST_PIP = (22, 3)  # the first with --python

CHECKS = {
    "lint": ["-m", "ruff", "check", "."],
    "format": ["-m", "ruff", "format", "--check", "."],
    "types": ["-m", "mypy"],
    "layers": ["-c", "from importlinter.cli import lint_imports_command as lint; lint()"],
    "tests": ["-m", "pytest", "-n", "2"],
    "validation": ["-m", "pytest", "-n", "2", "-m", "slow", "--timeout", "900"],
}
"""What CI checks, in order: a name, and what the environment's Python runs."""


def main(arguments: list[str]) -> int:
    """Set up, then run the command; returns its exit code."""
    if sys.version_info < OLDEST_PYTHON:
        return fail(
            f"this is Python {sys.version.split()[0]}, the harness needs 3.11 or newer.",
            "start run.py with a newer one: python3.11 run.py ...",
        )
    testing = arguments[:1] == ["test"]
    if testing and arguments[1:]:
        rest = " ".join(arguments[1:])
        return fail(
            f"test takes no arguments, got: {rest}", f"a part of the tests: .venv/bin/python -m pytest {rest}"
        )
    problem = set_up()
    if problem:
        return fail(*problem)
    if testing:
        return check()
    return replace_by([str(PYTHON), "-P", "-m", "harness", *arguments])


def check() -> int:
    """Run every check, even after one failed; 0 when all passed."""
    failed = []
    for name, arguments in CHECKS.items():
        say(f"{name} ...")
        begin = time.monotonic()
        if subprocess.call([str(PYTHON), *arguments], cwd=ROOT):
            failed.append(name)
        say(f"{name} {'FAILED' if name in failed else 'passed'} after {time.monotonic() - begin:.0f} s")
    say("failed: " + ", ".join(failed) if failed else "all checks passed")
    return 1 if failed else 0


def set_up() -> tuple[str, str] | None:
    """Make the environment what the project asks for; returns what is wrong and its remedy."""
    wanted = stamp()
    if PYTHON.exists() and STAMP.exists() and STAMP.read_text("utf-8") == wanted:
        return None
    say(f"setting up {ENVIRONMENT} (once, about a minute)")
    if not works([str(PYTHON), "-c", ""]):
        venv.create(ENVIRONMENT, clear=True, with_pip=False, symlinks=os.name != "nt")
    pip = find_pip()
    if pip is None:
        return (
            f"found no pip that {sys.executable} can use.",
            "install pip 22.3 or newer for this Python (Debian: apt install python3-pip) and run this again.",
        )
    install = [
        *pip,
        "install",
        "--quiet",
        "--disable-pip-version-check",
        "-c",
        "constraints.txt",
        "-e",
        ".[test]",
    ]
    if subprocess.call(install, cwd=ROOT, stdout=sys.stderr):
        return (
            "the packages in constraints.txt could not be installed; pip says why above.",
            "pip must reach a package index: check the network and pip's settings, then run this again.",
        )
    STAMP.write_text(wanted, "utf-8")
    return None


def find_pip() -> list[str] | None:
    """A pip that can install there: this Python's, the environment's own, or the bundled one."""
    outside = [sys.executable, "-m", "pip"]
    version = re.match(r"pip (\d+)\.(\d+)", output([*outside, "--version"]))
    if version and (int(version[1]), int(version[2])) >= OLDEST_PIP:
        return [*outside, "--python", str(PYTHON)]
    inside = [str(PYTHON), "-m", "pip"]
    if works([*inside, "--version"]) or works([str(PYTHON), "-m", "ensurepip", "--default-pip"]):
        return inside
    return None


def stamp() -> str:
    """What the environment is made from: when any of it changes, it is brought up to date."""
    digest = hashlib.sha256()
    for name in ("pyproject.toml", "constraints.txt"):
        digest.update((ROOT / name).read_bytes())
    return f"{ROOT}\n{digest.hexdigest()}\n"


def output(command: list[str]) -> str:
    """What a command prints."""
    return subprocess.run(command, capture_output=True, text=True, check=False).stdout


def works(command: list[str]) -> bool:
    """Whether a command can be run and succeeds."""
    try:
        return subprocess.run(command, capture_output=True, check=False).returncode == 0
    except OSError:
        return False


def replace_by(command: list[str]) -> int:
    """Become the command, so that its signals and its exit code are ours."""
    if os.name != "nt":
        os.execv(command[0], command)
    return subprocess.call(command)


def say(text: str) -> None:
    """Progress goes to standard error: standard output belongs to the command."""
    print(f"run.py: {text}", file=sys.stderr, flush=True)


def fail(what: str, remedy: str) -> int:
    """Say what is wrong and what would be right."""
    say(f"{what}\n    {remedy}")
    return 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
