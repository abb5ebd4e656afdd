"""A study as it was read: what is flown, what is varied, what is kept."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal, NamedTuple

from harness.mission.overrides import Override
from harness.units import KINDS

DesignKind = Literal["grid", "one-at-a-time", "latin-hypercube", "sobol", "monte-carlo"]
SAMPLED = frozenset({"latin-hypercube", "sobol", "monte-carlo"})

SI = {
    text: (next(name for name, factor in kind.units.items() if factor == 1.0), scale)
    for kind in KINDS.values()
    for text, scale in kind.units.items()
}
"""Of each unit its SI unit, and what one of it is in that."""

SUFFIXES = {"": "", "m/s": "_mps", "rad/s": "_radps", "1/s": "_per_s", "m/s2": "_mps2"}
"""How a unit ends a column's name, where it is not the unit itself."""


class Level(NamedTuple):
    """One value of a factor: as text, the way an override has it, and in SI; a word has no number."""

    text: str
    value: float | str


class Scale(NamedTuple):
    """How a factor's numbers are written: their unit and what follows it, such as "CAS" or "true"."""

    unit: str = ""
    qualifier: str = ""

    def level(self, number: float) -> Level:
        """The value `number`, in this unit. To 12 digits: 0.3 stays 0.3, and no measurement has more."""
        if (
            self.qualifier in {"true", "magnetic"}
            and not 0 <= number * SI[self.unit][1] <= SI["deg"][1] * 360
        ):
            number %= 360 * SI["deg"][1] / SI[self.unit][1]
        rounded = float(f"{number:.12g}")
        text = " ".join(filter(None, (f"{rounded:.12g}", self.unit, self.qualifier)))
        return Level(text, rounded * SI[self.unit][1])


@dataclass(frozen=True)
class Steps:
    """Numbers from `first`, `step` apart: levels that need no memory, however many."""

    scale: Scale
    first: float
    step: float
    count: int

    def __len__(self) -> int:
        return self.count

    def __iter__(self) -> Iterator[Level]:
        return (self[index] for index in range(self.count))

    def __getitem__(self, index: int) -> Level:
        if not -self.count <= index < self.count:
            raise IndexError(index)
        return self.scale.level(self.first + (index % self.count) * self.step)


@dataclass(frozen=True)
class Distribution:
    """How likely a factor's numbers are; `shape` are the numbers that scipy.stats knows it by."""

    scale: Scale
    name: Literal["uniform", "norm", "truncnorm", "lognorm", "triang"]
    shape: tuple[float, ...]
    location: float
    width: float


@dataclass(frozen=True)
class Factor:
    """A quantity that is varied: by its levels, or by its distribution.

    `column` is its name in the table, with the SI unit; `unit` is empty for words and plain numbers.
    """

    path: str
    column: str
    unit: str
    spread: tuple[Level, ...] | Steps | Distribution
    file: str
    line: int | None

    @property
    def levels(self) -> tuple[Level, ...] | Steps:
        """The levels; none if it has a distribution instead."""
        return () if isinstance(self.spread, Distribution) else self.spread

    def override(self, level: Level) -> Override:
        """The change to the mission that gives the factor this value."""
        return Override(self.path, level.text, self.file, self.line)


class Design(NamedTuple):
    """How the factors are varied: `n` samples (0: not sampled), from the master seed `seed`."""

    kind: DesignKind
    n: int = 0
    seed: int = 0


class Output(NamedTuple):
    """A quantity that is kept of each case: its dotted path, and its column in the table."""

    path: str
    column: str
    line: int | None


class Subject(NamedTuple):
    """What is flown: a mission's text, and the name of its file for messages."""

    file: str
    text: str


@dataclass(frozen=True)
class Study:
    """All of a study file."""

    name: str
    description: str
    kind: str
    mission_path: Path
    wall_limit: float
    fixed: tuple[Override, ...]
    factors: tuple[Factor, ...]
    design: Design
    outputs: tuple[Output, ...]
    source_path: Path


def column_name(name: str, unit: str) -> str:
    """The name of a column of a quantity: `column_name("loading/fuel", "kg")` is "loading_fuel_kg"."""
    return re.sub(r"\W+", "_", name).strip("_") + SUFFIXES.get(unit, f"_{unit}")
