"""What a study came to, in numbers: statistics of every output, and Sobol indices where the design gives them.

Sources: percentiles by linear interpolation (Hyndman and Fan 1996, type 7); Sobol indices by the estimators of
Saltelli et al., Computer Physics Communications 181 (2010) 259-270, table 2, as in scipy.stats.sobol_indices.
"""

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from harness.studies.model import Study

if TYPE_CHECKING:
    import pyarrow as pa

PERCENTILES = (5, 25, 50, 75, 95)
FEWEST = 2  # values that have a spread


def conclude(study: Study, table: "pa.Table") -> dict[str, Any]:
    """Statistics of each numeric output over the cases that succeeded, and its Sobol indices."""
    good = np.array(table["status"].to_pylist()) == "ok"
    numbers = {
        output.column: table[output.column].to_numpy()
        for output in study.outputs
        if table.schema.field(output.column).type == "double"
    }
    return {
        "statistics": {name: statistics(values[good]) for name, values in numbers.items()},
        "sobol": {name: indices for name, values in numbers.items() if (indices := sobol(study, values))},
    }


def statistics(values: NDArray[np.float64]) -> dict[str, float | int | None]:
    """n, mean, sample standard deviation, extremes and percentiles of those that are numbers."""
    known = values[np.isfinite(values)]
    if not len(known):
        return {"n": 0}
    found: dict[str, float | int | None] = {"n": len(known), "mean": float(known.mean())}
    found["standard_deviation"] = float(known.std(ddof=1)) if len(known) >= FEWEST else None
    found |= {"minimum": float(known.min()), "maximum": float(known.max())}
    return found | {f"p{p}": float(np.percentile(known, p)) for p in PERCENTILES}


def sobol(study: Study, values: NDArray[np.float64]) -> dict[str, dict[str, float]]:
    """First-order and total index of each factor; nothing if the design is another or a case is missing."""
    size, n = len(study.factors), study.design.n
    if study.design.kind != "sobol" or not np.isfinite(values).all() or np.ptp(values) == 0:
        return {}
    from scipy.stats import sobol_indices

    blocks = values.reshape(size + 2, 1, n)
    found = sobol_indices(func={"f_A": blocks[0], "f_B": blocks[1], "f_AB": blocks[2:]}, n=n)
    return {
        factor.column: {"first": float(first), "total": float(total)}
        for factor, first, total in zip(
            study.factors, found.first_order.ravel(), found.total_order.ravel(), strict=True
        )
    }
