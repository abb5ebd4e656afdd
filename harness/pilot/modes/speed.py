"""SPD: speed by thrust lever (THR), by flight path (PITCH), or not at all, the lever set by hand (OFF)."""

from collections.abc import Mapping
from math import inf

from harness.numerics import LowPass, approach, clamp, quantised
from harness.state import State
from harness.world.atmosphere import GRAVITY


class SpeedMode:
    """Controls calibrated airspeed.

    Both laws look at the specific excess energy rate, which is the climb angle plus the acceleration in g: what the
    thrust gives beyond the drag. It changes with lever and configuration only, not when speed is traded for height, so
    it can be filtered slowly. PITCH spends it: what the wanted acceleration leaves becomes the path. THR supplies it:
    the lever moves until it covers the wanted acceleration and the wanted path.
    Source of the idea: A. A. Lambregts, Vertical flight path and speed control autopilot design using total energy
    principles, AIAA 83-2239.
    """

    def __init__(self, gains: Mapping[str, float]) -> None:
        self.sub_mode = "OFF"
        self.lever = 0.0  # where the levers are
        self.hand = 0.0  # where the hand puts them, in OFF at once and in PITCH gently
        self.highest_lever = 1.0
        self._speed_gain = 1.0 / gains["speed-time-constant"]
        self._most_acceleration = gains["speed-acceleration"]
        self._lever_gain = gains["lever-per-energy"]
        self._lever_integral = gains["lever-per-energy"] / gains["lever-integral-time"]
        self._hand_rate = gains["lever-rate"]
        self._climb = (gains["least-climb-angle"], gains["climb-angle-limit"])
        self._descent = (-gains["descent-angle-limit"], -gains["least-descent-angle"])
        self._excess = LowPass(gains["excess-energy-filter"])
        self._cas = -1.0
        self._integral = 0.0

    def select(self, sub_mode: str) -> None:
        """Change the sub-mode; THR takes over the lever where it stands."""
        if sub_mode == "THR" and self.sub_mode != "THR":
            self._integral = self.lever
        self.sub_mode = sub_mode

    def put(self, lever: float) -> None:
        """Put the hand somewhere; in OFF the levers are there at once."""
        self.hand = lever
        if self.sub_mode == "OFF":
            self.lever = quantised(lever)

    def observe(self, state: State, dt: float) -> None:
        """Keep the excess energy up to date; `dt` is the time since the last call, s."""
        if self._cas < 0.0:
            self._cas = state.cas
        rate = (state.cas - self._cas) / dt
        self._cas = state.cas
        self._excess.update(state.vertical_speed / max(state.tas, 1.0) + _in_g(rate, state), dt)

    def move(self, dt: float) -> None:
        """OFF and PITCH: let the levers follow the hand for `dt` seconds."""
        step = self._hand_rate * dt if self.sub_mode == "PITCH" else inf
        self.lever = quantised(approach(self.lever, self.hand, step))

    def update(self, state: State, target: float, path: float, dt: float) -> None:
        """THR: move the lever for the CAS `target` (m/s) on the flight `path` (rad)."""
        energy = self._acceleration(state, target) + path - self._excess.value
        lever = self._integral + self._lever_gain * energy
        if 0.0 < lever < self.highest_lever or (lever <= 0.0) == (energy > 0.0):
            self._integral += self._lever_integral * energy * dt
        self.lever = quantised(clamp(lever, 0.0, self.highest_lever))

    def path(self, state: State, target: float) -> float:
        """PITCH: return the flight path (rad) that brings the CAS to `target` with the thrust there is.

        It never gives up the climb to gain speed nor the descent to lose it.
        """
        low, high = self._climb if self.hand > 0.0 else self._descent
        return clamp(self._excess.value - self._acceleration(state, target), low, high)

    def _acceleration(self, state: State, target: float) -> float:
        """Wanted along the path, in g."""
        most = self._most_acceleration
        return _in_g(clamp(self._speed_gain * (target - state.cas), -most, most), state)


def _in_g(rate: float, state: State) -> float:
    """Acceleration in g along the path from a rate of change of CAS."""
    return rate * state.tas / max(state.cas, 1.0) / GRAVITY
