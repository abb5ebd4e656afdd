"""VP: pitch attitude (ATT), flight path (PATH), or guidance to a level or down a glide slope (NAV)."""

from collections.abc import Mapping
from math import hypot, tan

from harness.navigation.database import Ils
from harness.navigation.receivers import NeedleReading
from harness.numerics import ROUNDER, approach, clamp, quantised
from harness.state import State
from harness.world.atmosphere import GRAVITY

SLOPE = tan(Ils.GLIDE_ANGLE)
AIM = Ils.CROSSING_HEIGHT / SLOPE  # m past the threshold, where the path meets a level runway
SLOWEST = 30.0  # m/s: below it path angles mean nothing


class VerticalMode:
    """Gives the pitch attitude to hold.

    ATT moves the attitude target to a set value. PATH and NAV work through a flight-path angle (climb over airspeed)
    that may bend no faster than a small load-factor increment allows. The attitude for it is the path plus the slowly
    filtered angle between nose and path, which is the angle of attack, and so needs no integrator.
    """

    def __init__(self, gains: Mapping[str, float], step: float) -> None:
        """`step` is the time between two calls of `fly`, s."""
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.attitude = 0.0  # wanted by ATT
        self.angle: float | str = 0.0  # wanted by PATH: rad, or "by-speed", "flare"
        self.vertical_speed: float | None = None  # wanted by PATH instead of an angle
        self.path_angle = 0.0  # being flown towards
        self._pitch = 0.0
        self._law = (
            0.0,
            0.0,
            0.0,
            SLOWEST,
            0.0,
        )  # path wanted, its bend a step, gain, speed, share of incidence
        self._incidence = 0.0
        self._step = step
        self._attitude_step = gains["pitch-rate"] * step
        self._path = (gains["path-load-factor-increment"] * GRAVITY, gains["path-gain"])
        self._flare = (gains["flare-load-factor-increment"] * GRAVITY, gains["flare-path-gain"])
        self._incidence_share = step / (gains["incidence-filter"] + step)
        self._level_time = gains["level-time-constant"]
        self._level_speed = gains["level-vertical-speed-limit"]
        self._slope_time = gains["glide-slope-time-constant"]
        self._flare_time = gains["flare-time-constant"]
        self._flare_lead = gains["flare-lead-time"]
        self._touchdown_sink = gains["flare-touchdown-sink"]

    def select(self, sub_mode: str, state: State) -> None:
        """Change the sub-mode, starting from the attitude and path the aircraft has."""
        if sub_mode == "ATT":
            self._pitch = state.pitch
        elif self.sub_mode == "ATT":
            self.path_angle = state.vertical_speed / max(state.tas, SLOWEST)
            self._incidence = state.pitch - self.path_angle
        self.sub_mode = sub_mode

    def aim(
        self, state: State, level_error: float, slope: NeedleReading, threshold: float, path_by_speed: float
    ) -> None:
        """Renew the path that is wanted.

        `level_error`: height of the wanted level above the aircraft; `threshold`: distance to the runway, m.
        """
        speed = max(state.tas, SLOWEST)
        increment, gain = self._path
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
            increment, gain = self._flare
            height = max(
                state.height + self._flare_lead * state.vertical_speed, 0.0
            )  # soon, when pitch has answered
            wanted = -(height / self._flare_time + self._touchdown_sink) / speed
        else:
            wanted = float(self.angle)
        self._law = (wanted, increment / speed * self._step, gain, speed, self._incidence_share)

    def fly(self, vertical_speed: float, pitch: float) -> float:
        """Return the pitch attitude to hold now, rad. Called at every pilot step, and so written to cost little."""
        if self.sub_mode == "ATT":
            self._pitch = approach(self._pitch, self.attitude, self._attitude_step)
            return quantised(self._pitch)
        wanted, bend, gain, speed, share = self._law
        path = self.path_angle
        missing = wanted - path
        path += bend if missing > bend else -bend if missing < -bend else missing  # noqa: FURB136  twice as fast
        self.path_angle = path
        climb = vertical_speed / speed
        incidence = self._incidence
        incidence += (pitch - climb - incidence) * share
        self._incidence = incidence
        return path + incidence + gain * (path - climb) + ROUNDER - ROUNDER

    def _slope(self, state: State, slope: NeedleReading, threshold: float) -> float:
        """The climb that takes the height error away in the time constant while descending with the slope."""
        error = slope.deviation * max(threshold + AIM, AIM)
        correction = clamp(error / self._slope_time, -3.0, 3.0)
        return -hypot(state.velocity_north, state.velocity_east) * SLOPE - correction
