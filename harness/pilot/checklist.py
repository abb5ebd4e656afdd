"""Checklists: the pilot reads them, and moves on to the next phase when every item holds (Fig. 7)."""

from collections.abc import Callable, Mapping
from math import hypot
from typing import TYPE_CHECKING, NamedTuple

from harness.plan import Checklist, Condition
from harness.plan_reader import parse_reference
from harness.state import State
from harness.units import show
from harness.vocabulary import QUANTITIES

if TYPE_CHECKING:
    from harness.pilot.pilot import Pilot

Measure = Callable[["Pilot", State], float]

MEASURES: Mapping[str, Measure] = {
    "time-in-phase": lambda pilot, state: state.time - pilot.phase_begin,
    "cas": lambda pilot, state: state.cas,
    "ground-speed": lambda pilot, state: hypot(state.velocity_north, state.velocity_east),
    "mach": lambda pilot, state: state.mach,
    "altitude": lambda pilot, state: state.altitude,
    "height": lambda pilot, state: state.height,
    "vertical-speed": lambda pilot, state: state.vertical_speed,
    "pitch": lambda pilot, state: state.pitch,
    "bank": lambda pilot, state: abs(state.roll),
    "flap": lambda pilot, state: state.flap,
    "gear": lambda pilot, state: state.gear,
    "propeller-speed": lambda pilot, state: state.propeller_speed,
    "main-gear-on-ground": lambda pilot, state: state.main_on_ground,
    "nose-gear-on-ground": lambda pilot, state: state.nose_on_ground,
    "level-above": lambda pilot, state: pilot.route.level_error(state),
    "level-below": lambda pilot, state: -pilot.route.level_error(state),
    "level-captured": lambda pilot, state: float(pilot.level_captured(state)),
    "speed-error": lambda pilot, state: abs(pilot.target_cas - state.cas),
    "waypoints-remaining": lambda pilot, state: float(pilot.route.waypoints_remaining),
    "distance-to-waypoint": lambda pilot, state: pilot.route.remaining,
    "distance-to-threshold": lambda pilot, state: pilot.route.distance_to_threshold,
    "distance-past-threshold": lambda pilot, state: pilot.runway_offset(state)[0],
    "localizer-captured": lambda pilot, state: float(abs(pilot.route.localizer.dots) < 1.0),
    "localizer-dots": lambda pilot, state: abs(pilot.route.localizer.dots),
    "glide-slope-dots": lambda pilot, state: pilot.route.glide_slope.dots,
    "glide-slope-alive": lambda pilot, state: float(pilot.route.glide_slope.received),
    "taxi-distance": lambda pilot, state: pilot.taxi_distance,
    "heading-error": lambda pilot, state: abs(pilot.heading_error(state)),
    "centreline-deviation": lambda pilot, state: abs(pilot.runway_offset(state)[1]),
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
    """A condition made ready to be read: its number looked up, its comparison chosen."""

    condition: Condition
    measure: Measure
    required: Callable[[State], float]

    def holds(self, pilot: "Pilot", state: State) -> bool:
        """Whether it is fulfilled now."""
        value, required = self.measure(pilot, state), self.required(state)
        relation = self.condition.relation
        if relation == "at-least":
            return value >= required
        if relation == "at-most":
            return value <= required
        return abs(value - required) <= _TOLERANCE

    def achieved(self, pilot: "Pilot", state: State) -> str:
        """The measured value as text with its unit."""
        return self._text(self.measure(pilot, state))

    def wanted(self, state: State) -> str:
        """The required value as text with its unit, and its name if it has one."""
        text = self._text(self.required(state))
        named = "" if text == self.condition.required else f" ({self.condition.required})"
        return f"{self.condition.relation.replace('-', ' ')} {text}{named}"

    def _text(self, value: float) -> str:
        kind = QUANTITIES[self.condition.quantity]
        if kind == "yes-no":
            return "yes" if value else "no"
        unit, digits = _SHOWN.get(kind, ("", 2))
        return show(value, unit, digits) if unit else f"{value:.{digits}f}"


class OpenChecklist(NamedTuple):
    """The way to another phase, ready to be read."""

    to: str
    items: tuple[Item, ...]

    def complete(self, pilot: "Pilot", state: State) -> bool:
        """Whether every item holds at once."""
        return all(item.holds(pilot, state) for item in self.items)

    def waiting(self, pilot: "Pilot", state: State) -> list[Item]:
        """The items that do not hold yet."""
        return [item for item in self.items if not item.holds(pilot, state)]


def prepared(checklist: Checklist, pilot: "Pilot", mass: float) -> OpenChecklist:
    """Look up the numbers of a checklist for an aircraft of `mass` kg."""
    return OpenChecklist(checklist.to, tuple(item(condition, pilot, mass) for condition in checklist.items))


def item(condition: Condition, pilot: "Pilot", mass: float) -> Item:
    """Look up the numbers of one condition."""
    return Item(condition, MEASURES[condition.quantity], _required(condition, pilot, mass))


def _required(condition: Condition, pilot: "Pilot", mass: float) -> Callable[[State], float]:
    reference = parse_reference(condition.required, QUANTITIES[condition.quantity])
    if reference.name == "leg-speed":
        return lambda state: pilot.route.target_cas + reference.offset
    if condition.quantity == "flap" and reference.name:
        value = pilot.manual.flap(reference.name).position
    elif condition.quantity == "gear" and reference.name:
        value = float(reference.name == "down")
    elif reference.name:
        value = pilot.named_speed(reference.name, mass) + reference.offset
    else:
        value = reference.offset
    return lambda state: value
