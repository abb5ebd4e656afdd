"""Checklists: the pilot reads them, and moves on to the next phase when every item holds (Fig. 7)."""

from collections.abc import Callable, Mapping
from math import hypot
from typing import NamedTuple, Protocol

from harness.pilot.control import ControlSystem
from harness.pilot.route import NavigationComputer
from harness.plan import Checklist, Condition
from harness.plan_reader import parse_reference
from harness.state import State
from harness.units import show
from harness.vocabulary import QUANTITIES


class Cockpit(Protocol):
    """What a pilot looks at when reading a checklist, besides the aircraft's state."""

    phase_begin: float
    level_error: float
    approaches: int

    @property
    def route(self) -> NavigationComputer:
        """Where the aircraft is on its route."""
        ...

    @property
    def control(self) -> ControlSystem:
        """What is selected and aimed at."""
        ...

    def level_captured(self, state: State) -> bool:
        """Whether the wanted level is near enough to round out towards it."""
        ...

    def heading_error(self, state: State) -> float:
        """Angle from the runway's direction to the nose."""
        ...


Number = Callable[[State], float]
Test = Callable[[State], bool]

MEASURES: Mapping[str, Callable[[Cockpit], Number]] = {
    "time": lambda pilot: lambda state: state.time,
    "time-in-phase": lambda pilot: lambda state: state.time - pilot.phase_begin,
    "cas": lambda pilot: lambda state: state.cas,
    "ground-speed": lambda pilot: lambda state: hypot(state.velocity_north, state.velocity_east),
    "mach": lambda pilot: lambda state: state.mach,
    "altitude": lambda pilot: lambda state: state.altitude,
    "height": lambda pilot: lambda state: state.height,
    "vertical-speed": lambda pilot: lambda state: state.vertical_speed,
    "pitch": lambda pilot: lambda state: state.pitch,
    "bank": lambda pilot: lambda state: abs(state.roll),
    "flap": lambda pilot: lambda state: state.flap,
    "gear": lambda pilot: lambda state: state.gear,
    "propeller-speed": lambda pilot: lambda state: state.propeller_speed,
    "engines-failed": lambda pilot: lambda state: pilot.control.failed_engines.bit_count(),
    "main-gear-on-ground": lambda pilot: lambda state: state.main_on_ground,
    "nose-gear-on-ground": lambda pilot: lambda state: state.nose_on_ground,
    "level-above": lambda pilot: lambda state: pilot.level_error,
    "level-below": lambda pilot: lambda state: -pilot.level_error,
    "level-captured": lambda pilot: lambda state: float(pilot.level_captured(state)),
    "speed-error": lambda pilot: lambda state: abs(pilot.control.target_cas - state.cas),
    "waypoints-remaining": lambda pilot: lambda state: pilot.route.waypoints_remaining,
    "distance-to-waypoint": lambda pilot: lambda state: pilot.route.remaining,
    "distance-to-threshold": lambda pilot: lambda state: pilot.route.distance_to_threshold,
    "distance-past-threshold": lambda pilot: lambda state: pilot.control.runway.offset(state)[0],
    "approaches-missed": lambda pilot: lambda state: pilot.approaches,
    "localizer-captured": lambda pilot: lambda state: float(abs(pilot.route.localizer.dots) < 1.0),
    "localizer-dots": lambda pilot: lambda state: abs(pilot.route.localizer.dots),
    "glide-slope-dots": lambda pilot: lambda state: pilot.route.glide_slope.dots,
    "glide-slope-alive": lambda pilot: lambda state: float(pilot.route.glide_slope.received),
    "taxi-distance": lambda pilot: lambda state: pilot.control.taxi_distance,
    "heading-error": lambda pilot: lambda state: abs(pilot.heading_error(state)),
    "centreline-deviation": lambda pilot: lambda state: abs(pilot.control.runway.offset(state)[1]),
}
"""How the pilot measures each word of `vocabulary.QUANTITIES`, SI; yes is 1, no is 0."""

_SHOWN = {
    "time": ("s", 1),
    "speed": ("kt", 1),
    "length": ("ft", 0),
    "vertical-speed": ("ft/min", 0),
    "angle": ("deg", 1),
    "angular-speed": ("rpm", 0),
}
_TOLERANCE = 0.005  # a position asked for exactly (`is`) is reached this close to it


class Item(NamedTuple):
    """A condition made ready to be read: what is measured, the number it is held against, and the comparison."""

    condition: Condition
    measure: Number
    required: Number
    holds: Test

    def achieved(self, state: State) -> str:
        """The measured value as text with its unit."""
        return self._text(self.measure(state))

    def wanted(self, state: State) -> str:
        """The required value as text with its unit, and its name if it has one."""
        text = self._text(self.required(state))
        written = self.condition.required
        named = f" ({written})" if written[:1].isalpha() and written not in ("yes", "no") else ""
        return f"{self.condition.relation.replace('-', ' ')} {text}{named}"

    def _text(self, value: float) -> str:
        kind = QUANTITIES[self.condition.quantity]
        if kind == "yes-no":
            return "yes" if value else "no"
        unit, digits = _SHOWN.get(kind, ("", 2))
        return show(value, unit, digits) if unit else f"{value:.{digits}f}"


class OpenChecklist:
    """The way to another phase, ready to be read."""

    def __init__(self, to: str, items: tuple[Item, ...]) -> None:
        self.to = to
        self.items = items
        self._tests = tuple(entry.holds for entry in items)

    def complete(self, state: State) -> bool:
        """Whether every item holds at once."""
        for holds in self._tests:  # noqa: SIM110  a plain loop: this runs at every pilot step
            if not holds(state):
                return False
        return True

    def waiting(self, state: State) -> list[Item]:
        """The items that do not hold yet."""
        return [entry for entry in self.items if not entry.holds(state)]


def prepared(checklist: Checklist, pilot: Cockpit, mass: float) -> OpenChecklist:
    """Look up the numbers of a checklist for an aircraft of `mass` kg."""
    return OpenChecklist(checklist.to, tuple(item(condition, pilot, mass) for condition in checklist.items))


def item(condition: Condition, pilot: Cockpit, mass: float) -> Item:
    """Look up the numbers of one condition."""
    measure = MEASURES[condition.quantity](pilot)
    reference = parse_reference(condition.required, QUANTITIES[condition.quantity])
    if reference.name == "leg-speed":

        def following(state: State) -> float:
            return pilot.route.target_cas + reference.offset

        return Item(
            condition, measure, following, lambda state: _compare(condition, measure(state), following(state))
        )
    if condition.quantity == "flap" and reference.name:
        value = pilot.control.manual.flap(reference.name).position
    elif condition.quantity == "gear" and reference.name:
        value = float(reference.name == "down")
    elif reference.name:
        value = pilot.control.named_speed(reference.name, mass) + reference.offset
    else:
        value = reference.offset
    return Item(condition, measure, lambda state: value, _test(condition, measure, value))


def _test(condition: Condition, measure: Number, value: float) -> Test:
    if condition.relation == "at-least":
        return lambda state: measure(state) >= value
    if condition.relation == "at-most":
        return lambda state: measure(state) <= value
    return lambda state: abs(measure(state) - value) <= _TOLERANCE


def _compare(condition: Condition, value: float, required: float) -> bool:
    if condition.relation == "at-least":
        return value >= required
    if condition.relation == "at-most":
        return value <= required
    return abs(value - required) <= _TOLERANCE
