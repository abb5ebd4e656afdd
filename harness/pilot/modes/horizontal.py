"""HP: bank (ATT), a track (PATH), or guidance along route, localizer or runway (NAV)."""

from collections.abc import Mapping
from math import atan, atan2, hypot

from harness.numerics import clamp, wrap
from harness.pilot.route import Guidance
from harness.state import State
from harness.world.atmosphere import GRAVITY


class HorizontalMode:
    """Gives the bank angle to hold, rad."""

    def __init__(self, gains: Mapping[str, float]) -> None:
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.bank = 0.0  # wanted by ATT
        self.track = 0.0  # wanted by PATH, true
        self._most_bank = gains["bank-limit"]
        self._turn_time = gains["turn-time-constant"]
        self._laws = {  # time to close a cross-track error, time to close a track error, most bank
            "route": (gains["cross-track-time-constant"], self._turn_time, self._most_bank),
            "localizer": (gains["localizer-time-constant"], self._turn_time, gains["approach-bank-limit"]),
            "align": (
                gains["align-time-constant"],
                gains["align-turn-time-constant"],
                gains["align-bank-limit"],
            ),
        }
        self._steepest_intercept = gains["intercept-angle-limit"]

    def update(self, state: State, guidance: Guidance) -> float:
        """Return the bank angle to hold, rad."""
        if self.sub_mode == "ATT":
            return self.bank
        speed = hypot(state.velocity_north, state.velocity_east)
        if self.sub_mode == "PATH":
            return _bank(wrap(self.track - _track(state, speed)), speed, self._turn_time, self._most_bank)
        if self.guidance in ("runway", "taxi"):
            return 0.0
        if guidance.homing:
            return _bank(guidance.bearing_error, speed, self._turn_time, self._most_bank)
        line_time, turn_time, limit = self._laws[self.guidance]
        reach = max(speed, 30.0) * line_time
        intercept = clamp(
            atan(guidance.cross_track / reach), -self._steepest_intercept, self._steepest_intercept
        )
        return _bank(wrap(guidance.course - intercept - _track(state, speed)), speed, turn_time, limit)


def _bank(error: float, speed: float, turn_time: float, limit: float) -> float:
    """The bank that turns a track error away at a rate of error / turn time."""
    return clamp(atan(speed / GRAVITY * error / turn_time), -limit, limit)


def _track(state: State, speed: float) -> float:
    if speed < 1.0:
        return state.heading
    return atan2(state.velocity_east, state.velocity_north)
