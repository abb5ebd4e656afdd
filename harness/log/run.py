"""What is left of a flight: its time history, its events, its waypoint passages and its summary."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from harness.log.inputs import Inputs

History = dict[str, NDArray[Any]]

_STATE_UNITS = {
    "s": "time",
    "rad": "latitude longitude roll pitch heading alpha beta greatest_bank greatest_alpha",
    "rad/s": "roll_rate pitch_rate yaw_rate propeller_speed",
    "m": "altitude pressure_altitude height centre_of_gravity",
    "m/s": "cas tas velocity_north velocity_east vertical_speed",
    "N": "thrust",
    "kg": "mass fuel fuel_used fuel_leaked dropped",
    "kg/s": "fuel_flow",
    "Pa": "pressure",
    "K": "temperature",
    "1": "mach load_factor main_on_ground nose_on_ground flap gear stall_warning engines_failed"
    " greatest_load_factor least_load_factor stall_warned",
}
_OTHER_UNITS = {
    "m": "distance target_level target_level_error target_cross_track target_distance_to_go",
    "m/s": "target_cas",
    "rad": "command_path command_pitch command_bank",
}
UNITS = {
    name: unit
    for table in (_STATE_UNITS, _OTHER_UNITS)
    for unit, names in table.items()
    for name in names.split()
}
"""The SI unit of every numeric column; a command or target not listed is a plain ratio."""


class Event(NamedTuple):
    """Something that happened: at `time` (s), in `phase`, and why.

    `kind` is phase, checklist, procedure, mode, waypoint, failure, limit, warning, emergency or navigation; `name` says
    which one, `detail` what a step did.
    """

    time: float
    kind: str
    name: str
    phase: str
    reason: str = ""
    detail: str = ""


class Passage(NamedTuple):
    """A waypoint passed. SI and radians; `distance` and `fuel_used` since brake release.

    `closest` is the smallest distance to the fix between the passages before and after it, NaN if the fix is
    not known.
    """

    name: str
    time: float
    latitude: float
    longitude: float
    altitude: float
    pressure_altitude: float
    cas: float
    tas: float
    mach: float
    distance: float
    fuel_used: float
    mass: float
    closest: float


@dataclass(frozen=True)
class Run:
    """A flight that was flown, whole or not.

    `history` maps a column to an array, all of one length, in the SI unit that `units` gives; `phase` and the
    `mode_*` columns hold words. `summary` is described in docs/summary-schema.md. `inputs` is
    what was written into the simulator; `read_run` leaves it in its file. `folder` is where the run
    is kept, if it is.
    """

    history: History
    events: tuple[Event, ...]
    passages: tuple[Passage, ...]
    summary: dict[str, Any]
    mission_text: str
    inputs: Inputs | None = None
    folder: Path | None = None

    @property
    def units(self) -> dict[str, str]:
        """The unit of each numeric column of the history."""
        return {
            name: UNITS.get(name, "1") for name, column in self.history.items() if column.dtype.kind == "f"
        }

    def at(self, column: str, time: float) -> float:
        """A numeric column of the history at `time` (s), interpolated."""
        return float(np.interp(time, self.history["time"], self.history[column]))
