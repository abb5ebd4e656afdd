"""The International Standard Atmosphere from -2 to 20 km, and the same air on a warmer or colder day.

Altitudes are geopotential metres unless a name says otherwise. On a non-standard day the temperature of every
level is shifted by `isa_deviation` kelvin; the pressure of a *pressure altitude* does not move.

Source: ISO 2533:1975, Standard atmosphere, sections 2 and 4.
"""

from math import exp, log, sqrt

SEA_LEVEL_PRESSURE = 101_325.0  # Pa
SEA_LEVEL_TEMPERATURE = 288.15  # K
GRAVITY = 9.80665  # m/s2
GAS_CONSTANT = 287.05287  # of air, J/(kg K)
HEAT_RATIO = 1.4
LAPSE_RATE = 0.0065  # K/m up to the tropopause
TROPOPAUSE = 11_000.0  # m
EARTH_RADIUS = 6_356_766.0  # nominal, for geopotential altitude only, m

SEA_LEVEL_DENSITY = SEA_LEVEL_PRESSURE / (GAS_CONSTANT * SEA_LEVEL_TEMPERATURE)
SEA_LEVEL_SOUND = sqrt(HEAT_RATIO * GAS_CONSTANT * SEA_LEVEL_TEMPERATURE)

_TROPOPAUSE_TEMPERATURE = SEA_LEVEL_TEMPERATURE - LAPSE_RATE * TROPOPAUSE
_EXPONENT = GRAVITY / (GAS_CONSTANT * LAPSE_RATE)
_TROPOPAUSE_PRESSURE: float = (
    SEA_LEVEL_PRESSURE * (_TROPOPAUSE_TEMPERATURE / SEA_LEVEL_TEMPERATURE) ** _EXPONENT
)
_SCALE_HEIGHT = GAS_CONSTANT * _TROPOPAUSE_TEMPERATURE / GRAVITY  # above the tropopause, m


def temperature(altitude: float, isa_deviation: float = 0.0) -> float:
    """Return the temperature in K at a pressure altitude."""
    return SEA_LEVEL_TEMPERATURE - LAPSE_RATE * min(altitude, TROPOPAUSE) + isa_deviation


def pressure(altitude: float) -> float:
    """Return the static pressure in Pa at a pressure altitude."""
    if altitude > TROPOPAUSE:
        return _TROPOPAUSE_PRESSURE * exp((TROPOPAUSE - altitude) / _SCALE_HEIGHT)
    ratio: float = (1.0 - LAPSE_RATE * altitude / SEA_LEVEL_TEMPERATURE) ** _EXPONENT
    return SEA_LEVEL_PRESSURE * ratio


def pressure_altitude(pressure: float) -> float:
    """Return the altitude in m at which the standard atmosphere has `pressure` (Pa)."""
    if pressure < _TROPOPAUSE_PRESSURE:
        return TROPOPAUSE - _SCALE_HEIGHT * log(pressure / _TROPOPAUSE_PRESSURE)
    ratio: float = (pressure / SEA_LEVEL_PRESSURE) ** (1.0 / _EXPONENT)
    return SEA_LEVEL_TEMPERATURE / LAPSE_RATE * (1.0 - ratio)


def density(altitude: float, isa_deviation: float = 0.0) -> float:
    """Return the density in kg/m3 at a pressure altitude."""
    return pressure(altitude) / (GAS_CONSTANT * temperature(altitude, isa_deviation))


def speed_of_sound(temperature: float) -> float:
    """Return the speed of sound in m/s in air of `temperature` (K)."""
    return sqrt(HEAT_RATIO * GAS_CONSTANT * temperature)


def geopotential(geometric: float) -> float:
    """Return the geopotential altitude in m of a geometric altitude in m."""
    return EARTH_RADIUS * geometric / (EARTH_RADIUS + geometric)


def geometric(geopotential: float) -> float:
    """Return the geometric altitude in m of a geopotential altitude in m."""
    return EARTH_RADIUS * geopotential / (EARTH_RADIUS - geopotential)
