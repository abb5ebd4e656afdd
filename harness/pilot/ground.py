"""Steering and speed on the ground: along taxiways, and on the runway's centreline (Fig. 11, ground steering)."""

from collections.abc import Mapping, Sequence
from math import atan, atan2, cos, hypot, inf, sin, sqrt

from harness.errors import OverrunError
from harness.navigation.database import Runway
from harness.numerics import clamp, wrap
from harness.state import State
from harness.units import parse
from harness.world.local import LocalFrame, Point, filleted

STOP_DECELERATION = 0.5  # m/s2, gentle; the taxi speed falls along this towards a turn or the end of the path
LATERAL_ACCELERATION = 0.6  # m/s2 in a turn: what taxiing crews accept
OVERRUN_MARGIN = 5.0  # m past the end or the edge of the runway
SLIP_SPEED = 10.0  # m/s: from here on the track is steered, below it the heading
NEAREST_WINDOW = 30  # path points searched for the nearest one, so that a path may cross itself


class TaxiPath:
    """A taxi route: rounded corners, the speed each metre allows, and how far the aircraft has come."""

    def __init__(self, frame: LocalFrame, corners: Sequence[Point], radius: float, top_speed: float) -> None:
        self._frame = frame
        self._points = filleted(list(corners), radius)
        self._speeds = _speeds(self._points, top_speed)
        self._last = len(self._points) - 1
        self._nearest = 0

    def follow(self, state: State, look_ahead: float) -> tuple[float, float, float]:
        """Return (bearing error to the point `look_ahead` metres on, speed allowed, distance left)."""
        north, east = self._frame.point(state.latitude, state.longitude)
        points, i = self._points, self._nearest
        best = inf
        for k in range(i, min(i + NEAREST_WINDOW, self._last + 1)):
            gap = (points[k][0] - north) ** 2 + (points[k][1] - east) ** 2
            if gap < best:
                best, i = gap, k
        self._nearest = i
        ahead = min(i + max(int(look_ahead), 1), self._last)
        target = points[ahead]
        beyond = look_ahead - (ahead - i)
        if beyond > 0.0 and self._last > 0:  # past the end: aim along the last metre of the path
            a, b = points[-2], points[-1]
            length = hypot(b[0] - a[0], b[1] - a[1]) or 1.0
            target = (b[0] + (b[0] - a[0]) / length * beyond, b[1] + (b[1] - a[1]) / length * beyond)
        error = wrap(atan2(target[1] - east, target[0] - north) - state.heading)
        left = (
            hypot(points[-1][0] - north, points[-1][1] - east)
            if self._last - i < 3
            else float(self._last - i)
        )
        return error, 0.0 if i >= self._last - 1 else self._speeds[i], left


def _speeds(points: list[Point], top: float) -> list[float]:
    """Speed allowed at each point: limited by the bend there and by stopping at the end."""
    count = len(points)
    allowed = [top] * count
    for i in range(5, count - 5):
        a, b, c = points[i - 5], points[i], points[i + 5]
        turn = abs(wrap(atan2(c[1] - b[1], c[0] - b[0]) - atan2(b[1] - a[1], b[0] - a[0])))
        if turn > 1e-3:
            arc = hypot(c[0] - b[0], c[1] - b[1])
            allowed[i] = min(top, sqrt(LATERAL_ACCELERATION * arc / turn))
    allowed[-1] = 0.0
    for i in range(count - 2, -1, -1):
        step = hypot(points[i + 1][0] - points[i][0], points[i + 1][1] - points[i][1])
        allowed[i] = min(allowed[i], sqrt(allowed[i + 1] ** 2 + 2.0 * STOP_DECELERATION * step))
    return allowed


class Centreline:
    """The runway in use on a flat map: where the aircraft is along and across it."""

    def __init__(self, runway: Runway) -> None:
        self._frame = LocalFrame(runway.latitude, runway.longitude)
        self.heading = runway.true_heading
        self._cos, self._sin = cos(self.heading), sin(self.heading)
        self._runway = runway

    def offset(self, state: State) -> tuple[float, float]:
        """Return (metres past the threshold, metres right of the centreline)."""
        north, east = self._frame.point(state.latitude, state.longitude)
        return north * self._cos + east * self._sin, east * self._cos - north * self._sin

    def check(self, state: State, phase: str) -> None:
        """Raise OverrunError when the aircraft has left the runway."""
        along, across = self.offset(state)
        length, half_width = self._runway.length, 0.5 * self._runway.width
        past_end = along > length + OVERRUN_MARGIN
        if past_end or abs(across) > half_width + OVERRUN_MARGIN:
            raise OverrunError(
                f"left the {'end' if past_end else 'side'} of runway {self._runway.airport} {self._runway.designator}",
                time=state.time,
                phase=phase,
                achieved=f"{along:.0f} m past the threshold, {across:.0f} m right of the centreline",
                required=f"within {length:.0f} m and {half_width:.0f} m",
                knob="less mass, less wind, a longer runway, or more brake",
            )


