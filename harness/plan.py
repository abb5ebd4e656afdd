"""What a phase is made of, as data: a procedure, which the pilot acts out, and checklists, which it reads."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Literal, NamedTuple, Protocol, TypeVar

Relation = Literal["at-least", "at-most", "is"]
RELATIONS: tuple[Relation, ...] = ("at-least", "at-most", "is")


class Condition(NamedTuple):
    """One line that is true or not yet: `quantity` against `required`, which is text as written."""

    name: str
    quantity: str
    relation: Relation
    required: str
    file: str
    line: int
    remove: bool = False  # in a mission: the item of this name in the manual is dropped


class Step(NamedTuple):
    """One act of a procedure, done once all its conditions hold; `action` has its other attributes.

    It is skipped when, at its turn, one of `only_if` does not hold.
    """

    name: str
    action: dict[str, str]
    when: tuple[Condition, ...]
    file: str
    line: int
    remove: bool = False
    only_if: tuple[Condition, ...] = ()


class Checklist(NamedTuple):
    """The way to another phase: open until every item holds."""

    to: str
    items: tuple[Condition, ...]
    file: str = ""
    line: int = 0


class Named(Protocol):
    """A step or an item: has a name, may be marked for removal."""

    @property
    def name(self) -> str:
        """What it is known by."""

    @property
    def remove(self) -> bool:
        """Whether it drops the entry of that name."""


class Emergency(NamedTuple):
    """What the pilot does besides the procedure of the phase, once all conditions hold."""

    name: str
    when: tuple[Condition, ...]
    steps: tuple[Step, ...]


class Failure(NamedTuple):
    """Something that breaks once all its conditions hold, in `phase` if one is named; `name` is the manual's."""

    name: str
    phase: str
    when: tuple[Condition, ...]
    file: str
    line: int


Entry = TypeVar("Entry", bound=Named)


@dataclass(frozen=True)
class PhasePlan:
    """The procedure and the checklists of one phase. Checklists are tried in order."""

    name: str
    steps: tuple[Step, ...]
    checklists: tuple[Checklist, ...]
    file: str = ""
    line: int = 0

    def changed_by(self, other: "PhasePlan") -> "PhasePlan":
        """This plan with the steps and items of `other`: same name replaces, new is added, `remove` drops."""
        checklists = {checklist.to: checklist for checklist in self.checklists}
        for change in other.checklists:
            mine = checklists.get(change.to, change._replace(items=()))
            checklists[change.to] = change._replace(items=_merged(mine.items, change.items))
        return replace(self, steps=_merged(self.steps, other.steps), checklists=tuple(checklists.values()))


def _merged(mine: Iterable[Entry], theirs: Iterable[Entry]) -> tuple[Entry, ...]:
    entries = {entry.name: entry for entry in mine}
    entries.update((entry.name, entry) for entry in theirs)
    return tuple(entry for entry in entries.values() if not entry.remove)
