"""VP: pitch attitude (ATT), flight path (PATH), or guidance to a level or down a glide slope (NAV)."""

from collections.abc import Mapping
from math import hypot, tan

from harness.navigation.database import Ils
from harness.navigation.receivers import NeedleReading
from harness.numerics import approach, clamp
from harness.state import ALONG_PATH, FLARING, TO_ATTITUDE, State
from harness.world.atmosphere import GRAVITY

SLOPE = tan(Ils.GLIDE_ANGLE)
AIM = Ils.CROSSING_HEIGHT / SLOPE  # m past the threshold, where the path meets a level runway
SLOWEST = 30.0  # m/s: below it path angles mean nothing


class VerticalMode:
    """Gives the attitude to go to, or the flight path to follow.

    ATT moves the attitude target to a set value. PATH and NAV work through a flight-path angle (climb over airspeed)
    that may bend no faster than a small load-factor increment allows. What makes pitch attitudes of both is
    systems/path-hold.xml.
    """

    def __init__(self, gains: Mapping[str, float]) -> None:
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.attitude = 0.0  # wanted by ATT
        self.angle: float | str = 0.0  # wanted by PATH: rad, or "by-speed", "flare"
        self.vertical_speed: float | None = None  # wanted by PATH instead of an angle
        self.wanted = 0.0  # path, rad
        self.path_angle = 0.0  # being flown towards
        self._increment = gains["path-load-factor-increment"] * GRAVITY
        self._flare_increment = gains["flare-load-factor-increment"] * GRAVITY
        self._level_time = gains["level-time-constant"]
        self._level_speed = gains["level-vertical-speed-limit"]
        self._slope_time = gains["glide-slope-time-constant"]
        self._flare_time = gains["flare-time-constant"]
        self._flare_lead = gains["flare-lead-time"]
        self._touchdown_sink = gains["flare-touchdown-sink"]

    def select(self, sub_mode: str, state: State) -> None:
        """Change the sub-mode, starting from the path the aircraft has."""
        if self.sub_mode == "ATT":
            self.path_angle = state.vertical_speed / max(state.tas, SLOWEST)
        self.sub_mode = sub_mode

    @property
    def law(self) -> float:
        """Which law makes the pitch attitude, as `Commands.vertical`."""
        if self.sub_mode == "ATT":
            return TO_ATTITUDE
        return FLARING if self._flares else ALONG_PATH

    @property
    def _flares(self) -> bool:
        return self.sub_mode == "PATH" and self.vertical_speed is None and self.angle == "flare"

    def follow(self, state: State, dt: float) -> None:
        """Let the path being flown towards bend for `dt` seconds, as systems/path-hold.xml does."""
        increment = self._flare_increment if self._flares else self._increment
        self.path_angle = approach(self.path_angle, self.wanted, increment / max(state.tas, SLOWEST) * dt)

    def aim(
        self, state: State, level_error: float, slope: NeedleReading, threshold: float, path_by_speed: float
    ) -> None:
        """Renew the path that is wanted.

        `level_error`: height of the wanted level above the aircraft; `threshold`: distance to the runway, m.
        """
        speed = max(state.tas, SLOWEST)
        if self.sub_mode == "NAV":
            if self.guidance == "level":
                wanted = clamp(level_error / self._level_time, -self._level_speed, self._level_speed) / speed
            else:
                wanted = self._slope(state, slope, threshold) / speed
        elif self.vertical_speed is not None:
            wanted = self.vertical_speed / speed
        elif self.angle == "by-speed":
            wanted = path_by_speed
        elif self.angle == "flare":
            height = max(
                state.height + self._flare_lead * state.vertical_speed, 0.0
            )  # soon, when pitch has answered
            wanted = -(height / self._flare_time + self._touchdown_sink) / speed
        else:
            wanted = float(self.angle)
        self.wanted = wanted

    def _slope(self, state: State, slope: NeedleReading, threshold: float) -> float:
        """The climb that takes the height error away in the time constant while descending with the slope."""
        error = slope.deviation * max(threshold + AIM, AIM)
        correction = clamp(error / self._slope_time, -3.0, 3.0)
        return -hypot(state.velocity_north, state.velocity_east) * SLOPE - correction
