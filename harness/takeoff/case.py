"""One take-off as it is asked for, and whether it can be asked for."""

from cmath import phase
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import pi
from typing import Literal

from harness.errors import InputError, InputErrors, did_you_mean
from harness.manual import FlightManual, read_manual
from harness.mission.envelope import SLOWEST_DECISION
from harness.mission.model import STANDARD_QNH, Environment, Loading
from harness.navigation.database import Runway
from harness.units import DEG, FT, HPA, KT, show
from harness.world import earth

Surface = Literal["dry", "wet"]
Start = Literal["brakes-held", "rolling"]
FIXED_VR = 62.5  # m/s CAS: reproduces both distances of the paper, see docs/takeoff.md
SCHEDULED_RATIO = (
    1.08  # VR over the power-off stall speed; estimate: V2 of 1.13 is reached by 35 ft, engines all running
)
LEAST_FUEL = 2e3  # kg, estimate: below it the feed tanks are near what no engine can draw
FUEL = 10e3  # kg, estimate: a short flight of this class; the payload makes up the mass
RANGES: dict[str, tuple[float, float, str, float, str]] = {
    "isa_deviation": (-60.0, 45.0, "K", 1.0, "--isa-deviation"),
    "qnh": (850.0, 1090.0, "hPa", HPA, "--qnh"),
    "elevation": (-1500.0, 15000.0, "ft", FT, "--elevation"),
    "headwind": (-15.0, 40.0, "kt", KT, "--wind"),
    "crosswind": (-20.0, 20.0, "kt", KT, "--wind"),
    "slope": (-3.0, 3.0, "%", 0.01, "--slope"),
}
"""What is credible on a runway: lowest, highest, their unit and its factor, the option it comes from."""


@dataclass(frozen=True)
class TakeOff:
    """A take-off: SI and radians. `vr` None is the scheduled one, in proportion to the stall speed.

    `friction` is a factor on the rolling friction.
    Headwind is positive against the take-off, crosswind positive from the right, slope positive uphill.
    The pilot rotates at the first of his steps at or above VR: with 30 a second up to 2 m late, with 120 half a metre.
    Besides that, distances with 30 frames a second are those with 480 within 3 m (tested): what a trade study needs;
    `fine` is for one whose numbers are searched or compared.
    """

    mass: float
    vr: float | None = FIXED_VR
    start: Start = "brakes-held"
    flaps: str = "take-off"
    isa_deviation: float = 0.0
    qnh: float = STANDARD_QNH
    elevation: float = 0.0
    headwind: float = 0.0
    crosswind: float = 0.0
    slope: float = 0.0
    surface: Surface = "dry"
    friction: float = 1.0
    heading: float = 0.0
    rate: int = 30
    pilot_rate: int = 30
    aircraft: str = "gta"

    @property
    def environment(self) -> Environment:
        """The day, as a mission has it."""
        wind = complex(self.headwind, self.crosswind)
        return Environment(self.isa_deviation, self.qnh, (self.heading + phase(wind)) % (2 * pi), abs(wind))

    def rotation_speed(self, manual: FlightManual) -> float:
        """VR in m/s CAS."""
        return SCHEDULED_RATIO * manual.stall_speed(self.mass, self.flaps) if self.vr is None else self.vr

    def loading(self, manual: FlightManual) -> Loading:
        """FUEL in the tanks, more if the payload would be too heavy, less if the aircraft would be."""
        limits = manual.limits
        fuel = max(
            self.mass - limits["maximum-zero-fuel-mass"],
            min(FUEL, self.mass - limits["operating-empty-mass"]),
        )
        return Loading(self.mass, None, fuel)

    def runway(self, length: float) -> Runway:
        """A level runway of that length in the middle of Germany, at this elevation and heading."""
        latitude, longitude = 50.87 * DEG, 7.14 * DEG
        end_latitude, end_longitude = earth.direct(latitude, longitude, self.heading, length)
        return Runway(
            "take-off",
            "study",
            latitude,
            longitude,
            self.elevation,
            self.heading,
            length,
            60.0,
            "asphalt",
            end_latitude,
            end_longitude,
            self.elevation,
        )


