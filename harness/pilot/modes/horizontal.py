"""HP: bank (ATT), a track (PATH), or guidance along route, localizer or runway (NAV)."""

from math import atan, atan2, hypot

from harness.numerics import clamp, wrap
from harness.pilot.route import Guidance
from harness.state import State
from harness.world.atmosphere import GRAVITY


class HorizontalMode:
    """Gives the bank angle to hold, rad."""

    def __init__(self, gains: dict[str, float]) -> None:
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.bank = 0.0  # wanted by ATT
        self.track = 0.0  # wanted by PATH, true
        self._most_bank = gains["bank-limit"]
        self._approach_bank = gains["approach-bank-limit"]
        self._align_bank = gains["align-bank-limit"]
        self._turn_time = gains["turn-time-constant"]
        self._line_time = gains["cross-track-time-constant"]
        self._localizer_time = gains["localizer-time-constant"]
        self._steepest_intercept = gains["intercept-angle-limit"]

    def select(self, sub_mode: str, state: State) -> None:
        """Change the sub-mode. There is nothing to carry over: the aircraft limits the roll rate."""
        self.sub_mode = sub_mode

    def update(self, state: State, guidance: Guidance) -> float:
        """Return the bank angle to hold, rad."""
        if self.sub_mode == "ATT":
            return self.bank
        speed = hypot(state.velocity_north, state.velocity_east)
        if self.sub_mode == "PATH":
            return self._bank(wrap(self.track - _track(state, speed)), speed, self._most_bank)
        if self.guidance in ("runway", "taxi"):
            return 0.0
        if guidance.homing:
            return self._bank(guidance.bearing_error, speed, self._most_bank)
        near = self.guidance != "route"
        limit = (
            self._most_bank
            if not near
            else self._align_bank
            if self.guidance == "align"
            else self._approach_bank
        )
        reach = max(speed, 30.0) * (self._localizer_time if near else self._line_time)
        intercept = clamp(
            atan(guidance.cross_track / reach), -self._steepest_intercept, self._steepest_intercept
        )
        return self._bank(wrap(guidance.course - intercept - _track(state, speed)), speed, limit)

    def _bank(self, error: float, speed: float, limit: float) -> float:
        """The bank that turns a track error away at a rate of error / turn time."""
        return clamp(atan(speed / GRAVITY * error / self._turn_time), -limit, limit)


def _track(state: State, speed: float) -> float:
    if speed < 1.0:
        return state.heading
    return atan2(state.velocity_east, state.velocity_north)
