"""What a take-off gives, as one flat row: the columns of the tables, of the JSON and of a study."""

from typing import Any

from harness.takeoff.case import TakeOff
from harness.takeoff.flight import CS25_SCREEN, SCREEN, Flown, fly_take_off

FACTOR = 1.15  # CS 25.113(a)(2), (b)(2): on the distances with all engines


def row(flown: Flown) -> dict[str, Any]:
    """The numbers of a flown take-off, SI. Distances are from brake release, heights those of the lowest main wheel."""
    case = flown.case
    rotation = flown.at_speed(flown.vr)
    liftoff, low, high = flown.liftoff, flown.at_height(CS25_SCREEN), flown.at_height(SCREEN)
    at = flown.at
    middle = 0.5 * (at(liftoff, "along") + at(low, "along"))
    return {
        "mass_kg": case.mass,
        "vr_mps": flown.vr,
        "vlof_mps": at(liftoff, "cas"),
        "v_35ft_mps": at(low, "cas"),
        "v_35m_mps": at(high, "cas"),
        "rotation_distance_m": at(rotation, "along"),
        "liftoff_distance_m": at(liftoff, "along"),
        "distance_35ft_m": at(low, "along"),
        "distance_35m_m": at(high, "along"),
        "time_liftoff_s": at(liftoff, "time"),
        "time_35ft_s": at(low, "time"),
        "time_35m_s": at(high, "time"),
        "takeoff_run_aeo_m": FACTOR * middle,
        "takeoff_distance_aeo_m": FACTOR * at(low, "along"),
        "greatest_pitch_rad": float(flown.pitch.max()),
        "greatest_deviation_m": float(abs(flown.across).max()),
        "start": case.start,
        "flaps": case.flaps,
        "isa_deviation_K": case.isa_deviation,
        "qnh_Pa": case.qnh,
        "elevation_m": case.elevation,
        "headwind_mps": case.headwind,
        "crosswind_mps": case.crosswind,
        "slope": case.slope,
    }


COLUMNS = frozenset(
    [
        "mass_kg",
        "vr_mps",
        "vlof_mps",
        "v_35ft_mps",
        "v_35m_mps",
        "rotation_distance_m",
        "liftoff_distance_m",
        "distance_35ft_m",
        "distance_35m_m",
        "time_liftoff_s",
        "time_35ft_s",
        "time_35m_s",
        "takeoff_run_aeo_m",
        "takeoff_distance_aeo_m",
        "greatest_pitch_rad",
        "greatest_deviation_m",
        "start",
        "flaps",
        "isa_deviation_K",
        "qnh_Pa",
        "elevation_m",
        "headwind_mps",
        "crosswind_mps",
        "slope",
    ]
)
"""The keys of a row, known before anything is flown."""


def case_row(case: TakeOff) -> dict[str, Any]:
    """Fly a take-off and return its row. Raises InputErrors, FlightError."""
    return row(fly_take_off(case))
