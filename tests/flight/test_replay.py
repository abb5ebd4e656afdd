"""JSBSim scripts replayed: ours and others', what they may not do, and what becomes of those that fail."""

import importlib.util
import json
import sys
from pathlib import Path
from types import ModuleType

import jsbsim
import numpy as np
import pytest

from harness.cli import main
from harness.errors import FlightError, InputError
from harness.log import read_run
from harness.replay.player import Choices, replay

SHIPPED = Path(jsbsim.__file__).parent

SCRIPT = """<?xml version="1.0"?>
<runscript name="test">
  <use aircraft="gta" initialize="parked"/>
  <run start="0" end="1.0" dt="0.005">
    {run}
    <event name="flaps"><condition> simulation/sim-time-sec ge 0.5 </condition>
      <set name="fcs/flap-cmd-norm" value="1"/><notify><property>fcs/flap-cmd-norm</property></notify></event>
  </run>
</runscript>
"""


@pytest.fixture
def script(tmp_path: Path) -> Path:
    file = tmp_path / "test.xml"
    file.write_text(SCRIPT.format(run=""), "utf-8")
    return file


def test_a_script_is_replayed_at_its_own_step_into_a_run(script: Path, tmp_path: Path) -> None:
    run, stopped, _ = replay(str(script), tmp_path / "runs", Choices())
    assert stopped is None
    assert run.summary["step_s"] == 0.005
    assert run.summary["frames"] == 201  # JSBSim goes one frame past the end
    assert [(event.time, event.name, event.detail) for event in run.events] == [
        (0.5, "flaps", "fcs/flap-cmd-norm = 1")
    ]
    assert np.all(np.diff(run.history["time"]) > 0)
    assert run.history["command_flap"][-1] == 1.0
    assert run.folder is not None
    kept = read_run(run.folder)
    assert kept.summary == json.loads(json.dumps(run.summary))
    assert {file.name for file in run.folder.iterdir()} >= {
        "history.parquet",
        "profile.png",
        "script.xml",
        "track.png",
    }


def test_rate_end_and_settings_are_obeyed(script: Path, tmp_path: Path) -> None:
    choices = Choices(rate=100.0, end=0.2, settings=(("fcs/flap-cmd-norm", 0.25),))
    run, _, _ = replay(str(script), tmp_path / "runs", choices)
    assert run.summary["step_s"] == 0.01
    assert run.summary["frames"] in (20, 21)  # the sum of 20 steps may be a hair above 0.2
    assert run.history["command_flap"][-1] == 0.25


def test_outputs_stay_in_the_run_and_sockets_stay_shut(tmp_path: Path) -> None:
    outside = tmp_path / "outside.csv"
    outputs = (
        f'</run><output name="{outside}" type="CSV" rate="10"><property>fcs/flap-cmd-norm</property></output>'
        '<output name="localhost" type="SOCKET" port="41234" protocol="TCP" rate="10"/><input port="41235"/><run>'
    )
    file = tmp_path / "talks.xml"
    file.write_text(SCRIPT.format(run="").replace("</run>", outputs.removesuffix("<run>"), 1), "utf-8")
    run, _, _ = replay(str(file), tmp_path / "runs", Choices())
    assert not outside.exists()
    assert run.folder is not None
    assert (run.folder / "outside.csv").stat().st_size > 0
    staged = (run.folder / "jsbsim.log").read_text("utf-8") if (run.folder / "jsbsim.log").exists() else ""
    assert "41234" not in staged


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("<runscript", "<mission"), "not a <runscript>"),
        (('aircraft="gta"', 'aircraft="gtaa"'), 'no aircraft "gtaa"'),
        (('dt="0.005"', 'dt="quick"'), "is not a number"),
        (('initialize="parked"', 'initialize="flying"'), "could not be read"),
        (("sim-time-sec ge", "sim-time-sec gee"), 'test.xml:6: .*"gee" does not exist'),
    ],
)
def test_what_is_no_script_is_refused_with_its_file(
    change: tuple[str, str], message: str, script: Path, tmp_path: Path
) -> None:
    text = script.read_text("utf-8").replace(*change)
    script.write_text(
        text.replace("</runscript>", f"</{change[1][1:]}>") if "mission" in change[1] else text, "utf-8"
    )
    with pytest.raises(InputError, match=message) as caught:
        replay(str(script), tmp_path / "runs", Choices())
    assert caught.value.file == str(script)
    assert not list((tmp_path / "runs").glob("*")) if (tmp_path / "runs").exists() else True


def test_a_misspelt_property_is_no_new_one(
    script: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["replay", str(script), "--set", "fcs/flap-cmd-nrom=1", "--out", str(tmp_path / "runs")]) == 2
    assert "did you mean fcs/flap-cmd-norm" in capsys.readouterr().err


def test_a_script_that_aborts_jsbsim_does_not_take_us_along(tmp_path: Path, script: Path) -> None:
    root = tmp_path / "root"
    home = root / "aircraft" / "stone"
    home.mkdir(parents=True)
    plain = (SHIPPED / "aircraft" / "ball" / "ball.xml").read_text("utf-8")
    unknown = '<axis name="DRAG"><function name="aero/d"><property>no/such</property></function></axis>'
    aerodynamics = f"<aerodynamics>{unknown}</aerodynamics></fdm_config>"
    text = plain.partition("<aerodynamics")[0] + aerodynamics
    (home / "stone.xml").write_text(text, "utf-8")
    (home / "parked.xml").write_text('<initialize name="parked"/>', "utf-8")
    script.write_text(script.read_text("utf-8").replace('"gta"', '"stone"'), "utf-8")
    with pytest.raises(FlightError) as caught:
        replay(str(script), tmp_path / "runs", Choices(root=root))
    assert caught.value.exit_code == 3
    assert "ended the process" in str(caught.value)
    assert "no/such does not exist" in str(caught.value)


