"""Watches a flight and remembers it. Made to cost next to nothing between two records."""

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from harness.log.run import Event, History
from harness.state import Commands, State

Floats = NDArray[np.float64]

BOUNCE = 5.0
"""Wheels that touch again this soon after leaving the ground, s, have bounced: no other touchdown."""


class Reporter(Protocol):
    """What the log asks the pilot: the phase, one sub-mode for each super-mode, and what is aimed at, in SI.

    `modes` and `targets` have the same keys throughout a flight; a target not aimed at is NaN.
    """

    @property
    def phase(self) -> str:
        """The phase, as in harness.vocabulary."""
        ...

    @property
    def modes(self) -> Mapping[str, str]:
        """The sub-mode of each super-mode."""
        ...

    @property
    def targets(self) -> Mapping[str, float]:
        """What is aimed at."""
        ...


class Moment(NamedTuple):
    """The aircraft at an instant that counts, and the fuel used until then (kg)."""

    state: State
    fuel_used: float


class FlightLog:
    """Records every `every`-th pilot step, and every event with the aircraft's state in its own step.

    The fuel used is the integral of the fuel flow over the records, to be held against the scales.
    """

    def __init__(self, every: int = 6) -> None:
        self.events: list[Event] = []
        self.passages: list[tuple[Event, Moment]] = []
        self.moments: dict[str, Moment] = {}
        self._every = every
        self._rows: list[tuple[State, Commands, str, tuple[str, ...], tuple[float, ...], float]] = []
        self._mode_names: tuple[str, ...] = ()
        self._target_names: tuple[str, ...] = ()
        self._countdown = 1
        self._time = 0.0
        self._fuel_flow = 0.0
        self._fuel_used = 0.0
        self._brake: float | None = None
        self._on_ground = 1.0
        self._left_ground = 0.0
        self._passed: list[Event] = []
        self._last: State | None = None
        self._commands: Commands | None = None
        self._pilot: Reporter | None = None

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        """Called once a pilot step."""
        self._countdown -= 1
        self._last = state
        self._commands = commands
        if (
            self._countdown
            and commands.brake == self._brake
            and state.main_on_ground == self._on_ground
            and not self._passed
        ):
            return
        self._pilot = pilot
        self._burn(state)
        if state.main_on_ground != self._on_ground:
            self._wheels(state)
        if commands.brake != self._brake:
            self._brakes(state, commands, pilot)
        if self._passed:
            self.passages += [(event, Moment(state, self._fuel_used)) for event in self._passed]
            self._passed.clear()
        if self._countdown <= 0:
            self._countdown = self._every
            self._record(state, commands, pilot)

    def note(self, event: Event) -> None:
        """Called when something happens, before the step it happens in is seen."""
        self.events.append(event)
        if event.kind == "waypoint":
            self._passed.append(event)
        elif event.kind == "phase":
            self._brake = None  # brakes may be off already when the take-off run begins: look again

    def history(self) -> History:
        """The columns recorded so far, ending with the last step seen."""
        if self._last and self._commands and self._pilot and self._rows[-1][0] is not self._last:
            self._burn(self._last)
            self._record(self._last, self._commands, self._pilot)
        if not self._rows:
            return {"time": np.empty(0)}
        states, commands, phases, modes, targets, fuel_used = zip(*self._rows, strict=True)
        numbers = dict(zip(State._fields, np.array(states).T.copy(), strict=True))
        numbers["fuel_used"] = np.array(fuel_used)
        numbers["distance"] = _integral(
            numbers["time"], np.hypot(numbers["velocity_north"], numbers["velocity_east"])
        )
        for prefix, names, rows in (
            ("command_", Commands._fields, commands),
            ("target_", self._target_names, targets),
        ):
            columns = np.array(rows, dtype=float).reshape(len(rows), len(names)).T
            numbers.update(
                (prefix + name, column.copy()) for name, column in zip(names, columns, strict=True)
            )
        words = {"phase": phases} | {
            f"mode_{name}": column
            for name, column in zip(self._mode_names, zip(*modes, strict=True), strict=True)
        }
        return numbers | {name: np.array(column) for name, column in words.items()}

    def _record(self, state: State, commands: Commands, pilot: Reporter) -> None:
        modes, targets = pilot.modes, pilot.targets
        if not self._rows:
            self._mode_names, self._target_names = tuple(modes), tuple(targets)
        self._rows.append(
            (state, commands, pilot.phase, tuple(modes.values()), tuple(targets.values()), self._fuel_used)
        )

    def _burn(self, state: State) -> None:
        self._fuel_used += 0.5 * (state.fuel_flow + self._fuel_flow) * (state.time - self._time)
        self._time = state.time
        self._fuel_flow = state.fuel_flow

    def _wheels(self, state: State) -> None:
        self._on_ground = state.main_on_ground
        if not state.main_on_ground:
            self._left_ground = state.time
            if "touchdown" not in self.moments:
                self.moments["lift-off"] = Moment(state, self._fuel_used)
        elif state.time - self._left_ground > BOUNCE:
            self.moments["touchdown"] = Moment(state, self._fuel_used)

    def _brakes(self, state: State, commands: Commands, pilot: Reporter) -> None:
        self._brake = commands.brake
        if commands.brake == 0.0:
            moment = Moment(state, self._fuel_used)
            self.moments.setdefault("off blocks", moment)
            if pilot.phase.startswith("T/O"):
                self.moments.setdefault("brake release", moment)


def _integral(time: Floats, rate: Floats) -> Floats:
    return np.concatenate(([0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))))
