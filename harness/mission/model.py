"""A mission as the pilot reads it: SI and radians, every fix computed, nothing left to look up."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, NamedTuple

from harness.loading.balance import Item
from harness.manual import PropertySetting
from harness.navigation.database import Station
from harness.plan import Failure, PhasePlan, Step
from harness.units import Level, Quantity, Speed

STANDARD_QNH = 101325.0

Mode = Literal["homing", "tracking", "direct"]
Turn = Literal["fly-by", "fly-over"]
Part = Literal["route", "arrival"]


class Position(NamedTuple):
    """A point on the ground, radians, WGS84."""

    latitude: float
    longitude: float


class Stand(NamedTuple):
    """Where the aircraft is parked, and its true heading. Radians."""

    latitude: float
    longitude: float
    heading: float


class Fix(NamedTuple):
    """Where a leg ends, radians; `station` if at or from one, `distance` from it in metres if a DME fix."""

    latitude: float
    longitude: float
    station: Station | None = None
    distance: float | None = None


class Leg(NamedTuple):
    """One line of the route: fly to the fix, at this speed and level. Tracking legs have a `course_true`, rad."""

    name: str
    fix: Fix
    mode: Mode
    course_true: float | None
    speed: Speed
    level: Level
    turn: Turn
    actions: tuple[Step, ...]
    line: int
    part: Part = "route"  # of the mission's own route, or of the arrival to the runway

    @property
    def path(self) -> str:
        """Where the leg stands in the mission file."""
        return f"{self.part}/waypoint[{self.name}]"


class Pallet(NamedTuple):
    """A load in the hold, and the drag area of the parachute that can pull it out (m2, 0: it rolls out by itself)."""

    item: Item
    parachute: float = 0.0

    @property
    def path(self) -> str:
        """Where it stands in the mission file."""
        return f"loading/pallet[{self.item.name}]"


class Loading(NamedTuple):
    """What is on board at brake release, kg: fuel, and take-off mass or payload; the other is None.

    With `passengers` or `pallets` the payload is their sum.
    """

    takeoff_mass: float | None
    payload: float | None
    fuel: float
    passengers: tuple[Item, ...] = ()
    pallets: tuple[Pallet, ...] = ()

    @property
    def items(self) -> tuple[Item, ...]:
        """All that has its own place."""
        return (*self.passengers, *(pallet.item for pallet in self.pallets))

    def total(self, operating_empty_mass: float) -> float:
        """The take-off mass, kg."""
        if self.takeoff_mass is not None:
            return self.takeoff_mass
        return operating_empty_mass + (self.payload or 0.0) + self.fuel

    def payload_of(self, operating_empty_mass: float) -> float:
        """The payload, kg; negative if the take-off mass asked for is too small."""
        if self.payload is not None:
            return self.payload
        return self.total(operating_empty_mass) - operating_empty_mass - self.fuel


class Environment(NamedTuple):
    """The day: deviation from ISA (K), QNH (Pa), where the wind comes from (true, rad) and how fast (m/s)."""

    isa_deviation: float = 0.0
    qnh: float = STANDARD_QNH
    wind_from: float = 0.0
    wind_speed: float = 0.0


class Departure(NamedTuple):
    """Where it begins: on the stand, then along `taxi`; without a stand lined up on the runway."""

    airport: str
    runway: str
    stand: Stand | None
    taxi: tuple[Position, ...]


class Arrival(NamedTuple):
    """Where it ends: on the stand, along `taxi` from the runway; without a stand stopped on the runway."""

    airport: str
    runway: str
    taxi: tuple[Position, ...]
    stand: Stand | None


@dataclass(frozen=True)
class Mission:
    """All of a mission file.

    `speeds`, `gains` and `phases` change the flight manual for this mission only. `configuration` has the choice made
    for each configuration of the manual that is not left as it is; `properties` are numbers of the aircraft's own that
    are other for this flight, in JSBSim's units. `expects` is the outcome that is no failure. `text` is the mission as
    flown, with its variants and overrides applied. `places` tells where each part was written (file, line), by its
    path.
    """

    name: str
    description: str
    aircraft: str
    speeds: dict[str, Speed]
    loading: Loading
    environment: Environment
    departure: Departure
    legs: tuple[Leg, ...]
    arrival: Arrival
    phases: dict[str, PhasePlan]
    source_path: Path
    text: str
    gains: dict[str, Quantity] = field(default_factory=dict)
    properties: tuple[PropertySetting, ...] = ()
    configuration: dict[str, str] = field(default_factory=dict)
    failures: tuple[Failure, ...] = ()
    expects: str = "completed"
    places: dict[str, tuple[str, int | None]] = field(default_factory=dict, compare=False)

    @property
    def released(self) -> tuple[str, ...]:
        """The names of the loads that actions release, in the order of the route and then of the phases."""
        steps = [step for leg in self.legs for step in leg.actions]
        steps += [step for plan in self.phases.values() for step in plan.steps]
        names = (step.action.get("to", "") for step in steps if step.action.get("set") == "release")
        return tuple(dict.fromkeys(names))

    def place(self, path: str) -> tuple[str, int | None]:
        """File and line of a part such as `loading/fuel`, or of the element around it."""
        while path not in self.places and path:
            path = path.rpartition("/")[0]
        return self.places.get(path, (str(self.source_path), 1))
