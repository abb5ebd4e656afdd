"""What can be known of a mission without flying: whether this aircraft, loaded so, can fly it on this day."""

from collections.abc import Iterable, Iterator
from itertools import islice
from math import atan2, pi, tan
from pathlib import Path

from harness.errors import InputError, InputErrors, did_you_mean
from harness.manual import FlightManual, read_manual
from harness.mission.balance import LoadSheet
from harness.mission.envelope import STALL_MARGIN, Envelope
from harness.mission.model import Leg, Mission, Position
from harness.mission.reader import read_mission
from harness.mission.words import word_faults
from harness.navigation.database import Database, Ils, Runway, load
from harness.units import DEG, FT, G0, HPA, KM, KT, NM, show
from harness.world import earth
from harness.xml_source import MOST_FAULTS

TERRAIN_CLEARANCE = 1000 * FT
HARDEST_ACCELERATION = 0.5 * G0  # no transport aircraft gains or loses speed faster on a runway
FARTHEST_TAXI = 10 * KM
NEAREST_LAST_WAYPOINT = 3 * NM  # before the threshold: less leaves no room to line up
SHORTEST_LEG = 100.0
STEEPEST_LEG = (
    15 * DEG
)  # climb or descent from one waypoint to the next: more than a transport aircraft can keep up
DAY = {
    "isa-deviation": (-80.0, 60.0, "K", 1.0),
    "qnh": (850 * HPA, 1090 * HPA, "hPa", HPA),
    "wind-speed": (0.0, 60.0, "m/s", 1.0),
}
"""The weather that has been seen on Earth near the ground, rounded outwards (WMO archive of extremes)."""


def check_file(path: str | Path, overrides: Iterable[str] = ()) -> Mission:
    """Read a mission and its flight manual and check them against each other. Raises InputErrors."""
    mission = read_mission(path, overrides)
    check(mission, read_manual(mission.aircraft))
    return mission


def check(mission: Mission, manual: FlightManual, database: Database | None = None) -> None:
    """Raise InputErrors with everything in the mission that this aircraft cannot do."""
    faults = list(islice(_Checker(mission, manual, database or load()).faults(), MOST_FAULTS))
    if faults:
        raise InputErrors(faults)


