"""The points of a study: which value each factor has in each case.

Source of the estimators' sampling scheme: Saltelli et al., Computer Physics Communications 181 (2010) 259-270.
"""

from collections.abc import Iterator, Sequence
from math import prod
from typing import TYPE_CHECKING

from harness.studies.model import Distribution, Factor, Level, Study

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Samples = NDArray[np.float64]

Point = tuple[Level | None, ...]
"""One value for each factor; None leaves it as the mission has it."""


def count(study: Study) -> int:
    """How many cases the study has."""
    levels = [len(factor.levels) for factor in study.factors]
    kind, n = study.design.kind, study.design.n
    if kind == "grid":
        return prod(levels)
    if kind == "one-at-a-time":
        return 1 + sum(levels)
    return n * (len(levels) + 2) if kind == "sobol" else n


def points(study: Study) -> Iterator[Point]:
    """Every point, in the order of the table. Grids take no memory, sampled designs that of their samples."""
    factors = study.factors
    if study.design.kind == "grid":
        for index in range(count(study)):
            yield _of_grid(index, factors)
    elif study.design.kind == "one-at-a-time":
        yield (None,) * len(factors)
        for place, factor in enumerate(factors):
            for level in factor.levels:
                yield tuple(level if place == other else None for other in range(len(factors)))
    else:
        shares = samples(study)
        for place, factor in enumerate(factors):
            if isinstance(factor.spread, Distribution):
                shares[:, place] = _quantiles(factor.spread, shares[:, place])
        for row in shares:
            yield tuple(_sampled(factor, float(number)) for factor, number in zip(factors, row, strict=True))


def samples(study: Study) -> "Samples":
    """The points of a sampled design in the unit cube, (cases, factors).

    Those of a Sobol design are those of Saltelli's scheme: n of A, n of B, then for each factor the n of A with that
    factor's column from B.
    """
    import numpy as np

    kind, n, seed = study.design
    size = len(study.factors)
    if kind == "monte-carlo":
        return np.random.default_rng(seed).random((n, size))
    from scipy.stats import qmc  # takes a second to load

    if kind == "latin-hypercube":
        found: Samples = qmc.LatinHypercube(size, rng=seed).random(n)
        return found
    both = qmc.Sobol(2 * size, rng=seed).random(n)
    a, b = both[:, :size], both[:, size:]
    blocks = [a, b]
    for column in range(size):
        mixed = a.copy()
        mixed[:, column] = b[:, column]
        blocks.append(mixed)
    return np.concatenate(blocks)


def probes(study: Study) -> Iterator[Point]:
    """Points that show every level that a list has, and the ends of every range."""
    alone = study.design.kind == "one-at-a-time"
    first: Point = tuple(None if alone else _ends(factor)[0] for factor in study.factors)
    yield first
    for place, factor in enumerate(study.factors):
        for level in _ends(factor):
            yield (*first[:place], level, *first[place + 1 :])


def _ends(factor: Factor) -> Sequence[Level]:
    if isinstance(factor.spread, Distribution):
        import numpy as np

        return [
            factor.spread.scale.level(float(x)) for x in _quantiles(factor.spread, np.array((0.05, 0.95)))
        ]
    return factor.spread if isinstance(factor.spread, tuple) else (factor.spread[0], factor.spread[-1])


def _of_grid(index: int, factors: Sequence[Factor]) -> Point:
    """The point of that number; the last factor varies fastest."""
    chosen: list[Level] = []
    for factor in reversed(factors):
        index, place = divmod(index, len(factor.levels))
        chosen.append(factor.levels[place])
    return tuple(reversed(chosen))


def _sampled(factor: Factor, number: float) -> Level:
    """The level of a number of a factor's distribution, or of a share 0..1 of its levels."""
    spread = factor.spread
    if isinstance(spread, Distribution):
        return spread.scale.level(number)
    return spread[min(int(number * len(spread)), len(spread) - 1)]


def _quantiles(spread: Distribution, shares: "Samples") -> "Samples":
    """The numbers below which lie these shares of a distribution."""
    if spread.name == "uniform":
        return spread.location + shares * spread.width
    from scipy import stats

    law = getattr(stats, spread.name)
    found: Samples = law.ppf(shares, *spread.shape, loc=spread.location, scale=spread.width)
    return found
