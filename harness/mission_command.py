"""`harness fly`, `harness check` and `harness validate`: what is done with a mission."""

import argparse
import sys
from typing import TYPE_CHECKING

from harness import resources
from harness.command_line import (
    INTERRUPTED,
    OUTSIDE,
    RUNS,
    add_json,
    add_rate,
    end_as_interrupted,
    print_json,
    say,
)
from harness.errors import FlightError

if TYPE_CHECKING:
    from harness.command_line import Subparsers
    from harness.log import Run


def add(commands: "Subparsers") -> None:
    """The arguments of the three."""
    flying = commands.add_parser(
        "fly", help="fly a mission", description="Fly a mission and keep the run in a folder."
    )
    _add_mission(flying)
    flying.add_argument(
        "--out", metavar="DIR", default=RUNS, help="folder for the run's folder (default: %(default)s)"
    )
    add_rate(flying)
    flying.add_argument("--realtime", action="store_true", help="no faster than the clock on the wall")
    add_json(flying)
    flying.set_defaults(run=fly)

    checking = commands.add_parser(
        "check",
        help="find what is wrong with a mission or an aircraft",
        description="Everything that can be known without flying, of a mission or of an aircraft by its name.",
    )
    _add_mission(checking)
    add_json(checking)
    checking.set_defaults(run=check)

    validating = commands.add_parser(
        "validate",
        help="fly missions and hold them against their bars",
        description="Fly missions and print each quantity with its bar; exit code 1 if one is outside.",
    )
    validating.add_argument(
        "missions",
        metavar="MISSION",
        nargs="*",
        help="names from `harness list`, or mission files (default: cologne-munich, both readings, and circuits)",
    )
    add_json(validating)
    validating.set_defaults(run=validate)


def _add_mission(command: argparse.ArgumentParser) -> None:
    """The arguments that say which mission."""
    command.add_argument("mission", metavar="MISSION", help="a name from `harness list`, or a mission file")
    command.add_argument(
        "--set",
        dest="overrides",
        metavar="PATH=VALUE",
        action="append",
        default=[],
        help='change the mission, such as --set "loading/take-off-mass=110 t"; may be repeated',
    )


def fly(chosen: argparse.Namespace) -> int:
    """`harness fly`."""
    from harness.console import Console
    from harness.session import Session

    session = Session(chosen.mission, chosen.overrides)
    end_as_interrupted()
    console = Console(sys.stderr)
    try:
        run, stopped = session.fly(
            out=chosen.out, rate=chosen.rate, realtime=chosen.realtime, progress=console
        )
    finally:
        console.close()
    if stopped is not None:
        say(f"harness: {str(stopped) or 'interrupted'}")
        say(f"    what was flown is in {run.folder}")
    if chosen.json:
        print_json({**run.summary, "folder": str(run.folder)})
    elif stopped is None:
        print(_describe(run))
    return 0 if stopped is None else stopped.exit_code if isinstance(stopped, FlightError) else INTERRUPTED


def _describe(run: "Run") -> str:
    """A run that ended as its mission expects, in a few lines."""
    facts = run.summary
    told = (
        (
            f"  flight time   {facts['flight_time_s'] / 60:.1f} min",
            f"  block time    {facts['block_time_s'] / 60:.1f} min",
            f"  distance      {facts['distance_km']:.1f} km",
            f"  fuel          {facts['fuel_burned_kg']:.0f} kg",
        )
        if facts["completed"]
        else (f"  {name:<28}{value:.1f}" for name, value in (facts["rejected_take_off"] or {}).items())
    )
    return "\n".join(
        (
            f"{facts['mission']}: {facts['outcome']}",
            *told,
            f"  computed in   {facts['wall_time_s']:.1f} s, {facts['real_time_factor']:.0f} times real time",
            f"  kept in       {run.folder}",
        )
    )


def check(chosen: argparse.Namespace) -> int:
    """`harness check`."""
    from harness.lint import aircraft as lint
    from harness.mission.balance import LoadSheet
    from harness.session import Session

    if chosen.mission in resources.aircraft():
        lint.check(resources.root(), chosen.mission)
        if chosen.json:
            print_json({"aircraft": chosen.mission, "ok": True, "faults": []})
        else:
            print(f"{chosen.mission}: nothing in its files that JSBSim would refuse or misread.")
        return 0
    session = Session(chosen.mission, chosen.overrides)
    mission, sheet = session.mission, LoadSheet(session.mission, session.manual)
    lint.check(resources.root(), mission.aircraft)
    if chosen.json:
        fit = {"mission": mission.name, "file": str(mission.source_path), "ok": True, "faults": []}
        print_json({**fit, "loading": sheet.data()})
    else:
        print(f"{mission.source_path}: {mission.name} is fit to fly, as far as can be known without flying.")
        print(sheet)
    return 0


def validate(chosen: argparse.Namespace) -> int:
    """`harness validate`."""
    from harness import validation
    from harness.console import Console

    verdicts = []
    for trial, session in validation.prepare(chosen.missions):
        console = Console(sys.stderr)
        try:
            verdict = validation.validate(trial, session, console)
        finally:
            console.close()
        verdicts.append(verdict)
        if not chosen.json:
            print(validation.table(verdict), flush=True)
    inside = all(verdict.inside for verdict in verdicts)
    if chosen.json:
        print_json({"inside": inside, "flights": [validation.as_data(verdict) for verdict in verdicts]})
    return 0 if inside else OUTSIDE
