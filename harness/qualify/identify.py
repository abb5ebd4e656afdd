"""The natural modes of an aircraft from its recorded free motion: the linear system that made it, by least squares.

An independent way to what `linear` computes: here the aircraft really moves.
"""

from collections.abc import Sequence

import numpy as np

from harness.plant.bench import Record
from harness.qualify.linear import Mode


def modes(records: Sequence[Record], states: Sequence[str]) -> tuple[list[Mode], list[Mode]]:
    """Oscillations (fastest first) and single modes (fastest first) of the linear system behind free motions.

    The records share their time step and begin near the same trimmed flight.
    """
    tables = [np.column_stack([record[name] for name in states]) for record in records]
    size = np.maximum(np.max([np.ptp(table, axis=0) for table in tables], axis=0), 1e-9)
    reference = tables[0][0]
    rows = [np.column_stack([(table - reference) / size, np.ones(len(table))]) for table in tables]
    before = np.vstack([table[:-1] for table in rows])
    after = np.vstack([table[1:, :-1] for table in rows])
    matrix, *_ = np.linalg.lstsq(before, after, rcond=None)
    step = float(records[0]["time"][1] - records[0]["time"][0])
    poles = np.linalg.eigvals(matrix[:-1].T)
    values = np.log(poles[np.abs(poles) > 1e-6].astype(complex)) / step  # the rest: gone within a step
    pairs = [Mode(complex(value)) for value in values if value.imag > 1e-6]
    singles = [Mode(complex(value)) for value in values if abs(value.imag) <= 1e-6 and abs(value.real) > 1e-9]
    return (
        sorted(pairs, key=lambda mode: -mode.frequency),
        sorted(singles, key=lambda mode: abs(mode.time_constant)),
    )