class _Checker:
    """The checks of one mission; each yields its faults."""

    def __init__(self, mission: Mission, manual: FlightManual, database: Database) -> None:
        self.mission = mission
        self.manual = manual
        self.envelope = Envelope(mission, manual)
        self.flown = self.envelope.manual
        self.departure = database.runway(mission.departure.airport, mission.departure.runway)
        self.arrival = database.runway(mission.arrival.airport, mission.arrival.runway)
        self.mass = self.envelope.mass

    def faults(self) -> Iterator[InputError]:
        """Every fault; those that only follow from a wrong mass or an impossible day are left out."""
        sheet = LoadSheet(self.mission, self.manual)
        basic = [*self._loading(), *self._environment()]
        if not basic:
            basic = [*sheet.faults()]
        yield from basic
        if not basic:
            yield from self._decision_speeds()
            for before, leg in zip((None, *self.mission.legs), self.mission.legs, strict=False):
                wrong_level = [*self._level(leg)] or [*self._slope(before, leg)]
                yield from wrong_level or self._airspeed(leg)
            yield from self._runways()
        yield from self._route()
        yield from self._last_waypoint()
        yield from self._ground("departure", self.departure)
        yield from self._ground("arrival", self.arrival)
        words = [*word_faults(self.mission, self.manual)]
        yield from words
        if not words and not basic:
            yield from sheet.drop_faults()

    def _fault(self, path: str, what: str, remedy: str = "") -> InputError:
        file, line = self.mission.place(path)
        return InputError(what, file=file, line=line, remedy=remedy)

    def _loading(self) -> Iterator[InputError]:
        limits, fuel = self.manual.limits, self.mission.loading.fuel
        payload = self.mission.loading.payload_of(limits["operating-empty-mass"])
        given = "take-off-mass" if self.mission.loading.takeoff_mass is not None else "payload"
        if fuel <= 0:
            yield self._fault(
                "loading/fuel", f"fuel={show(fuel, 't', 1)} is nothing to burn", "load some fuel"
            )
        if fuel > limits["fuel-capacity"]:
            yield self._fault(
                "loading/fuel",
                f"{show(fuel, 't', 1)} of fuel is more than the tanks hold",
                f"{self.manual.aircraft} holds {show(limits['fuel-capacity'], 't', 1)}",
            )
        elif payload < 0:
            empty = show(limits["operating-empty-mass"], "t", 1)
            yield self._fault(
                f"loading/{given}",
                f"the payload would be {show(payload, 't', 1)}: the empty aircraft has {empty}, "
                f"the fuel {show(fuel, 't', 1)}",
                "more take-off mass, or less fuel",
            )
        elif self.mass > limits["maximum-take-off-mass"]:
            most = show(limits["maximum-take-off-mass"], "t", 1)
            what = f"the take-off mass of {show(self.mass, 't', 1)} is above the limit of {most}"
            yield self._fault(f"loading/{given}", what, "less payload or fuel")
        elif self.mass - fuel > limits["maximum-zero-fuel-mass"]:
            most = show(limits["maximum-zero-fuel-mass"], "t", 1)
            mass = show(self.mass - fuel, "t", 1)
            what = f"the mass without fuel, {mass}, is above the zero-fuel limit of {most}"
            yield self._fault(f"loading/{given}", what, "less payload")
        elif self.mass < limits["minimum-flight-mass"]:
            least = show(limits["minimum-flight-mass"], "t", 1)
            what = f"the take-off mass of {show(self.mass, 't', 1)} is below the minimum of {least}"
            yield self._fault(f"loading/{given}", what, "more payload or fuel")

    def _environment(self) -> Iterator[InputError]:
        day = self.mission.environment
        values = {"isa-deviation": day.isa_deviation, "qnh": day.qnh, "wind-speed": day.wind_speed}
        for name, (low, high, unit, factor) in DAY.items():
            if not low <= values[name] <= high:
                what = f"{name} of {show(values[name], unit, 1)} has not been seen on Earth"
                remedy = f"it lies between {low / factor:g} {unit} and {high / factor:g} {unit}"
                yield self._fault(f"environment/{name}", what, remedy)

    def _decision_speeds(self) -> Iterator[InputError]:
        for name in self.mission.speeds:
            path = f"aircraft/speed[{name}]/value"
            if name not in self.manual.speeds:
                what = f'{self.manual.aircraft} has no speed "{name}"'
                yield self._fault(path, what, did_you_mean(name, self.manual.speeds))
                continue
            speed = self.flown.speed(name, self.mass)
            low, high = self.envelope.decision_range(name)
            remedy = f"the manual says {_knots(self.manual.speed(name, self.mass))}"
            if speed > high:
                what = f"{name} of {_knots(speed)} is above {_knots(high)}, the limit with these flaps"
                yield self._fault(path, what, remedy)
            elif speed < low:
                yield self._fault(
                    path, f"{name} of {_knots(speed)} is below {_knots(low)}, too slow to fly", remedy
                )
            else:
                yield from self._order(name, path)

    def _order(self, changed: str, path: str) -> Iterator[InputError]:
        for low, high in (("V1", "VR"), ("VR", "V2")):
            if changed in (low, high) and {low, high} <= self.flown.speeds.keys():
                slow, fast = self.flown.speed(low, self.mass), self.flown.speed(high, self.mass)
                if slow > fast:
                    what = f"{low} of {_knots(slow)} is above {high} of {_knots(fast)}"
                    yield self._fault(path, what, "V1 <= VR <= V2")

    def _airspeed(self, leg: Leg) -> Iterator[InputError]:
        limits, path = self.manual.limits, f"{leg.path}/speed"
        speed = self.envelope.airspeeds(leg.speed, leg.level)
        slowest = self.envelope.slowest
        said = f"{leg.name}: {leg.speed} at {leg.level}"
        if speed.cas > limits["VMO"]:
            as_cas = "" if leg.speed.kind == "CAS" else f" is {_knots(speed.cas)} CAS and"
            yield self._fault(path, f"{said}{as_cas} is above VMO {_knots(limits['VMO'])}", "fly slower")
        elif speed.mach > limits["MMO"]:
            as_mach = "" if leg.speed.kind == "MACH" else f" is M{speed.mach:.3f} and"
            yield self._fault(
                path, f"{said}{as_mach} is above MMO M{limits['MMO']:g}", "fly slower, or lower"
            )
        elif speed.cas < slowest:
            as_cas = "" if leg.speed.kind == "CAS" else f" is {_knots(speed.cas)} CAS and"
            margin = f"{STALL_MARGIN:g} times the clean stall speed at {show(self.mass, 't', 1)}"
            yield self._fault(
                path, f"{said}{as_cas} is too slow", f"at least {_knots(slowest)} CAS: {margin}"
            )

    def _level(self, leg: Leg) -> Iterator[InputError]:
        path, highest = f"{leg.path}/level", self.manual.limits["maximum-altitude"]
        if leg.level.altitude > highest:
            what = f"{leg.name}: {leg.level} is above the maximum altitude of {self.manual.aircraft}"
            yield self._fault(path, what, f"at most {show(highest, 'ft')}")
        grounds = []
        if leg.fix.station is not None and leg.fix.distance is None:
            grounds.append((leg.fix.station.elevation, leg.fix.station.ident))
        if leg is self.mission.legs[0]:
            grounds.append(
                (self.departure.elevation, f"{self.departure.airport} {self.departure.designator}")
            )
        if leg is self.mission.legs[-1]:
            grounds.append((self.arrival.elevation, f"{self.arrival.airport} {self.arrival.designator}"))
        ground, where = max(grounds, default=(0.0, "the sea"))
        if self.envelope.altitude(leg.level) < ground + TERRAIN_CLEARANCE:
            what = f"{leg.name}: {leg.level} is too low: {where} lies at {show(ground, 'ft')}"
            yield self._fault(path, what, f"at least {show(ground + TERRAIN_CLEARANCE, 'ft')}")

    def _slope(self, before: Leg | None, leg: Leg) -> Iterator[InputError]:
        start = before.fix if before else self.departure
        altitude = self.envelope.altitude(before.level) if before else self.departure.elevation
        distance = earth.inverse(start.latitude, start.longitude, leg.fix.latitude, leg.fix.longitude)[2]
        rise = self.envelope.altitude(leg.level) - altitude
        if abs(rise) > distance * tan(STEEPEST_LEG) and distance > SHORTEST_LEG:
            angle, way = atan2(abs(rise), distance) / DEG, "climb" if rise > 0 else "descent"
            steep = f"{show(abs(rise), 'ft')} in {show(distance, 'NM', 1)} is a {way} of {angle:.0f} deg"
            what = f"{leg.name}: {leg.level} cannot be reached: {steep}"
            remedy = f"at most {STEEPEST_LEG / DEG:.0f} deg: another level, or a longer leg"
            yield self._fault(f"{leg.path}/level", what, remedy)

    def _route(self) -> Iterator[InputError]:
        before, start = "the departure runway", Position(*self.departure.point(self.departure.length))
        for leg in self.mission.legs:
            path = leg.path
            bearing, arriving, distance = earth.inverse(*start, leg.fix.latitude, leg.fix.longitude)
            if distance < SHORTEST_LEG:
                what = f"{leg.name} lies where {before} does: the leg has no length"
                yield self._fault(path, what, "delete one of them")
            elif (
                leg.course_true is not None
                and leg.fix.distance is None
                and _apart(leg.course_true, arriving) > pi / 2
            ):
                course = f"{leg.course_true / DEG:.0f} deg true"
                what = f"{leg.name}: the course of {course} leads away from its station"
                yield self._fault(
                    f"{path}/course", what, f"from {before} it lies {bearing / DEG:.0f} deg true"
                )
            before, start = leg.name, Position(leg.fix.latitude, leg.fix.longitude)

    def _last_waypoint(self) -> Iterator[InputError]:
        last, runway = self.mission.legs[-1], self.arrival
        name = f"{runway.airport} {runway.designator}"
        along = -runway.offset(last.fix.latitude, last.fix.longitude)[0]
        path = last.path
        if along < NEAREST_LAST_WAYPOINT:
            where = f"{show(along, 'NM', 1)} before" if along > 0 else "beyond"
            what = f"{last.name}, the last waypoint, lies {where} the threshold of {name}: no room to line up"
            yield self._fault(
                path, what, f"put it at least {show(NEAREST_LAST_WAYPOINT, 'NM')} before the threshold"
            )
            return
        glide = runway.elevation + along * tan(Ils.GLIDE_ANGLE)
        if self.envelope.altitude(last.level) > glide + TERRAIN_CLEARANCE:
            what = f"{last.name}, the last waypoint, is above the glide slope of {name}"
            yield self._fault(
                f"{path}/level",
                what,
                f"the slope is at {show(glide, 'ft')} there, and taken from below: lower, or farther out",
            )

    def _runways(self) -> Iterator[InputError]:
        for part, runway, name in (("departure", self.departure, "VR"), ("arrival", self.arrival, "VREF")):
            if name not in self.flown.speeds:
                continue
            speed = self.flown.speed(name, self.mass)
            needed = speed**2 / (2 * HARDEST_ACCELERATION)
            if runway.length < needed:
                what = f"{runway.airport} {runway.designator} is {show(runway.length, 'm')} long"
                yield self._fault(f"{part}/runway", what, f"{_knots(speed)} alone takes {show(needed, 'm')}")

    def _ground(self, part: str, runway: Runway) -> Iterator[InputError]:
        side = self.mission.departure if part == "departure" else self.mission.arrival
        stand = [] if side.stand is None else [("stand", Position(side.stand.latitude, side.stand.longitude))]
        for what, point in (*stand, *(("taxi", point) for point in side.taxi)):
            distance = earth.inverse(*point, runway.latitude, runway.longitude)[2]
            if distance > FARTHEST_TAXI:
                told = f"the {what} is {show(distance, 'km', 1)} from {runway.airport} {runway.designator}"
                yield self._fault(f"{part}/{what}", told, "latitude and longitude the wrong way round?")


def _knots(speed: float) -> str:
    return f"{speed / KT:.0f} kt"


def _apart(one: float, other: float) -> float:
    return abs((one - other + pi) % (2 * pi) - pi)
