"""The navigation receivers: what each shows at a position, the ideal reading of the geometry.

Positions are geodetic (rad, rad, m above mean sea level). Radio waves go straight, so bearings, slant ranges
and elevation angles are those of the straight line between the antennas. A reading carries `received`: inside
the line of sight and the coverage or not. The number is the ideal one in any case, so that a controller never
sees a jump. Deviations say where the aircraft is: positive right of the course flown, above the glide path.
"""

from math import atan2, cos, hypot, pi, sin, sqrt, tau
from typing import NamedTuple

from harness.navigation.database import Ils, Station
from harness.numerics import wrap
from harness.units import DEG, NM
from harness.world.earth import EFFECTIVE_RADIUS

DOTS_FULL_SCALE = 2.0
LOCALIZER_COVERAGE = ((10 * DEG, 25 * NM), (35 * DEG, 17 * NM))  # Source: ICAO Annex 10 Vol. I, 3.1.3.3.1
GLIDE_SECTOR = 8 * DEG  # each side of the centreline. Source: ICAO Annex 10 Vol. I, 3.1.5.3.1
GLIDE_RANGE = 15 * NM  # estimate: Annex 10 asks for at least 10 NM; signals are used further out


class VorReading(NamedTuple):
    """Magnetic angles in [0, 2 pi), with the station's own declination."""

    radial: float  # from the station
    bearing: float  # to the station: the reciprocal of the radial
    received: bool


class CourseDeviation(NamedTuple):
    """The needle of a course deviation indicator set to a course."""

    angle: float  # rad, in [-pi/2, pi/2], positive: aircraft right of the course line when flying the course
    to: bool  # True: the course leads to the station, False: away from it


class DmeReading(NamedTuple):
    """Slant range in metres."""

    distance: float
    received: bool


class NeedleReading(NamedTuple):
    """A localizer or glide-slope needle."""

    deviation: float  # rad, positive: aircraft right of the course, above the path
    dots: float  # 2 is full scale; not limited
    received: bool


def vor(station: Station, latitude: float, longitude: float, altitude: float) -> VorReading:
    """Read radial and bearing of a VOR, VORTAC or TACAN."""
    east, north, _ = station.antenna.locate(latitude, longitude, altitude)
    radial = (atan2(east, north) - station.declination) % tau
    received = hypot(east, north) <= horizon(station.elevation) + horizon(altitude)
    return VorReading(radial, (radial + pi) % tau, received)


def course_deviation(radial: float, course: float) -> CourseDeviation:
    """Compare a VOR's radial with a selected course; both magnetic at the station."""
    from_course = wrap(radial - course)
    if abs(from_course) <= pi / 2:
        return CourseDeviation(from_course, to=False)
    return CourseDeviation(wrap(pi - from_course), to=True)


def adf(station: Station, latitude: float, longitude: float, heading: float) -> float:
    """Read the bearing of an NDB relative to the nose, in [-pi, pi), positive right. `heading` is true."""
    east, north, _ = station.antenna.locate(latitude, longitude, station.elevation)
    # North at the aircraft is turned against north at the station by the convergence of the meridians.
    convergence = (longitude - station.longitude) * sin(0.5 * (latitude + station.latitude))
    return wrap(atan2(-east, -north) + convergence - heading)


def dme(station: Station, latitude: float, longitude: float, altitude: float) -> DmeReading:
    """Read the slant range to a station with DME."""
    distance = hypot(*station.antenna.locate(latitude, longitude, altitude))
    return DmeReading(distance, distance <= horizon(station.elevation) + horizon(altitude))


def vor_dme(station: Station, latitude: float, longitude: float, altitude: float) -> tuple[float, float]:
    """Read the magnetic radial and the slant range of a station that has both, as `vor` and `dme` would."""
    east, north, up = station.antenna.locate(latitude, longitude, altitude)
    return (atan2(east, north) - station.declination) % tau, sqrt(east * east + north * north + up * up)


def ils_dme(ils: Ils, latitude: float, longitude: float, altitude: float) -> DmeReading:
    """Read the DME of the ILS: slant range to the glide-slope antenna."""
    distance = hypot(*ils.glide_antenna.locate(latitude, longitude, altitude))
    return DmeReading(distance, distance <= horizon(ils.aim_elevation) + horizon(altitude))


def localizer(ils: Ils, latitude: float, longitude: float) -> NeedleReading:
    """Read the localizer needle. Not received behind the antenna, where the sense would be reversed."""
    east, north, _ = ils.localizer_antenna.locate(latitude, longitude, ils.runway.end_elevation)
    deviation = wrap(ils.course_at_localizer - atan2(-east, -north))
    off, distance = abs(deviation), hypot(east, north)
    (narrow, far), (wide, near) = LOCALIZER_COVERAGE
    received = (off <= narrow and distance <= far) or (off <= wide and distance <= near)
    return NeedleReading(deviation, deviation / ils.localizer_full_scale * DOTS_FULL_SCALE, received)


def glide_slope(ils: Ils, latitude: float, longitude: float, altitude: float) -> NeedleReading:
    """Read the glide-slope needle: elevation angle above the runway's aim point, along the centreline.

    The wave goes straight while sea level falls away beneath it, so an aircraft on the path flies higher than
    distance times tan(angle): by 27 m at 10 NM. Not received past the aim point.
    """
    east, north, up = ils.aim.locate(latitude, longitude, altitude)
    sin_course, cos_course = sin(ils.course), cos(ils.course)
    to_go = -(east * sin_course + north * cos_course)
    across = east * cos_course - north * sin_course
    deviation = atan2(up, to_go) - ils.GLIDE_ANGLE
    received = abs(atan2(across, to_go)) <= GLIDE_SECTOR and to_go <= GLIDE_RANGE
    return NeedleReading(deviation, deviation / ils.GLIDE_FULL_SCALE * DOTS_FULL_SCALE, received)


def horizon(height: float) -> float:
    """Return the distance in m to the radio horizon of a smooth Earth: 1.23 sqrt(h) in NM and feet."""
    return sqrt(2.0 * EFFECTIVE_RADIUS * height) if height > 0.0 else 0.0
