"""The command line: what it prints where, and its exit codes."""

import io
import json
import os
import time
from pathlib import Path
from types import MappingProxyType

import pytest
from conftest import Command

from harness import cli, resources
from harness.console import Console, clock
from harness.errors import InputError
from harness.log import Event
from harness.state import FIELDS, Commands, State
from harness.units import KT


def test_help_comes_at_once(harness: Command) -> None:
    begin = os.times()
    assert "fly a mission" in harness("--help").stdout
    end = os.times()  # of the processor: a busy machine is not the program's fault
    assert end.children_user + end.children_system - begin.children_user - begin.children_system < 0.5


def test_version(harness: Command) -> None:
    assert harness("--version").stdout == "harness 0.2.0\n"


def test_no_command_shows_the_help_and_is_wrong_usage(harness: Command) -> None:
    result = harness()
    assert (result.returncode, result.stdout) == (2, "")
    assert "commands:" in result.stderr


@pytest.mark.parametrize(
    "arguments",
    [
        ["flyy"],
        ["fly"],
        ["fly", "x", "--rate", "100"],
        ["fly", "x", "--rate", "fast"],
        ["list", "--yaml"],
        ["fly", "no-such-mission"],
        ["fly", "no/such/file.xml"],
        ["fly", "."],
        ["fly", "nul\0"],
        ["fly", "x" * 5000],
        ["fly", ""],
    ],
)
def test_wrong_usage_is_one_message_that_teaches(
    arguments: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(arguments) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith("harness: ")
    assert "\n    " in err
    assert len(err) < 1000


def test_a_misspelt_mission_is_recognised(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["check", "colonge-munich"]) == 2
    assert "did you mean cologne-munich" in capsys.readouterr().err


def test_a_refusal_as_json_is_alone_on_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["check", "colonge-munich", "--json"]) == 2
    out, err = capsys.readouterr()
    answer = json.loads(out)
    assert answer["ok"] is False
    assert "colonge-munich" in answer["faults"][0]["message"]
    assert err.startswith("harness: ")


def test_list_names_what_there_is(harness: Command) -> None:
    found = json.loads(harness("list", "--json").stdout)
    assert "cologne-munich" in found["missions"]
    assert "gta" in found["aircraft"]
    assert found["scripts"]
    plain = harness("list").stdout
    assert all(name in plain for names in found.values() for name in names)


def test_check_accepts_every_mission_shipped(capsys: pytest.CaptureFixture[str]) -> None:
    for name in resources.missions():
        assert cli.main(["check", name, "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["ok"] is True


def test_a_fault_in_the_file_is_named_with_its_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = resources.missions()["cologne-munich"].read_text("utf-8")
    broken = tmp_path / "broken.xml"
    broken.write_text(text.replace("<route>", "<rout>").replace("</route>", "</rout>"), "utf-8")
    assert cli.main(["check", str(broken)]) == 2
    line = text[: text.index("<route>")].count("\n") + 1
    assert f"harness: {broken}:{line}: " in capsys.readouterr().err


def test_an_output_folder_that_cannot_be_written_is_refused_before_flying(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "file").write_text("")
    begin = time.process_time()
    assert cli.main(["fly", "cologne-munich", "--out", str(tmp_path / "file" / "runs")]) == 2
    assert time.process_time() - begin < 5
    assert "cannot be written" in capsys.readouterr().err


def test_a_bug_shows_its_traceback(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(resources, "missions", lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        cli.main(["list"])


def test_names_are_found_from_any_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert resources.find_mission("cologne-munich").is_file()
    with pytest.raises(InputError, match="harness list"):
        resources.find_mission("nowhere")


def test_the_fingerprint_follows_every_file_of_the_aircraft(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    files = {
        "aircraft/a/a.xml": '<engine file="e"/><system file="s"/>',
        "engine/e.xml": '<propeller file="p"/>',
        "engine/p.xml": "1",
        "engine/other.xml": "1",
        "systems/s.xml": "1",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.setattr(resources, "root", lambda: tmp_path)
    first = resources.fingerprint("a")
    (tmp_path / "engine/other.xml").write_text("2")
    assert resources.fingerprint("a") == first
    for name in ("engine/p.xml", "systems/s.xml"):
        (tmp_path / name).write_text("2")
        assert resources.fingerprint("a") != first
        (tmp_path / name).write_text("1")
    assert resources.fingerprint("a") == first


def test_where_nobody_looks_the_console_writes_plain_lines() -> None:
    stream = io.StringIO()
    console = Console(stream)
    console.note(Event(3725.0, "phase", "ENR.CRS", "ENR.CLB", "level captured"))
    console.note(Event(3726.0, "procedure", "flaps up", "ENR.CRS"))
    console.close()
    assert stream.getvalue() == "1:02:05  phase     ENR.CRS  (level captured)\n"
    assert clock(59.9) == "0:00:59"


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


class Pilot:
    """Answers the console's questions."""

    phase = "ENR.CRS"
    modes = MappingProxyType({"CTRL": "direct: steering", "SPD": "THR", "HP": "NAV route", "VP": "NAV level"})
    targets = MappingProxyType({"distance_to_go": 18520.0})
    waiting = "level above: 0 ft, at least 300 ft"


def test_on_a_terminal_one_line_lives(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    stream = Terminal()
    console = Console(stream)
    state = State(**dict.fromkeys(FIELDS, 0.0) | {"time": 3725.0, "altitude": 3048.0, "cas": 100 * KT})
    console.see(state, Commands(), Pilot())
    line = stream.getvalue()
    assert line.startswith("\r1:02:05 ENR.CRS          10000 ft 100 kt  10.0 NM to go")
    assert len(line) == 80
    assert "THR | NAV" in line
    assert "\n" not in line
