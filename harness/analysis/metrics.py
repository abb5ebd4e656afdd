"""How well a flight was flown, in numbers computed from its log alone. Arrays are columns of its history, SI.

A number that cannot be formed, because that part was not flown, is NaN.
"""

from collections.abc import Sequence
from math import copysign, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from harness.analysis.spans import spans
from harness.log import Run
from harness.manual import FlightManual
from harness.mission.model import Leg, Mission
from harness.navigation.database import Runway
from harness.units import FT, KT, MIN
from harness.world import earth

Floats = NDArray[np.float64]

LEVEL_TOLERANCE = 50 * FT
CAS_TOLERANCE = 2 * KT
HOLD = 10.0  # s inside the tolerance: captured, and not passing through
SHORTEST_LEVEL = 60.0  # s; a level segment this short ends before it has settled
ROLL_SPEED = 15.0  # m/s; below it the aircraft leaves the centreline for the taxiway
LOW_APPROACH = 1000 * FT


class Deviation(NamedTuple):
    """A deviation from a target: when it was first captured (s), and its size from then on (SI)."""

    captured: float
    largest: float
    rms: float


class LevelSegment(NamedTuple):
    """A stretch of cruise at one level and one speed."""

    begin: float
    end: float
    altitude: Deviation
    cas: Deviation
    throttle_reversals: float  # per minute, once both are captured


class TrackedLeg(NamedTuple):
    """A tracked leg: its name and the largest distance from the course line in its last half, m."""

    name: str
    cross_track: float


class Touchdown(NamedTuple):
    """Where and how the main wheels met the runway: m past the threshold, m right of the centreline, m/s down."""

    distance: float
    across: float
    sink: float


class Envelope(NamedTuple):
    """The extremes of the flight in the air. A negative margin is an excursion."""

    bank: float  # rad
    load_factor_low: float
    load_factor_high: float
    vmo_margin: float  # m/s CAS
    mmo_margin: float  # Mach
    flap_speed_margin: float  # m/s CAS
    gear_speed_margin: float  # m/s CAS
    stall_ratio: float  # CAS over the power-off 1-g stall speed
    stall_warning: bool


def deviation(time: Floats, error: Floats, tolerance: float) -> Deviation:
    """Measure an error (SI) from when it has come inside the tolerance to stay there for `HOLD` seconds."""
    inside = np.abs(error) <= tolerance
    for span in spans(time, np.where(inside, "in", "out")):
        if span.word == "in" and span.end - span.begin >= HOLD:
            after = error[span.first :]
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


def level_segments(run: Run) -> list[LevelSegment]:
    """Measure every stretch of cruise in which neither the level nor the wanted speed jumps."""
    history = run.history
    time, wanted = history["time"], history["target_cas"]
    level = history["target_level"]
    jumps = np.concatenate(([0], np.cumsum((np.abs(np.diff(wanted)) > 0.5 * KT) | (np.diff(level) != 0))))
    words = np.char.add(np.char.add(history["phase"].astype(str), "#"), jumps.astype(str))
    found = []
    for span in spans(time, words):
        if not span.word.startswith("ENR.CRS#") or span.end - span.begin < SHORTEST_LEVEL:
            continue
        rows = span.rows
        altitude = deviation(time[rows], history["target_level_error"][rows], LEVEL_TOLERANCE)
        cas = deviation(time[rows], history["cas"][rows] - wanted[rows], CAS_TOLERANCE)
        settled = time[rows] >= max(altitude.captured, cas.captured)
        hunting = reversals(time[rows][settled], history["command_throttle"][rows][settled], deadband=0.02)
        found.append(LevelSegment(span.begin, span.end, altitude, cas, hunting))
    return found


def tracked_legs(run: Run, legs: Sequence[Leg]) -> list[TrackedLeg]:
    """Measure the tracked legs against the line through their station, or fix, at their true course."""
    history = run.history
    times = [passage.time for passage in run.passages]
    found = []
    for number, (leg, end) in enumerate(zip(legs, times, strict=False)):
        if leg.course_true is None:
            continue
        begin = times[number - 1] if number else 0.0
        distance = history["distance"]
        halfway = float(np.mean(np.interp((begin, end), history["time"], distance)))
        rows = (distance >= halfway) & (history["time"] <= end)
        origin = leg.fix.station or leg.fix
        _, across = earth.offsets(
            origin.latitude,
            origin.longitude,
            leg.course_true,
            history["latitude"][rows],
            history["longitude"][rows],
        )
        found.append(TrackedLeg(leg.name, largest(across)))
    return found


