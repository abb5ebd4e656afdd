"""Flights that go wrong: each ends at once, says what went wrong, and leaves what was flown."""

import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from harness import cli, flight, resources
from harness.errors import (
    FlightError,
    GroundImpactError,
    InputError,
    NumericalError,
    OverrunError,
    StuckError,
    TimeLimitError,
)
from harness.log import Event, Reporter, read_run
from harness.plant import jsbsim_plant
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.plant.properties import Binding
from harness.session import Session
from harness.state import FIELDS, Commands, State

STEP = 1.0 / flight.PILOT_RATE
LOOK = 1.0  # s: the longest time between two looks of the pilot
BASE = "circuit"
ROLL = 40.0  # s, in the take-off run
CRUISE = 100.0  # s, in level flight


def mission(folder: Path, phases: str) -> Path:
    """The shortest mission with these phases changed."""
    text = resources.missions()[BASE].read_text("utf-8")
    path = folder / "changed.xml"
    path.write_text(text.replace("</mission>", f"{phases}</mission>"), "utf-8")
    return path


def procedure(phase: str, step: str, action: str) -> str:
    return f'<phase name="{phase}"><procedure><step name="{step}" {action}/></procedure></phase>'


def wait_for(phase: str, to: str, item: str) -> str:
    return f'<phase name="{phase}"><checklist to="{to}"><item {item}/></checklist></phase>'


class Watcher:
    """Remembers the last step it saw; at a moment it may put a number into the simulator, or press Ctrl-C."""

    def __init__(self) -> None:
        self.plant: JSBSimPlant | None = None
        self.at = math.inf
        self.property = ""
        self.begun = math.inf
        self.last = 0.0

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        self.last = state.time
        if state.time >= self.at:
            self.begun, self.at = state.time, math.inf
            if self.plant is None:
                raise KeyboardInterrupt
            self.plant.fdm[self.property] = math.nan

    def note(self, event: Event) -> None:
        pass


@pytest.fixture
def watcher(monkeypatch: pytest.MonkeyPatch) -> Watcher:
    watching = Watcher()
    prepare = flight.prepare

    def prepared(*arguments: object, **options: object) -> object:
        pilot, watching.plant = prepare(*arguments, **options)
        return pilot, watching.plant

    monkeypatch.setattr(flight, "prepare", prepared)
    return watching


def failed(session: Session, watcher: Watcher) -> FlightError:
    """How a flight ended that was to fail, told not later than at the look after the last one seen."""
    run, error = session.fly(progress=watcher)
    assert isinstance(error, FlightError)
    assert error.exit_code == 3
    assert error.time - watcher.last <= LOOK + 1e-6
    assert run.summary["completed"] is False
    assert run.summary["reason"] == str(error)
    assert -1e-6 <= run.history["time"][-1] - watcher.last <= LOOK + 1e-6
    assert error.phase == run.summary["phases"][-1]["name"]
    assert error.knob
    return error


