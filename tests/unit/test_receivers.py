"""The receivers against geodesics and Earth-fixed coordinates from pyproj."""

from math import hypot, pi, tan, tau

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Transformer

from harness.navigation import database
from harness.navigation.database import Ils
from harness.navigation.receivers import adf, course_deviation, dme, glide_slope, ils_dme, localizer, vor
from harness.numerics import wrap
from harness.units import DEG, FT, NM
from harness.world import earth

NAV = database.load()
COL, NSN, RID = NAV.station("COL"), NAV.station("NSN"), NAV.station("RID")
ILS = Ils(NAV.runway("EDDM", "26L"))
RUNWAY = ILS.runway
CARTESIAN = Transformer.from_crs("EPSG:4979", "EPSG:4978")
A_HUNDREDTH_DEGREE = 0.01 * DEG

azimuths = st.floats(0, 360)
distances = st.floats(500, 200e3)
heights = st.floats(0, 11e3)


def straight_line(*positions):
    """Distance between two positions by PROJ's Earth-fixed coordinates, m."""
    one, two = (CARTESIAN.transform(lat / DEG, lon / DEG, height) for lat, lon, height in positions)
    return hypot(*(a - b for a, b in zip(one, two, strict=True)))


@given(azimuths, distances, heights)
def test_a_vor_shows_the_magnetic_radial_of_the_geodesic(azimuth, distance, height):
    position = earth.direct(COL.latitude, COL.longitude, azimuth * DEG, distance)
    reading = vor(COL, *position, height)
    assert wrap(reading.radial - (azimuth * DEG - COL.declination)) == pytest.approx(
        0, abs=A_HUNDREDTH_DEGREE
    )
    assert wrap(reading.bearing - reading.radial - pi) == pytest.approx(0, abs=1e-12)
    assert 0 <= reading.radial < tau
    assert 0 <= reading.bearing < tau


def test_a_vor_is_received_within_the_line_of_sight():
    # 1.23 (sqrt 5000 + sqrt 328) = 109.3 NM from Ried at 5 000 ft
    inside = earth.direct(RID.latitude, RID.longitude, 1.0, 108 * NM)
    outside = earth.direct(RID.latitude, RID.longitude, 1.0, 111 * NM)
    assert vor(RID, *inside, 5000 * FT).received
    assert not vor(RID, *outside, 5000 * FT).received
    assert vor(RID, *outside, 6000 * FT).received


@pytest.mark.parametrize(
    ("radial", "course", "angle", "to"),
    [
        (150, 148, 2, False),  # beyond the station, right of the course
        (330, 148, -2, True),  # ahead of the station: radial 330 is 2 degrees left of the line to it
        (326, 148, 2, True),
        (1, 359, 2, False),
        (58, 148, -90, False),
        (180, 1, 1, True),
    ],
)
def test_the_course_needle_shows_side_and_direction(radial, course, angle, to):
    needle = course_deviation(radial * DEG, course * DEG)
    assert needle.angle / DEG == pytest.approx(angle)
    assert needle.to is to


@given(st.floats(-60e3, 60e3), st.floats(-5e3, 5e3))
def test_the_course_needle_times_distance_is_the_cross_track(along, across):
    course = 148 * DEG
    foot = earth.direct(RID.latitude, RID.longitude, course + RID.declination, along)
    _, at_foot, there = earth.inverse(RID.latitude, RID.longitude, *foot)
    onward = at_foot if along > 0 else at_foot + pi
    position = earth.direct(*foot, (onward if there > 1 else course + RID.declination) + pi / 2, across)
    _, _, distance = earth.inverse(RID.latitude, RID.longitude, *position)
    if abs(along) > 100:
        needle = course_deviation(vor(RID, *position, 0).radial, course)
        assert needle.to is (along < 0)
        assert tan(needle.angle) * abs(along) == pytest.approx(across, abs=0.01 * distance + 1)


