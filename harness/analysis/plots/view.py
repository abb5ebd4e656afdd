"""The part of the world a map shows, and its scale. A map is a plane chart, true at its middle latitude."""

from collections.abc import Iterable
from math import cos
from typing import NamedTuple

from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import FancyArrowPatch

from harness.analysis.plots.look import INK
from harness.units import DEG, KM, NM

DEGREE = 60 * NM  # of latitude, m
SMALLEST = 12 * KM
MARGIN = 0.08  # of the route's extent on each side, for the names
FLATTEST, STEEPEST = 0.45, 1.15  # height over width: a route in one line would leave no room for its names
LENGTHS = (200, 100, 50, 20, 10, 5, 2, 1)  # of scale bars
LONGEST_BAR = 1.5  # inches

Point = tuple[float, float]  # longitude, latitude


class View(NamedTuple):
    """The map's edges in degrees, and how much longer a degree of latitude is than one of longitude."""

    west: float
    east: float
    south: float
    north: float
    stretch: float

    @property
    def width(self) -> float:
        """Metres from edge to edge."""
        return (self.east - self.west) / self.stretch * DEGREE

    @property
    def steepness(self) -> float:
        """Height over width on the paper."""
        return (self.north - self.south) * self.stretch / (self.east - self.west)

    def holds(self, latitude: float, longitude: float) -> bool:
        """Whether a point (rad) is on the map."""
        return self.west < longitude / DEG < self.east and self.south < latitude / DEG < self.north

    def on_paper(self, point: Point, width: float) -> Point:
        """Return where a point (deg) lies from the south-west corner of a map of some width, in its unit."""
        scale = width / (self.east - self.west)
        return (point[0] - self.west) * scale, (point[1] - self.south) * self.stretch * scale


def view_of(points: Iterable[Point]) -> View:
    """Return the view that holds all points (deg) with a margin."""
    longitudes, latitudes = zip(*points, strict=True)
    west, east, south, north = min(longitudes), max(longitudes), min(latitudes), max(latitudes)
    stretch = 1.0 / cos((south + north) / 2 * DEG)
    wide = max((east - west) * (1 + 2 * MARGIN) / stretch, SMALLEST / DEGREE)
    high = max((north - south) * (1 + 2 * MARGIN), FLATTEST * wide)
    wide = max(wide, high / STEEPEST) * stretch
    x, y = (west + east) / 2, (south + north) / 2
    return View(x - wide / 2, x + wide / 2, y - high / 2, y + high / 2, stretch)


def draw_scale(figure: Figure, view: View, width: float, corner: Point) -> None:
    """Draw a bar of kilometres over one of nautical miles and north above them, on the bare figure.

    `width` is that of the map and `corner` the lower left of the drawing, inches.
    """
    left, low = corner
    wide, high = figure.get_size_inches()
    for unit, name, y in ((KM, "km", low + 0.16), (NM, "NM", low)):
        count = next((length for length in LENGTHS if length * unit / view.width * width < LONGEST_BAR), 1)
        right = left + count * unit / view.width * width
        bar = Line2D([left / wide, right / wide], [y / high] * 2, color=INK, linewidth=2.5)
        bar.set_solid_capstyle("butt")
        figure.add_artist(bar)
        figure.text((right + 0.08) / wide, y / high, f"{count} {name}", va="center", fontsize=8)
    figure.text((left + 0.08) / wide, (low + 0.72) / high, "N", ha="center", va="bottom", weight="bold")
    foot, head = (low + 0.32) / high, (low + 0.7) / high
    x = (left + 0.08) / wide
    figure.add_artist(FancyArrowPatch((x, foot), (x, head), arrowstyle="-|>", mutation_scale=9, color=INK))
