"""Small pieces of arithmetic that every controller needs."""

from math import exp, pi


def clamp(value: float, low: float, high: float) -> float:
    """`value` held between `low` and `high`."""
    return low if value < low else min(value, high)


def wrap(angle: float) -> float:
    """`angle` (rad) brought into [-pi, pi)."""
    return (angle + pi) % (2.0 * pi) - pi


QUANTUM = 2.0**-13  # 1.2e-4: of a radian far below what an aircraft feels, of a full deflection too
_ROUNDER = 1.5 * 2.0**39  # its last binary digit is the quantum: adding it leaves no room for anything finer


def quantised(value: float) -> float:
    """`value` to the nearest QUANTUM, so that a steady command stays the same number and a recording of it short.

    Adding and taking away a large number is ten times faster than `round`, which works in decimal.
    """
    return value + _ROUNDER - _ROUNDER


def approach(value: float, target: float, step: float) -> float:
    """`value` moved towards `target` by at most `step`."""
    return target if abs(target - value) <= step else value + step if target > value else value - step


class LowPass:
    """First-order lag with time constant `tau` (s), exact for an input held over the step."""

    __slots__ = ("tau", "value")

    def __init__(self, tau: float, value: float = 0.0) -> None:
        self.tau = tau
        self.value = value

    def update(self, target: float, dt: float) -> float:
        """Let `dt` seconds pass with the input at `target`, and return the output."""
        self.value += (target - self.value) * (1.0 - exp(-dt / self.tau))
        return self.value
