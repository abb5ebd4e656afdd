"""A runway as the card takes it: from the navigation database, or given by hand, and the day on it."""

from dataclasses import replace
from math import cos, sin
from typing import NamedTuple

from harness.errors import InputError
from harness.navigation.database import load
from harness.takeoff.case import TakeOff
from harness.takeoff.field_flights import Runway
from harness.units import DEG
from harness.world.atmosphere import temperature

HARD = ("asphalt", "concrete", "paved")
FREEZING = 273.15  # K
HEADWIND_SHARE, TAILWIND_SHARE = 0.5, 1.5  # CS 25.105(d)(1): what is counted of the reported wind


class Site(NamedTuple):
    """A runway and what it offers: SI, slope uphill positive."""

    name: str
    heading: float
    elevation: float
    slope: float
    available: Runway


def from_database(name: str) -> Site:
    """The runway "EDDK/14L": its length is all that is available, without stopway or clearway. Raises InputError."""
    airport, _, designator = name.partition("/")
    if not designator:
        raise InputError(
            f'"{name}" is no runway', file="--runway", remedy="write airport/runway, such as EDDK/14L"
        )
    try:
        runway = load().runway(airport, designator)
    except LookupError as error:
        raise InputError(str(error), file="--runway") from None
    if not any(word in runway.surface for word in HARD):
        raise InputError(
            f"{name} has a surface of {runway.surface}",
            file="--runway",
            remedy="only paved ones are known here",
        )
    length = runway.length
    return Site(
        f"{runway.airport} {runway.designator}",
        runway.true_heading,
        runway.elevation,
        runway.slope,
        Runway(length, length, length),
    )


def on_site(case: TakeOff, site: Site, wind_from: float | None = None, wind: float = 0.0) -> TakeOff:
    """The take-off there. A wind (m/s, from a true direction in rad) is turned into head- and crosswind.

    Of a headwind half counts, of a tailwind one and a half.
    """
    if wind_from is not None:
        angle = wind_from - site.heading
        case = replace(case, headwind=wind * cos(angle), crosswind=wind * sin(angle))
    counted = case.headwind * (HEADWIND_SHARE if case.headwind > 0.0 else TAILWIND_SHARE)
    return replace(case, heading=site.heading, elevation=site.elevation, slope=site.slope, headwind=counted)


def deviation(celsius: float, elevation: float) -> float:
    """How much warmer than ISA it is, K, with `celsius` degrees on a runway at `elevation` (m)."""
    return celsius + FREEZING - temperature(elevation)


def wind_direction(text: str) -> float | None:
    """The direction of "250deg", rad, or None if it is not one."""
    number = text.removesuffix("deg").strip()
    return float(number) * DEG if text.endswith("deg") and number.replace(".", "", 1).isdigit() else None
