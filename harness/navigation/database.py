"""Radio aids and runways of western and southern Germany, read once from the tables in `data/`.

Angles are in radians and true, lengths in metres, frequencies in hertz.
"""

import csv
from collections.abc import Iterable
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache, cached_property
from importlib.resources import files
from math import atan, atan2, hypot, tan

from harness.units import DEG, FT
from harness.world import earth

_BEARING_KINDS = {"VOR", "VOR-DME", "VORTAC", "TACAN", "NDB", "NDB-DME"}
_DISTANCE_KINDS = {"VOR-DME", "VORTAC", "TACAN", "NDB-DME", "DME"}


@dataclass(frozen=True)
class Station:
    """A radio aid. `declination` (east positive) turns a magnetic course at the station into a true one."""

    ident: str
    name: str
    kind: str  # VOR, VOR-DME, VORTAC, TACAN, DME, NDB, NDB-DME
    latitude: float
    longitude: float
    elevation: float  # 0 where the source has none, which happens for NDBs only
    frequency: float  # of a TACAN or DME: its paired VHF frequency
    declination: float

    @cached_property
    def antenna(self) -> earth.Frame:
        """The station's own view of the world."""
        return earth.Frame(self.latitude, self.longitude, self.elevation)

    @property
    def has_bearing(self) -> bool:
        """Whether a direction can be received."""
        return self.kind in _BEARING_KINDS

    @property
    def has_dme(self) -> bool:
        """Whether a distance can be received."""
        return self.kind in _DISTANCE_KINDS

    @property
    def is_ndb(self) -> bool:
        """Whether the direction is relative to the nose, from a direction finder: no radials."""
        return self.kind.startswith("NDB")


@dataclass(frozen=True, slots=True)
class Runway:
    """A runway in one direction of use, from its threshold to the threshold of the other direction."""

    airport: str
    designator: str
    latitude: float  # of the threshold
    longitude: float
    elevation: float  # of the threshold
    true_heading: float  # at the threshold
    length: float
    width: float
    surface: str
    end_latitude: float  # of the opposite threshold
    end_longitude: float
    end_elevation: float

    @property
    def slope(self) -> float:
        """Rise over run, positive uphill."""
        return (self.end_elevation - self.elevation) / self.length

    def point(self, along: float, across: float = 0.0) -> tuple[float, float]:
        """Return (latitude, longitude) `along` metres past the threshold and `across` right of it."""
        return earth.direct(
            self.latitude,
            self.longitude,
            self.true_heading + atan2(across, along),
            hypot(along, across),
        )

    def offset(self, latitude: float, longitude: float) -> tuple[float, float]:
        """Return (along, across) of a point: metres past the threshold and right of the centreline."""
        return earth.offset(self.latitude, self.longitude, self.true_heading, latitude, longitude)


class Ils:
    """The instrument landing system of a runway, synthesised from its geometry.

    Real antenna sites are in restricted data only. The localizer stands `LOCALIZER_SETBACK` past the far end
    on the centreline; full scale (2 dots) is 350 ft beside the centreline at the threshold. The glide path
    rises at `GLIDE_ANGLE` and crosses the threshold at `CROSSING_HEIGHT`; its antenna stands abeam the point
    where the path meets the runway, the aim.

    Source: ICAO Annex 10 Vol. I, 3.1.3.7.1 (0.00145 DDM/m at the threshold: full deflection, 0.155 DDM, at
    107 m), 3.1.5.1 (3 deg, 15 m), 3.1.5.6 (0.0875 DDM at 0.12 of the angle: full, 0.175 DDM, near 0.7 deg).
    """

    LOCALIZER_SETBACK = 300.0  # estimate: a common site, beyond the stopway and clear of the overrun area
    SECTOR_AT_THRESHOLD = 350 * FT  # full scale at the threshold
    GLIDE_ANGLE = 3 * DEG
    GLIDE_FULL_SCALE = 0.7 * DEG
    CROSSING_HEIGHT = 15.0
    GLIDE_ANTENNA_ABEAM = 120.0  # estimate: a common site, outside the runway strip

    def __init__(self, runway: Runway) -> None:
        self.runway = runway
        self.localizer_latitude, self.localizer_longitude = runway.point(
            runway.length + self.LOCALIZER_SETBACK
        )
        towards, at_antenna, distance = earth.inverse(
            runway.latitude, runway.longitude, self.localizer_latitude, self.localizer_longitude
        )
        self.course = towards  # true, at the threshold
        self.course_at_localizer = at_antenna  # true, turned by the convergence of the meridians
        self.localizer_full_scale = atan(self.SECTOR_AT_THRESHOLD / distance)
        self.aim_distance = self.CROSSING_HEIGHT / (
            tan(self.GLIDE_ANGLE) + runway.slope
        )  # past the threshold
        self.aim_elevation = runway.elevation + runway.slope * self.aim_distance
        self.aim = earth.Frame(*runway.point(self.aim_distance), self.aim_elevation)
        self.glide_latitude, self.glide_longitude = runway.point(self.aim_distance, self.GLIDE_ANTENNA_ABEAM)
        self.glide_antenna = earth.Frame(self.glide_latitude, self.glide_longitude, self.aim_elevation)
        self.localizer_antenna = earth.Frame(
            self.localizer_latitude, self.localizer_longitude, runway.end_elevation
        )


