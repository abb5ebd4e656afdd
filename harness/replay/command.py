"""The options of `harness replay`, checked."""

from argparse import Namespace
from math import inf, isfinite
from pathlib import Path

from harness.errors import InputError
from harness.replay.player import Choices

FASTEST = 10_000.0  # Hz


def choices_of(chosen: Namespace) -> Choices:
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