@given(azimuths, distances, st.floats(0, 360))
def test_an_adf_points_at_the_ndb(azimuth, distance, heading):
    position = earth.direct(NSN.latitude, NSN.longitude, azimuth * DEG, distance)
    towards, _, _ = earth.inverse(*position, NSN.latitude, NSN.longitude)
    relative = adf(NSN, *position, heading * DEG)
    assert wrap(relative - (towards - heading * DEG)) == pytest.approx(0, abs=A_HUNDREDTH_DEGREE)
    assert -pi <= relative <= pi


@given(azimuths, st.floats(0, 200e3), heights)
def test_a_dme_shows_the_straight_line(azimuth, distance, height):
    position = earth.direct(COL.latitude, COL.longitude, azimuth * DEG, distance)
    expected = straight_line((*position, height), (COL.latitude, COL.longitude, COL.elevation))
    assert dme(COL, *position, height).distance == pytest.approx(expected, abs=1e-3)


def test_overhead_a_dme_shows_the_height():
    reading = dme(COL, COL.latitude, COL.longitude, COL.elevation + 6076 * FT)
    assert reading.distance == pytest.approx(1 * NM, abs=0.1)


@pytest.mark.parametrize("distance", [0.0, 2 * NM, 10 * NM, 20 * NM])
def test_the_localizer_is_centred_on_the_extended_centreline(distance):
    position = RUNWAY.point(-distance)
    reading = localizer(ILS, *position)
    assert reading.deviation == pytest.approx(0, abs=1e-5)
    assert reading.received


@pytest.mark.parametrize("across", [-350, -175, 175, 350])
def test_the_localizer_shows_one_dot_for_each_175_feet_at_the_threshold(across):
    reading = localizer(ILS, *RUNWAY.point(0, across * FT))
    assert reading.dots == pytest.approx(across / 175, rel=1e-3)


@pytest.mark.parametrize(
    ("along", "across", "received"),
    [
        (-24 * NM + 4300, 0, True),
        (-26 * NM, 0, False),
        (-10 * NM, 10 * NM * tan(20 * DEG), True),
        (-20 * NM, 20 * NM * tan(20 * DEG), False),
        (-10 * NM, 10 * NM * tan(50 * DEG), False),
        (6000, 0, False),
    ],
)
def test_the_localizer_covers_the_sectors_of_annex_10(along, across, received):
    assert localizer(ILS, *RUNWAY.point(along, across)).received is received


def test_the_glide_path_crosses_the_threshold_at_15_metres():
    reading = glide_slope(ILS, RUNWAY.latitude, RUNWAY.longitude, RUNWAY.elevation + 15)
    assert reading.deviation == pytest.approx(0, abs=0.01 * DEG)


@pytest.mark.parametrize("distance", [1 * NM, 3 * NM, 5 * NM, 10 * NM])
@pytest.mark.parametrize("above", [-0.7, -0.35, 0.0, 0.35, 0.7])
def test_the_glide_slope_shows_two_dots_at_0_7_degrees(distance, above):
    # the straight line at the angle, above a sea level that falls away by d^2 / 2R
    height = distance * tan((3 + above) * DEG) + distance**2 / (2 * earth.MEAN_RADIUS)
    reading = glide_slope(ILS, *RUNWAY.point(ILS.aim_distance - distance), ILS.aim_elevation + height)
    assert reading.deviation / DEG == pytest.approx(above, abs=0.005)
    assert reading.dots == pytest.approx(above / 0.35, abs=0.015)
    assert reading.received


@pytest.mark.parametrize(("along", "across"), [(1000, 0), (-16 * NM, 0), (-5 * NM, 5 * NM * tan(9 * DEG))])
def test_the_glide_slope_is_not_received_outside_its_sector(along, across):
    assert not glide_slope(ILS, *RUNWAY.point(along, across), 1000).received


def test_the_dme_of_the_ils_stands_abeam_the_aim_point():
    position = RUNWAY.point(ILS.aim_distance)
    assert ils_dme(ILS, *position, ILS.aim_elevation).distance == pytest.approx(120, abs=0.1)
