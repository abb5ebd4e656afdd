"""Stretches of a flight during which a word of its log, such as the phase or a mode, stays the same."""

from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Span(NamedTuple):
    """One stretch: its word, begin and end (s), and its rows `first` up to and without `last`."""

    word: str
    begin: float
    end: float
    first: int
    last: int

    @property
    def rows(self) -> slice:
        """The rows of the history it covers."""
        return slice(self.first, self.last)


def spans(time: NDArray[np.float64], words: Sequence[str] | NDArray[np.str_]) -> list[Span]:
    """Return the stretches of equal words in order. Each ends where the next begins."""
    words = np.asarray(words)
    if not len(words):
        return []
    edges = [0, *(np.flatnonzero(words[1:] != words[:-1]) + 1).tolist(), len(words)]
    times = [*time[edges[:-1]].tolist(), float(time[-1])]
    return [
        Span(str(words[first]), begin, end, first, last)
        for (first, last), (begin, end) in zip(pairwise(edges), pairwise(times), strict=True)
    ]
