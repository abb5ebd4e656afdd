"""The modes found in a free motion are the eigenvalues of the system that made it."""

import numpy as np
import pytest
from scipy.linalg import expm

from harness.qualify.identify import modes

STEP = 2 / 120
SYSTEM = np.array(
    [
        [-0.08, 0.10, -0.99, 0.075],
        [-2.9, -0.75, 0.36, 0.0],
        [0.78, -0.03, -0.16, 0.0],
        [0.0, 1.0, 0.10, 0.0],
    ]
)
"""Sideslip, roll rate, yaw rate, bank of a transport: a dutch roll, a roll mode and a slow spiral."""
STATES = ("beta", "p", "r", "phi")


def motion(start: list[float], offset: float = 0.0) -> dict[str, np.ndarray]:
    step, rows = expm(SYSTEM * STEP), [np.array(start)]
    for _ in range(1200):
        rows.append(step @ rows[-1])
    table = np.array(rows) + offset
    time = np.arange(len(rows)) * STEP
    return {"time": time, **{name: table[:, i] for i, name in enumerate(STATES)}}


@pytest.mark.parametrize("offset", [0.0, 0.05])
def test_modes_are_eigenvalues(offset: float) -> None:
    """The offset stands for a trim that is not at zero."""
    pairs, singles = modes([motion([0.02, 0, 0, 0], offset), motion([0, 0.05, 0, 0.01], offset)], STATES)
    eigenvalues = np.linalg.eigvals(SYSTEM)
    oscillation = next(s for s in eigenvalues if s.imag > 0)
    real = sorted(abs(1 / s.real) for s in eigenvalues if abs(s.imag) < 1e-9)
    assert pairs[0].frequency == pytest.approx(abs(oscillation), rel=1e-4)
    assert pairs[0].damping == pytest.approx(-oscillation.real / abs(oscillation), rel=1e-3)
    assert pairs[0].period == pytest.approx(2 * np.pi / oscillation.imag, rel=1e-4)
    assert [abs(mode.time_constant) for mode in singles] == pytest.approx(real, rel=1e-2)
