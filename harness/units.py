"""Units at the doors: text with a unit in, SI floats inside, text with a unit out.

Inside the house every number is SI (metres, seconds, kilograms, pascals, kelvins) and radians. The
constants are multiplied in and divided out: `250 * KT`, `state.altitude / FT`.

Sources: foot, nautical mile, pound: international agreement (NIST SP 811, appendix B); knot: NM per hour.
"""

import math
import re
from typing import Literal, NamedTuple

FT = 0.3048
NM = 1852.0
KM = 1000.0
KT = NM / 3600
KMH = KM / 3600
MIN = 60.0
HOUR = 3600.0
FPM = FT / MIN
DEG = math.pi / 180
RPM = 2 * math.pi / MIN
LB = 0.45359237
TONNE = 1000.0
HPA = 100.0
INHG = 3386.389
KN = 1000.0
KW = 1000.0
G0 = 9.80665

FLIGHT_LEVEL = 100 * FT
LONGEST_TEXT = 100  # characters: no quantity needs more


class UnitError(ValueError):
    """A text that is not the quantity wanted; the message says what would be. Readers add file and line."""


class Kind(NamedTuple):
    """A kind of quantity: how it reads in a sentence, an example, its units, the largest credible value."""

    noun: str
    example: str
    units: dict[str, float]
    largest: float


KINDS: dict[str, Kind] = {
    "length": Kind("a length", "120 m", {"m": 1.0, "km": KM, "ft": FT, "NM": NM}, 5e7),
    "speed": Kind("a speed", "130 m/s", {"m/s": 1.0, "kt": KT, "km/h": KMH}, 2000.0),
    "airspeed": Kind("an airspeed", "130 m/s CAS", {"m/s": 1.0, "kt": KT, "km/h": KMH}, 2000.0),
    "vertical-speed": Kind("a vertical speed", "500 ft/min", {"m/s": 1.0, "ft/min": FPM}, 500.0),
    "mass": Kind("a mass", "100 t", {"kg": 1.0, "t": TONNE, "lb": LB}, 1e6),
    "angle": Kind("an angle", "15 deg", {"deg": DEG, "rad": 1.0}, 20.0),
    "direction": Kind("a direction", "148 deg true", {"deg": DEG, "rad": 1.0}, 20.0),
    "angular-speed": Kind("an angular speed", "3 deg/s", {"deg/s": DEG, "rad/s": 1.0, "rpm": RPM}, 1e4),
    "pressure": Kind("a pressure", "1013.25 hPa", {"Pa": 1.0, "hPa": HPA, "inHg": INHG}, 1e7),
    "temperature-difference": Kind("a temperature difference", "10 K", {"K": 1.0}, 200.0),
    "time": Kind("a time", "12 s", {"s": 1.0, "min": MIN, "h": HOUR}, 1e6),
    "frequency": Kind("a rate", "0.5 1/s", {"1/s": 1.0}, 1e4),
    "acceleration": Kind("an acceleration", "2 m/s2", {"m/s2": 1.0, "g": G0}, 1000.0),
    "force": Kind("a force", "400 kN", {"N": 1.0, "kN": KN}, 1e8),
    "power": Kind("a power", "7971 kW", {"W": 1.0, "kW": KW}, 1e9),
    "area": Kind("an area", "221.5 m2", {"m2": 1.0}, 1e5),
    "count": Kind("a count", "2", {"": 1.0}, 1e6),
    "ratio": Kind("a number without unit", "0.5", {"": 1.0, "%": 0.01}, 1e6),
}
FACTORS: dict[str, float] = {unit: factor for kind in KINDS.values() for unit, factor in kind.units.items()}

SpeedKind = Literal["CAS", "TAS", "MACH"]
LevelKind = Literal["FL", "ALT"]

_NUMBER = re.compile(r"([+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)[ \t]*(.*)", re.ASCII)
_MACH = re.compile(r"M[ \t]?([0-9]+\.?[0-9]*|\.[0-9]+)", re.ASCII)
_FLIGHT_LEVEL = re.compile(r"FL[ \t]?([0-9]{1,3})", re.ASCII)


class Quantity(NamedTuple):
    """A value and its unit, both SI."""

    value: float
    unit: str


class Speed(NamedTuple):
    """An airspeed with its kind: value in m/s, or the Mach number itself."""

    kind: SpeedKind
    value: float

    def __str__(self) -> str:
        return f"M{self.value:.3g}" if self.kind == "MACH" else f"{self.value / KT:.0f} kt {self.kind}"


class Level(NamedTuple):
    """A level to fly: a flight level (pressure altitude) or an altitude above mean sea level, in metres."""

    kind: LevelKind
    altitude: float

    def __str__(self) -> str:
        if self.kind == "FL":
            return f"FL{self.altitude / FLIGHT_LEVEL:.0f}"
        return f"{self.altitude / FT:.0f} ft"


def parse(text: str, kind: str) -> float:
    """The SI value of `text`, such as "12 t", which must be a quantity of `kind` (a key of KINDS).

    Raises UnitError: not a number, no unit, a unit of another kind, or beyond anything that flies.
    """
    wanted = KINDS[kind]
    number, unit = _split(text, f"{wanted.noun} is wanted, e.g. {wanted.example}")
    if unit not in wanted.units:
        raise UnitError(_wrong_unit(text, number, unit, wanted))
    return _credible(text, number * wanted.units[unit], wanted)


