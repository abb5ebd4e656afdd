"""SPD: speed by thrust lever (THR), by flight path (PITCH), or not at all, the lever set by hand (OFF)."""

from collections.abc import Mapping

from harness.numerics import LowPass, clamp, quantised
from harness.state import State
from harness.world.atmosphere import GRAVITY


class SpeedMode:
    """Controls calibrated airspeed.

    Both laws work on the rate of change of CAS: the speed error asks for one (limited), and the difference to the
    measured one is an amount of specific energy that the lever (THR) or the flight path (PITCH) has to supply.
    Source of the idea: A. A. Lambregts, Vertical flight path and speed control autopilot design using total energy
    principles, AIAA 83-2239.
    """

    def __init__(self, gains: Mapping[str, float]) -> None:
        self.sub_mode = "OFF"
        self.lever = 0.0  # set by hand
        self.highest_lever = 1.0
        self._speed_gain = 1.0 / gains["speed-time-constant"]
        self._most_acceleration = gains["speed-acceleration"]
        self._lever_gain = gains["lever-per-energy"]
        self._lever_integral = gains["lever-per-energy"] / gains["lever-integral-time"]
        self._cas_rate = LowPass(gains["speed-rate-filter"])
        self._cas = -1.0
        self._integral = 0.0
        self._climb = (gains["least-climb-angle"], gains["climb-angle-limit"])
        self._descent = (-gains["descent-angle-limit"], -gains["least-descent-angle"])

    def select(self, sub_mode: str) -> None:
        """Change the sub-mode; THR takes over the lever where it stands."""
        if sub_mode == "THR" and self.sub_mode != "THR":
            self._integral = self.lever
        self.sub_mode = sub_mode

    def observe(self, state: State, dt: float) -> None:
        """Keep the rate of change of the airspeed up to date."""
        if self._cas < 0.0:
            self._cas = state.cas
        self._cas_rate.update((state.cas - self._cas) / dt, dt)
        self._cas = state.cas

    def update(self, state: State, target: float, path_error: float, dt: float) -> float:
        """THR: the lever. `path_error`: climb asked for beyond the present one, rad; the lever supplies it too."""
        energy = self._energy_wanted(state, target) + clamp(path_error, -0.05, 0.05)
        lever = self._integral + self._lever_gain * energy
        if 0.0 < lever < self.highest_lever or (lever <= 0.0) == (energy > 0.0):
            self._integral += self._lever_integral * energy * dt
        self.lever = quantised(clamp(lever, 0.0, self.highest_lever))
        return self.lever

    def path(self, state: State, target: float) -> float:
        """PITCH: the flight-path angle (rad) that brings the speed to `target` with the thrust there is.

        It never gives up the climb to gain speed nor the descent to lose it.
        """
        path = state.vertical_speed / max(state.tas, 1.0)
        low, high = self._climb if self.lever > 0.0 else self._descent
        return clamp(path - self._energy_wanted(state, target), low, high)

    def _energy_wanted(self, state: State, target: float) -> float:
        """Acceleration still missing, in g along the path."""
        wanted = clamp(
            self._speed_gain * (target - state.cas), -self._most_acceleration, self._most_acceleration
        )
        return (wanted - self._cas_rate.value) * state.tas / max(state.cas, 1.0) / GRAVITY
