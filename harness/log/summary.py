"""Draws the conclusions of a flight from its record. The schema is described in docs/summary-schema.md."""

import math
import platform
from collections.abc import Mapping
from importlib.metadata import version
from itertools import pairwise
from typing import Any

import numpy as np

from harness.log.inputs import Inputs
from harness.log.record import FlightLog
from harness.log.run import Event, History, Passage, Run
from harness.state import State
from harness.world.local import LocalFrame, Point

SCHEMA = 1
LIBRARIES = ("jsbsim", "numpy")


def conclude(
    log: FlightLog,
    inputs: Inputs,
    *,
    identity: Mapping[str, object],
    fixes: Mapping[str, tuple[float, float]],
    last_waypoint: str,
    mission_text: str,
    wall_time: float,
    outcome: str,
    reason: str,
) -> Run:
    """Make the run out of what was recorded, and of what was written into the simulator.

    `identity` goes into the summary as it is; `fixes` are the waypoints' latitudes and longitudes (rad),
    `last_waypoint` is the name of the route's last one, before the arrival;
    `wall_time` is in seconds; `outcome` is one of `vocabulary.OUTCOMES`, or "stopped" for a flight that could not go
    on; `reason` says why the flight did not end as expected, empty if it did.
    """
    history = log.history()
    passages = _passages(log, history, fixes)
    simulated = float(history["time"][-1]) if len(history["time"]) else 0.0
    completed = outcome == "completed"
    summary: dict[str, Any] = {"schema": SCHEMA, **identity, "completed": completed, "outcome": outcome}
    summary["reason"] = reason
    last = [passage for passage in passages if passage.name == last_waypoint]
    summary |= _flight(log, history, last, completed=completed)
    summary["rejected_take_off"] = None
    summary["phases"] = _phases(log.events, history)
    summary |= {
        "simulated_time_s": simulated,
        "wall_time_s": wall_time,
        "real_time_factor": simulated / wall_time if wall_time > 0 else None,
        "versions": {"python": platform.python_version()} | {name: version(name) for name in LIBRARIES},
    }
    return Run(history, tuple(log.events), passages, _finite(summary), mission_text, inputs)


def _flight(
    log: FlightLog, history: History, last: list[Passage], *, completed: bool
) -> dict[str, float | None]:
    """Times, distances and masses; None for what the flight did not come to."""
    off_blocks, release, lift_off, touchdown = (
        log.moments.get(name) for name in ("off blocks", "brake release", "lift-off", "touchdown")
    )
    end = float(history["time"][-1]) if completed else None
    result: dict[str, float | None] = {
        "brake_release_s": _time(release),
        "lift_off_s": _time(lift_off),
        "touchdown_s": _time(touchdown),
        "flight_time_s": _between(_time(release), _time(touchdown)),
        "block_time_s": _between(_time(off_blocks), end),
        "time_to_last_waypoint_s": _between(_time(release), last[0].time if last else None),
        "takeoff_mass_kg": release.mass if release else None,
        "landing_mass_kg": touchdown.mass if touchdown else None,
        "distance_km": None,
        "fuel_burned_kg": None,
        "fuel_leaked_kg": None,
        "dropped_kg": None,
        "mass_closure_kg": None,
    }
    if release and touchdown:
        begin_distance, end_distance = np.interp(
            (release.time, touchdown.time), history["time"], history["distance"]
        )
        used = touchdown.fuel_used - release.fuel_used
        result["distance_km"] = float(end_distance - begin_distance) / 1000.0
        result["fuel_leaked_kg"] = leaked = touchdown.fuel_leaked - release.fuel_leaked
        result["fuel_burned_kg"] = release.fuel - touchdown.fuel - leaked
        result["dropped_kg"] = dropped = touchdown.dropped - release.dropped
        result["mass_closure_kg"] = release.mass - touchdown.mass - used - leaked - dropped
    return result


def _phases(events: list[Event], history: History) -> list[dict[str, Any]]:
    """Each phase in the order flown: start and end (s), fuel (kg), distance (km)."""
    if not len(history["time"]):
        return []
    changes = [event for event in events if event.kind == "phase"]
    ends = [event.time for event in changes[1:]] + [float(history["time"][-1])]
    rows = []
    for event, end in zip(changes, ends, strict=bool(changes)):
        fuel, distance = (
            float(np.diff(np.interp((event.time, end), history["time"], history[column]))[0])
            for column in ("fuel_used", "distance")
        )
        rows.append(
            {"name": event.name, "start": event.time, "end": end, "fuel": fuel, "distance": distance / 1000.0}
        )
    return rows


def _passages(
    log: FlightLog, history: History, fixes: Mapping[str, tuple[float, float]]
) -> tuple[Passage, ...]:
    if not log.passages:
        return ()
    release = log.moments.get("brake release", log.passages[0][1])
    times = [moment.time for _, moment in log.passages]
    rows = []
    for index, (event, state) in enumerate(log.passages):
        begin = times[index - 1] if index else 0.0
        end = times[index + 1] if index + 1 < len(times) else math.inf
        distances = np.interp((release.time, state.time), history["time"], history["distance"])
        rows.append(
            Passage(
                name=event.name,
                time=state.time,
                latitude=state.latitude,
                longitude=state.longitude,
                altitude=state.altitude,
                pressure_altitude=state.pressure_altitude,
                cas=state.cas,
                tas=state.tas,
                mach=state.mach,
                distance=float(distances[1] - distances[0]),
                fuel_used=state.fuel_used - release.fuel_used,
                mass=state.mass,
                closest=_closest(history, begin, end, fixes.get(event.name)),
            )
        )
    return tuple(rows)


def _closest(history: History, begin: float, end: float, fix: tuple[float, float] | None) -> float:
    """The smallest distance to the fix from `begin` to `end`, m."""
    if fix is None:
        return math.nan
    window = (history["time"] >= begin) & (history["time"] <= end)
    frame = LocalFrame(*fix)
    track = [
        frame.point(*position)
        for position in zip(history["latitude"][window], history["longitude"][window], strict=True)
    ]
    return min((_from_origin(a, b) for a, b in pairwise(track)), default=math.nan)


def _from_origin(a: Point, b: Point) -> float:
    """Distance from the origin to the straight line from a to b: between two records the track is straight."""
    north, east = b[0] - a[0], b[1] - a[1]
    length = north * north + east * east
    share = -(a[0] * north + a[1] * east) / length if length else 0.0
    share = min(max(share, 0.0), 1.0)
    return math.hypot(a[0] + share * north, a[1] + share * east)


def _time(moment: State | None) -> float | None:
    return moment.time if moment else None


def _between(begin: float | None, end: float | None) -> float | None:
    return None if begin is None or end is None else end - begin


def _finite(value: Any) -> Any:  # noqa: ANN401  whatever JSON can hold
    """The value with None in place of numbers that are not finite: JSON has no word for them."""
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