def fine(case: TakeOff) -> TakeOff:
    """The case with at least 120 frames and with 120 pilot steps a second: V1 and VR are met within 0.03 m/s."""
    return replace(case, rate=max(case.rate, 120), pilot_rate=120)


@dataclass(frozen=True)
class Happening:
    """What goes wrong in a take-off, and what the pilot does about it. Speeds are in m/s CAS.

    The engine fails at `vef`; without it none does. At `v1` the take-off is rejected, with full brakes and, if asked,
    reverse; without it the take-off is continued, at `v2` by pitch if that is given. `steering` False leaves the nose
    wheel free, as CS 25.149(e) wants it; `slow_down` slows the aircraft down once it is up, banked towards the live
    engines with full rudder, as CS 25.149(b) wants it.
    """

    vef: float | None = None
    v1: float | None = None
    v2: float | None = None
    reverse: bool = False
    gear_up: bool = True
    steering: bool = True
    slow_down: bool = False
    engine: str = "engine 1"


NOTHING = Happening()


def lightest(manual: FlightManual) -> float:
    """The least take-off mass, kg: empty with some fuel, or what the aircraft may fly with."""
    limits = manual.limits
    return max(limits["minimum-flight-mass"], limits["operating-empty-mass"] + LEAST_FUEL)


def check(case: TakeOff, manual: FlightManual) -> None:
    """Raise InputErrors with everything about `case` that cannot be flown."""
    faults = [*_faults(case, manual)]
    if faults:
        raise InputErrors(faults)


def check_all(cases: Sequence[TakeOff]) -> None:
    """Check the take-offs of one aircraft before the first of them flies. Raises InputErrors."""
    manual = read_manual(cases[0].aircraft)
    for case in cases:
        check(case, manual)


def _faults(case: TakeOff, manual: FlightManual) -> Iterator[InputError]:
    if case.flaps not in {setting.name for setting in manual.flaps}:
        known = [setting.name for setting in manual.flaps]
        yield InputError(
            f'{manual.aircraft} has no flap setting "{case.flaps}"',
            file="--flaps",
            remedy=did_you_mean(case.flaps, known),
        )
        return
    for name, (low, high, unit, factor, option) in RANGES.items():
        value = getattr(case, name)
        if not low * factor <= value <= high * factor:
            yield InputError(
                f"{value / factor:g} {unit} is outside what a take-off is flown in",
                file=option,
                remedy=f"it lies between {low:g} {unit} and {high:g} {unit}",
            )
    limits = manual.limits
    low, high = lightest(manual), limits["maximum-take-off-mass"]
    if not low <= case.mass <= high:
        yield InputError(
            f"a take-off mass of {show(case.mass, 't', 1)} is outside the limits of {manual.aircraft}",
            file="--mass",
            remedy=f"from {show(low, 't', 1)} to {show(high, 't', 1)}",
        )
        return
    yield from _speed_faults(case, manual)


def _speed_faults(case: TakeOff, manual: FlightManual) -> Iterator[InputError]:
    vr = case.rotation_speed(manual)
    slowest = SLOWEST_DECISION * manual.stall_speed(case.mass, case.flaps)
    fastest = manual.flap(case.flaps).maximum_speed
    told = f"VR of {vr:.1f} m/s ({show(vr, 'kt')})"
    if vr > fastest:
        yield InputError(
            f"{told} is above {show(fastest, 'kt')}, the limit with flaps {case.flaps}",
            file="--vr",
            remedy=_why_not_140(vr) or f"the study's value is {FIXED_VR} m/s",
        )
    elif vr < slowest:
        yield InputError(
            f"{told} is below {show(slowest, 'kt')}: at {show(case.mass, 't', 1)} the wings do not carry",
            file="--vr",
            remedy="faster, or a smaller mass",
        )


def _why_not_140(vr: float) -> str:
    """What is wrong with the paper's rotation speed, if it is that which was asked for."""
    if not 139.0 <= vr <= 141.0:
        return ""
    return (
        "the paper prints 140 m/s, but its 972 m would then take 1.03 g on average, three times the thrust there is. "
        f"{FIXED_VR} m/s reproduces both of its distances; 140 kt is 13 to 21 % too long"
    )
