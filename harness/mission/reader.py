"""Reads a mission file into a Mission. Every fault has its file and line; one reading reports them all."""

from collections.abc import Iterable
from dataclasses import replace
from pathlib import Path

from lxml import etree

from harness import resources
from harness.errors import did_you_mean
from harness.manual import PropertySetting
from harness.mission.loading import read_loading
from harness.mission.model import (
    Arrival,
    Departure,
    Environment,
    Leg,
    Mission,
    Position,
    Stand,
)
from harness.mission.overrides import Override, apply, from_option, path_of
from harness.mission.waypoint import NO_SPEED, coordinates, not_found, read_leg
from harness.navigation.database import Database, Runway, load
from harness.plan import Failure
from harness.plan_reader import read_failure, read_phase
from harness.units import Quantity, Speed, UnitError, parse_direction, parse_quantity, parse_speed
from harness.xml_source import NAN, Element, Source, children

SCHEMA = "mission.xsd"


def read_mission(
    path: str | Path,
    overrides: Iterable[str | Override] = (),
    database: Database | None = None,
    *,
    text: str | None = None,
) -> Mission:
    """Read a mission file, with overrides applied, which as texts are `PATH=VALUE`.

    With `text`, that is the mission, and `path` only names it in messages.

    Raises InputErrors: what is wrong in the file by itself, and stations and runways that do not exist.
    Whether the aircraft can fly it is for `harness.mission.check`.
    """
    source = _source(Path(path), text)
    for override in overrides:
        apply(source, from_option(override) if isinstance(override, str) else override)
    source.validate()
    mission = _Reader(source, database or load()).mission()
    source.finish()
    return replace(mission, source_path=Path(path))  # of a variant: not that of its base


def _source(path: Path, text: str | None) -> Source:
    """The mission's tree; of a variant, the tree of its base with the variant's values set."""
    source = Source(path, SCHEMA, "mission", "variant", text=text)
    if source.root.tag == "mission":
        return source
    source.validate()
    of = source.root.get("of", "")
    base_path = path.with_name(f"{of}.xml")
    if base_path == path or not base_path.is_file():
        others = [other.stem for other in path.parent.glob("*.xml") if other != path]
        source.fault(
            f'of="{of}" is not a mission in the same folder', source.root, "of", did_you_mean(of, others)
        )
        source.finish()
    base = Source(base_path, SCHEMA, "mission")
    base.root.set("name", source.root.get("name", ""))
    description = source.one(source.root, "description", needed=False)
    source.finish()
    if description is not None:
        apply(base, Override("description", description.text or "", *source.place(description)))
    for line in children(source.root, "set"):
        apply(base, Override(line.get("path", ""), line.get("value", ""), *source.place(line)))
    return base