def test_a_phase_that_cannot_be_left_says_what_it_waits_for_and_keeps_the_flight(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = mission(
        tmp_path, wait_for("T/O.lift-off", "T/O.transition", 'name="faster" quantity="cas" at-least="290 kt"')
    )
    assert cli.main(["fly", str(path), "--json", "--out", str(tmp_path / "out")]) == 3
    out, err = capsys.readouterr()
    said = err[err.index("harness: t=") :]
    assert ", T/O.lift-off: not over after 20 s" in said
    assert 'still waits for "faster": required at least 290.0 kt, achieved 1' in said
    line = path.read_text("utf-8").count("\n")
    assert f"{path}:{line}" in said
    folder = tmp_path / "out" / "circuit-001"
    assert f"what was flown is in {folder}" in said
    assert [entry.name for entry in (tmp_path / "out").iterdir()] == [folder.name]
    summary = json.loads(out)
    assert (summary["completed"], summary["folder"]) == (False, str(folder))
    run = read_run(folder)
    assert run.summary["reason"] in said
    assert run.history["time"][-1] > run.summary["lift_off_s"]
    assert (run.summary["touchdown_s"], run.summary["flight_time_s"]) == (None, None)
    assert run.events[-1].name != "END"
    assert {"route_map.png", "profile.png", "modes.png"} <= {entry.name for entry in folder.iterdir()}


def test_an_aircraft_held_by_its_brakes_never_rotates(tmp_path: Path, watcher: Watcher) -> None:
    path = mission(tmp_path, procedure("T/O.run", "brakes released", 'set="brakes" to="1"'))
    error = failed(Session(path), watcher)
    assert isinstance(error, StuckError)
    assert (error.phase, error.waiting, error.achieved) == ("T/O.run", "rotation speed", "0.0 kt")
    assert "(VR)" in error.required
    assert "flight-manual.xml:" in error.knob


@pytest.mark.parametrize(
    "name",
    [
        "inertia/pointmass-weight-lbs[0]",
        "propulsion/tank[0]/contents-lbs",
        "atmosphere/wind-north-fps",
        "atmosphere/delta-T",
    ],
)
@pytest.mark.parametrize("moment", [ROLL, CRUISE])
def test_a_number_that_is_none_is_seen_in_the_same_step(name: str, moment: float, watcher: Watcher) -> None:
    watcher.property, watcher.at = name, moment
    error = failed(Session(BASE), watcher)
    assert isinstance(error, NumericalError)
    assert error.time - watcher.begun <= STEP + 1e-6
    assert "no longer finite" in str(error)


def test_what_was_flown_into_nowhere_is_kept_with_its_pictures(tmp_path: Path, watcher: Watcher) -> None:
    watcher.property, watcher.at = "inertia/pointmass-weight-lbs[0]", ROLL
    run, error = Session(BASE).fly(out=tmp_path, progress=watcher)
    assert isinstance(error, NumericalError)
    assert run.folder is not None
    kept = read_run(run.folder)
    assert all(math.isfinite(value) for name in FIELDS for value in kept.history[name])
    assert (run.folder / "profile.png").is_file()


def test_a_dive_into_the_ground_is_named(tmp_path: Path, watcher: Watcher) -> None:
    path = mission(tmp_path, procedure("DEP", "follow the route", 'mode="VP" to="ATT" pitch="-10 deg"'))
    error = failed(Session(path), watcher)
    assert isinstance(error, GroundImpactError)
    assert error.phase == "DEP"
    assert "touched the ground" in str(error)
    assert error.time < 66.0  # the fuselage touches 64.7 s into the flight


def test_empty_tanks_are_named_as_what_brought_it_down(watcher: Watcher) -> None:
    error = failed(Session(BASE, ["loading/fuel=100 kg"]), watcher)
    assert isinstance(error, GroundImpactError)
    assert "fuel" in error.knob


def test_leaving_the_side_of_the_runway_is_named(tmp_path: Path, watcher: Watcher) -> None:
    """The pilot pushes a pedal and does not steer."""
    by_hand = procedure("T/O.run", "front-wheel steering", 'mode="CTRL" control="steering" to="DIRECT"')
    pedal = '<step name="pedal" set="rudder" to="1"/>'
    path = mission(tmp_path, by_hand.replace("</procedure>", f"{pedal}</procedure>"))
    error = failed(Session(path), watcher)
    assert isinstance(error, OverrunError)
    assert error.phase == "T/O.run"
    assert "side of runway EDDM 26L" in str(error)
    assert "right of the centreline" in error.achieved


def test_leaving_the_end_of_the_runway_is_named(tmp_path: Path, watcher: Watcher) -> None:
    """The pilot does not brake after landing, and gives thrust."""
    thrust = procedure("LDG.roll-out", "reverse thrust", 'set="thrust" to="climb"')
    others = '<step name="reverse thrust off" remove="yes"/><step name="brakes" set="brakes" to="0"/>'
    path = mission(tmp_path, thrust.replace("</procedure>", f"{others}</procedure>"))
    error = failed(Session(path), watcher)
    assert isinstance(error, OverrunError)
    assert error.phase == "LDG.roll-out"
    assert "end of runway EDDM 26L" in str(error)
    past = float(error.achieved.split()[0])  # the threshold of a runway of 3999 m
    assert 3999 + 5 <= past < 3999 + 5 + 100 / 12  # he looks twelve times a second


def test_a_flight_has_a_time_limit() -> None:
    session = Session(BASE)
    with pytest.raises(TimeLimitError, match="still flying after 25 s") as caught:
        flight.fly_mission(session.mission, session.manual, time_limit=25.0)
    assert caught.value.time - 25.0 <= STEP + 1e-6
    assert caught.value.phase == "TXY.out"


@pytest.mark.parametrize("changed", ["cas", "brake"])
def test_a_property_the_aircraft_does_not_have_is_refused_before_flying(
    changed: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    if changed == "cas":
        at = FIELDS.index("cas")
        bindings = [*jsbsim_plant.STATE]
        bindings[at] = Binding("velocities/vcas-kmh")
        monkeypatch.setattr(jsbsim_plant, "STATE", tuple(bindings))
    else:
        monkeypatch.setitem(jsbsim_plant.COMMANDS, "brake", ("velocities/vcas-kmh",))
    assert cli.main(["fly", BASE, "--out", str(tmp_path / "new" / "out")]) == 2
    err = capsys.readouterr().err
    assert "the aircraft has no property velocities/vcas-kmh" in err
    assert "\n    " in err
    assert list(tmp_path.iterdir()) == []


def test_a_property_that_cannot_be_written_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(jsbsim_plant.COMMANDS, "brake", ("velocities/vc-fps",))
    session = Session(BASE)
    with pytest.raises(InputError, match="velocities/vc-fps cannot be written"):
        flight.prepare(session.mission, session.manual, rate=120)


def started(out: Path, repository: Path, *arguments: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-P", "-m", "harness", "fly", "cologne-munich", "--out", str(out), *arguments]
    environment = {**os.environ, "PYTHONPATH": str(repository)}
    return subprocess.Popen(
        command, cwd=out.parent, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


@pytest.mark.parametrize(
    ("name", "said", "reason"),
    [
        ("SIGINT", "harness: interrupted", "interrupted from the keyboard"),
        ("SIGTERM", "harness: ended by SIGTERM", "ended by SIGTERM"),
    ],
)
def test_an_interrupted_command_keeps_what_was_flown(
    name: str, said: str, reason: str, tmp_path: Path, repository: Path
) -> None:
    out = tmp_path / "out"
    with started(out, repository, "--realtime", "--json") as process:
        assert process.stderr is not None
        assert "TXY.out" in process.stderr.readline()
        time.sleep(0.5)
        process.send_signal(getattr(signal, name))
        result, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert "Traceback" not in err
    assert said in err
    assert [entry.name for entry in out.iterdir()] == ["cologne-munich-001"]
    summary = json.loads(result)
    assert (summary["completed"], summary["reason"]) == (False, reason)
    assert read_run(out / "cologne-munich-001").history["time"][-1] > 0.3


@pytest.mark.parametrize("where", ["a file", "below a file", "a device", "a read-only folder"])
def test_where_nothing_can_be_written_nothing_is_flown(
    where: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(flight, "fly_mission", lambda *_, **__: pytest.fail("it flew"))
    (tmp_path / "file").write_text("mine", "utf-8")
    (tmp_path / "locked").mkdir(mode=0o555)
    out = {
        "a file": tmp_path / "file",
        "below a file": tmp_path / "file" / "runs" / "today",
        "a device": Path(os.devnull) / "runs",
        "a read-only folder": tmp_path / "locked",
    }[where]
    if where == "a read-only folder" and os.access(out, os.W_OK):
        pytest.skip("this user may write everywhere")
    assert cli.main(["fly", BASE, "--out", str(out)]) == 2
    err = capsys.readouterr().err
    assert err.startswith(f"harness: {out}: cannot be written: ")
    assert "--out DIR" in err
    assert where != "a file" or "it is a file, not a folder" in err
    assert sorted(entry.name for entry in tmp_path.rglob("*")) == ["file", "locked"]
    assert (tmp_path / "file").read_text("utf-8") == "mine"


def test_an_output_folder_without_a_name_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert cli.main(["fly", BASE, "--out", ""]) == 2
    assert "the output folder has no name" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_fills_up_leaves_nothing_half_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, watcher: Watcher
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("harness.log.files._write_table", full)
    watcher.property, watcher.at = "inertia/pointmass-weight-lbs[0]", 1.0
    monkeypatch.setattr("harness.console.Console", lambda _: watcher)
    watcher.close = lambda: None  # type: ignore[attr-defined]
    assert cli.main(["fly", BASE, "--out", str(tmp_path / "out")]) == 2
    assert list(tmp_path.iterdir()) == []


def test_two_flights_into_one_folder_do_not_meet(tmp_path: Path, repository: Path) -> None:
    out = tmp_path / "out"
    path = mission(
        tmp_path, wait_for("T/O.lift-off", "T/O.transition", 'name="never" quantity="mach" at-least="1.2"')
    )
    command = [sys.executable, "-P", "-m", "harness", "fly", str(path), "--out", str(out), "--json"]
    environment = {**os.environ, "PYTHONPATH": str(repository)}
    both = [
        subprocess.Popen(
            command, cwd=tmp_path, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        for _ in range(2)
    ]
    folders = {json.loads(process.communicate(timeout=120)[0])["folder"] for process in both}
    assert folders == {str(out / "circuit-001"), str(out / "circuit-002")}
    assert sorted(entry.name for entry in out.iterdir()) == ["circuit-001", "circuit-002"]
    first, second = ((Path(folder) / "history.parquet").read_bytes() for folder in sorted(folders))
    assert first == second


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        (lambda _: '<system name="wheels">', "systems/wheels.xml:"),
        (lambda text: text.replace("gear/main-wow", "gear/main-wov"), "gear/main-wow"),
        (lambda _: None, "wheels.xml"),
    ],
    ids=["malformed", "an output missing", "a file missing"],
)
def test_an_aircraft_that_jsbsim_cannot_load_is_refused(
    changed: Callable[[str], str | None], said: str, tmp_path: Path, repository: Path
) -> None:
    for folder in ("harness", "aircraft", "engine", "systems", "missions"):
        shutil.copytree(
            repository / folder, tmp_path / folder, ignore=shutil.ignore_patterns("__pycache__", "analysis")
        )
    wheels = tmp_path / "systems" / "wheels.xml"
    content = changed(wheels.read_text("utf-8"))
    wheels.unlink() if content is None else wheels.write_text(content, "utf-8")
    command = [sys.executable, "-P", "-m", "harness", "fly", BASE, "--out", str(tmp_path / "out")]
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    result = subprocess.run(
        command, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
    )
    assert result.returncode == 2, result.stderr
    assert result.stderr.startswith("harness: ")
    assert said in result.stderr
    assert "Traceback" not in result.stderr
    assert not (tmp_path / "out").exists()


def test_a_rejected_take_off_that_nobody_expected_is_no_completed_mission(
    tmp_path: Path, watcher: Watcher
) -> None:
    item = 'name="engine failure" quantity="time-in-phase" at-least="3 s"'
    error = failed(Session(mission(tmp_path, wait_for("T/O.run", "RTO", item))), watcher)
    assert (error.required, error.phase) == ("completed", "END")
    assert "rejected take-off" in str(error)
    assert "engine failure" in error.achieved
    assert "expects" in error.knob


@pytest.mark.parametrize("rate", [0, 100, -24])
def test_a_frame_rate_the_pilot_cannot_keep_is_refused(rate: int) -> None:
    session = Session(BASE)
    with pytest.raises(InputError, match="frames a second are not possible"):
        flight.fly_mission(session.mission, session.manual, rate=rate)
