"""Small motions about a trimmed flight: linear model by central differences, and the natural modes it has.

The aircraft is held still in moving air while each state is disturbed both ways; what it would accelerate with gives
the columns of the system matrix. Engines and governors follow a disturbance as they would one that lasts `SETTLE`;
the downwash at the tail, which arrives late, is a state of its own. Controls stay where the trim put them, so this is
the bare airframe when the aircraft's laws are off; the closed loop is measured in time histories (`decay`).

Source: Stevens and Lewis, Aircraft Control and Simulation, sec. 3.7 (numerical linearisation), 4.2 (modes).
"""

from math import exp, inf, log, pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eig

from harness.plant.bench import Bench
from harness.units import FT

Matrix = NDArray[np.float64]

SYMMETRIC = ("u", "w", "q", "theta", "height", "downwash")
LATERAL = ("v", "p", "r", "phi")
STATES = SYMMETRIC + LATERAL
"""m/s in body axes, rad/s, rad, m, rad."""
CONTROLS = ("elevator", "aileron", "rudder")
"""Stick and pedals, -1..1."""
SETTLE = 2.0  # s for propeller governors and actuators
STILL = 1e15  # ft: a tail so far behind that the downwash keeps its value
FRAMES = 12  # in which the downwash is let move: a whole number of the turns of any slow channel
_SET = {
    "u": ("ic/u-fps", FT, 1.0),
    "w": ("ic/w-fps", FT, 0.5),
    "q": ("ic/q-rad_sec", 1.0, 0.005),
    "theta": ("ic/theta-rad", 1.0, 0.005),
    "height": ("ic/h-sl-ft", FT, 30.0),
    "downwash": ("aero/downwash-rad", 1.0, 0.002),
    "v": ("ic/v-fps", FT, 0.5),
    "p": ("ic/p-rad_sec", 1.0, 0.005),
    "r": ("ic/r-rad_sec", 1.0, 0.005),
    "phi": ("ic/phi-rad", 1.0, 0.005),
}
"""Each state: the property that sets it, its unit in SI, and how far it is disturbed."""
_NOW = {
    "u": "velocities/u-fps",
    "w": "velocities/w-fps",
    "q": "velocities/q-rad_sec",
    "theta": "attitude/theta-rad",
    "height": "position/h-sl-ft",
    "downwash": "aero/downwash-rad",
    "v": "velocities/v-fps",
    "p": "velocities/p-rad_sec",
    "r": "velocities/r-rad_sec",
    "phi": "attitude/phi-rad",
}
_RATE = {
    "u": "accelerations/udot-ft_sec2",
    "w": "accelerations/wdot-ft_sec2",
    "q": "accelerations/qdot-rad_sec2",
    "theta": "velocities/thetadot-rad_sec",
    "height": "velocities/h-dot-fps",
    "v": "accelerations/vdot-ft_sec2",
    "p": "accelerations/pdot-rad_sec2",
    "r": "accelerations/rdot-rad_sec2",
    "phi": "velocities/phidot-rad_sec",
}


class Linear(NamedTuple):
    """dx/dt = A x + B u with x as STATES and u as CONTROLS."""

    A: Matrix
    B: Matrix

    def part(self, states: tuple[str, ...]) -> Matrix:
        """The system matrix of some of the states, the others held."""
        rows = [STATES.index(name) for name in states]
        return self.A[np.ix_(rows, rows)]


class Mode(NamedTuple):
    """A natural motion, from its eigenvalue in 1/s (the one with a positive imaginary part)."""

    eigenvalue: complex

    @property
    def frequency(self) -> float:
        """Undamped natural frequency, rad/s."""
        return abs(self.eigenvalue)

    @property
    def damping(self) -> float:
        """Damping ratio; negative: it grows."""
        return -self.eigenvalue.real / abs(self.eigenvalue)

    @property
    def period(self) -> float:
        """Of the oscillation, s; infinite without one."""
        return 2 * pi / self.eigenvalue.imag if self.eigenvalue.imag else inf

    @property
    def time_constant(self) -> float:
        """Of the decay, s; negative: of the growth."""
        return -1.0 / self.eigenvalue.real

    @property
    def doubling(self) -> float:
        """Time to double, s; negative: to halve."""
        return log(2.0) / self.eigenvalue.real