def roll_deviation(run: Run, runway: Runway, phase: str, above: float = 0.0) -> float:
    """Return the largest distance from the centreline in m, on the main wheels and faster than `above` (m/s)."""
    history = run.history
    rows = (
        np.char.startswith(history["phase"].astype(str), phase)
        & (history["main_on_ground"] > 0)
        & (history["tas"] >= above)
    )
    _, across = earth.offsets(
        runway.latitude,
        runway.longitude,
        runway.true_heading,
        history["latitude"][rows],
        history["longitude"][rows],
    )
    return largest(across)


def approach_dots(run: Run, runway: Runway) -> tuple[float, float]:
    """Return the largest glide-slope and localizer deviations in dots, from 1,000 ft down to the flare."""
    history = run.history
    rows = (history["phase"] == "APP.final") & (history["altitude"] - runway.elevation <= LOW_APPROACH)
    return largest(history["target_glide_slope_dots"][rows]), largest(history["target_localizer_dots"][rows])


def touchdown(run: Run, runway: Runway) -> Touchdown:
    """Locate the touchdown that the summary names; the sink is that of the last record in the air."""
    at = run.summary.get("touchdown_s")
    if at is None:
        return Touchdown(nan, nan, nan)
    along, across = runway.offset(run.at("latitude", at), run.at("longitude", at))
    history = run.history
    airborne = np.flatnonzero((history["time"] <= at) & (history["main_on_ground"] == 0))
    return Touchdown(along, across, -float(history["vertical_speed"][airborne[-1]]) if len(airborne) else nan)


def stopping_margin(run: Run, runway: Runway) -> float:
    """Return the metres of runway left where the aircraft got slow enough to leave it; negative: overrun."""
    history = run.history
    rows = np.flatnonzero((history["phase"] == "LDG.roll-out") & (history["tas"] <= ROLL_SPEED))
    if not len(rows):
        return nan
    along, _ = runway.offset(history["latitude"][rows[0]], history["longitude"][rows[0]])
    return runway.length - along


def envelope(run: Run, manual: FlightManual) -> Envelope:
    """Compare the flight in the air with the limits of the flight manual."""
    history = run.history
    air = history["main_on_ground"] == 0
    cas, mach, flap, gear = (history[name][air] for name in ("cas", "mach", "flap", "gear"))
    positions = np.array([setting.position for setting in manual.flaps])
    order = np.argsort(positions)
    flap_limit = _next_setting(flap, positions[order], [manual.flaps[i].maximum_speed for i in order])
    stall = np.interp(flap, positions[order], [manual.stall_speed(1.0, manual.flaps[i].name) for i in order])
    limits = manual.limits
    return Envelope(
        bank=largest(history["roll"][air]),
        load_factor_low=smallest(history["load_factor"][air]),
        load_factor_high=-smallest(-history["load_factor"][air]),
        vmo_margin=smallest(limits["VMO"] - cas),
        mmo_margin=smallest(limits["MMO"] - mach),
        flap_speed_margin=smallest(flap_limit - cas),
        gear_speed_margin=smallest((limits["VLO"] - cas)[gear > 0.0]),
        stall_ratio=smallest(cas / (stall * np.sqrt(history["mass"][air]))),
        stall_warning=bool(np.any(history["stall_warning"][air] > 0)),
    )


def _next_setting(flap: Floats, positions: Floats, speeds: Sequence[float]) -> Floats:
    """Return the limit speed of the setting the flap is at or, moving, the next one further out."""
    setting = np.searchsorted(positions, flap - 1e-6, side="left").clip(0, len(speeds) - 1)
    return np.take(np.array(speeds), setting)


def largest(values: Floats) -> float:
    """Return the largest magnitude, NaN of nothing."""
    return float(np.max(np.abs(values))) if len(values) else nan


def smallest(values: Floats) -> float:
    """Return the smallest value, NaN of nothing."""
    return float(np.min(values)) if len(values) else nan


class Measures(NamedTuple):
    """Everything above for one flight."""

    levels: list[LevelSegment]
    legs: list[TrackedLeg]
    takeoff_roll: float
    landing_roll: float
    glide_slope_dots: float
    localizer_dots: float
    touchdown: Touchdown
    stopping_margin: float
    envelope: Envelope


def measure(run: Run, mission: Mission, manual: FlightManual, departure: Runway, arrival: Runway) -> Measures:
    """Measure a flight; waypoint miss distances are in the run's passages already."""
    glide_slope, localizer = approach_dots(run, arrival)
    return Measures(
        levels=level_segments(run),
        legs=tracked_legs(run, mission.legs),
        takeoff_roll=roll_deviation(run, departure, "T/O"),
        landing_roll=roll_deviation(run, arrival, "LDG", above=ROLL_SPEED),
        glide_slope_dots=glide_slope,
        localizer_dots=localizer,
        touchdown=touchdown(run, arrival),
        stopping_margin=stopping_margin(run, arrival),
        envelope=envelope(run, manual),
    )
