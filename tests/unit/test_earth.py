"""Geodesics against geographiclib, the implementation of the method's author."""

from math import pi, tau

import numpy as np
import pytest
from geographiclib.geodesic import Geodesic
from hypothesis import given
from hypothesis import strategies as st

from harness.units import DEG
from harness.world import earth

COLOGNE = (50.8659 * DEG, 7.1427 * DEG)
MUNICH = (48.3538 * DEG, 11.7861 * DEG)
MICROMETRE = 1e-6


def test_cologne_to_munich_is_what_geographiclib_says():
    authority = Geodesic.WGS84.Inverse(50.8659, 7.1427, 48.3538, 11.7861)
    azimuth_1, azimuth_2, distance = earth.inverse(*COLOGNE, *MUNICH)
    assert distance == pytest.approx(authority["s12"], abs=MICROMETRE)
    assert azimuth_1 == pytest.approx(authority["azi1"] * DEG, abs=1e-12)
    assert azimuth_2 == pytest.approx(authority["azi2"] * DEG, abs=1e-12)


@given(st.floats(-80, 80), st.floats(-180, 180), st.floats(0, 360), st.floats(0, 2e6))
def test_direct_is_what_geographiclib_says_and_inverse_undoes_it(latitude, longitude, azimuth, distance):
    authority = Geodesic.WGS84.Direct(latitude, longitude, azimuth, distance)
    reached = earth.direct(latitude * DEG, longitude * DEG, azimuth * DEG, distance)
    assert reached[0] == pytest.approx(authority["lat2"] * DEG, abs=1e-12)
    assert (reached[1] - authority["lon2"] * DEG + pi) % tau - pi == pytest.approx(0, abs=1e-11)
    _, _, back = earth.inverse(latitude * DEG, longitude * DEG, *reached)
    assert back == pytest.approx(distance, abs=MICROMETRE)


def test_azimuths_are_never_negative():
    west, _, _ = earth.inverse(*MUNICH, *COLOGNE)
    assert pi < west < tau


@pytest.mark.parametrize("along", [-20e3, -300.0, 0.0, 300.0, 20e3, 150e3])
@pytest.mark.parametrize("across", [-5000.0, -3.0, 0.0, 3.0, 5000.0])
def test_offset_is_the_foot_and_the_length_of_the_perpendicular(along, across):
    course = 148 * DEG
    foot = earth.direct(*COLOGNE, course, along)
    _, course_at_foot, distance = earth.inverse(*COLOGNE, *foot)
    if along < 0:
        course_at_foot -= pi
    if distance == 0:
        course_at_foot = course
    beside = earth.direct(*foot, course_at_foot + pi / 2, across)
    found_along, found_across = earth.offset(*COLOGNE, course, *beside)
    assert found_across == pytest.approx(across, abs=1e-3, rel=3e-3)
    assert found_along == pytest.approx(along, abs=1.0, rel=1e-4)


def test_offsets_of_arrays_are_the_offsets_of_their_points():
    latitudes = np.linspace(COLOGNE[0], MUNICH[0], 7)
    longitudes = np.linspace(COLOGNE[1], MUNICH[1], 7)
    along, across = earth.offsets(*COLOGNE, 2.3, latitudes, longitudes)
    expected = [earth.offset(*COLOGNE, 2.3, *point) for point in zip(latitudes, longitudes, strict=True)]
    np.testing.assert_allclose(np.column_stack((along, across)), expected, atol=1e-9)
