"""Airspeeds against closed forms of other authors and against limits that hold exactly."""

from math import sqrt

import pytest
from hypothesis import given
from hypothesis import strategies as st

from harness.units import FT, KT
from harness.world import airspeed, atmosphere


@pytest.mark.parametrize("speed", [0.0, 1.0, 70.0, 200.0, 340.0])
def test_at_sea_level_on_a_standard_day_all_speeds_are_the_same(speed):
    pressure, temperature = atmosphere.pressure(0), atmosphere.temperature(0)
    assert airspeed.tas_from_cas(speed, pressure, temperature) == pytest.approx(speed, abs=1e-9)
    mach = airspeed.mach_from_cas(speed, pressure)
    assert airspeed.eas_from_mach(mach, pressure) == pytest.approx(speed, abs=1e-9)


def test_mach_0_4_at_fl230_is_170_knots_calibrated():
    # NACA 837 worked by hand: p/p0 at 23 000 ft 0.404 64, qc/p0 = 0.404 64 (1.032^3.5 - 1) = 0.047 162
    by_hand = 661.479 * sqrt(5 * (1.047162 ** (2 / 7) - 1))
    cas = airspeed.cas_from_mach(0.4, atmosphere.pressure(23_000 * FT)) / KT
    assert cas == pytest.approx(by_hand, abs=0.05)
    assert round(cas) == 170


@pytest.mark.parametrize(("cas_kt", "mach"), [(300, 0.78), (280, 0.76), (250, 0.7), (170, 0.4)])
def test_speeds_meet_at_the_crossover_altitude(cas_kt, mach):
    # EUROCONTROL, User Manual for BADA 3.12, 3.1: the pressure at which a CAS and a Mach number meet
    a0 = atmosphere.SEA_LEVEL_SOUND
    ratio = ((1 + 0.2 * (cas_kt * KT / a0) ** 2) ** 3.5 - 1) / ((1 + 0.2 * mach**2) ** 3.5 - 1)
    pressure = ratio * atmosphere.SEA_LEVEL_PRESSURE
    assert airspeed.cas_from_mach(mach, pressure) == pytest.approx(cas_kt * KT, rel=1e-12)
    assert airspeed.mach_from_cas(cas_kt * KT, pressure) == pytest.approx(mach, rel=1e-12)


def test_slow_air_is_incompressible():
    pressure, temperature = atmosphere.pressure(3000), atmosphere.temperature(3000)
    eas = 10 * sqrt(atmosphere.density(3000) / atmosphere.density(0))
    assert airspeed.cas_from_tas(10, pressure, temperature) == pytest.approx(eas, rel=1e-4)


@given(st.floats(0.0, 0.95), st.floats(-2000, 20_000), st.floats(-40, 40))
def test_every_conversion_undoes_its_inverse(mach, altitude, deviation):
    pressure, temperature = atmosphere.pressure(altitude), atmosphere.temperature(altitude, deviation)
    cas = airspeed.cas_from_mach(mach, pressure)
    tas = airspeed.tas_from_mach(mach, temperature)
    assert airspeed.mach_from_cas(cas, pressure) == pytest.approx(mach, abs=1e-7)
    assert airspeed.mach_from_tas(tas, temperature) == pytest.approx(mach, abs=1e-12)
    assert airspeed.tas_from_cas(cas, pressure, temperature) == pytest.approx(tas, abs=1e-4)
    assert airspeed.cas_from_tas(tas, pressure, temperature) == pytest.approx(cas, abs=1e-4)
    assert airspeed.eas_from_mach(mach, pressure) == pytest.approx(
        tas * sqrt(pressure / (atmosphere.GAS_CONSTANT * temperature) / atmosphere.SEA_LEVEL_DENSITY),
        abs=1e-4,
    )
