"""What a manoeuvre gives back, and what all manoeuvres need."""

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from harness.analysis.panel import Curve, Panel
from harness.plant.bench import Bench, Record
from harness.qualify.condition import Condition


class Outcome(NamedTuple):
    """Measured quantities by name, in the units of the guide, and diagrams of how they came about."""

    values: Mapping[str, float]
    panels: Sequence[Panel]
    remark: str = ""


class Aircraft(NamedTuple):
    """Where an aircraft is, and a fresh bench with it."""

    root: Path
    name: str

    def bench(self) -> Bench:
        """A new simulator with this aircraft."""
        return Bench(self.root, self.name)

    def loaded(self, condition: Condition) -> Bench:
        """A new simulator with the loading, the configuration and the day of a condition."""
        bench = self.bench()
        bench.day(condition.isa)
        bench.load(condition.mass, condition.fuel)
        bench.configure(flap=condition.flap, gear=condition.gear)
        return bench


Manoeuvre = Callable[[Aircraft, Condition], Outcome]


def history(
    record: Record, label: str, *shown: tuple[str, float], marks: Sequence[tuple[str, float]] = ()
) -> Panel:
    """A panel over time of recorded quantities, each divided by a unit."""
    return Panel(
        "time, s",
        label,
        [Curve(name, (record["time"]).tolist(), (record[name] / unit).tolist()) for name, unit in shown],
        marks,
    )
