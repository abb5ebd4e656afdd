"""Reads one <waypoint> of a route into a leg, its fix computed."""

from math import isfinite
from typing import cast

from harness.mission.model import Fix, Leg, Mode, Turn
from harness.navigation.database import Database, Station
from harness.plan_reader import read_step
from harness.units import DEG, Level, Speed, UnitError, parse, parse_direction, parse_level, parse_speed
from harness.world import earth
from harness.xml_source import NAN, Element, Source, children

NO_SPEED = Speed("CAS", NAN)
NO_LEVEL = Level("ALT", NAN)


def read_leg(source: Source, database: Database, element: Element) -> Leg:
    """The leg in a <waypoint>, faults noted in `source`."""
    parent = element.getparent()
    mode = cast(Mode, element.get("mode"))  # the schema has checked these two
    station = _station(source, database, element)
    course = _course(source, element, mode, station)
    turn = cast(Turn, element.get("turn", "fly-by" if mode == "direct" else "fly-over"))
    if mode == "homing" and turn == "fly-by":
        source.fault("a homing leg ends over its station", element, "turn", 'delete turn="fly-by"')
    return Leg(
        name=element.get("name", ""),
        fix=_fix(source, element, mode, station, course),
        mode=mode,
        course_true=course,
        speed=source.read(element, "speed", parse_speed, NO_SPEED),
        level=source.read(element, "level", parse_level, NO_LEVEL),
        turn=turn,
        actions=tuple(read_step(source, action) for action in children(element, "action")),
        line=source.place(element)[1] or 1,
        part="arrival" if parent is not None and parent.tag == "arrival" else "route",
    )


def _station(source: Source, database: Database, element: Element) -> Station | None:
    ident = element.get("station")
    if ident is None:
        return None
    try:
        return database.station(ident)
    except LookupError as error:
        not_found(source, error, element, "station")
        return None


def _course(source: Source, element: Element, mode: Mode, station: Station | None) -> float | None:
    if mode != "tracking":
        if element.get("course") is not None:
            what = f"a {mode} leg has no course"
            source.fault(what, element, "course", 'delete it, or write mode="tracking"')
        return None
    if not source.needed(element, "course", "148 deg magnetic"):
        return None
    course, magnetic = source.read(element, "course", parse_direction, (NAN, False))
    if magnetic and station is not None:
        course = (course + station.declination) % (360 * DEG)
    return course


def _fix(source: Source, element: Element, mode: Mode, station: Station | None, course: float | None) -> Fix:
    placed = element.get("latitude") is not None or element.get("longitude") is not None
    if (element.get("station") is not None) == placed:
        source.fault(
            "a waypoint is either at a station or at a latitude and a longitude",
            element,
            remedy='write station="COL", or latitude="48.35 deg" longitude="11.79 deg"',
        )
        return Fix(NAN, NAN)
    if placed:
        return _place(source, element, mode)
    if station is None:
        return Fix(NAN, NAN)
    if mode != "direct" and not station.has_bearing:
        what = f"{station.ident} is a {station.kind}: it gives no bearing to fly a {mode} leg by"
        source.fault(what, element, "station", 'write mode="direct", or choose another station')
    if element.get("distance") is None:
        return Fix(station.latitude, station.longitude, station)
    return _dme_fix(source, element, station, course)


def _place(source: Source, element: Element, mode: Mode) -> Fix:
    for attribute in ("latitude", "longitude"):
        source.needed(element, attribute, "48.35 deg")
    if mode != "direct":
        what = f"a {mode} leg needs a station to receive"
        source.fault(what, element, remedy='name one with station="...", or write mode="direct"')
    if element.get("distance") is not None:
        source.fault("a distance needs a station to measure it from", element, "distance", "delete it")
    return Fix(*coordinates(source, element))


def _dme_fix(source: Source, element: Element, station: Station, course: float | None) -> Fix:
    distance = source.quantity(element, "distance", "length")
    if course is None:
        if element.get("mode") != "tracking":
            what = "only a tracking leg can end at a distance from its station"
            source.fault(what, element, "distance", 'delete it, or write mode="tracking" course="..."')
    elif not station.has_dme:
        source.fault(f"{station.ident} is a {station.kind}: it has no DME", element, "distance")
    elif distance <= 0 or distance > earth.MEAN_RADIUS:
        text = element.get("distance")
        source.fault(f'distance="{text}" is not a distance from the station', element, "distance")
    elif isfinite(course + distance):  # else one of them has been told already
        return Fix(*earth.direct(station.latitude, station.longitude, course, distance), station, distance)
    return Fix(station.latitude, station.longitude, station)


def coordinates(source: Source, element: Element) -> tuple[float, float]:
    """The latitude and longitude of an element, rad, faults noted in `source`."""
    return (
        source.read(element, "latitude", lambda text: _within(text, 90), NAN),
        source.read(element, "longitude", lambda text: _within(text, 180), NAN),
    )


def not_found(source: Source, error: LookupError, element: Element, attribute: str) -> None:
    """Note what the navigation database said of a name it does not have."""
    what, _, remedy = str(error.args[0]).partition("; ")
    source.fault(what, element, attribute, remedy)


def _within(text: str, degrees: float) -> float:
    angle = parse(text, "angle")
    if abs(angle) > degrees * DEG:
        raise UnitError(f'"{text}" is beyond {degrees} deg')
    return angle
