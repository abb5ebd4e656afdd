"""The commands. Nothing heavy is imported until a command needs it."""

import argparse
import json
import signal
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NoReturn

from harness import __version__, resources
from harness.errors import FlightError, HarnessError, InputError
from harness.takeoff import command as takeoff

if TYPE_CHECKING:
    from harness.log import Run

OUTSIDE = 1
INTERRUPTED = 130
DEFAULT_OUT = "runs"
RATES = (120, 240, 480)


class Parser(argparse.ArgumentParser):
    """Refuses as the rest of the harness does: what is wrong, what would be right, exit code 2."""

    def error(self, message: str) -> NoReturn:
        """Raise what argparse has found wrong."""
        raise InputError(message.rstrip(".") + ".", remedy=f"see: {self.prog} --help")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command. Exit codes: 0 done, 1 a bar not met, 2 wrong input, 3 flight not completed, 130 interrupted."""
    words = sys.argv[1:] if arguments is None else list(arguments)
    try:
        chosen = parser().parse_args(words)
        if chosen.command is None:
            parser().print_help(sys.stderr)
            return 2
        return int(chosen.run(chosen))
    except HarnessError as error:
        return refuse(error, as_json="--json" in words)
    except KeyboardInterrupt:
        say("harness: interrupted")
        return INTERRUPTED
    except BrokenPipeError:
        sys.stderr.close()  # the reader has left; nothing more to say to it
        return 1


def parser() -> Parser:
    """Build the command line."""
    top = Parser(prog="harness", description="Flies missions from XML, from stand to stand, without a human.")
    top.add_argument("--version", action="version", version=f"harness {__version__}")
    commands = top.add_subparsers(dest="command", metavar="COMMAND", title="commands")

    flying = commands.add_parser(
        "fly", help="fly a mission", description="Fly a mission and keep the run in a folder."
    )
    add_mission(flying)
    flying.add_argument(
        "--out", metavar="DIR", default=DEFAULT_OUT, help="folder for the run's folder (default: %(default)s)"
    )
    flying.add_argument(
        "--rate", metavar="HZ", type=int, choices=RATES, default=120, help="frames a second: 120, 240 or 480"
    )
    flying.add_argument("--realtime", action="store_true", help="no faster than the clock on the wall")
    add_json(flying)
    flying.set_defaults(run=fly)

    checking = commands.add_parser(
        "check",
        help="find what is wrong with a mission or an aircraft",
        description="Everything that can be known without flying, of a mission or of an aircraft by its name.",
    )
    add_mission(checking)
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

    qualifying = commands.add_parser(
        "qualify",
        help="fly an aircraft's test guide and hold each result against its target",
        description="Fly the objective tests of aircraft/NAME/qualification.csv; exit code 1 if a result is outside.",
    )
    qualifying.add_argument(
        "aircraft", metavar="AIRCRAFT", nargs="?", default="gta", help="its name (default: %(default)s)"
    )
    qualifying.add_argument(
        "--only", metavar="TEST", nargs="+", default=[], help="ids of tests, such as V10 V27"
    )
    qualifying.add_argument(
        "--out", metavar="DIR", help="folder for the HTML page (default: none is written)"
    )
    qualifying.add_argument(
        "--jobs", metavar="N", type=int, help="flights at once (default: one a processor)"
    )
    add_json(qualifying)
    qualifying.set_defaults(run=qualify)

    add_replay(commands)

    studying = commands.add_parser(
        "study",
        help="fly a mission many times with factors varied",
        description="Run the cases of a study, or what is left of them, into one table.",
    )
    studying.add_argument("study", metavar="STUDY", help="a name from `harness list`, or a study file")
    studying.add_argument("--workers", metavar="N", type=int, help="processes (default: one for each core)")
    studying.add_argument("--resume", action="store_true", help="continue, and try again what failed")
    studying.add_argument(
        "--cluster", metavar="ADDRESS", help="run on a Dask cluster: its scheduler, such as tcp://host:8786"
    )
    studying.add_argument("--out", metavar="DIR", help="folder of the results (default: runs/study-STUDY)")
    studying.add_argument("--yes", action="store_true", help="do not ask, however many cases there are")
    add_json(studying)
    studying.set_defaults(run=study)

    taking_off = commands.add_parser(
        "takeoff",
        help="take-off distances over mass",
        description="Fly take-offs from standstill to the screen height, one for each mass.",
    )
    takeoff.add(taking_off, add_json)

    listing = commands.add_parser(
        "list", help="missions, studies, aircraft and scripts", description="What can be named."
    )
    add_json(listing)
    listing.set_defaults(run=show_list)
    return top


def add_replay(commands: "argparse._SubParsersAction[Parser]") -> None:
    """The commands for JSBSim scripts."""
    replaying = commands.add_parser(
        "replay",
        help="run a JSBSim script and keep the run in a folder",
        description="Run any JSBSim script, as the `jsbsim` command does, and keep the run in a folder.",
    )
    replaying.add_argument("script", metavar="SCRIPT", help="a name from `harness list`, or a script file")
    replaying.add_argument(
        "--root", metavar="DIR", help="the JSBSim root (default: the one the script is in)"
    )
    replaying.add_argument(
        "--rate", metavar="HZ", type=float, help="frames a second (default: the script's own)"
    )
    replaying.add_argument("--end", metavar="SECONDS", type=float, help="stop after this simulated time")
    replaying.add_argument(
        "--set",
        dest="settings",
        metavar="PROPERTY=VALUE",
        action="append",
        default=[],
        help="set a property before the start, in JSBSim's unit; may be repeated",
    )
    replaying.add_argument(
        "--limit", metavar="SECONDS", type=float, default=600.0, help="computing time (default: %(default)s)"
    )
    replaying.add_argument(
        "--sockets", action="store_true", help="open the sockets that aircraft and script name"
    )
    replaying.add_argument("--compare", metavar="RUN", help="hold it against the run it was exported from")
    replaying.add_argument("--out", metavar="DIR", default=DEFAULT_OUT, help="folder for the run's folder")
    add_json(replaying)
    replaying.set_defaults(run=replay)

    exporting = commands.add_parser(
        "export",
        help="write a run as a JSBSim script",
        description="Write a run of `harness fly` as one JSBSim script that stock JSBSim replays to the last bit.",
    )
    exporting.add_argument("folder", metavar="RUN", help="the folder of a run")
    exporting.add_argument(
        "--out", metavar="FILE", help="the script's file (default: replay.xml in the run's folder)"
    )
    add_json(exporting)
    exporting.set_defaults(run=export)


def add_mission(command: argparse.ArgumentParser) -> None:
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


def add_json(command: argparse.ArgumentParser) -> None:
    """The argument that asks for a machine-readable result."""
    command.add_argument("--json", action="store_true", help="print the result as JSON, and nothing else")


def fly(chosen: argparse.Namespace) -> int:
    """`harness fly`."""
    from harness.console import Console
    from harness.session import Session

    session = Session(chosen.mission, chosen.overrides)
    signal.signal(signal.SIGTERM, end)
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
        print(describe(run))
    return 0 if stopped is None else stopped.exit_code if isinstance(stopped, FlightError) else INTERRUPTED


def end(*_: object) -> NoReturn:
    """Told to end by a signal: keep what was flown, as for Ctrl-C."""
    raise KeyboardInterrupt("ended by SIGTERM")


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


def qualify(chosen: argparse.Namespace) -> int:
    """`harness qualify`."""
    from harness.qualify.command import run

    if chosen.jobs is not None and chosen.jobs < 1:
        raise InputError(f"{chosen.jobs} flights at once are none.", file="--jobs", remedy="give 1 or more")
    verdicts, page = run(
        chosen.aircraft,
        chosen.only,
        out=chosen.out,
        jobs=chosen.jobs,
        told=lambda text: say(f"harness: {text}"),
    )
    if chosen.json:
        print_json([verdict.as_data() for verdict in verdicts])
    else:
        from harness.qualify.report import table

        print(table(verdicts))
        if page is not None:
            print(f"page: {page}")
    return 0 if all(verdict.inside for verdict in verdicts) else OUTSIDE


def replay(chosen: argparse.Namespace) -> int:
    """`harness replay`."""
    from harness.replay.command import choices_of
    from harness.replay.player import replay as play

    run, stopped, comparison = play(chosen.script, chosen.out, choices_of(chosen), chosen.compare)
    if stopped is not None:
        say(f"harness: {stopped}")
        say(f"    what was flown is in {run.folder}")
    result = {**run.summary, "folder": str(run.folder)} | (comparison._asdict() if comparison else {})
    if chosen.json:
        print_json(result)
    elif stopped is None:
        print(
            f"{run.summary['script']}: {run.summary['simulated_time_s']:.1f} s in {run.summary['frames']} frames, "
            f"{len(run.events)} events; kept in {run.folder}"
        )
        if comparison:
            verdict = "identical" if comparison.identical else "NOT identical"
            print(
                f"  {verdict} to {chosen.compare} at {comparison.frames} frames: at most "
                f"{comparison.max_position_m:.3g} m and {comparison.max_attitude_deg:.3g} deg apart"
            )
    if stopped is not None:
        return stopped.exit_code
    return 0 if comparison is None or comparison.identical else OUTSIDE


def export(chosen: argparse.Namespace) -> int:
    """`harness export`."""
    from pathlib import Path

    from harness.log import read_run
    from harness.log.inputs import read_inputs
    from harness.replay.export import script_of, write_script

    run = read_run(chosen.folder)
    file = Path(chosen.out) if chosen.out else Path(chosen.folder) / "replay.xml"
    text = script_of(run, read_inputs(Path(chosen.folder)))
    write_script(text, file)
    if chosen.json:
        print_json({"file": str(file), "bytes": len(text)})
    else:
        print(
            f"{file}: {len(text) / 1e6:.2f} MB; replay it with: harness replay {file} --compare {chosen.folder}"
        )
    return 0


def study(chosen: argparse.Namespace) -> int:
    """`harness study`."""
    from harness.studies import command
    from harness.studies.console import StudyProgress, describe_study

    opened = command.open_study(chosen.study)
    signal.signal(signal.SIGTERM, end)
    folder = command.default_folder(opened) if chosen.out is None else chosen.out
    try:
        with StudyProgress(opened.name, sys.stderr) as progress:
            summary = command.conduct(
                opened,
                folder,
                workers=chosen.workers,
                cluster=chosen.cluster,
                resume=chosen.resume,
                confirm=None if chosen.yes else confirm,
                progress=progress,
            )
    except KeyboardInterrupt:
        say(f"harness: interrupted\n    what was finished is in {folder}; continue with --resume")
        return INTERRUPTED
    if chosen.json:
        print_json(summary)
    else:
        print(describe_study(summary))
    return 0 if summary["counts"].keys() <= {"ok"} else FlightError.exit_code


def confirm(cases: int) -> None:
    """Ask whether so many cases are meant. Raises InputError when they are not, or when nobody can be asked."""
    remedy = "fewer levels, or --yes if they are meant"
    if not sys.stdin.isatty():
        raise InputError(f"the study has {cases:,} cases", remedy=remedy)
    say(f"The study has {cases:,} cases. Go on? [y/N]")
    if sys.stdin.readline().strip().lower() not in {"y", "yes"}:
        raise InputError(f"the {cases:,} cases were not begun", remedy=remedy)


def show_list(chosen: argparse.Namespace) -> int:
    """`harness list`."""
    found = {
        kind: {
            name: {"file": str(path), "description": resources.description(path)}
            for name, path in named.items()
        }
        for kind, named in (
            ("missions", resources.missions()),
            ("studies", resources.studies()),
            ("aircraft", resources.aircraft()),
            ("scripts", resources.scripts()),
        )
    }
    if chosen.json:
        print_json(found)
        return 0
    for kind, entries in found.items():
        print(f"{kind}:")
        for name, entry in entries.items():
            print(f"  {name:<20} {entry['description']}")
    return 0


def describe(run: "Run") -> str:
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


def refuse(error: HarnessError, *, as_json: bool) -> int:
    """Say what is wrong, on standard error, and for a machine on standard output."""
    for fault in error.faults:
        say(f"harness: {fault}")
    if as_json:
        print_json({"ok": False, "faults": [describe_fault(fault) for fault in error.faults]})
    return error.exit_code


def describe_fault(fault: HarnessError) -> dict[str, Any]:
    """One fault as data."""
    known = ("file", "line", "path", "what", "remedy")
    return {"message": str(fault)} | {name: getattr(fault, name) for name in known if hasattr(fault, name)}


def print_json(value: object) -> None:
    """The machine-readable result, alone on standard output."""
    print(json.dumps(value, indent=2, ensure_ascii=False))


def say(text: str) -> None:
    """What is meant for people goes to standard error."""
    print(text, file=sys.stderr, flush=True)
