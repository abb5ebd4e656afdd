"""Watches a flight and remembers it. Made to cost next to nothing between two records."""

from collections.abc import Mapping
from copy import copy
from math import floor
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from harness.log.run import Event, History
from harness.state import FIELDS, Commands, State, close_to_ground, values

Floats = NDArray[np.float64]

LOW = 300.0  # m
BOUNCE = 5.0
SAME_MOMENT = 1e-6  # of an interval
RELEASED = 0.01  # brakes less than this hold nothing
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

    @property
    def waiting(self) -> str:
        """The open checklist item that the next phase waits for."""
        ...


class FlightLog:
    """Records the flight at 1 Hz, at 2 Hz near the ground, at 12 Hz on the runway and just above it; and every event.

    A record keeps State as the pilot saw it.
    """

    def __init__(self) -> None:
        self.events: list[Event] = []
        self.passages: list[tuple[Event, State]] = []
        self.moments: dict[str, State] = {}
        self._rows: list[tuple[tuple[float, ...], Commands, str, tuple[str, ...], tuple[float, ...]]] = []
        self._mode_names: tuple[str, ...] = ()
        self._target_names: tuple[str, ...] = ()
        self._due = 0.0  # time of the next record, s
        self._aloft = False
        self._brake: float | None = None
        self._on_ground = 1.0
        self._left_ground = 0.0
        self._passed: list[Event] = []
        self._last: State | None = None
        self._commands: Commands | None = None
        self._pilot: Reporter | None = None

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        """Called at each pilot step at which the pilot acts."""
        self._last = state
        self._commands = commands
        due = state.time >= self._due
        if self._aloft and not due:
            return
        self._pilot = pilot
        if state.main_on_ground != self._on_ground:
            self._wheels(state)
        if commands.brake != self._brake:
            self._brakes(state, commands, pilot)
        if self._passed:
            self._aloft = state.height > LOW
            self.passages += [(event, copy(state)) for event in self._passed]
            self._passed.clear()
        if due:
            interval = _interval(state)
            self._due = (floor(state.time / interval + SAME_MOMENT) + 1 - SAME_MOMENT) * interval
            self._aloft = state.height > LOW  # until the next record neither wheels nor brakes can matter
            self._record(state, commands, pilot)

    def note(self, event: Event) -> None:
        """Called when something happens, before the step it happens in is seen."""
        self.events.append(event)
        if event.kind == "waypoint":
            self._passed.append(event)
            self._aloft = False  # look at the step it happens in
        elif event.kind == "phase":
            self._brake = None  # brakes may be off already when the take-off run begins: look again

    def history(self) -> History:
        """The columns recorded so far, ending with the aircraft as it is now."""
        last = self._last
        if last and self._commands and self._pilot and self._rows[-1][0][0] != last.time:
            self._record(last, self._commands, self._pilot)
        if not self._rows:
            return {"time": np.empty(0)}
        states, commands, phases, modes, targets = zip(*self._rows, strict=True)
        numbers = dict(zip(FIELDS, np.array(states).T.copy(), strict=True))
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
            (values(state), commands, pilot.phase, tuple(modes.values()), tuple(targets.values()))
        )

    def _wheels(self, state: State) -> None:
        self._on_ground = state.main_on_ground
        if not state.main_on_ground:
            self._left_ground = state.time
            if "touchdown" not in self.moments:
                self.moments["lift-off"] = copy(state)
        elif state.time - self._left_ground > BOUNCE:
            self.moments["touchdown"] = copy(state)

    def _brakes(self, state: State, commands: Commands, pilot: Reporter) -> None:
        self._brake = commands.brake
        if commands.brake < RELEASED:
            self.moments.setdefault("off blocks", copy(state))
            if pilot.phase.startswith("T/O"):
                self.moments.setdefault("brake release", copy(state))


def _interval(state: State) -> float:
    """Seconds from record to record, on multiples: no more often than most of State is renewed."""
    if close_to_ground(state.height, state.cas):
        return 1 / 12
    return 0.5 if state.height < LOW else 1.0


def _integral(time: Floats, rate: Floats) -> Floats:
    return np.concatenate(([0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))))
