"""Every script runs with the stock program, without any Python of ours, and does what it says."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

SAID = {
    "gta-landing": ("touchdown: spoilers", "stopped"),
    "gta-engine-failure": ("engine failure", "gear up"),
    "gta-takeoff": ("lift-off", "flaps up"),
    "gta-cruise": ("released", "wings level"),
}
"""Events that must come."""
STOCK = "import sys; from jsbsim.script import main; sys.exit(main())"


def stock(repository: Path, name: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", STOCK, "--root=.", f"--script=scripts/{name}.xml"],
        cwd=repository,
        capture_output=True,
        check=False,
        timeout=300,
    )
    text = re.sub(rb"\x1b\[[0-9;]*m", b"", done.stdout + done.stderr).decode("utf-8", "replace")
    assert done.returncode in (0, None), text[-2000:]
    return text


@pytest.mark.slow
@pytest.mark.parametrize("name", SAID)
def test_a_script_runs_with_the_stock_program(repository: Path, name: str) -> None:
    said = stock(repository, name)
    places = [said.find(f"{event}") for event in SAID[name]]
    assert -1 not in places, said[-2000:]
    assert places == sorted(places)
    assert not re.search(r"\bnan\b|ERROR|CRASH", said)


@pytest.mark.slow
def test_the_engine_failure_is_climbed_away_from(repository: Path) -> None:
    heights = re.findall(r"position/h-agl-ft = ([\d.]+)", stock(repository, "gta-engine-failure"))
    assert float(heights[-1]) > 1000.0
