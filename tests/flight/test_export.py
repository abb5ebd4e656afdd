"""A flight exported as a JSBSim script and replayed by the stock program, without any Python of ours."""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

from harness.replay.export import script_of, write_script
from harness.session import Session
from harness.units import FT

COLUMNS = {
    "latitude": ("position/lat-geod-rad", 1.0),
    "longitude": ("position/long-gc-rad", 1.0),
    "altitude": ("position/h-sl-ft", FT),
    "roll": ("attitude/phi-rad", 1.0),
    "pitch": ("attitude/theta-rad", 1.0),
    "heading": ("attitude/psi-rad", 1.0),
}
PILOT_RATE = 24


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mission", "overrides"),
    [("circuit", ["environment/wind-from=300 deg true", "environment/wind-speed=20 kt"])],
    ids=["wind"],
)
def test_stock_jsbsim_replays_an_exported_flight_to_the_last_bit(
    mission: str, overrides: list[str], repository: Path, tmp_path: Path
) -> None:
    run, stopped = Session(mission, overrides).fly()
    assert stopped is None
    assert run.inputs is not None
    write_script(script_of(run, run.inputs), tmp_path / "flight.xml")
    rows = stock_replay(repository, tmp_path)
    times = run.history["time"]
    assert len(times) > 500
    for field, (_, factor) in COLUMNS.items():
        column = list(COLUMNS).index(field)
        replayed = [rows[round(time * PILOT_RATE)][column] * factor for time in times[1:]]
        assert replayed == run.history[field][1:].tolist(), field


def stock_replay(root: Path, folder: Path) -> dict[int, list[float]]:
    """Position and attitude at each pilot step, by the `jsbsim` command with 17 digits."""
    properties = "".join(f'<property precision="17">{name}</property>' for name, _ in COLUMNS.values())
    directive = f'<output name="{folder}/out.csv" type="CSV" rate="{PILOT_RATE}">{properties}</output>'
    (folder / "directive.xml").write_text(directive, "utf-8")
    arguments = (
        "--nohighlight",
        f"--root={root}",
        f"--script={folder}/flight.xml",
        f"--logdirectivefile={folder}/directive.xml",
    )
    command = [sys.executable, "-c", "from jsbsim.script import main; main()", *arguments]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    with (folder / "out.csv").open(encoding="utf-8") as file:
        rows = [[float(value) for value in row] for row in list(csv.reader(file))[1:]]
    return {round(row[0] * PILOT_RATE): row[1:] for row in rows}
