"""How fuel is put into the tanks: the fuel-management table."""

from collections.abc import Sequence

from harness.errors import InputError


def filled(capacities: Sequence[float], order: Sequence[Sequence[int]], fuel: float) -> list[float]:
    """Kilograms in each tank when `fuel` kg are put in; the tanks of one line of `order` fill in proportion.

    Raises InputError when it does not fit.
    """
    contents = [0.0] * len(capacities)
    left = fuel
    for group in order:
        capacity = sum(capacities[tank] for tank in group)
        share = min(left / capacity, 1.0)
        for tank in group:
            contents[tank] = share * capacities[tank]
        left -= share * capacity
    if left > 1e-6:
        raise InputError(f"{fuel:.0f} kg of fuel do not fit: the tanks hold {fuel - left:.0f} kg")
    return contents
