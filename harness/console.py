"""What a person sees while a flight runs: one live line on a terminal, and a plain line for what happens."""

import shutil
import time
from typing import TextIO

from harness.log import Event, Reporter
from harness.state import Commands, State
from harness.units import FT, KT, NM

REFRESH = 0.2  # s, of the clock on the wall
STANDING = frozenset({"CTRL", "INN"})  # super-modes that hardly change and would fill the line
REPORTED = frozenset({"phase", "waypoint"})


class Console:
    """Watches a flight and shows it on `stream`."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream
        self._live = stream.isatty()
        self._begin = time.monotonic()
        self._shown = 0.0

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:  # noqa: ARG002  an observer
        """Refresh the live line now and then."""
        if not self._live:
            return
        now = time.monotonic()
        if now - self._shown >= REFRESH:
            self._shown = now
            width = shutil.get_terminal_size().columns - 1
            self._stream.write(f"\r{live_line(state, pilot, now - self._begin):<{width}.{width}}")
            self._stream.flush()

    def note(self, event: Event) -> None:
        """Write a line for what matters to someone who waits."""
        if event.kind in REPORTED:
            reason = f"  ({event.reason})" if event.reason else ""
            self._clear()
            self._stream.write(f"{clock(event.time)}  {event.kind:<8}  {event.name}{reason}\n")
            self._stream.flush()

    def close(self) -> None:
        """Leave the cursor on a fresh line."""
        self._clear()
        self._stream.flush()

    def _clear(self) -> None:
        if self._live:
            self._stream.write("\r" + " " * (shutil.get_terminal_size().columns - 1) + "\r")


def live_line(state: State, pilot: Reporter, elapsed: float) -> str:
    """Phase, altitude, speed, distance to go, times real time, modes and what is waited for.

    `elapsed` is in seconds on the wall.
    """
    modes = " | ".join(mode for name, mode in pilot.modes.items() if name not in STANDING)
    to_go = pilot.targets.get("distance_to_go", 0.0) / NM
    faster = state.time / elapsed if elapsed > 0 else 0.0
    return (  # the least urgent last: on a narrow terminal it is cut off
        f"{clock(state.time)} {pilot.phase:<16}{state.altitude / FT:6.0f} ft{state.cas / KT:4.0f} kt"
        f"{to_go:6.1f} NM to go{faster:5.0f} x  {modes}  waits for {pilot.waiting}"
    )


def clock(seconds: float) -> str:
    """Simulated time as h:mm:ss."""
    minutes, second = divmod(int(seconds), 60)
    return f"{minutes // 60}:{minutes % 60:02d}:{second:02d}"
