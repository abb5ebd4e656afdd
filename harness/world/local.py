"""A flat map around a point, for taxiways and runways: good to a centimetre within 3 km."""

from itertools import pairwise
from math import atan2, cos, hypot, radians, sin, sqrt

from harness.world.earth import ECCENTRICITY_SQUARED, SEMI_MAJOR_AXIS

Point = tuple[float, float]


class LocalFrame:
    """North and east of an origin on the plane that touches the WGS 84 ellipsoid there. Radians and metres."""

    def __init__(self, latitude: float, longitude: float) -> None:
        self.latitude = latitude
        self.longitude = longitude
        e2 = ECCENTRICITY_SQUARED
        w = 1.0 - e2 * sin(latitude) ** 2
        self._north = SEMI_MAJOR_AXIS * (1.0 - e2) / (w * sqrt(w))  # meridian radius of curvature
        self._east = SEMI_MAJOR_AXIS / sqrt(w) * cos(latitude)  # radius of the parallel

    def point(self, latitude: float, longitude: float) -> Point:
        """Return (north, east) in metres."""
        return (latitude - self.latitude) * self._north, (longitude - self.longitude) * self._east


def filleted(corners: list[Point], radius: float, spacing: float = 1.0) -> list[Point]:
    """Round the corners of a polyline with arcs and return points `spacing` metres apart along it.

    An arc takes `radius`, or less where the neighbouring straights are too short for it.
    """
    path = [corners[0]]
    for i in range(1, len(corners) - 1):
        path.extend(_arc(corners[i - 1], corners[i], corners[i + 1], radius, spacing))
    path.append(corners[-1])
    return _spaced(path, spacing)


def _arc(before: Point, corner: Point, after: Point, radius: float, spacing: float) -> list[Point]:
    length_in, length_out = _distance(before, corner), _distance(corner, after)
    azimuth_in, azimuth_out = _azimuth(before, corner), _azimuth(corner, after)
    turn = (azimuth_out - azimuth_in + radians(180)) % radians(360) - radians(180)
    half = abs(turn) / 2
    if half < radians(1) or half > radians(85):
        return [corner]
    tangent = min(radius * sin(half) / cos(half), 0.49 * length_in, 0.49 * length_out)
    radius = tangent * cos(half) / sin(half)
    side = 1.0 if turn > 0 else -1.0
    start = (corner[0] - tangent * cos(azimuth_in), corner[1] - tangent * sin(azimuth_in))
    centre = (start[0] - side * radius * sin(azimuth_in), start[1] + side * radius * cos(azimuth_in))
    count = max(2, int(abs(turn) * radius / spacing))
    points = []
    for k in range(count + 1):
        azimuth = azimuth_in + turn * k / count
        points.append((centre[0] + side * radius * sin(azimuth), centre[1] - side * radius * cos(azimuth)))
    return points


def _spaced(path: list[Point], spacing: float) -> list[Point]:
    points = [path[0]]
    for a, b in pairwise(path):
        length = _distance(a, b)
        count = int(length / spacing)
        points.extend(
            (a[0] + (b[0] - a[0]) * k / count, a[1] + (b[1] - a[1]) * k / count) for k in range(1, count)
        )
        if length > 0.0:
            points.append(b)
    return points


def _distance(a: Point, b: Point) -> float:
    return hypot(b[0] - a[0], b[1] - a[1])


def _azimuth(a: Point, b: Point) -> float:
    return atan2(b[1] - a[1], b[0] - a[0])
