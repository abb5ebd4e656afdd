"""How steadily a flight was flown: level segments and climbs, from its log alone. SI; NaN where nothing was flown.

A value is captured when it first comes inside its tolerance to stay there for `HOLD` seconds; passing through is
no capture. From then on it is judged until its target changes, the `HOLD` seconds included: inside them it is within
the tolerance by definition, so that the size given counts from their end and shows more than the edge of the band.
"""

from collections.abc import Iterator
from math import copysign, isnan, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from harness.analysis.spans import Span, spans
from harness.log import Run
from harness.units import DEG, FT, KT, MIN

Floats = NDArray[np.float64]
Rows = NDArray[np.bool_]

LEVEL_TOLERANCE = 50 * FT
CAS_TOLERANCE = 2 * KT
HOLD = 10.0  # s inside the tolerance: captured, and not passing through
SHORTEST = 60.0  # s; what lasts no longer is over before it has settled, and is judged only if captured
NEW_SPEED = 0.5 * KT  # a wanted speed that changes by more from one record to the next is a new one
SETTLED = 60.0  # s after both captures, or after a turn: what still moves then, moves for ever
CALM = 20.0  # s, likewise in a climb or descent, which are shorter
WINDOW = 120.0  # s of steady flight looked at together, its trend taken out
SHORTEST_WINDOW = 15.0  # s
WINGS_LEVEL = 3 * DEG
LEVER_DEADBAND = 0.02


class Deviation(NamedTuple):
    """A deviation from a target: when it was first captured (s), and its size from then on (SI)."""

    captured: float
    largest: float
    rms: float


class Hold(NamedTuple):
    """A stretch of level flight at one target: when it begins and ends, s, the target and how well it was held."""

    begin: float
    end: float
    target: float
    deviation: Deviation


class LevelFlight(NamedTuple):
    """All level flight: the levels held and, each within a captured level, the speeds held; and its steadiness."""

    levels: list[Hold]
    speeds: list[Hold]
    lever_reversals: float  # the most in a minute of any speed hold, once captured, turns included
    lever_swing: float  # peak to peak in steady straight flight, at most
    level_swing: float  # m, likewise
    cas_swing: float  # m/s, likewise


def deviation(time: Floats, error: Floats, tolerance: float) -> Deviation:
    """Measure an error (SI) from when it has come inside the tolerance to stay there for `HOLD` seconds."""
    inside = np.abs(error) <= tolerance
    for span in spans(time, np.where(inside, "in", "out")):
        if span.word == "in" and span.end - span.begin >= HOLD:
            after = error[time >= span.begin + HOLD]
            return Deviation(span.begin, float(np.max(np.abs(after))), float(np.sqrt(np.mean(after**2))))
    return Deviation(nan, nan, nan)


def reversals(time: Floats, signal: Floats, deadband: float) -> float:
    """Count the turning points of a signal, per minute; swings smaller than `deadband` are ignored."""
    if len(time) < 2:
        return nan
    turns, direction, pivot = 0, 0.0, float(signal[0])
    for value in signal.tolist():
        step = value - pivot
        if step * direction > 0.0:
            pivot = value
        elif abs(step) > deadband:
            turns += direction != 0.0
            direction, pivot = copysign(1.0, step), value
    return turns / (float(time[-1] - time[0]) / MIN)


