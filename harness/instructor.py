"""The instructor's station of the simulator: sets the aircraft up as the mission asks, and makes it fail."""

from collections.abc import Callable, Sequence
from math import isclose
from typing import NamedTuple

from harness.errors import InputError
from harness.log import Event
from harness.manual import PropertySetting
from harness.pilot.checklist import Item, item
from harness.pilot.pilot import Pilot
from harness.plan import Failure
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.state import State


class _Armed(NamedTuple):
    """A failure that has not happened yet."""

    failure: Failure
    when: tuple[Item, ...]
    happen: Callable[[], object]
    detail: str


class Instructor:
    """Watches for the moment of each failure of the mission; `waiting` while there are more to come."""

    def __init__(self, pilot: Pilot, plant: JSBSimPlant, note: Callable[[Event], None]) -> None:
        """`note` is told each failure. Raises InputError for a failure that this aircraft cannot have."""
        self._pilot = pilot
        self._note = note
        mass = plant.state().mass
        self._armed = [
            _Armed(
                failure,
                tuple(item(condition, pilot, mass) for condition in failure.when),
                _order(pilot.manual.failures[failure.name], plant),
                "{0.property} = {0.value:g}".format(pilot.manual.failures[failure.name]),
            )
            for failure in pilot.mission.failures
        ]
        self.waiting = bool(self._armed)

    def act(self, state: State) -> None:
        """Let happen what is due."""
        phase = self._pilot.phase
        for armed in tuple(self._armed):
            if armed.failure.phase in ("", phase) and all(entry.holds(state) for entry in armed.when):
                self._armed.remove(armed)
                self.waiting = bool(self._armed)
                armed.happen()
                reason = "; ".join(f"{entry.achieved(state)}, {entry.wanted(state)}" for entry in armed.when)
                self._note(Event(state.time, "failure", armed.failure.name, phase, reason, armed.detail))


def configure(plant: JSBSimPlant, settings: Sequence[PropertySetting]) -> None:
    """Set the aircraft up. Raises InputError when it does not have what its flight manual says."""
    for setting in settings:
        _order(setting, plant)()


def check_kept(plant: JSBSimPlant, settings: Sequence[PropertySetting]) -> None:
    """Raise InputError when, after flying, the aircraft has another value than it was set to: it made no difference."""
    for setting in settings:
        now = plant.fdm.get_property_value(setting.property)
        if not isclose(now, setting.value, rel_tol=1e-6, abs_tol=1e-9):
            raise InputError(
                f"the property {setting.property} was set to {setting.value:g} and is {now:g}: it is computed",
                file=setting.file,
                line=setting.line,
                remedy="set what it is computed from",
            )


def _order(setting: PropertySetting, plant: JSBSimPlant) -> Callable[[], object]:
    """What carries a setting out, once it is known to be possible."""
    try:
        put = plant.setter(setting.property)
    except InputError as error:
        raise InputError(error.what, file=setting.file, line=setting.line, remedy=error.remedy) from None
    return lambda: put(setting.value)
