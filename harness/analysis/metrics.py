"""How well a flight was flown, in numbers computed from its log alone. Arrays are columns of its history, SI.

A number that cannot be formed, because that part was not flown, is NaN. Level flight is in `level.py`.
"""

from collections.abc import Sequence
from math import hypot, nan
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from harness.analysis.level import LevelFlight, climb_swing, level_flight
from harness.log import Passage, Run
from harness.manual import FlightManual
from harness.mission.model import Leg, Mission, Stand
from harness.navigation.database import Runway
from harness.numerics import wrap
from harness.units import FT
from harness.world import earth

Floats = NDArray[np.float64]

LOW_APPROACH = 1000 * FT


class FlownLeg(NamedTuple):
    """A leg and how it was flown. Metres; what its mode gives no meaning to is NaN.

    `closest` is the smallest distance of any record to the fix: up to half a record's flight more than it was.
    `cross_track` is the largest distance from the course line in the last half of the leg, up to the passage,
    which is the beginning of the turn when flown by.
    """

    leg: Leg
    passage: Passage | None
    closest: float
    cross_track: float


class Touchdown(NamedTuple):
    """Where and how the main wheels met the runway: m past the threshold, m right of the centreline, m/s down."""

    distance: float
    across: float
    sink: float


class Parked(NamedTuple):
    """Where the flight ended: m from the stand and rad off its heading (NaN without one), and still moving at m/s."""

    distance: float
    heading_error: float
    speed: float


class Envelope(NamedTuple):
    """The extremes of the flight in the air. A negative margin is an excursion.

    Bank, load factor and stall warning were latched by the aircraft; the others are of the records.
    """

    bank: float  # rad
    load_factor_low: float
    load_factor_high: float
    vmo_margin: float  # m/s CAS
    mmo_margin: float  # Mach
    flap_speed_margin: float  # m/s CAS
    gear_speed_margin: float  # m/s CAS
    stall_ratio: float  # CAS over the power-off 1-g stall speed
    stall_warning: bool


def flown_legs(run: Run, legs: Sequence[Leg]) -> list[FlownLeg]:
    """Measure every leg; one that was not come to has no passage.

    A tracked leg is held against the line through its station, or fix, at its true course; a direct one against
    the line the pilot says it flew (the log's `target_cross_track`).
    """
    history = run.history
    found, begin = [], 0.0
    for number, leg in enumerate(legs):
        if number >= len(run.passages):
            found.append(FlownLeg(leg, None, nan, nan))
            continue
        passage = run.passages[number]
        halfway = float(np.mean(np.interp((begin, passage.time), history["time"], history["distance"])))
        rows = (history["distance"] >= halfway) & (history["time"] < passage.time)
        across = nan
        if leg.course_true is not None:
            origin = leg.fix.station or leg.fix
            position = (history["latitude"][rows], history["longitude"][rows])
            _, off = earth.offsets(origin.latitude, origin.longitude, leg.course_true, *position)
            across = largest(off)
        elif leg.mode == "direct":
            across = largest(history["target_cross_track"][rows])
        found.append(FlownLeg(leg, passage, passage.closest, across))
        begin = passage.time
    return found


def roll_deviation(run: Run, runway: Runway, phase: str) -> float:
    """Return the largest distance from the centreline in m, on the main wheels in a phase that begins so."""
    history = run.history
    rows = np.char.startswith(history["phase"].astype(str), phase) & (history["main_on_ground"] > 0)
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
    """Return the metres of runway left where the landing roll ended; negative or NaN: it did not stop on it."""
    history = run.history
    rows = np.flatnonzero(history["phase"] == "LDG.roll-out")
    if not len(rows):
        return nan
    along, across = runway.offset(history["latitude"][rows[-1]], history["longitude"][rows[-1]])
    return runway.length - along if abs(across) <= 0.5 * runway.width else nan


def parked(run: Run, stand: Stand | None) -> Parked:
    """Return how the flight ended."""
    latitude, longitude, heading, north, east = (
        float(run.history[name][-1])
        for name in ("latitude", "longitude", "heading", "velocity_north", "velocity_east")
    )
    if stand is None:
        return Parked(nan, nan, hypot(north, east))
    _, _, distance = earth.inverse(latitude, longitude, stand.latitude, stand.longitude)
    return Parked(distance, wrap(heading - stand.heading), hypot(north, east))


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
        bank=largest(history["greatest_bank"]),
        load_factor_low=smallest(history["least_load_factor"]),
        load_factor_high=largest(history["greatest_load_factor"]),
        vmo_margin=smallest(limits["VMO"] - cas),
        mmo_margin=smallest(limits["MMO"] - mach),
        flap_speed_margin=smallest(flap_limit - cas),
        gear_speed_margin=smallest((limits["VLO"] - cas)[gear > 0.0]),
        stall_ratio=smallest(cas / (stall * np.sqrt(history["mass"][air]))),
        stall_warning=bool(np.any(history["stall_warned"] > 0)),
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

    level: LevelFlight
    climb_swing: float
    legs: list[FlownLeg]
    takeoff_roll: float
    landing_roll: float
    glide_slope_dots: float
    localizer_dots: float
    touchdown: Touchdown
    stopping_margin: float
    parked: Parked
    envelope: Envelope


def measure(run: Run, mission: Mission, manual: FlightManual, departure: Runway, arrival: Runway) -> Measures:
    """Measure a flight."""
    glide_slope, localizer = approach_dots(run, arrival)
    return Measures(
        level=level_flight(run),
        climb_swing=climb_swing(run),
        legs=flown_legs(run, mission.legs),
        takeoff_roll=roll_deviation(run, departure, "T/O"),
        landing_roll=roll_deviation(run, arrival, "LDG"),
        glide_slope_dots=glide_slope,
        localizer_dots=localizer,
        touchdown=touchdown(run, arrival),
        stopping_margin=stopping_margin(run, arrival),
        parked=parked(run, mission.arrival.stand),
        envelope=envelope(run, manual),
    )
