"""Geodesics and straight lines on the WGS 84 ellipsoid. Radians, metres; azimuths clockwise from true north.

Heights above mean sea level serve as heights above the ellipsoid: the geoid moves station and aircraft alike.

Source: C. F. F. Karney, Algorithms for geodesics, J. Geodesy 87 (2013), as implemented in PROJ;
NIMA TR-8350.2 (ellipsoid; sec. 4.3 geodetic to Cartesian).
"""

from math import asin, atan2, cos, sin, sqrt, tau

import numpy as np
from numpy.typing import NDArray
from pyproj import Geod

MEAN_RADIUS = 6_371_008.8  # (2a + b) / 3, m
EFFECTIVE_RADIUS = (
    MEAN_RADIUS * 4 / 3
)  # of the Earth a radio wave sees, m. Source: ITU-R P.834, standard refraction

SEMI_MAJOR_AXIS = 6_378_137.0  # m
ECCENTRICITY_SQUARED = 0.006_694_379_990_141_3
_POLAR = 1.0 - ECCENTRICITY_SQUARED

_WGS84 = Geod(ellps="WGS84")

Floats = NDArray[np.float64]


def direct(latitude: float, longitude: float, azimuth: float, distance: float) -> tuple[float, float]:
    """Return (latitude, longitude) reached after `distance` metres on the geodesic leaving at `azimuth`."""
    reached = _WGS84.fwd(longitude, latitude, azimuth, distance, radians=True)
    return reached[1], reached[0]


def inverse(
    latitude_1: float, longitude_1: float, latitude_2: float, longitude_2: float
) -> tuple[float, float, float]:
    """Return (azimuth at 1, azimuth at 2, distance) of the geodesic from 1 to 2.

    Both azimuths point forward, from 1 towards 2, in [0, 2 pi).
    """
    azimuth_1, azimuth_2, distance = _WGS84.inv(
        longitude_1, latitude_1, longitude_2, latitude_2, radians=True, return_back_azimuth=False
    )
    return azimuth_1 % tau, azimuth_2 % tau, distance


def offset(
    latitude: float, longitude: float, azimuth: float, latitude_2: float, longitude_2: float
) -> tuple[float, float]:
    """Return (along, across) in m: where point 2 lies on the line from point 1 at `azimuth`, across right.

    The triangle is solved on the mean sphere, with distance and azimuth to point 2 from the ellipsoid: exact
    on the line itself, and within 0.3 % of `across` beside it.
    """
    azimuth_2, _, distance = inverse(latitude, longitude, latitude_2, longitude_2)
    return beside(distance, azimuth_2 - azimuth)


def beside(distance: float, angle: float) -> tuple[float, float]:
    """Return (along, across) of a point at `distance` and `angle` off a line: the right triangle on the mean sphere."""
    arc = distance / MEAN_RADIUS
    return (
        MEAN_RADIUS * atan2(sin(arc) * cos(angle), cos(arc)),
        MEAN_RADIUS * asin(sin(arc) * sin(angle)),
    )


def offsets(
    latitude: float, longitude: float, azimuth: float, latitudes: Floats, longitudes: Floats
) -> tuple[Floats, Floats]:
    """Return (along, across) for arrays of points: see `offset`."""
    azimuths, _, distances = _WGS84.inv(
        np.full_like(longitudes, longitude),
        np.full_like(latitudes, latitude),
        longitudes,
        latitudes,
        radians=True,
    )
    arc = distances / MEAN_RADIUS
    turn = azimuths - azimuth
    return (
        MEAN_RADIUS * np.arctan2(np.sin(arc) * np.cos(turn), np.cos(arc)),
        MEAN_RADIUS * np.arcsin(np.sin(arc) * np.sin(turn)),
    )


class Frame:
    """East, north and up at a point: how an antenna there sees an aircraft along a straight line."""

    __slots__ = ("_east", "_north", "_origin", "_up")

    def __init__(self, latitude: float, longitude: float, height: float) -> None:
        """Stand at a geodetic position (rad, rad, m)."""
        sin_latitude, cos_latitude = sin(latitude), cos(latitude)
        sin_longitude, cos_longitude = sin(longitude), cos(longitude)
        self._origin = cartesian(latitude, longitude, height)
        self._east = (-sin_longitude, cos_longitude)
        self._north = (-sin_latitude * cos_longitude, -sin_latitude * sin_longitude, cos_latitude)
        self._up = (cos_latitude * cos_longitude, cos_latitude * sin_longitude, sin_latitude)

    def locate(self, latitude: float, longitude: float, height: float) -> tuple[float, float, float]:
        """Return (east, north, up) of a geodetic position, m."""
        x, y, z = cartesian(latitude, longitude, height)
        x0, y0, z0 = self._origin
        x, y, z = x - x0, y - y0, z - z0
        east_x, east_y = self._east
        north_x, north_y, north_z = self._north
        up_x, up_y, up_z = self._up
        return (
            east_x * x + east_y * y,
            north_x * x + north_y * y + north_z * z,
            up_x * x + up_y * y + up_z * z,
        )


def cartesian(latitude: float, longitude: float, height: float) -> tuple[float, float, float]:
    """Return the Earth-fixed (x, y, z) of a geodetic position, m."""
    sin_latitude = sin(latitude)
    normal = SEMI_MAJOR_AXIS / sqrt(1.0 - ECCENTRICITY_SQUARED * sin_latitude * sin_latitude)
    from_axis = (normal + height) * cos(latitude)
    return from_axis * cos(longitude), from_axis * sin(longitude), (normal * _POLAR + height) * sin_latitude
