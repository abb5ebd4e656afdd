"""How fuel is put into the tanks."""

from typing import NamedTuple

from harness.errors import InputError


class Tank(NamedTuple):
    """A fuel tank: capacity in kg and its place in the filling order."""

    capacity: float
    order: float


def filled(tanks: list[Tank], fuel: float) -> list[float]:
    """Kilograms in each tank when `fuel` is put in by filling order; tanks of equal order fill in proportion.

    Raises InputError when it does not fit.
    """
    contents = [0.0] * len(tanks)
    left = fuel
    for order in sorted({tank.order for tank in tanks}):
        group = [i for i, tank in enumerate(tanks) if tank.order == order]
        capacity = sum(tanks[i].capacity for i in group)
        share = min(left / capacity, 1.0)
        for i in group:
            contents[i] = share * tanks[i].capacity
        left -= share * capacity
    if left > 1e-6:
        raise InputError(f"{fuel:.0f} kg of fuel do not fit: the tanks hold {fuel - left:.0f} kg")
    return contents
