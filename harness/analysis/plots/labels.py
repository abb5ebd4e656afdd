"""Where names go on a map: beside their points, clear of the route, the symbols and each other.

Lengths are in points (1/72 in).
"""

from collections.abc import Sequence
from itertools import pairwise
from math import atan2, ceil, cos, hypot, pi, sin
from typing import NamedTuple

Point = tuple[float, float]

FONT = 8.0
GAP = 11.0  # from the point to its name
TURNS = (0.0, 0.25, -0.25, 0.5, -0.5, 0.75, -0.75, 1.0)  # of half a turn, tried in this order
ROUTE_STEP = 4.0  # between the spots of the route that a name should not cover
COST_OF_SYMBOL, COST_OF_NAME = 5.0, 20.0  # in spots of the route


class Box(NamedTuple):
    """A rectangle on the paper."""

    left: float
    bottom: float
    right: float
    top: float

    def overlaps(self, other: "Box") -> bool:
        """Whether two rectangles share any area."""
        return (
            self.left < other.right
            and other.left < self.right
            and self.bottom < other.top
            and other.bottom < self.top
        )

    def inside(self, other: "Box") -> bool:
        """Whether the other rectangle holds all of this one."""
        return (
            other.left <= self.left
            and self.right <= other.right
            and other.bottom <= self.bottom
            and self.top <= other.top
        )


def outward(before: Point, here: Point, after: Point) -> Point:
    """Return the unit vector away from both neighbours; left of the route where it does not turn."""
    one = _unit(here[0] - before[0], here[1] - before[1])
    two = _unit(here[0] - after[0], here[1] - after[1])
    x, y = one[0] + two[0], one[1] + two[1]
    return _unit(x, y) if hypot(x, y) > 0.2 else (-one[1], one[0])


def alignment(away: Point) -> tuple[str, str]:
    """Return the horizontal and vertical alignment of a name that lies in a direction from its point."""
    horizontal = "left" if away[0] > 0.35 else "right" if away[0] < -0.35 else "center"
    vertical = "bottom" if away[1] > 0.35 else "top" if away[1] < -0.35 else "center"
    return horizontal, vertical


def directions(route: Sequence[Point], names: Sequence[str], paper: Box, taken: Sequence[Box]) -> list[Point]:
    """Return the direction of each name from its point: `names` belong to the inner points of `route`.

    Each name in turn takes the first of eight directions, beginning with the outer side of the turn, that
    covers least of the route, of other symbols, of names placed before and of what is `taken`, and stays on
    the paper.
    """
    spots = [spot for start, end in pairwise(route) for spot in _along(start, end)]
    symbols = [Box(x - 6, y - 6, x + 6, y + 6) for x, y in route]
    placed = [*taken]
    chosen = []
    for before, here, after, name in zip(route, route[1:], route[2:], names, strict=False):
        outside = outward(before, here, after)
        best: tuple[float, Point, Box] | None = None
        for turn in TURNS:
            angle = atan2(outside[1], outside[0]) + turn * pi
            away = (cos(angle), sin(angle))
            box = box_of(name, (here[0] + GAP * away[0], here[1] + GAP * away[1]), *alignment(away))
            cost = float(sum(box.left < x < box.right and box.bottom < y < box.top for x, y in spots))
            cost += COST_OF_SYMBOL * sum(box.overlaps(symbol) for symbol in symbols)
            cost += COST_OF_NAME * sum(box.overlaps(other) for other in placed)
            cost += COST_OF_NAME * (not box.inside(paper))
            if best is None or cost < best[0]:
                best = (cost, away, box)
        if best:
            chosen.append(best[1])
            placed.append(best[2])
    return chosen


def box_of(name: str, anchor: Point, horizontal: str, vertical: str) -> Box:
    """Return the rectangle a name takes at its anchor, for letters of mean width."""
    lines = name.split("\n")
    wide, high = 0.68 * FONT * max(map(len, lines)), 1.25 * FONT * len(lines)
    left = anchor[0] - {"left": 0.0, "right": wide, "center": wide / 2}[horizontal]
    bottom = anchor[1] - {"bottom": 0.0, "top": high, "center": high / 2}[vertical]
    return Box(left, bottom, left + wide, bottom + high)


def _along(start: Point, end: Point) -> list[Point]:
    count = ceil(hypot(end[0] - start[0], end[1] - start[1]) / ROUTE_STEP) or 1
    return [
        (start[0] + (end[0] - start[0]) * k / count, start[1] + (end[1] - start[1]) * k / count)
        for k in range(count)
    ]


def _unit(x: float, y: float) -> Point:
    length = hypot(x, y)
    return (x / length, y / length) if length else (0.0, 0.0)