def level_flight(run: Run) -> LevelFlight:
    """Measure the flight in the mode that holds a level (VP NAV level)."""
    history = run.history
    time, wanted = history["time"], history["target_cas"]
    levels: list[Hold] = []
    speeds: list[Hold] = []
    hunting: list[float] = []
    swings: list[tuple[float, float, float]] = []
    for span in _level_spans(run):
        found = deviation(time[span.rows], history["target_level_error"][span.rows], LEVEL_TOLERANCE)
        if not isnan(found.captured) or span.end - span.begin > SHORTEST:
            levels.append(Hold(span.begin, span.end, float(history["target_level"][span.first]), found))
        if isnan(found.captured):
            continue
        for part in _speed_spans(run, span, found.captured):
            rows = part.rows
            speed = deviation(time[rows], history["cas"][rows] - wanted[rows], CAS_TOLERANCE)
            if not isnan(speed.captured) or part.end - part.begin > SHORTEST:
                speeds.append(Hold(part.begin, part.end, float(wanted[part.first]), speed))
            if isnan(speed.captured):
                continue
            since = slice(int(np.searchsorted(time, speed.captured)), part.last)
            if part.end - speed.captured > SHORTEST:
                hunting.append(reversals(time[since], history["command_throttle"][since], LEVER_DEADBAND))
            swings += [_swings(run, window) for window in _steady(run, since, SETTLED)]
    lever, level, cas = np.max(swings, axis=0).tolist() if swings else (nan, nan, nan)
    return LevelFlight(levels, speeds, max(hunting, default=nan), lever, level, cas)


def climb_swing(run: Run) -> float:
    """Return the largest peak to peak load factor of a climb or descent with the speed captured and wings level.

    Looked at where the path holds the speed (SPD PITCH), from `CALM` seconds after the speed's capture and after
    a turn: a limit cycle goes on, a transient is over.
    """
    history = run.history
    time, wanted = history["time"], history["target_cas"]
    jumps = np.concatenate(([0], np.cumsum(np.abs(np.diff(wanted)) > NEW_SPEED)))
    swings = [nan]
    for span in spans(time, np.where(history["mode_SPD"] == "PITCH", jumps.astype(str), "")):
        if not span.word:
            continue
        rows = span.rows
        captured = deviation(time[rows], history["cas"][rows] - wanted[rows], CAS_TOLERANCE).captured
        if not isnan(captured):
            since = slice(int(np.searchsorted(time, captured)), span.last)
            swings += [float(np.ptp(history["load_factor"][window])) for window in _steady(run, since, CALM)]
    return float(np.nanmax(swings)) if len(swings) > 1 else nan


def _level_spans(run: Run) -> Iterator[Span]:
    history = run.history
    words = np.where(history["mode_VP"] == "NAV level", history["target_level"].astype(str), "")
    return (span for span in spans(history["time"], words) if span.word)


def _speed_spans(run: Run, level: Span, captured: float) -> Iterator[Span]:
    """Within a level, from its capture: the stretches at one wanted speed, which may drift but not jump."""
    wanted = run.history["target_cas"]
    first = int(np.searchsorted(run.history["time"], captured))
    jumps = np.concatenate(([0], np.cumsum(np.abs(np.diff(wanted[first : level.last])) > NEW_SPEED)))
    for span in spans(run.history["time"][first : level.last], jumps.astype(str)):
        yield span._replace(first=span.first + first, last=span.last + first)


def _steady(run: Run, since: slice, settled: float) -> Iterator[slice]:
    """Windows of straight flight, from `settled` seconds after the speed's capture and after the last turn."""
    time, straight = run.history["time"], np.abs(run.history["roll"]) < WINGS_LEVEL
    for span in spans(time[since], np.where(straight[since], "straight", "")):
        begin = span.begin + settled
        while span.word and begin + SHORTEST_WINDOW <= span.end:
            end = min(begin + WINDOW, span.end)
            yield slice(int(np.searchsorted(time, begin)), int(np.searchsorted(time, end)))
            begin = end


def _swings(run: Run, rows: slice) -> tuple[float, float, float]:
    """Peak to peak of lever, level and speed, their trends taken out."""
    history = run.history
    time = history["time"][rows] - history["time"][rows][0]
    found = []
    for name in ("command_throttle", "target_level_error", "cas"):
        values = history[name][rows]
        slope, _ = np.polyfit(time, values, 1)
        found.append(float(np.ptp(values - slope * time)))
    return found[0], found[1], found[2]