class GroundSteering:
    """Nose wheel and rudder: turns a wanted yaw rate into deflections.

    The wanted rate comes from a taxi path (pure pursuit) or a centreline. The nose wheel gets the kinematic angle
    plus feedback; the rudder takes over as the dynamic pressure grows. A slow integral trims crosswind away.
    Source: R. C. Coulter, Implementation of the pure pursuit path tracking algorithm, CMU-RI-TR-92-01.
    """

    def __init__(self, gains: Mapping[str, float]) -> None:
        self._wheelbase = gains["wheelbase"]
        self._full_scale = _full_scale(gains)
        self._rate_gain = gains["ground-yaw-rate-gain"]
        self._heading_time = gains["ground-heading-time-constant"]
        self._line_time = gains["ground-cross-track-time-constant"]
        self._trim_gain = gains["ground-yaw-trim-gain"]
        self._rudder_gain = gains["ground-rudder-gain"]
        self._align_gain = gains["align-rudder-gain"]
        self._trim = 0.0

    def reset(self) -> None:
        """Forget the crosswind trim."""
        self._trim = 0.0

    def pursue(self, state: State, bearing_error: float, look_ahead: float) -> float:
        """Return the nose wheel towards a point `look_ahead` metres away."""
        angle = atan(2.0 * self._wheelbase * sin(clamp(bearing_error, -1.5, 1.5)) / look_ahead)
        speed = hypot(state.velocity_north, state.velocity_east)
        return clamp(angle / self._steering_angle(speed), -1.0, 1.0)

    def hold_line(self, state: State, course: float, across: float, dt: float) -> tuple[float, float]:
        """Return (nose wheel, rudder) that bring the aircraft onto the centreline and keep it there."""
        speed = hypot(state.velocity_north, state.velocity_east)
        # In a crosswind the wheels slip: what must lie along the runway is the track, not the nose.
        track = atan2(state.velocity_east, state.velocity_north) if speed > SLIP_SPEED else state.heading
        speed = max(speed, 3.0)
        reach = max(speed * self._line_time, 25.0)
        wanted = wrap(course - clamp(atan(across / reach), -0.4, 0.4) - track) / self._heading_time
        missing = wanted - state.yaw_rate
        if speed > SLIP_SPEED:
            self._trim = clamp(self._trim + self._trim_gain * missing * dt, -0.15, 0.15)
        turn = wanted + self._rate_gain * missing + self._trim
        wheel = self._wheelbase / speed * turn / self._steering_angle(speed)
        share = clamp((speed - 15.0) / 20.0, 0.0, 1.0)
        return clamp(wheel, -1.0, 1.0), clamp(share * self._rudder_gain * turn, -1.0, 1.0)

    def _steering_angle(self, speed: float) -> float:
        """Nose-wheel angle at full deflection of the tiller at this ground speed, rad."""
        below = self._full_scale[0]
        for above in self._full_scale[1:]:
            if speed < above[0]:
                share = clamp((speed - below[0]) / (above[0] - below[0]), 0.0, 1.0)
                return below[1] + share * (above[1] - below[1])
            below = above
        return below[1]

    def align(self, state: State, course: float) -> float:
        """Return the pedals that turn the nose to the runway's direction in the flare."""
        error = wrap(course - state.heading)
        return clamp(self._align_gain * (error / self._heading_time - state.yaw_rate), -1.0, 1.0)


def _full_scale(gains: Mapping[str, float]) -> list[tuple[float, float]]:
    """(ground speed, full nose-wheel angle) from the gains called `steering-angle at 10 m/s`, by speed."""
    prefix = "steering-angle at "
    return sorted(
        (parse(name.removeprefix(prefix), "speed"), angle)
        for name, angle in gains.items()
        if name.startswith(prefix)
    )
