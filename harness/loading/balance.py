"""Mass, centre of gravity and inertia of things put together: the closed forms.

Axes are the structural ones of the aircraft's files: x aft of the nose, y to the right, z up; metres and kilograms.
"""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Matrix = NDArray[np.float64]

_CORNERS = np.array([(1.0, 1.0, 1.0), (1.0, -1.0, -1.0), (-1.0, 1.0, -1.0), (-1.0, -1.0, 1.0)])
"""Of a regular tetrahedron about the origin: their sum is zero, and the sum of v v^T four times the unit matrix."""


class Item(NamedTuple):
    """Something on board: its mass, where its centre of gravity is, and the cylinder along x that it fills.

    `radius` and `length` of 0 make it a point.
    """

    name: str
    mass: float
    x: float
    y: float
    z: float
    radius: float = 0.0
    length: float = 0.0


class Body(NamedTuple):
    """Several things as one: mass, centre of gravity, and the second moments of mass about it, that is of r r^T."""

    mass: float
    centre: Matrix
    moments: Matrix

    @property
    def inertia(self) -> Matrix:
        """The inertia tensor about the centre of gravity, products with their minus sign: tr(J) 1 - J."""
        return float(np.trace(self.moments)) * np.eye(3) - self.moments


def combined(items: Iterable[Item]) -> Body:
    """All of `items` as one body, by the parallel-axis theorem. Of nothing: no mass, at the origin."""
    every = list(items)
    mass = sum(item.mass for item in every)
    if mass <= 0:
        return Body(0.0, np.zeros(3), np.zeros((3, 3)))
    places = np.array([(item.x, item.y, item.z) for item in every])
    weights = np.array([item.mass for item in every])
    centre = weights @ places / mass
    away = places - centre
    moments = (away * weights[:, None]).T @ away
    for item in every:
        across = item.mass * item.radius**2 / 4
        moments += np.diag((item.mass * item.length**2 / 12, across, across))
    return Body(mass, centre, moments)


def four_points(body: Body) -> Sequence[tuple[float, float, float]]:
    """Places of four equal point masses that have together the mass, centre of gravity and inertia of `body`.

    They are the corners of a regular tetrahedron, stretched by the square root of the second moments per mass.
    """
    if body.mass <= 0:
        return [(0.0, 0.0, 0.0)] * 4
    values, axes = np.linalg.eigh(body.moments / body.mass)
    stretch = axes @ np.diag(np.sqrt(np.maximum(values, 0.0))) @ axes.T
    return [(float(x), float(y), float(z)) for x, y, z in body.centre + _CORNERS @ stretch]