class Database:
    """Stations and runways by name. A name that is not there raises a LookupError that says what is."""

    def __init__(self, stations: Iterable[Station], runways: Iterable[tuple[Runway, str]]) -> None:
        """Index stations, and runways with the designator each had in 2010."""
        self._stations: dict[str, list[Station]] = {}
        self._runways: dict[str, dict[str, Runway]] = {}
        self._former: dict[str, dict[str, list[Runway]]] = {}
        for station in stations:
            self._stations.setdefault(station.ident, []).append(station)
        for runway, former in runways:
            self._runways.setdefault(runway.airport, {})[runway.designator] = runway
            if former:
                self._former.setdefault(runway.airport, {}).setdefault(former, []).append(runway)

    def station(self, name: str) -> Station:
        """Return the station `COL`, or `IGL TACAN` where two stations share an ident."""
        ident, _, kind = name.strip().upper().partition(" ")
        found = self._stations.get(ident)
        if not found:
            raise LookupError(
                f"no station {name!r} in the navigation database{_suggest(ident, self._stations)}"
            )
        chosen = [station for station in found if not kind or station.kind == kind.strip()]
        if len(chosen) == 1:
            return chosen[0]
        choices = " or ".join(f"{station.ident} {station.kind}" for station in found)
        if chosen:
            raise LookupError(f"{len(chosen)} stations are called {ident}; write {choices}")
        raise LookupError(f"no station {name!r} in the navigation database; did you mean {choices}?")

    def runway(self, airport: str, designator: str) -> Runway:
        """Return a runway by its designator of today, or of 2010 where no runway of today has that one."""
        airport, designator = airport.strip().upper(), designator.strip().upper()
        runways = self._runways.get(airport)
        if runways is None:
            raise LookupError(
                f"no airport {airport!r} in the navigation database{_suggest(airport, self._runways) or ';'} "
                f"it has {', '.join(self.airport_names())}"
            )
        if designator in runways:
            return runways[designator]
        former = self._former.get(airport, {}).get(designator, [])
        if len(former) == 1:
            return former[0]
        raise LookupError(f"{airport} has no runway {designator!r}; it has {', '.join(sorted(runways))}")

    def stations(self) -> tuple[Station, ...]:
        """Return every station, by ident."""
        return tuple(station for _, found in sorted(self._stations.items()) for station in found)

    def runways(self, airport: str) -> tuple[Runway, ...]:
        """Return every runway of an airport known to the database, by designator."""
        return tuple(runway for _, runway in sorted(self._runways[airport].items()))

    def airport_names(self) -> tuple[str, ...]:
        """Return the ICAO codes of the airports."""
        return tuple(sorted(self._runways))


def _suggest(name: str, known: Iterable[str]) -> str:
    close = get_close_matches(name, list(known), cutoff=0.5)
    return f"; did you mean {' or '.join(close)}?" if close else ""


@cache
def load() -> Database:
    """Return the database shipped with the harness; the tables are read once."""
    return Database(_stations(), _runways())


def _rows(table: str) -> list[dict[str, str]]:
    text = (files("harness.navigation") / "data" / table).read_text(encoding="utf-8")
    return list(csv.DictReader(text.splitlines()))


def _stations() -> list[Station]:
    return [
        Station(
            row["ident"],
            row["name"],
            row["kind"],
            float(row["latitude_deg"]) * DEG,
            float(row["longitude_deg"]) * DEG,
            float(row["elevation_ft"] or 0) * FT,
            float(row["frequency_khz"]) * 1e3,
            float(row["declination_2010_deg"]) * DEG,
        )
        for row in _rows("stations.csv")
    ]


def _runways() -> list[tuple[Runway, str]]:
    rows = {(row["airport"], row["designator"]): row for row in _rows("runways.csv")}
    runways = []
    for (airport, designator), row in rows.items():
        latitude, longitude, elevation = _end(row)
        end_latitude, end_longitude, end_elevation = _end(rows[airport, _opposite(designator)])
        heading, _, length = earth.inverse(latitude, longitude, end_latitude, end_longitude)
        runway = Runway(
            airport,
            designator,
            latitude,
            longitude,
            elevation,
            heading,
            length,
            float(row["width_ft"]) * FT,
            row["surface"],
            end_latitude,
            end_longitude,
            end_elevation,
        )
        runways.append((runway, row["designator_2010"]))
    return runways


def _end(row: dict[str, str]) -> tuple[float, float, float]:
    return (
        float(row["latitude_deg"]) * DEG,
        float(row["longitude_deg"]) * DEG,
        float(row["elevation_ft"]) * FT,
    )


def _opposite(designator: str) -> str:
    number = (int(designator[:2]) + 17) % 36 + 1
    return f"{number:02d}" + designator[2:].translate(str.maketrans("LR", "RL"))
