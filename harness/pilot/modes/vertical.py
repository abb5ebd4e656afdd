"""VP: pitch attitude (ATT), flight path (PATH), or guidance to a level or down a glide slope (NAV)."""

from math import hypot

from harness.navigation.receivers import NeedleReading
from harness.numerics import approach, clamp
from harness.state import State
from harness.world.atmosphere import GRAVITY

SLOPE = 0.0524078  # tangent of 3 degrees, the glide path of every Ils of the navigation database
AIM = 286.0  # m past the threshold, where that path meets the runway
DIGITS = 4  # of the attitude, rad: a steady flight then has a steady command
SLOWEST = 30.0  # m/s: below it path angles mean nothing


class VerticalMode:
    """Gives the pitch attitude to hold.

    ATT moves the attitude target to a set value. PATH and NAV work through a flight-path angle (climb over airspeed)
    that may bend no faster than a small load-factor increment allows. The attitude for it is the path plus the slowly
    filtered angle between nose and path, which is the angle of attack, and so needs no integrator.
    """

    def __init__(self, gains: dict[str, float]) -> None:
        self.sub_mode = "ATT"
        self.guidance = ""  # of NAV
        self.attitude = 0.0  # wanted by ATT
        self.angle: float | str = 0.0  # wanted by PATH: rad, or "by-speed", "flare"
        self.vertical_speed: float | None = None  # wanted by PATH instead of an angle
        self.pitch = 0.0
        self.path_angle = 0.0  # being flown towards
        self._incidence = 0.0
        self._attitude_rate = gains["pitch-rate"]
        self._path = (gains["path-load-factor-increment"] * GRAVITY, gains["path-gain"])
        self._flare = (gains["flare-load-factor-increment"] * GRAVITY, gains["flare-path-gain"])
        self._incidence_time = gains["incidence-filter"]
        self._level_time = gains["level-time-constant"]
        self._level_speed = gains["level-vertical-speed-limit"]
        self._slope_time = gains["glide-slope-time-constant"]
        self._flare_time = gains["flare-time-constant"]
        self._flare_lead = gains["flare-lead-time"]
        self._touchdown_sink = gains["flare-touchdown-sink"]

    def select(self, sub_mode: str, state: State) -> None:
        """Change the sub-mode, starting from the attitude and path the aircraft has."""
        if sub_mode == "ATT":
            self.pitch = state.pitch
        elif self.sub_mode == "ATT":
            self.path_angle = state.vertical_speed / max(state.tas, SLOWEST)
            self._incidence = state.pitch - self.path_angle
        self.sub_mode = sub_mode

    def path_error(self, state: State) -> float:
        """Climb asked for beyond the present one, rad."""
        if self.sub_mode == "ATT":
            return 0.0
        return self.path_angle - state.vertical_speed / max(state.tas, SLOWEST)

    def update(
        self, state: State, level_error: float, slope: NeedleReading, threshold: float, path_by_speed: float, dt: float
    ) -> float:
        """Return the pitch attitude to hold, rad.

        `level_error`: height of the wanted level above the aircraft; `threshold`: distance to the runway, m.
        """
        if self.sub_mode == "ATT":
            self.pitch = approach(self.pitch, self.attitude, self._attitude_rate * dt)
            return round(self.pitch, DIGITS)
        speed = state.tas if state.tas > SLOWEST else SLOWEST
        bend, gain = self._path
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
            bend, gain = self._flare
            height = max(state.height + self._flare_lead * state.vertical_speed, 0.0)  # soon, when pitch has answered
            wanted = -(height / self._flare_time + self._touchdown_sink) / speed
        else:
            wanted = float(self.angle)
        self.path_angle = path = approach(self.path_angle, wanted, bend / speed * dt)
        climb = state.vertical_speed / speed
        self._incidence += (state.pitch - climb - self._incidence) * dt / (self._incidence_time + dt)
        return round(path + self._incidence + gain * (path - climb), DIGITS)

    def _slope(self, state: State, slope: NeedleReading, threshold: float) -> float:
        """The climb that takes the height error away in the time constant while descending with the slope."""
        error = slope.deviation * max(threshold + AIM, AIM)
        correction = clamp(error / self._slope_time, -3.0, 3.0)
        return -hypot(state.velocity_north, state.velocity_east) * SLOPE - correction
