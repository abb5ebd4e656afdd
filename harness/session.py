"""One flight from its mission's name to its run's folder: reads, checks, flies, concludes, keeps."""

import time
from collections.abc import Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Self

from harness import __version__, resources
from harness.errors import FlightError
from harness.log import Event, FlightLog, Inputs, Reporter, Run, RunFolder, conclude, write_run
from harness.manual import FlightManual, read_manual
from harness.mission.check import check_file
from harness.mission.model import Mission
from harness.navigation.database import load
from harness.state import Commands, State
from harness.vocabulary import OUTCOMES

if TYPE_CHECKING:  # at run time only when flying: it brings JSBSim along
    from harness.flight import Observer


class Pace:
    """Holds a flight back to real time."""

    def __init__(self) -> None:
        self._begin: float | None = None

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:  # noqa: ARG002  an observer
        """Wait until the clock on the wall has caught up with the flight."""
        if self._begin is None:
            self._begin = time.monotonic() - state.time
        ahead = self._begin + state.time - time.monotonic()
        if ahead > 0:
            time.sleep(ahead)

    def note(self, event: Event) -> None:
        """Events take no time."""


class Session:
    """A mission made ready to fly.

    Raises InputError for anything that can be known to be wrong without flying.
    """

    def __init__(self, mission: str | PathLike[str], overrides: Sequence[str] = ()) -> None:
        self.mission = check_file(resources.find_mission(mission), overrides)
        self.manual = read_manual(self.mission.aircraft)

    @classmethod
    def of(cls, mission: Mission, manual: FlightManual) -> Self:
        """A session of a mission that was read and checked before."""
        session = cls.__new__(cls)
        session.mission, session.manual = mission, manual
        return session

    def fly(
        self,
        *,
        out: str | PathLike[str] | None = None,
        rate: int = 120,
        realtime: bool = False,
        progress: "Observer | None" = None,
    ) -> tuple[Run, FlightError | KeyboardInterrupt | None]:
        """Fly, and keep the run in a new folder of `out` if given.

        Returns the run and what stopped it early, if anything did. Raises
        OutputError, before flying if `out` cannot be written.
        """
        if out is None:
            return self._fly(rate, realtime, progress)
        with RunFolder(out, self.mission.name) as folder:
            run, stopped = self._fly(rate, realtime, progress)
            from harness.analysis.plots import draw_all  # after the flight: it takes a while to load

            write_run(run, folder.path)
            try:
                draw_all(run, folder.path)
            except KeyboardInterrupt as error:  # no pictures then, but the flight is kept
                stopped = stopped or error
            return replace(run, folder=folder.keep()), stopped

    def _fly(
        self, rate: int, realtime: bool, progress: "Observer | None"
    ) -> tuple[Run, FlightError | KeyboardInterrupt | None]:
        from harness.flight import fly_mission

        log, inputs = FlightLog(), Inputs()
        observers: list[Observer] = [
            log,
            *([progress] if progress else []),
            *([Pace()] if realtime else []),
        ]
        stopped: FlightError | KeyboardInterrupt | None = None
        outcome = "stopped"
        begin = time.perf_counter()
        try:
            outcome = fly_mission(self.mission, self.manual, rate=rate, observers=observers, inputs=inputs)
        except (FlightError, KeyboardInterrupt) as error:
            stopped = error
        wall_time = time.perf_counter() - begin
        if outcome not in ("stopped", self.mission.expects):
            stopped = _unexpected(outcome, self.mission.expects, log)
        reason = "" if stopped is None else str(stopped) or "interrupted from the keyboard"
        run = conclude(
            log,
            inputs,
            identity=self._identity(rate),
            fixes={leg.name: (leg.fix.latitude, leg.fix.longitude) for leg in self.mission.legs},
            last_waypoint=[leg.name for leg in self.mission.legs if leg.part == "route"][-1],
            mission_text=self.mission.text,
            wall_time=wall_time,
            outcome=outcome,
            reason=reason,
        )
        if outcome == OUTCOMES["RTO"]:
            from harness.analysis.rejected import rejected_take_off

            departure = self.mission.departure
            runway = load().runway(departure.airport, departure.runway)
            run.summary["rejected_take_off"] = rejected_take_off(run, runway)._asdict()
        return run, stopped

    def _identity(self, rate: int) -> dict[str, object]:
        return {
            "mission": self.mission.name,
            "mission_file": Path(self.mission.source_path).name,
            "aircraft": self.mission.aircraft,
            "aircraft_sha256": resources.fingerprint(self.mission.aircraft),
            "harness_version": __version__,
            "frame_rate_hz": rate,
            "seed": None,
        }


def _unexpected(outcome: str, expected: str, log: FlightLog) -> FlightError:
    """The error for a flight that came to an end, but not to the one that its mission expects."""
    phases = [event for event in log.events if event.kind == "phase"]
    return FlightError(
        f"the flight ended with: {outcome}",
        time=phases[-1].time,
        phase=phases[-1].name,
        waiting="the end of the mission",
        required=expected,
        achieved=f"{outcome}, because of: {phases[-2].reason}",
        knob=f'write expects="{outcome}" into <mission> where this is what the flight is for',
    )
