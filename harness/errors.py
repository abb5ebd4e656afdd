"""Every way we refuse, as a tree. `str(error)` is the whole message; the command line adds `harness: `.

HarnessError
    InputError          a file or a value we were given is wrong               exit 2
        InputErrors     several of them, found in one reading                  exit 2
    OutputError         a place we were told to write to cannot be written     exit 2
    FlightError         a flight that cannot go on                             exit 3
        NumericalError      the state is no longer finite
        GroundImpactError   flown into the ground
        OverrunError        past the end of the runway
        TimeLimitError      longer than it was given
        StuckError          the next phase cannot be reached
"""

from collections.abc import Iterable, Sequence
from difflib import get_close_matches
from pathlib import Path
from typing import Any


class HarnessError(Exception):
    """Anything the harness refuses, with the exit code of the command that meets it."""

    exit_code = 1

    @property
    def faults(self) -> Sequence["HarnessError"]:
        """One error per fault: the command line prints each on its own."""
        return (self,)

    def __reduce__(self) -> tuple[Any, ...]:
        """Errors cross from a worker process whole, whatever their `__init__` asks for."""
        return _restored, (type(self), self.args, self.__dict__)


def _restored(kind: type[HarnessError], args: tuple[Any, ...], state: dict[str, Any]) -> HarnessError:
    error = kind.__new__(kind, *args)
    error.__dict__.update(state)
    return error


class InputError(HarnessError):
    """What we were given is wrong: where, what is wrong, what would be right.

    `file` is a path or an option such as `--set environment/qnh=0`, `line` counts from 1.
    """

    exit_code = 2

    def __init__(
        self, what: str, *, file: str | Path | None = None, line: int | None = None, remedy: str = ""
    ) -> None:
        super().__init__(what)
        self.what = what
        self.file = None if file is None else str(file)
        self.line = line
        self.remedy = remedy

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line) if part is not None)
        return _lines(f"{place}: {self.what}" if place else self.what, self.remedy)


class InputErrors(InputError):  # noqa: N818  the plural says what it is
    """Several faults found in one reading, in the order of the file; at most `SHOWN` are spelt out."""

    SHOWN = 20

    def __init__(self, faults: Iterable[InputError]) -> None:
        every = sorted(faults, key=lambda fault: (fault.file or "", fault.line or 0))
        first = every[0]
        super().__init__(first.what, file=first.file, line=first.line, remedy=first.remedy)
        self.every = every

    @property
    def faults(self) -> Sequence[HarnessError]:
        """The faults to show; the last one counts those left out."""
        left_out = len(self.every) - self.SHOWN
        if left_out <= 0:
            return self.every
        last = self.every[self.SHOWN]
        return [
            *self.every[: self.SHOWN],
            InputError(f"and {left_out} more faults", file=last.file, line=last.line),
        ]

    def __str__(self) -> str:
        return "\n".join(str(fault) for fault in self.faults)


class OutputError(HarnessError):
    """A file or folder that cannot be written."""

    exit_code = 2

    def __init__(self, what: str, *, path: str | Path | None = None, remedy: str = "") -> None:
        super().__init__(what)
        self.what = what
        self.path = None if path is None else str(path)
        self.remedy = remedy

    def __str__(self) -> str:
        return _lines(self.what if self.path is None else f"{self.path}: {self.what}", self.remedy)


class FlightError(HarnessError):
    """A flight that cannot go on: when, in which phase, what it waited for, and the likely knob.

    `waiting` is the name of the open checklist item, `required` against `achieved` as text with units.
    """

    exit_code = 3

    def __init__(
        self,
        what: str,
        *,
        time: float,
        phase: str,
        waiting: str = "",
        required: str = "",
        achieved: str = "",
        knob: str = "",
    ) -> None:
        super().__init__(what)
        self.what = what
        self.time = time
        self.phase = phase
        self.waiting = waiting
        self.required = required
        self.achieved = achieved
        self.knob = knob
        self.run: Any = None  # what was flown (a harness.log.Run), when raised by harness.fly

    def __str__(self) -> str:
        waits = f'still waits for "{self.waiting}"' if self.waiting else ""
        numbers = f"required {self.required}, achieved {self.achieved}" if self.required else ""
        detail = ": ".join(part for part in (waits, numbers) if part)
        return _lines(f"t={self.time:.1f} s, {self.phase}: {self.what}", detail, self.knob)


class NumericalError(FlightError):
    """The state of the aircraft is no longer finite."""


class GroundImpactError(FlightError):
    """The aircraft was flown into the ground."""


class OverrunError(FlightError):
    """The aircraft left the end of the runway."""


class TimeLimitError(FlightError):
    """The flight took longer than it was given."""


class StuckError(FlightError):
    """The next phase cannot be reached: a checklist stays open."""


def did_you_mean(word: str, known: Iterable[str], form: str = "{}") -> str:
    """A remedy line: the closest of the known words, or all of them when they are few and none is close."""
    choices = sorted(known)
    close = get_close_matches(word[:80], choices, n=2, cutoff=0.6) or [
        choice for choice in choices if choice.lower() == word.lower()
    ]
    if close:
        return f"did you mean {' or '.join(form.format(choice) for choice in close)}?"
    if not choices:
        return ""
    shown = ", ".join(form.format(choice) for choice in choices[:12])
    return f"known: {shown}" + (", ..." if len(choices) > 12 else "")


def shorten(text: object, most: int = 60) -> str:
    """The text for a message: on one line and not too long."""
    plain = " ".join(str(text).replace("\x00", "").split())
    return plain if len(plain) <= most else plain[: most - 3] + "..."


def _lines(first: str, *others: str) -> str:
    return "\n    ".join(line for line in (first, *others) if line)