def test_a_property_that_is_not_there_is_told_with_its_line(script: Path, tmp_path: Path) -> None:
    script.write_text(SCRIPT.format(run="").replace("simulation/sim-time-sec ge", "fcs/flop ge"), "utf-8")
    _, stopped, _ = replay(str(script), tmp_path / "runs", Choices())
    assert f"{script}:6 names it" in str(stopped)


def test_a_name_that_is_no_script_is_answered_with_those_there_are(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="did you mean gta-takeoff"):
        replay("gta-takeof", tmp_path, Choices())


def test_a_script_without_an_end_is_stopped_by_its_limit(script: Path, tmp_path: Path) -> None:
    script.write_text(script.read_text("utf-8").replace('end="1.0"', 'end="1e9"'), "utf-8")
    run, stopped, _ = replay(str(script), tmp_path / "runs", Choices(limit=1.0))
    assert stopped is not None
    assert "has not ended after 1 s" in str(stopped)
    assert run.history["time"][-1] > 1.0


def test_a_state_that_is_no_number_is_named(tmp_path: Path) -> None:
    file = tmp_path / "nan.xml"
    heavy = '<set name="inertia/pointmass-weight-lbs[0]" value="1e308"/>'
    text = SCRIPT.format(run="").replace('<set name="fcs/flap-cmd-norm" value="1"/>', heavy)
    file.write_text(text.replace('end="1.0"', 'end="20"'), "utf-8")
    _, stopped, _ = replay(str(file), tmp_path / "runs", Choices())
    assert stopped is not None
    assert "no longer finite" in str(stopped)


def test_export_needs_the_record_of_a_flight(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["export", str(tmp_path)]) == 2
    assert "not the folder of a run" in capsys.readouterr().err


SHIPPED_SCRIPTS = (
    "737_cruise",
    "c1723",
    "c3104",
    "737_cruise_steady_turn_simplex",
    "ball_orbit",
    "weather-balloon",
)


@pytest.mark.parametrize(
    "name",
    ["plotfile", "Short_S23_1", *(pytest.param(name, marks=pytest.mark.slow) for name in SHIPPED_SCRIPTS)],
)
def test_a_shipped_script_ends_as_with_the_stock_program(name: str, shipped: ModuleType) -> None:
    both = shipped.pair(SHIPPED / "scripts" / f"{name}.xml", 5.0)
    assert both.same, both
    assert bool(both.ours.message) == (name in {"plotfile", "737_cruise_steady_turn_simplex"})


@pytest.fixture(scope="module")
def shipped(repository: Path) -> ModuleType:
    """The generator of the table in docs/scripts.md."""
    spec = importlib.util.spec_from_file_location("shipped", repository / "docs" / "shipped_scripts.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["shipped"] = module
    spec.loader.exec_module(module)
    return module


def test_what_jsbsim_writes_where_it_stands_stays_in_the_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    replay(str(SHIPPED / "scripts" / "737_cruise_steady_turn_linearize.xml"), "runs", Choices(end=1.0))
    assert [file.name for file in here.iterdir()] == ["runs"]
    assert list(here.glob("runs/*/737_lin.sce"))


def test_entities_of_a_script_are_put_in_but_no_flood_and_no_other_file(script: Path, tmp_path: Path) -> None:
    plain = script.read_text("utf-8").replace('value="1"', 'value="&all;"')
    entities = {
        '<!ENTITY all "0.75">': "",
        '<!ENTITY all SYSTEM "file:///etc/hostname">': "well-formed",
        f'<!ENTITY a "{"1" * 9000}"><!ENTITY b "{"&a;" * 900}"><!ENTITY all "{"&b;" * 900}">': "mplification",
    }
    for entity, refusal in entities.items():
        script.write_text(
            plain.replace("<runscript", f"<!DOCTYPE runscript [{entity}]>\n<runscript"), "utf-8"
        )
        if refusal:
            with pytest.raises(InputError, match=refusal):
                replay(str(script), tmp_path / "runs", Choices())
        else:
            run, _, _ = replay(str(script), tmp_path / "runs", Choices())
            assert run.history["command_flap"][-1] == 0.75


@pytest.mark.parametrize("name", ["gta-elevator-doublet", "gta-aileron-step", "gta-rudder-kick"])
@pytest.mark.slow
def test_a_step_in_cruise_starts_from_steady_flight_and_shows_its_mode(name: str, tmp_path: Path) -> None:
    run, stopped, _ = replay(name, tmp_path, Choices())
    assert stopped is None
    time = run.history["time"]
    column, steady, least, most = {
        "gta-elevator-doublet": ("alpha", 0.1, 2.0, 9.0),
        "gta-aileron-step": ("roll_rate", 0.1, -3.0, 12.0),
        "gta-rudder-kick": ("beta", 0.1, -6.0, 6.0),
    }[name]
    values = np.degrees(run.history[column])
    before, after = values[(time > 120) & (time < 125)], values[time > 125]
    assert np.ptp(before) < steady
    assert least < after.min() < after.max() < most
    assert np.ptp(after) > (most - least) / 2


@pytest.mark.slow
def test_a_rejected_take_off_stops_on_the_runway(tmp_path: Path) -> None:
    run, stopped, _ = replay("gta-rejected-takeoff", tmp_path, Choices())
    assert stopped is None
    names = [event.name for event in run.events]
    assert names[-4:] == [
        "the left outer engine fails",
        "rejected: idle, brakes, spoilers",
        "reverse of the inner engines",
        "stopped",
    ]
    assert abs(np.ptp(run.history["longitude"])) * 6.4e6 * np.cos(0.87) < 10.0
    assert run.history["tas"][-1] < 0.1
