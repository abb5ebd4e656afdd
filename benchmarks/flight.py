"""What the pilot costs: a mission's processor time over that of bare JSBSim stepping the same frames.

`python benchmarks/flight.py [MISSION]` prints one JSON line. The mission is flown as `harness fly` flies it: the pilot
with his checklists at 2 Hz aloft (1 Hz in steady level flight) and at 24 Hz at the runway, and the log. Every ten
seconds of flight a second JSBSim of the same aircraft is given the commands of the end of each of these seconds, and
steps the frames of that second in a bare loop. So both sides meet the same machine load, in the same phase of flight,
and no Python runs between the frames of the bare side. The pilot's laws that are JSBSim systems (path-hold, in the
direct law inner-modes) run on both sides.
"""

import json
import sys
from time import thread_time

import environment  # noqa: F401  which is to come first

from harness.errors import HarnessError
from harness.flight import PILOT_RATE, fly_mission, prepare
from harness.log import Event, FlightLog, Reporter
from harness.session import Session
from harness.state import MEDIUM_PERIOD, SLOW_PERIOD, Commands, State

FRAME_RATE = 120
SAME_MOMENT = 1e-6  # s
SECONDS = 10  # of flight before its frames are repeated bare: long enough for each side to warm its caches


class Interleaved:
    """Observes a flight, and after every segment repeats its frames bare."""

    def __init__(self, session: Session) -> None:
        _, self._plant = prepare(session.mission, session.manual, rate=FRAME_RATE)
        self._plant._frames = 0  # noqa: SLF001  `advance` then writes the commands and leaves the frames to us
        self._due = 1.0
        self._commands: list[Commands] = []
        self.flight_time = 0.0
        self.bare_time = 0.0
        self.frames = 0
        self._mark = thread_time()

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:  # noqa: ARG002  an observer
        """Keep the commands of every second; repeat the frames when there are enough."""
        if state.time >= self._due - SAME_MOMENT:
            self._due += 1.0
            self._commands.append(commands)
            if len(self._commands) == SECONDS:
                self.close()

    def note(self, event: Event) -> None:
        """Events cost nothing here."""

    def close(self) -> None:
        """Account for the seconds flown and step as many frames bare."""
        self.flight_time += thread_time() - self._mark
        step = self._plant.fdm.run
        for commands in self._commands:
            self._plant.advance(commands)
            begin = thread_time()
            for _ in range(FRAME_RATE):
                step()
            self.bare_time += thread_time() - begin
        self.frames += len(self._commands) * FRAME_RATE
        self._commands.clear()
        self._mark = thread_time()


def main(mission: str) -> None:
    """Fly, and print the result."""
    try:
        session = Session(mission)
        interleaved = Interleaved(session)
        fly_mission(session.mission, session.manual, rate=FRAME_RATE, observers=[FlightLog(), interleaved])
    except HarnessError as error:
        sys.exit(f"benchmarks/flight.py: {error}")
    result = {
        "mission": mission,
        "pilot_hz": PILOT_RATE,
        "outer_loops_hz": PILOT_RATE
        / MEDIUM_PERIOD,  # aloft; at the pilot's rate on and just above the runway
        "outer_loops_hz_steady": PILOT_RATE / SLOW_PERIOD,
        "ratio": interleaved.flight_time / interleaved.bare_time,
        "real_time_factor": interleaved.frames / FRAME_RATE / interleaved.flight_time,
        "frame_us": interleaved.bare_time / interleaved.frames * 1e6,
        "frames": interleaved.frames,
    }
    print(
        json.dumps(
            {key: round(value, 4) if isinstance(value, float) else value for key, value in result.items()}
        )
    )


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "cologne-munich")
