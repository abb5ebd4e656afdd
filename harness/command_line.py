"""What the commands share: options, exit codes, and how they answer. Nothing heavy is imported here.

A command is a module with `add`, which adds its arguments to the command line, and a function for each command, which
imports what it needs and returns the exit code.
"""

import argparse
import json
import signal
import sys
from typing import TYPE_CHECKING, NoReturn, TypeAlias

from harness.errors import InputError

OUTSIDE = 1
INTERRUPTED = 130
RUNS = "runs"
RATES = (120, 240, 480)


class Parser(argparse.ArgumentParser):
    """Refuses as the rest of the harness does: what is wrong, what would be right, exit code 2."""

    def error(self, message: str) -> NoReturn:
        """Raise what argparse has found wrong."""
        raise InputError(message.rstrip(".") + ".", remedy=f"see: {self.prog} --help")


if TYPE_CHECKING:
    Subparsers: TypeAlias = argparse._SubParsersAction[Parser]  # noqa: SLF001  argparse gives what it returns no public name


def add_json(command: argparse.ArgumentParser) -> None:
    """The argument that asks for a machine-readable result."""
    command.add_argument("--json", action="store_true", help="print the result as JSON, and nothing else")


def add_rate(command: argparse.ArgumentParser, rates: tuple[int, ...] = RATES) -> None:
    """The argument for the step of the simulation, one of `rates`, the first if it is not given."""
    *others, last = map(str, rates)
    command.add_argument(
        "--rate",
        metavar="HZ",
        type=int,
        choices=rates,
        default=rates[0],
        help=f"frames a second: {', '.join(others)} or {last}",
    )


def print_json(value: object) -> None:
    """The machine-readable result, alone on standard output."""
    print(json.dumps(value, indent=2, ensure_ascii=False))


def say(text: str) -> None:
    """What is meant for people goes to standard error."""
    print(text, file=sys.stderr, flush=True)


def end_as_interrupted() -> None:
    """From now on SIGTERM ends a command as Ctrl-C does: what was flown is kept."""
    signal.signal(signal.SIGTERM, _interrupt)


def _interrupt(*_: object) -> NoReturn:
    raise KeyboardInterrupt("ended by SIGTERM")
