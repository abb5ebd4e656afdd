"""The atmosphere against the tables of ISO 2533:1975 (table 5: geopotential altitude)."""

import pytest

from harness.world import atmosphere

# geopotential altitude m, temperature K, pressure Pa, density kg/m3
ISO_2533 = [
    (-2000, 301.15, 127_774, 1.47808),
    (0, 288.15, 101_325, 1.22500),
    (1000, 281.65, 89_874.6, 1.11164),
    (5000, 255.65, 54_019.9, 0.736116),
    (10_000, 223.15, 26_436.3, 0.412707),
    (11_000, 216.65, 22_632.1, 0.363918),
    (15_000, 216.65, 12_044.6, 0.193674),
    (20_000, 216.65, 5_474.89, 0.0880349),
]
SIX_DIGITS = 6e-6


@pytest.mark.parametrize(("altitude", "temperature", "pressure", "density"), ISO_2533)
def test_the_standard_day_is_that_of_iso_2533(altitude, temperature, pressure, density):
    assert atmosphere.temperature(altitude) == pytest.approx(temperature, abs=1e-9)
    assert atmosphere.pressure(altitude) == pytest.approx(pressure, rel=SIX_DIGITS)
    assert atmosphere.density(altitude) == pytest.approx(density, rel=SIX_DIGITS)


def test_the_speed_of_sound_at_sea_level_is_that_of_iso_2533():
    assert pytest.approx(340.294, abs=5e-4) == atmosphere.SEA_LEVEL_SOUND


@pytest.mark.parametrize("altitude", [-2000.0, 0.0, 1.0, 7010.4, 10_999.9, 11_000.0, 11_000.1, 20_000.0])
def test_pressure_altitude_undoes_pressure(altitude):
    assert atmosphere.pressure_altitude(atmosphere.pressure(altitude)) == pytest.approx(altitude, abs=1e-6)


def test_pressure_is_smooth_through_the_tropopause():
    below, above = atmosphere.pressure(11_000 - 1e-3), atmosphere.pressure(11_000 + 1e-3)
    assert below > above
    assert below - above == pytest.approx(2e-3 * atmosphere.density(11_000) * atmosphere.GRAVITY, rel=1e-4)


def test_a_warm_day_shifts_every_temperature_and_thins_the_air():
    assert atmosphere.temperature(5000, 15.0) == atmosphere.temperature(5000) + 15.0
    assert atmosphere.density(5000, 15.0) < atmosphere.density(5000)


def test_geopotential_altitude_is_that_of_iso_2533():
    # geometric 11 019 m is geopotential 11 000 m, 20 063 m is 20 000 m
    assert atmosphere.geometric(11_000) == pytest.approx(11_019, abs=0.5)
    assert atmosphere.geometric(20_000) == pytest.approx(20_063, abs=0.5)
    assert atmosphere.geopotential(atmosphere.geometric(7010.4)) == pytest.approx(7010.4, abs=1e-9)
