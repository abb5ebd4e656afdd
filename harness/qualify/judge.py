"""Flies the tests of a guide, several at once in processes of their own, and judges what comes out."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future
from dataclasses import dataclass
from math import isfinite, nan
from multiprocessing import get_context
from os import cpu_count
from typing import Any

from pebble import ProcessPool

from harness.analysis.panel import Panel
from harness.errors import FlightError, InputError
from harness.qualify.condition import Condition
from harness.qualify.guide import Row
from harness.qualify.manoeuvres import MANOEUVRES
from harness.qualify.outcome import Aircraft, Outcome

PATIENCE = 240.0  # s of wall time for one manoeuvre; the longest takes a tenth of it


@dataclass(frozen=True)
class Verdict:
    """A row of the guide with its result."""

    row: Row
    result: float  # nan: could not be measured
    remark: str
    panels: Sequence[Panel]

    @property
    def inside(self) -> bool:
        """Whether the result is within the tolerance."""
        return self.row.inside(self.result)

    def as_data(self) -> dict[str, Any]:
        """For machines; what is not finite is null."""
        row = self.row
        return {
            "id": row.id,
            "title": row.title,
            "manoeuvre": row.manoeuvre,
            "condition": row.condition_text,
            "quantity": row.quantity,
            "result": _finite(self.result),
            "target": row.target,
            "tolerance": row.tolerance,
            "low": _finite(row.low),
            "high": _finite(row.high),
            "unit": row.unit,
            "inside": self.inside,
            "calibrated": row.calibrated,
            "calibrated_on": row.calibrated_on,
            "source": row.source,
            "tolerance_source": row.tolerance_source,
            "remark": self.remark,
        }


def qualify(
    aircraft: Aircraft, rows: Sequence[Row], *, jobs: int | None = None, told: Callable[[str], None] = print
) -> Iterator[Verdict]:
    """Judge rows flight by flight: those of the same manoeuvre and condition share one, in a process of its own.

    Raises InputError when the aircraft itself is refused.
    """
    flights: dict[tuple[str, Condition], list[Row]] = {}
    for row in rows:
        flights.setdefault((row.manoeuvre, row.condition), []).append(row)
    with ProcessPool(max_workers=jobs or cpu_count() or 1, context=get_context("spawn")) as pool:
        scheduled = [
            (judged, pool.schedule(fly, args=[aircraft, name, condition], timeout=PATIENCE))
            for (name, condition), judged in flights.items()
        ]
        try:
            for done, (judged, future) in enumerate(scheduled, 1):
                outcome = _outcome(future)
                told(f"{done}/{len(scheduled)} {judged[0].id} {judged[0].title}")
                for row in judged:
                    yield _judge(row, outcome)
        except BaseException:
            pool.stop()  # type: ignore[no-untyped-call]
            raise


def fly(aircraft: Aircraft, manoeuvre: str, condition: Condition) -> Outcome:
    """Fly one manoeuvre; one that cannot be flown has no values, and says why."""
    try:
        return MANOEUVRES[manoeuvre](aircraft, condition)
    except (FlightError, ArithmeticError) as error:
        return Outcome({}, [], f"not flown: {error}")


def _outcome(future: Future[Outcome]) -> Outcome:
    try:
        return future.result()
    except TimeoutError:
        return Outcome({}, [], f"not flown: no end after {PATIENCE:.0f} s")


def _judge(row: Row, outcome: Outcome) -> Verdict:
    if outcome.values and row.quantity not in outcome.values:
        raise InputError(
            f'{row.id}: the manoeuvre "{row.manoeuvre}" measures no "{row.quantity}".',
            file="qualification.csv",
            remedy=f"it measures {', '.join(outcome.values)}",
        )
    return Verdict(row, outcome.values.get(row.quantity, nan), outcome.remark, outcome.panels)


def _finite(value: float) -> float | None:
    return value if isfinite(value) else None
