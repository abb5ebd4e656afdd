"""The condition of a test as it stands in the guide: `mass=110 t; level=FL230; speed=M0.40`."""

from dataclasses import dataclass, fields
from typing import Any

from harness.units import Level, Speed, UnitError, parse, parse_level, parse_speed
from harness.world.airspeed import cas_from_tas, tas_from_cas, tas_from_mach
from harness.world.atmosphere import pressure, temperature

SEA_LEVEL = Level("ALT", 0.0)
SLOW = Speed("CAS", 77.0)


@dataclass(frozen=True)
class Condition:
    """Configuration and flight condition of a test; each manoeuvre reads what it needs. SI."""

    mass: float = 100e3
    fuel: float | None = None  # None: as the bench likes
    payload: float = 0.0
    reserve: float = 0.0  # fuel left at the end
    level: Level = SEA_LEVEL
    end: Level = SEA_LEVEL
    speed: Speed = SLOW
    flap: float = 0.0
    gear: float = 0.0
    lever: float = 1.0
    step: float = 1.0  # the lever after a step
    failed: int = 0  # 0 none, else engine 1..4
    bank: float = 0.0
    isa: float = 0.0
    screen: float = 35.0
    ratio: float = 1.0
    augmented: float = 0.0

    @property
    def altitude(self) -> float:
        """The pressure altitude, m."""
        return self.level.altitude

    @property
    def tas(self) -> float:
        """The true airspeed, m/s."""
        return self.tas_at(self.altitude)

    @property
    def cas(self) -> float:
        """The calibrated airspeed, m/s."""
        return cas_from_tas(self.tas, pressure(self.altitude), temperature(self.altitude, self.isa))

    def tas_at(self, altitude: float) -> float:
        """The true airspeed of this condition's speed at another altitude, m/s."""
        air = pressure(altitude), temperature(altitude, self.isa)
        if self.speed.kind == "MACH":
            return tas_from_mach(self.speed.value, air[1])
        return self.speed.value if self.speed.kind == "TAS" else tas_from_cas(self.speed.value, *air)

    @property
    def growth(self) -> float:
        """How the true airspeed grows with height at this condition's speed, 1/s."""
        return (self.tas_at(self.altitude + 10.0) - self.tas_at(self.altitude - 10.0)) / 20.0


KINDS = {
    "mass": "mass",
    "fuel": "mass",
    "payload": "mass",
    "reserve": "mass",
    "flap": "ratio",
    "gear": "ratio",
    "lever": "ratio",
    "step": "ratio",
    "failed": "count",
    "bank": "angle",
    "isa": "temperature-difference",
    "screen": "length",
    "ratio": "ratio",
    "augmented": "ratio",
}


def read(text: str) -> Condition:
    """A condition from `key=value` pairs with units. Raises UnitError that says which pair and why."""
    values: dict[str, Any] = {}
    known = {field.name for field in fields(Condition)}
    for pair in filter(None, (part.strip() for part in text.split(";"))):
        key, _, value = (part.strip() for part in pair.partition("="))
        if key not in known:
            raise UnitError(f'"{key}" is not a part of a condition; known are {", ".join(sorted(known))}')
        if key in values:
            raise UnitError(f'"{key}" stands there twice')
        if key in ("level", "end"):
            values[key] = parse_level(value)
        elif key == "speed":
            values[key] = parse_speed(value)
        else:
            number = parse(value, KINDS[key])
            values[key] = int(number) if key == "failed" else number
    return Condition(**values)