def linearise(bench: Bench) -> Linear:
    """The linear model about the flight in which the bench is held still, trimmed and settled.

    Leaves the aircraft in that flight.
    """
    start = {name: bench.get(_NOW[name]) * _SET[name][1] for name in STATES}
    controls = {name: bench.get(f"fcs/{name}-cmd-norm") for name in CONTROLS}
    arm = bench.get("aero/tail-arm-ft")

    def rates(state: dict[str, float], stick: dict[str, float]) -> Matrix:
        for name, position in stick.items():
            bench.put(f"fcs/{name}-cmd-norm", position)
        for name in STATES:
            bench.put(_SET[name][0], state[name] / _SET[name][1])
        bench.put("aero/tail-arm-ft", STILL)
        bench.initialise()
        bench.put(_SET["downwash"][0], state["downwash"])
        bench.run(SETTLE)
        result = [bench.get(_RATE[name]) * _SET[name][1] if name in _RATE else 0.0 for name in STATES]
        bench.put("aero/tail-arm-ft", arm)
        bench.run(FRAMES / bench.rate)
        late = bench.get("velocities/vt-fps") / arm  # 1/s
        moved = bench.get(_NOW["downwash"]) - state["downwash"]
        result[STATES.index("downwash")] = moved * late / (1.0 - exp(-late * FRAMES / bench.rate))
        return np.array(result)

    A = [
        (
            rates(start | {name: start[name] + step}, controls)
            - rates(start | {name: start[name] - step}, controls)
        )
        / (2 * step)
        for name, (_, _, step) in _SET.items()
    ]
    B = [
        (rates(start, controls | {name: c + 0.02}) - rates(start, controls | {name: c - 0.02})) / 0.04
        for name, c in controls.items()
    ]
    rates(start, controls)
    order = [list(_SET).index(name) for name in STATES]
    return Linear(np.array(A)[order].T, np.array(B).T)


def longitudinal(model: Linear) -> tuple[Mode, Mode]:
    """Short period and phugoid."""
    values = [mode for mode in _modes(model.part(SYMMETRIC)) if mode.eigenvalue.imag > 0]
    if len(values) < 2:
        raise ArithmeticError("the aircraft has no short period and phugoid here, but " + str(values))
    ordered = sorted(values, key=lambda mode: -mode.frequency)
    return ordered[0], ordered[-1]


def lateral(model: Linear) -> tuple[Mode, Mode, Mode]:
    """Dutch roll, roll mode and spiral."""
    modes = _modes(model.part(LATERAL))
    (dutch,) = (mode for mode in modes if mode.eigenvalue.imag > 0)
    roll, spiral = sorted(
        (mode for mode in modes if mode.eigenvalue.imag == 0), key=lambda mode: -abs(mode.eigenvalue)
    )
    return dutch, roll, spiral


def load_factor_per_alpha(model: Linear, speed: float) -> float:
    """Steady load factor per incidence, 1/rad, at true airspeed `speed` in m/s: what the control anticipation
    parameter wn^2 / (n/alpha) is formed with.
    """
    w = STATES.index("w")
    return float(-model.A[w, w]) * speed / 9.80665


def decay(time: Matrix, values: Matrix, order: int = 4) -> list[Mode]:
    """The modes in a free response sampled at equal steps, those with the most in it first.

    Matrix pencil: Hua and Sarkar, IEEE Trans. ASSP 38 (1990), 814.
    """
    step = float(time[1] - time[0])
    signal = values - values[-len(values) // 10 :].mean()
    window = len(signal) // 2
    hankel = np.lib.stride_tricks.sliding_window_view(signal, window + 1)
    _, _, right = np.linalg.svd(hankel, full_matrices=False)
    V = right[:order].T
    poles = np.linalg.eigvals(np.linalg.pinv(V[:-1]) @ V[1:])
    poles = np.log(poles[np.abs(poles) > 1e-6].astype(complex)) / step
    basis = np.exp(np.outer(time - time[0], poles))
    share, *_ = np.linalg.lstsq(basis, signal.astype(complex), rcond=None)
    energy = np.linalg.norm(basis * share, axis=0)
    return [Mode(complex(poles[i])) for i in np.argsort(-energy) if poles[i].imag >= 0]


def _modes(A: Matrix) -> list[Mode]:
    values = eig(A, right=False)
    return [Mode(complex(value)) for value in values if value.imag >= 0]
