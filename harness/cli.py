"""The command line. Nothing heavy is imported until a command needs it."""

import argparse
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from harness import __version__, mission_command, resources
from harness.command_line import INTERRUPTED, Parser, add_json, print_json, say
from harness.errors import HarnessError
from harness.qualify import command as qualify
from harness.replay import command as replay
from harness.studies import command as studies
from harness.takeoff import command as takeoff

if TYPE_CHECKING:
    from harness.command_line import Subparsers


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
    for command in (mission_command, qualify, replay, studies, takeoff):
        command.add(commands)
    add_list(commands)
    return top


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


def add_list(commands: "Subparsers") -> None:
    """The arguments of `harness list`."""
    listing = commands.add_parser(
        "list", help="missions, studies, aircraft and scripts", description="What can be named."
    )
    add_json(listing)
    listing.set_defaults(run=show_list)


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
    width = max((len(name) for entries in found.values() for name in entries), default=0)
    for kind, entries in found.items():
        print(f"{kind}:")
        for name, entry in entries.items():
            first, end, _ = entry["description"].partition(". ")
            print(f"  {name:<{width}}  {first}{end.rstrip()}")
    return 0