def parse_any(text: str) -> float:
    """The SI value of a number with any unit or none; units may be divided: "0.5 deg/m". For gains."""
    number, unit = _split(text, "a number is wanted, with a unit if it has one, e.g. 12 s")
    factor = FACTORS.get(unit)
    if factor is None:
        above, _, below = unit.partition("/")
        if above not in FACTORS or below not in FACTORS or not below:
            raise UnitError(
                f'"{text}": the unit "{unit}" is not known; known are {", ".join(filter(None, FACTORS))}'
            )
        factor = FACTORS[above] / FACTORS[below]
    if not math.isfinite(number * factor):
        raise UnitError(f'"{text}" is not a finite number')
    return number * factor


def parse_quantity(text: str) -> Quantity:
    """As `parse_any`, with the SI unit: "3 deg/s" is in rad/s, a number without unit in "". Raises UnitError."""
    value = parse_any(text)
    _, unit = _split(text, "")
    above, _, below = (unit, "", "") if unit in FACTORS else unit.partition("/")
    return Quantity(value, f"{_si_unit(above)}/{_si_unit(below)}" if below else _si_unit(above))


def _si_unit(unit: str) -> str:
    kind = next(kind for kind in KINDS.values() if unit in kind.units)
    return next(name for name, factor in kind.units.items() if factor == 1.0)


def parse_speed(text: str) -> Speed:
    """An airspeed whose kind is said: "130 m/s CAS", "250 kt TAS", "M0.4". Raises UnitError."""
    mach = _MACH.fullmatch(text.strip())
    if mach:
        return Speed("MACH", _positive(text, _credible(text, float(mach[1]), KINDS["ratio"], 5.0)))
    words = text.split()
    if words and words[-1] in ("CAS", "TAS"):
        kind: SpeedKind = "CAS" if words[-1] == "CAS" else "TAS"
        return Speed(kind, _positive(text, parse(" ".join(words[:-1]), "airspeed")))
    parse(text, "airspeed")
    raise UnitError(f'"{text}" does not say which airspeed; write {text.strip()} CAS or {text.strip()} TAS')


def parse_level(text: str) -> Level:
    """A level: "FL230" is a pressure altitude, "5000 ft" is above mean sea level. Raises UnitError."""
    flight_level = _FLIGHT_LEVEL.fullmatch(text.strip())
    if flight_level:
        return Level("FL", float(flight_level[1]) * FLIGHT_LEVEL)
    try:
        return Level("ALT", parse(text, "length"))
    except UnitError:
        raise UnitError(f'"{_short(text)}" is not a level; write e.g. FL230 or 5000 ft') from None


def parse_direction(text: str) -> tuple[float, bool]:
    """A direction, "148 deg magnetic", as (radians in [0, 2 pi), True if magnetic). Raises UnitError."""
    words = text.split()
    if not words or words[-1] not in ("true", "magnetic"):
        parse(text, "direction")
        raise UnitError(
            f'"{text}" does not say from which north; write {text.strip()} true or {text.strip()} magnetic'
        )
    angle = parse(" ".join(words[:-1]), "direction")
    if not 0 <= angle <= 2 * math.pi + 1e-9:
        raise UnitError(f'"{text}": a direction lies between 0 deg and 360 deg')
    return angle % (2 * math.pi), words[-1] == "magnetic"


def show(value: float, unit: str, digits: int = 0) -> str:
    """An SI value at the door: `show(1524, "ft")` is "5,000 ft"."""
    return f"{value / FACTORS[unit]:,.{digits}f} {unit}".rstrip()


def _split(text: str, wanted: str) -> tuple[float, str]:
    found = _NUMBER.fullmatch(text.strip()) if len(text) <= LONGEST_TEXT else None
    if not found:
        raise UnitError(f'"{_short(text)}" is not a number; {wanted}')
    return float(found[1]), found[2].strip()


def _wrong_unit(text: str, number: float, unit: str, wanted: Kind) -> str:
    example = f"{number:g} {next(iter(wanted.units))}".strip()
    if not unit:
        unit = wanted.example.partition(" ")[2]
        return f'"{text}" has no unit; {wanted.noun} is wanted, e.g. {number:g} {unit}'
    for kind in KINDS.values():
        if unit in kind.units:
            return f'"{_short(text)}" is {kind.noun}; {wanted.noun} is wanted, e.g. {wanted.example}'
    if wanted.units.keys() == KINDS["ratio"].units.keys():
        return f'"{_short(text)}": a number without unit is wanted, e.g. {example}'
    known = ", ".join(filter(None, wanted.units))
    return f'"{_short(text)}": the unit "{_short(unit)}" is not known for {wanted.noun}; known are {known}'


def _credible(text: str, value: float, kind: Kind, largest: float | None = None) -> float:
    if not abs(value) <= (largest or kind.largest):
        raise UnitError(
            f'"{_short(text)}" is beyond anything that flies; {kind.noun} is wanted, e.g. {kind.example}'
        )
    return value


def _positive(text: str, value: float) -> float:
    if value <= 0:
        raise UnitError(f'"{text}": an airspeed is more than zero')
    return value


def _short(text: str, most: int = 60) -> str:
    return text if len(text) <= most else text[: most - 3] + "..."