class _Reader:
    """Turns the elements of one mission into its model; faults are noted in the source."""

    def __init__(self, source: Source, database: Database) -> None:
        self.source = source
        self.database = database

    def mission(self) -> Mission:
        """The mission; parts with faults hold NaN and the like, so the caller must look at the faults."""
        root = self.source.root
        description = self.source.one(root, "description", needed=False)
        aircraft = self.source.one(root, "aircraft")
        environment = self.source.one(root, "environment", needed=False)
        configuration = self.source.one(root, "configuration", needed=False)
        route = self.source.one(root, "route")
        arrival = self.source.one(root, "arrival")
        loading = self.source.one(root, "loading")
        phases = list(children(root, "phase"))
        self.source.distinct(phases, "name")
        return Mission(
            name=root.get("name", ""),
            description=" ".join((description.text or "").split()) if description is not None else "",
            aircraft=self._aircraft(aircraft),
            speeds=self._speeds(aircraft),
            loading=read_loading(self.source, loading, None if aircraft is None else aircraft.get("name")),
            environment=self._environment(environment),
            departure=self._departure(self.source.one(root, "departure")),
            legs=self._legs(route, arrival),
            arrival=self._arrival(arrival),
            phases={phase.get("name", ""): read_phase(self.source, phase) for phase in phases},
            gains=self._gains(aircraft),
            properties=self._properties(aircraft),
            configuration={} if configuration is None else _words(configuration),
            failures=self._failures(self.source.one(root, "failures", needed=False)),
            expects=root.get("expects", "completed"),
            source_path=self.source.path,
            text=etree.tostring(root.getroottree(), encoding="unicode"),
            places=self._places(),
        )

    def _aircraft(self, element: Element | None) -> str:
        name = "" if element is None else element.get("name", "")
        if element is not None and name not in resources.aircraft():
            what = f'there is no aircraft "{name}"'
            self.source.fault(what, element, "name", did_you_mean(name, resources.aircraft()))
        return name

    def _places(self) -> dict[str, tuple[str, int | None]]:
        """Where each element was written, and each value that an override put there."""
        changed = {(element, attribute) for element, attribute in self.source.origins if attribute}
        places = {path_of(element): self.source.place(element) for element in self.source.root.iter("*")}
        return places | {
            f"{path_of(element)}/{attribute}": self.source.place(element, attribute)
            for element, attribute in changed
        }

    def _speeds(self, aircraft: Element | None) -> dict[str, Speed]:
        elements = [] if aircraft is None else list(children(aircraft, "speed"))
        self.source.distinct(elements, "name")
        return {
            element.get("name", ""): self.source.read(element, "value", _decision_speed, NO_SPEED)
            for element in elements
        }

    def _gains(self, aircraft: Element | None) -> dict[str, Quantity]:
        elements = [] if aircraft is None else list(children(aircraft, "gain"))
        self.source.distinct(elements, "name")
        return {
            element.get("name", ""): self.source.read(element, "value", parse_quantity, Quantity(NAN, ""))
            for element in elements
        }

    def _properties(self, aircraft: Element | None) -> tuple[PropertySetting, ...]:
        elements = [] if aircraft is None else list(children(aircraft, "property"))
        self.source.distinct(elements, "name")
        return tuple(
            PropertySetting(
                element.get("name", ""),
                self.source.quantity(element, "value", "ratio"),  # the property's name says its unit
                *self.source.place(element, "value"),
            )
            for element in elements
        )

    def _failures(self, element: Element | None) -> tuple[Failure, ...]:
        elements = [] if element is None else list(children(element, "failure"))
        self.source.distinct(elements, "name")
        return tuple(read_failure(self.source, failure) for failure in elements)

    def _environment(self, element: Element | None) -> Environment:
        day = Environment()
        if element is None:
            return day
        if element.get("wind-speed") is not None and element.get("wind-from") is None:
            self.source.fault(
                "a wind-speed needs a wind-from", element, "wind-speed", remedy='add wind-from="270 deg true"'
            )
        return Environment(
            self.source.quantity(element, "isa-deviation", "temperature-difference", day.isa_deviation),
            self.source.quantity(element, "qnh", "pressure", day.qnh),
            self.source.read(element, "wind-from", _true_direction, day.wind_from),
            self.source.quantity(element, "wind-speed", "speed", day.wind_speed),
        )

    def _departure(self, element: Element | None) -> Departure:
        airport, runway, taxi, stand = self._airport(element)
        return Departure(airport, runway, stand, taxi)

    def _arrival(self, element: Element | None) -> Arrival:
        return Arrival(*self._airport(element))

    def _airport(self, element: Element | None) -> tuple[str, str, tuple[Position, ...], Stand | None]:
        if element is None:
            return "", "", (), None
        runway = self._runway(element)
        stand = self.source.one(element, "stand", needed=False)
        taxi = self.source.one(element, "taxi", needed=False)
        if taxi is not None and stand is None:
            self.source.fault(
                "<taxi> leads to no <stand>", taxi, remedy="add a <stand>, or delete the <taxi>"
            )
        points = [] if taxi is None else list(children(taxi, "point"))
        return (
            runway.airport if runway else "",
            runway.designator if runway else "",
            tuple(Position(*coordinates(self.source, point)) for point in points),
            None
            if stand is None
            else Stand(
                *coordinates(self.source, stand), self.source.read(stand, "heading", _true_direction, NAN)
            ),
        )

    def _runway(self, element: Element) -> Runway | None:
        try:
            return self.database.runway(element.get("airport", ""), element.get("runway", ""))
        except LookupError as error:
            not_found(self.source, error, element, "runway")
            return None

    def _legs(self, *parts: Element | None) -> tuple[Leg, ...]:
        waypoints = [
            waypoint for part in parts if part is not None for waypoint in children(part, "waypoint")
        ]
        self.source.distinct(waypoints, "name")
        return tuple(read_leg(self.source, self.database, waypoint) for waypoint in waypoints)


def _words(element: Element) -> dict[str, str]:
    """The attributes of an element."""
    return {str(name): str(value) for name, value in element.attrib.items()}


def _decision_speed(text: str) -> Speed:
    speed = parse_speed(text)
    if speed.kind != "CAS":
        raise UnitError(f'"{text}" is not a calibrated airspeed; decision speeds are, e.g. 121 kt CAS')
    return speed


def _true_direction(text: str) -> float:
    direction, magnetic = parse_direction(text)
    if magnetic:
        raise UnitError(
            f'"{text}" is magnetic, but there is no station here to take the declination from; write true'
        )
    return direction
