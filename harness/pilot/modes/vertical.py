"""VP: pitch attitude (ATT), flight path (PATH), or guidance to a level or down a glide slope (NAV)."""

from math import asin, atan

from harness.navigation.receivers import NeedleReading
from harness.numerics import LowPass, approach, clamp
from harness.state import State
from harness.world.atmosphere import GRAVITY


class VerticalMode:
    """Gives the pitch attitude to hold.

    ATT moves the attitude target to a set value. PATH and NAV work through a flight-path angle that may bend no
    faster than a small load-factor increment allows; the attitude for it is the path plus the slowly filtered
    angle between nose and path, which is the angle of attack (and needs no integrator).
    """

    def __init__(self, gains: dict[str, float]) -> None:
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.attitude = 0.0  # wanted by ATT
        self.angle: float | str = 0.0  # wanted by PATH: rad, or "by-speed", "flare"
        self.vertical_speed: float | None = None  # wanted by PATH instead of an angle
        self.pitch = 0.0
        self.path_angle = 0.0  # rad, the path being flown towards
        self._attitude_rate = gains["pitch-rate"]
        self._path_gain = gains["path-gain"]
        self._load_increment = gains["path-load-factor-increment"]
        self._flare_gain = gains["flare-path-gain"]
        self._flare_increment = gains["flare-load-factor-increment"]
        self._incidence = LowPass(gains["incidence-filter"])
        self._level_time = gains["level-time-constant"]
        self._level_speed = gains["level-vertical-speed-limit"]
        self._slope_time = gains["glide-slope-time-constant"]
        self._flare_time = gains["flare-time-constant"]
        self._touchdown_sink = gains["flare-touchdown-sink"]

    def select(self, sub_mode: str, state: State) -> None:
        """Change the sub-mode, starting from the attitude and path the aircraft has."""
        if sub_mode == "ATT":
            self.pitch = state.pitch
        elif self.sub_mode == "ATT":
            self.path_angle = _climb_angle(state)
            self._incidence.reset(state.pitch - self.path_angle)
        self.sub_mode = sub_mode

    def path_error(self, state: State) -> float:
        """Climb asked for beyond the present one, rad."""
        return self.path_angle - _climb_angle(state) if self.sub_mode != "ATT" else 0.0

    def update(
        self,
        state: State,
        level_error: float,
        slope: NeedleReading,
        threshold: float,
        path_by_speed: float,
        dt: float,
    ) -> float:
        """Return the pitch attitude to hold, rad.

        `level_error`: height of the wanted level above the aircraft; `threshold`: distance to the runway, m.
        """
        if self.sub_mode == "ATT":
            self.pitch = approach(self.pitch, self.attitude, self._attitude_rate * dt)
            return self.pitch
        speed = max(state.tas, 30.0)
        increment, gain = self._load_increment, self._path_gain
        if self.sub_mode == "NAV":
            if self.guidance == "level":
                wanted = self._climb_to_angle(
                    clamp(level_error / self._level_time, -self._level_speed, self._level_speed), speed
                )
            else:
                wanted = self._slope_angle(state, slope, threshold, speed)
        elif self.vertical_speed is not None:
            wanted = self._climb_to_angle(self.vertical_speed, speed)
        elif self.angle == "by-speed":
            wanted = path_by_speed
        elif self.angle == "flare":
            increment, gain = self._flare_increment, self._flare_gain
            sink = max(state.height, 0.0) / self._flare_time + self._touchdown_sink
            wanted = self._climb_to_angle(-sink, speed)
        else:
            wanted = float(self.angle)
        bend = increment * GRAVITY / speed
        self.path_angle = approach(self.path_angle, wanted, bend * dt)
        climb = _climb_angle(state)
        incidence = self._incidence.update(state.pitch - climb, dt)
        self.pitch = self.path_angle + incidence + gain * (self.path_angle - climb)
        return self.pitch

    def _slope_angle(self, state: State, slope: NeedleReading, threshold: float, speed: float) -> float:
        """The path that closes the height error in the time constant while descending with the slope."""
        ground_speed = (state.velocity_north**2 + state.velocity_east**2) ** 0.5
        error = slope.deviation * max(threshold + 300.0, 300.0)
        correction = clamp(error / self._slope_time, -3.0, 3.0)
        return self._climb_to_angle(-ground_speed * _SLOPE_TANGENT - correction, speed)

    @staticmethod
    def _climb_to_angle(vertical_speed: float, speed: float) -> float:
        return asin(clamp(vertical_speed / speed, -0.5, 0.5))


_SLOPE_TANGENT = 0.0524078  # of 3 degrees, the glide path of every Ils in the database


def _climb_angle(state: State) -> float:
    return atan(state.vertical_speed / max((state.velocity_north**2 + state.velocity_east**2) ** 0.5, 10.0))
