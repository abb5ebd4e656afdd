"""The command line's words for a take-off, read into SI. Nothing heavy is imported here."""

import argparse
from collections.abc import Callable
from typing import Any, NamedTuple, TypeVar

from harness.command_line import RATES, add_rate
from harness.errors import InputError
from harness.units import UnitError, parse

MOST_CASES = 1000
Value = TypeVar("Value")
WINDS = {
    "headwind": ("headwind", 1.0),
    "tailwind": ("headwind", -1.0),
    "crosswind-from-right": ("crosswind", 1.0),
    "crosswind-from-left": ("crosswind", -1.0),
}


class Quantity(NamedTuple):
    """An option that is one quantity: the field of TakeOff, its kind, an example and what it is."""

    field: str
    kind: str
    example: str
    help: str


QUANTITIES = {
    "--isa-deviation": Quantity(
        "isa_deviation",
        "temperature-difference",
        "15K",
        "warmer than ISA; a colder day: --isa-deviation=-10K",
    ),
    "--qnh": Quantity("qnh", "pressure", "1003hPa", "pressure at mean sea level"),
    "--elevation": Quantity("elevation", "length", "500ft", "of the runway"),
    "--slope": Quantity("slope", "ratio", "1.5%%", "of the runway, uphill positive"),
}


def add_conditions(command: argparse.ArgumentParser, *, fine: bool = True) -> None:
    """The options that say on which day and runway, and how it is begun; not `fine`, with 30 frames a second."""
    command.add_argument(
        "--start",
        choices=("brakes-held", "rolling"),
        default="brakes-held",
        help="power set on the brakes (default), or while rolling",
    )
    command.add_argument(
        "--flaps", metavar="SETTING", default="take-off", help="flap setting (default: %(default)s)"
    )
    for option, quantity in QUANTITIES.items():
        command.add_argument(option, metavar=quantity.example.replace("%%", "%"), help=quantity.help)
    command.add_argument(
        "--wind",
        metavar=("10kt", "headwind"),
        nargs=2,
        action="append",
        default=[],
        help=f"and one of {', '.join(WINDS)}; may be repeated",
    )
    add_rate(command, RATES if fine else (30, 60, *RATES))
    command.add_argument("--workers", metavar="N", help="processes (default: one for each processor)")


def conditions(chosen: argparse.Namespace) -> dict[str, Any]:
    """The fields of TakeOff that these options and `--vr` set. Raises InputError."""
    fields: dict[str, Any] = {
        "vr": read("--vr", rotation_speed, chosen.vr),
        "start": chosen.start,
        "flaps": chosen.flaps,
        "rate": chosen.rate,
    }
    for option, quantity in QUANTITIES.items():
        text = getattr(chosen, option.removeprefix("--").replace("-", "_"))
        if text is not None:
            fields[quantity.field] = read(option, parse, text, quantity.kind)
    for speed, word in chosen.wind:
        if word not in WINDS:
            raise InputError(
                f'"{word}" is no wind',
                file="--wind",
                remedy=f"one of {', '.join(WINDS)}, e.g. --wind 10kt headwind",
            )
        field, sign = WINDS[word]
        fields[field] = sign * read("--wind", parse, speed, "speed")
    return fields


def read(option: str, reader: Callable[..., Value], *arguments: str) -> Value:
    """What `reader` makes of the text of an option, its refusal as one of that option."""
    try:
        return reader(*arguments)
    except UnitError as error:
        raise InputError(str(error), file=option) from None


def several(text: str, kind: str) -> list[float]:
    """Quantities of "0m,1000m,2000m", SI. Raises UnitError."""
    return [parse(word, kind) for word in text.split(",")]


def masses(text: str) -> list[float]:
    """Masses of "100t", "89t,100t" or "89t:124t:7t" (from, to, step), kg. Raises UnitError, InputError."""
    if ":" not in text:
        return several(text, "mass")
    words = text.split(":")
    if len(words) != 3:
        raise UnitError(f'"{text}" is no range; write from:to:step, each with its unit, e.g. 89t:124t:7t')
    low, high, step = (parse(word, "mass") for word in words)
    if not (step > 0 and high >= low):
        raise UnitError(
            f'"{text}" is an empty range; write from:to:step with from below to, e.g. 89t:124t:7t'
        )
    count = int((high - low) / step * (1 + 1e-12) + 1e-9) + 1
    if count > MOST_CASES:
        raise UnitError(
            f'"{text}" are {count} take-offs; at most {MOST_CASES} here, and harness study for more'
        )
    return [low + i * step for i in range(count)]


def rotation_speed(text: str) -> float | None:
    """VR of "62.5m/s", "121 kt CAS", or None for "scheduled". Raises UnitError."""
    return None if text == "scheduled" else parse(text.removesuffix("CAS").strip(), "airspeed")


def workers(text: str | None) -> int:
    """How many processes. Raises InputError."""
    from harness.takeoff.fleet import cpus

    if text is None:
        return cpus()
    if not (text.isascii() and text.isdigit() and 1 <= int(text) <= 256):
        raise InputError(
            f'"{text}" is no number of processes', file="--workers", remedy="a whole number from 1 to 256"
        )
    return int(text)
