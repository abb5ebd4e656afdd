"""The kinds of case a study can run, and the module of each, which is imported where a case runs.

A kind's module has

* `run_case(subject, overrides, seed)`: runs one case and returns what came out, a dictionary of numbers and words
  (nested ones are reached by dotted paths). Raises HarnessError when it could not be completed;
* `probe(subject, overrides)`: raises InputError for an override that leads nowhere or has the wrong unit;
* `make_ready()`: loads, after the first case of a process, what every other begins with;
* `outputs()`: the paths of the numbers and words that `run_case` may return, but those that differ from one computer to
  the next.
"""

from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any, Protocol, cast

from harness.mission.overrides import Override
from harness.studies.model import Subject

KINDS = {"flight": "harness.studies.flight", "take-off": "harness.studies.takeoff"}
"""The module of each kind."""


class Kind(Protocol):
    """What the module of a kind has."""

    def run_case(self, subject: Subject, overrides: Sequence[Override], seed: int) -> Mapping[str, Any]:
        """Run one case."""

    def probe(self, subject: Subject, overrides: Sequence[Override]) -> None:
        """Look at what the overrides lead to."""

    def make_ready(self) -> None:
        """Load what every case begins with."""

    def outputs(self) -> frozenset[str]:
        """The paths of what comes out."""


def load_kind(module: str) -> Kind:
    """The kind in that module."""
    return cast(Kind, import_module(module))
