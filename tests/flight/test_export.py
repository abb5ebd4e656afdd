"""A flight exported as a JSBSim script and replayed by the stock program, without any Python of ours."""

import csv
import json
import subprocess
import sys
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest

from harness.cli import main
from harness.log import Inputs, Run
from harness.log.inputs import Write
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
GUST = """<event name="breath"><condition>simulation/sim-time-sec ge 200</condition>
  <set name="atmosphere/wind-down-fps" value="1e-6"/></event></run>"""
WIND = ("environment/wind-from=300 deg true", "environment/wind-speed=20 kt")
FAILURES = """<failures>
  <failure name="engine 1" phase="ENR.CRS"><when quantity="time-in-phase" at-least="20 s"/></failure>
</failures>"""


def test_what_the_aircraft_sets_back_is_never_held() -> None:
    summary = {"aircraft": "gta", "mission": "drops", "harness_version": "0", "aircraft_sha256": "0"}
    drops = [Write(24 * load, "payload/release", float(load)) for load in range(1, 8)]
    levers = [Write(step, "fcs/throttle-cmd-norm[0]", step / 300) for step in range(300)]
    text = script_of(Run({}, (), (), summary, ""), Inputs(120, 5, 300, [*drops, *levers]))
    held = [element.get("name") for element in fromstring(text).findall("run/event[@name='pilot']/set")]
    assert held == ["fcs/throttle-cmd-norm[0]"]
    released = [
        element for element in fromstring(text).iter("set") if element.get("name") == "payload/release"
    ]
    assert [element.get("value") for element in released] == [f"{load}.0" for load in range(1, 8)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("mission", "overrides", "failure", "rate"),
    [
        ("circuit", WIND, True, 120),
        ("airdrop", (), False, 120),
        ("circuit", (), False, 240),
    ],
    ids=["wind and engine failure", "airdrop", "240 Hz"],
)
def test_stock_jsbsim_replays_an_exported_flight_to_the_last_bit(
    mission: str, overrides: tuple[str, ...], *, failure: bool, rate: int, repository: Path, tmp_path: Path
) -> None:
    text = (repository / "missions" / f"{mission}.xml").read_text("utf-8")
    if failure:
        text = text.replace("</mission>", f"{FAILURES}</mission>")
    (tmp_path / "flown.xml").write_text(text, "utf-8")
    run, stopped = Session(tmp_path / "flown.xml", overrides).fly(rate=rate)
    assert stopped is None
    assert failure == any(event.kind == "failure" for event in run.events)
    assert (mission == "airdrop") == bool(run.history["dropped"][-1] > 7900)
    assert_replayed(run, repository, tmp_path, rate)


def assert_replayed(run: Run, root: Path, folder: Path, rate: int = 120) -> None:
    """Export a run and hold what the stock program makes of it against it."""
    assert run.inputs is not None
    write_script(script_of(run, run.inputs), folder / "flight.xml")
    rows = stock_replay(root, folder, rate)
    times = run.history["time"]
    assert len(times) > 500
    for field, (_, factor) in COLUMNS.items():
        column = list(COLUMNS).index(field)
        replayed = [rows[round(time * PILOT_RATE)][column] * factor for time in times[1:]]
        assert replayed == run.history[field][1:].tolist(), field


def stock_replay(root: Path, folder: Path, rate: int) -> dict[int, list[float]]:
    """Position and attitude at each pilot step, by the `jsbsim` command with 17 digits."""
    properties = "".join(f'<property precision="17">{name}</property>' for name, _ in COLUMNS.values())
    directive = f'<output name="{folder}/out.csv" type="CSV" rate="{PILOT_RATE}">{properties}</output>'
    (folder / "directive.xml").write_text(directive, "utf-8")
    arguments = (
        "--nohighlight",
        f"--root={root}",
        f"--script={folder}/flight.xml",
        f"--simulation-rate={rate}",
        f"--logdirectivefile={folder}/directive.xml",
    )
    command = [sys.executable, "-c", "from jsbsim.script import main; main()", *arguments]
    subprocess.run(command, check=True, capture_output=True, timeout=600)
    with (folder / "out.csv").open(encoding="utf-8") as file:
        rows = [[float(value) for value in row] for row in list(csv.reader(file))[1:]]
    return {round(row[0] * PILOT_RATE): row[1:] for row in rows}


@pytest.mark.slow
def test_a_flight_exported_and_replayed_by_us_is_told_to_be_identical(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    def told(*arguments: str, code: int = 0) -> dict[str, object]:
        assert main([*arguments, "--json"]) == code
        answer: dict[str, object] = json.loads(capsys.readouterr().out)
        return answer

    told("fly", "circuit", "--out", str(tmp_path))
    (run,) = tmp_path.glob("circuit-*")
    script = tmp_path / "flown.xml"
    told("export", str(run), "--out", str(script))
    same = told("replay", str(script), "--compare", str(run), "--out", str(tmp_path))
    assert same["identical"] is True
    assert same["max_position_m"] == same["max_attitude_deg"] == 0.0
    assert int(str(same["frames"])) > 500

    # A flight that differs by a hair is told to.
    text = script.read_text("utf-8")
    script.write_text(text.replace("</run>", GUST, 1), "utf-8")
    other = told("replay", str(script), "--compare", str(run), "--out", str(tmp_path), code=1)
    assert other["identical"] is False
    assert 0.0 < float(str(other["max_position_m"])) < 100.0
