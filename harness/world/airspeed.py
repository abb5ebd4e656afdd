"""Subsonic conversions between Mach number, calibrated, true and equivalent airspeed. m/s, Pa and K.

Calibrated airspeed is what an error-free indicator shows: impact pressure through the sea-level relation.

Source: NACA Report 837 (W. S. Aiken, 1946), isentropic pitot relations, with the constants of ISO 2533.
"""

from math import sqrt

from harness.world.atmosphere import SEA_LEVEL_PRESSURE, SEA_LEVEL_SOUND, speed_of_sound


def impact_pressure(mach: float, pressure: float) -> float:
    """Return total minus static pressure in Pa at a Mach number below 1."""
    ratio: float = (1.0 + 0.2 * mach * mach) ** 3.5
    return pressure * (ratio - 1.0)


def _mach_from_impact(impact_pressure: float, pressure: float) -> float:
    ratio: float = (impact_pressure / pressure + 1.0) ** (2.0 / 7.0)
    return sqrt(5.0 * (ratio - 1.0))


def cas_from_mach(mach: float, pressure: float) -> float:
    """Return the calibrated airspeed in m/s at a Mach number and static pressure."""
    return SEA_LEVEL_SOUND * _mach_from_impact(impact_pressure(mach, pressure), SEA_LEVEL_PRESSURE)


def mach_from_cas(cas: float, pressure: float) -> float:
    """Return the Mach number at a calibrated airspeed and static pressure."""
    return _mach_from_impact(impact_pressure(cas / SEA_LEVEL_SOUND, SEA_LEVEL_PRESSURE), pressure)


def tas_from_mach(mach: float, temperature: float) -> float:
    """Return the true airspeed in m/s at a Mach number and static temperature."""
    return mach * speed_of_sound(temperature)


def mach_from_tas(tas: float, temperature: float) -> float:
    """Return the Mach number at a true airspeed and static temperature."""
    return tas / speed_of_sound(temperature)


def tas_from_cas(cas: float, pressure: float, temperature: float) -> float:
    """Return the true airspeed in m/s at a calibrated airspeed, static pressure and temperature."""
    return tas_from_mach(mach_from_cas(cas, pressure), temperature)


def cas_from_tas(tas: float, pressure: float, temperature: float) -> float:
    """Return the calibrated airspeed in m/s at a true airspeed, static pressure and temperature."""
    return cas_from_mach(mach_from_tas(tas, temperature), pressure)


def eas_from_mach(mach: float, pressure: float) -> float:
    """Return the equivalent airspeed in m/s: the sea-level speed with the same dynamic pressure."""
    return SEA_LEVEL_SOUND * mach * sqrt(pressure / SEA_LEVEL_PRESSURE)
