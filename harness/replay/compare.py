"""A replay held against the flight it came from."""

from collections.abc import Sequence
from math import degrees
from typing import NamedTuple

import numpy as np

from harness.errors import InputError
from harness.log import Run
from harness.numerics import wrap
from harness.world.earth import inverse

POSITION = ("latitude", "longitude", "altitude")
ATTITUDE = ("roll", "pitch", "heading")


class Comparison(NamedTuple):
    """Of position and attitude at every compared frame; `identical` means to the last bit."""

    identical: bool
    max_position_m: float
    max_attitude_deg: float
    frames: int


def frames_of(reference: Run, rate: float) -> tuple[int, ...]:
    """The frames of a replay at `rate` (Hz) at which the reference has rows, without the start.

    A script trims the aircraft in its first frame, the flight before it: the moment of the start has no counterpart.
    """
    return tuple(round(time * rate) for time in reference.history["time"].tolist() if time > 0)


def compare(run: Run, reference: Run) -> Comparison:
    """Compare a replay with the flight it came from, at the rows of the latter.

    Raises InputError when the replay has none of its frames.
    """
    ours, theirs = run.history, reference.history
    rows: dict[int, int] = {round(time * 1000): row for row, time in enumerate(ours["time"].tolist())}
    pairs = [
        (rows[key], row)
        for row, key in enumerate(round(time * 1000) for time in theirs["time"].tolist())
        if key > 0 and key in rows
    ]
    if not pairs:
        raise InputError(
            "the replay and the run have no time in common",
            file=reference.folder,
            remedy="is it the run's script?",
        )
    mine, its = (list(side) for side in zip(*pairs, strict=True))
    columns = {name: (ours[name][mine], theirs[name][its]) for name in POSITION + ATTITUDE}
    return Comparison(
        identical=all(np.array_equal(a, b) for a, b in columns.values())
        and len(pairs) == int(np.count_nonzero(theirs["time"] > 0)),
        max_position_m=_farthest([columns[name] for name in POSITION]),
        max_attitude_deg=degrees(
            max(abs(wrap(a - b)) for name in ATTITUDE for a, b in zip(*columns[name], strict=True))
        ),
        frames=len(pairs),
    )


def _farthest(columns: Sequence[tuple[np.ndarray, np.ndarray]]) -> float:
    (latitude, latitude0), (longitude, longitude0), (altitude, altitude0) = columns
    differ = (latitude != latitude0) | (longitude != longitude0)
    distance = np.zeros(len(latitude))
    for row in np.flatnonzero(differ).tolist():
        distance[row] = inverse(
            float(latitude[row]), float(longitude[row]), float(latitude0[row]), float(longitude0[row])
        )[2]
    return float(np.max(np.hypot(distance, altitude - altitude0)))
