"""Flies missions and holds each flight against its bars: what `harness validate` does."""

from collections.abc import Sequence
from math import isnan
from typing import TYPE_CHECKING, Any, NamedTuple

from harness.analysis.bars import Bar, judge
from harness.errors import FlightError
from harness.navigation.database import load
from harness.session import Session

if TYPE_CHECKING:
    from harness.flight import Observer
    from harness.log import Run

MAIN = "cologne-munich"


class Trial(NamedTuple):
    """One flight to be judged."""

    mission: str
    overrides: tuple[str, ...] = ()

    @property
    def title(self) -> str:
        """What it is called in the table."""
        return " ".join((self.mission, *self.overrides))


CROSSWIND = Trial("circuit", ("environment/wind-from=353.5 deg true", "environment/wind-speed=15 kt"))
SUITE = (Trial(MAIN), Trial(f"{MAIN}-tas"), Trial("circuit"), CROSSWIND)
"""What shows every row that a flight can show."""


class Verdict(NamedTuple):
    """A trial flown, and its bars."""

    trial: Trial
    bars: list[Bar]

    @property
    def inside(self) -> bool:
        """Whether every bar is met."""
        return all(bar.inside is not False for bar in self.bars)


def trials(missions: Sequence[str]) -> list[Trial]:
    """The flights that show the bars of these missions; the main one brings its companions along."""
    found: dict[Trial, None] = {}
    for mission in missions or (MAIN,):
        found.update(dict.fromkeys(SUITE if mission == MAIN else (Trial(mission),)))
    return list(found)


def prepare(missions: Sequence[str]) -> list[tuple[Trial, Session]]:
    """The trials of these missions, ready to fly. Raises InputError when one of them is not fit to."""
    return [(trial, Session(trial.mission, trial.overrides)) for trial in trials(missions)]


def validate(trial: Trial, session: Session, progress: "Observer | None" = None) -> Verdict:
    """Fly a trial and judge it; a flight that does not complete fails its bars.

    Raises KeyboardInterrupt when interrupted.
    """
    run, stopped = session.fly(progress=progress)
    if stopped is not None and not isinstance(stopped, FlightError):
        raise stopped
    return Verdict(trial, judge_run(run, session))


def judge_run(run: "Run", session: Session) -> list[Bar]:
    """Judge a run of a session's mission."""
    mission, database = session.mission, load()
    departure, arrival = (
        database.runway(end.airport, end.runway) for end in (mission.departure, mission.arrival)
    )
    return judge(run, mission, session.manual.with_mission(mission), departure, arrival)


def table(verdict: Verdict) -> str:
    """A verdict for people: quantity, measured, bar, inside or not."""
    lines = [verdict.trial.title]
    for bar in verdict.bars:
        word = {None: "", True: "yes", False: "NO"}[bar.inside]
        measured = f"{bar.measured:.3f}" if abs(bar.measured) < 10 else f"{bar.measured:.1f}"
        lines.append(
            f"  {bar.quantity:<44}{measured:>9} {bar.unit:<6}{bounds(bar):<18}{word:<4}{bar.remark}".rstrip()
        )
    return "\n".join(lines)


def bounds(bar: Bar) -> str:
    """The bar in words."""
    low, high = (None if value is None else f"{value:.4g}" for value in (bar.low, bar.high))
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"at least {low}" if low is not None else f"at most {high}" if high is not None else ""


def as_data(verdict: Verdict) -> dict[str, Any]:
    """A verdict for machines; a number that could not be measured is null."""
    return {
        "mission": verdict.trial.mission,
        "overrides": list(verdict.trial.overrides),
        "inside": verdict.inside,
        "bars": [
            bar._asdict() | {"measured": None if isnan(bar.measured) else bar.measured, "inside": bar.inside}
            for bar in verdict.bars
        ],
    }
