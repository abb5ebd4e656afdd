"""`harness replay` and `harness export`: JSBSim scripts read and written."""

import argparse
from math import inf, isfinite
from pathlib import Path
from typing import TYPE_CHECKING

from harness.command_line import OUTSIDE, RUNS, add_json, print_json, say
from harness.errors import InputError

if TYPE_CHECKING:
    from harness.command_line import Subparsers
    from harness.replay.compare import Comparison
    from harness.replay.player import Choices

FASTEST = 10_000.0  # Hz


def add(commands: "Subparsers") -> None:
    """The arguments of both."""
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
    replaying.add_argument("--out", metavar="DIR", default=RUNS, help="folder for the run's folder")
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


def replay(chosen: argparse.Namespace) -> int:
    """`harness replay`: exit code 1 if it differs from the run to compare with."""
    from harness.replay import player

    run, stopped, comparison = player.replay(chosen.script, chosen.out, _choices(chosen), chosen.compare)
    if stopped is not None:
        say(f"harness: {stopped}")
        say(f"    what was flown is in {run.folder}")
    if chosen.json:
        found = comparison._asdict() if comparison else {}
        print_json({**run.summary, "folder": str(run.folder), **found})
    elif stopped is None:
        print(
            f"{run.summary['script']}: {run.summary['simulated_time_s']:.1f} s in {run.summary['frames']} frames, "
            f"{len(run.events)} events; kept in {run.folder}"
        )
        if comparison:
            print(_verdict(comparison, chosen.compare))
    if stopped is not None:
        return stopped.exit_code
    return 0 if comparison is None or comparison.identical else OUTSIDE


def _verdict(comparison: "Comparison", against: str) -> str:
    return (
        f"  {'identical' if comparison.identical else 'NOT identical'} to {against} at {comparison.frames} frames: "
        f"at most {comparison.max_position_m:.3g} m and {comparison.max_attitude_deg:.3g} deg apart"
    )


def _choices(chosen: argparse.Namespace) -> "Choices":
    """Make the choices out of the command line. Raises InputError."""
    for name, most in (("rate", FASTEST), ("end", inf), ("limit", inf)):
        value = getattr(chosen, name)
        if value is not None and not 0 < value <= most:
            raise InputError(f"{value:g} is not possible", file=f"--{name}", remedy="a number above 0")
    root = Path(chosen.root) if chosen.root else None
    if root and not (root / "aircraft").is_dir():
        raise InputError(
            f"{root} is not a JSBSim root",
            file="--root",
            remedy="a folder with aircraft/, engine/ and systems/",
        )
    from harness.replay.player import Choices

    return Choices(
        root=root,
        rate=chosen.rate,
        end=chosen.end or inf,
        settings=tuple(_setting(text) for text in chosen.settings),
        limit=chosen.limit,
        sockets=chosen.sockets,
    )


def _setting(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    try:
        number = float(value)
    except ValueError:
        number = inf
    if not name or not isfinite(number):
        raise InputError(
            f'"{text}" is not PROPERTY=NUMBER', file="--set", remedy='such as --set "fcs/flap-cmd-norm=0.5"'
        )
    return name.strip(), number


def export(chosen: argparse.Namespace) -> int:
    """`harness export`."""
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
