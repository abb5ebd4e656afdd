"""The flight manual: limits, flaps, thrust settings, speeds, gains and phases of one type of aircraft.

Its file is aircraft/NAME/flight-manual.xml; another aircraft is another file. A mission may change speeds and
phases for its own flight (`FlightManual.with_mission`).
"""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from math import sqrt
from pathlib import Path
from typing import NamedTuple, Protocol

from harness import resources
from harness.errors import InputError, InputErrors, did_you_mean
from harness.plan import Checklist, Condition, PhasePlan, Step
from harness.plan_reader import Words, check_plans, read_phase
from harness.units import G0, Speed, UnitError, parse, parse_any, parse_speed
from harness.world.atmosphere import SEA_LEVEL_DENSITY
from harness.xml_source import NAN, Element, Source, children

__all__ = [
    "Checklist",
    "Condition",
    "FlapSetting",
    "FlightManual",
    "PhasePlan",
    "SpeedRule",
    "Step",
    "read_manual",
]

LIMITS: dict[str, str] = {
    "VMO": "cas",
    "VLO": "cas",
    "MMO": "mach",
    "maximum-altitude": "length",
    "maximum-take-off-mass": "mass",
    "maximum-landing-mass": "mass",
    "maximum-zero-fuel-mass": "mass",
    "minimum-flight-mass": "mass",
    "operating-empty-mass": "mass",
    "fuel-capacity": "mass",
    "maximum-bank": "angle",
    "minimum-load-factor": "ratio",
    "maximum-load-factor": "ratio",
    "wing-area": "area",
    "tail-clearance-pitch": "angle",
}
"""Limits every manual states, with their kind of quantity; a manual may state more."""


class FlapSetting(NamedTuple):
    """A flap setting: position 0 up .. 1 landing, highest airspeed (m/s CAS), power-off lift coefficient."""

    name: str
    position: float
    maximum_speed: float
    maximum_lift_coefficient: float


class SpeedRule(NamedTuple):
    """A named speed: fixed (`cas`, m/s), or `stall_ratio` times the stall speed with `flaps`, `plus` m/s."""

    name: str
    cas: float | None = None
    stall_ratio: float = 0.0
    flaps: str = ""
    plus: float = 0.0


class Numbers(dict[str, float]):
    """Numbers by name, from one file. A name that is not there is refused with an InputError that says which are."""

    def __init__(self, what: str, file: Path, numbers: Mapping[str, float]) -> None:
        super().__init__(numbers)
        self._what = what
        self._file = file

    def __missing__(self, name: str) -> float:
        raise _unknown(self._file, self._what, name, self)


class Changes(Protocol):
    """What a mission may change in the manual."""

    @property
    def speeds(self) -> dict[str, Speed]: ...
    @property
    def phases(self) -> dict[str, PhasePlan]: ...


@dataclass(frozen=True)
class FlightManual:
    """What a pilot looks up. SI and radians; MMO is a Mach number; thrust settings are levers, -1..1."""

    aircraft: str
    limits: Mapping[str, float]
    flaps: tuple[FlapSetting, ...]
    thrust: Mapping[str, float]
    speeds: Mapping[str, SpeedRule]
    gains: Mapping[str, float]
    phases: Mapping[str, PhasePlan]
    source_path: Path

    def flap(self, name: str) -> FlapSetting:
        """The flap setting of that name. Raises InputError."""
        for setting in self.flaps:
            if setting.name == name:
                return setting
        raise _unknown(self.source_path, "flap setting", name, [setting.name for setting in self.flaps])

    def stall_speed(self, mass: float, flaps: str) -> float:
        """The power-off 1-g stall speed in m/s CAS at `mass` (kg). CAS is taken as EAS: it is, when slow.

        Source: lift equals weight, CS 25.103.
        """
        lift = self.limits["wing-area"] * self.flap(flaps).maximum_lift_coefficient * SEA_LEVEL_DENSITY / 2
        return sqrt(mass * G0 / lift)

    def speed(self, name: str, mass: float) -> float:
        """A named speed in m/s CAS at `mass` (kg). Raises InputError for a name the manual does not have."""
        rule = self.speeds.get(name)
        if rule is None:
            raise _unknown(self.source_path, "speed", name, self.speeds)
        if rule.cas is not None:
            return rule.cas
        return rule.stall_ratio * self.stall_speed(mass, rule.flaps) + rule.plus

    def with_mission(self, mission: Changes) -> "FlightManual":
        """This manual with the mission's speeds and phases in place of its own."""
        speeds = {name: SpeedRule(name, cas=speed.value) for name, speed in mission.speeds.items()}
        phases = dict(self.phases)
        for name, change in mission.phases.items():
            phases[name] = phases.get(name, PhasePlan(name, (), ())).changed_by(change)
        return replace(self, speeds={**self.speeds, **speeds}, phases=phases)


def read_manual(aircraft: str | Path) -> FlightManual:
    """Read and check the flight manual of an aircraft given by name, or a manual's file given as a Path.

    Raises InputErrors naming file and line of everything wrong in it.
    """
    source = Source(_manual_file(aircraft), "flight-manual.xsd", "flight-manual")
    source.validate()
    root = source.root
    manual = FlightManual(
        aircraft=root.get("aircraft", ""),
        limits=_limits(source),
        flaps=tuple(_flap(source, element) for element in _entries(source, "flaps")),
        thrust=Numbers(
            "thrust setting",
            source.path,
            {
                element.get("name", ""): _ratio(source, element, "lever")
                for element in _entries(source, "thrust")
            },
        ),
        speeds={element.get("name", ""): _speed(source, element) for element in _entries(source, "speeds")},
        gains=Numbers(
            "gain",
            source.path,
            {
                element.get("name", ""): source.read(element, "value", parse_any, NAN)
                for element in _entries(source, "gains")
            },
        ),
        phases={
            element.get("name", ""): read_phase(source, element) for element in _entries(source, "phases")
        },
        source_path=source.path,
    )
    source.finish()
    faults = [*_cross_references(manual, source), *check_plans(manual.phases.values(), words_of(manual))]
    if faults:
        raise InputErrors(faults)
    return manual


def _unknown(file: Path, what: str, name: str, known: Iterable[str]) -> InputError:
    return InputError(f'has no {what} "{name}"', file=file, remedy=did_you_mean(name, known))


def _manual_file(aircraft: str | Path) -> Path:
    if isinstance(aircraft, Path):
        return aircraft
    known = resources.aircraft()
    if aircraft not in known:
        raise InputError(f'there is no aircraft "{aircraft}"', remedy=did_you_mean(aircraft, known))
    return known[aircraft].with_name("flight-manual.xml")


def words_of(manual: FlightManual) -> Words:
    """The names of this manual that its steps and conditions may use."""
    limits = {name: kind for name, kind in LIMITS.items() if name in manual.limits}
    speeds = {*manual.speeds, *(name for name, kind in limits.items() if kind == "cas")}
    return Words(
        frozenset(speeds), frozenset(manual.thrust), frozenset(setting.name for setting in manual.flaps)
    )


def _entries(source: Source, section: str) -> list[Element]:
    parent = source.one(source.root, section)
    if parent is None:
        return []
    entries = list(children(parent))
    source.distinct(entries, "name")
    return entries


def _ratio(source: Source, element: Element, attribute: str) -> float:
    source.needed(element, attribute, "0.5")
    return source.quantity(element, attribute, "ratio")


def _limits(source: Source) -> dict[str, float]:
    elements = {element.get("name", ""): element for element in _entries(source, "limits")}
    for name in sorted(LIMITS.keys() - elements.keys()):
        what = f'<limits> has no limit "{name}"'
        source.fault(what, source.root, remedy=f'add <limit name="{name}" value="..."/>')
    return {
        name: source.read(element, "value", partial(_limit, LIMITS.get(name)), NAN)
        for name, element in elements.items()
    }


def _limit(kind: str | None, text: str) -> float:
    if kind == "cas":
        return _cas(text)
    if kind == "mach":
        speed = parse_speed(text)
        if speed.kind != "MACH":
            raise UnitError(f'"{text}" is not a Mach number; write e.g. M0.72')
        return speed.value
    return parse_any(text) if kind is None else parse(text, kind)


def _cas(text: str) -> float:
    speed = parse_speed(text)
    if speed.kind != "CAS":
        raise UnitError(f'"{text}" is not a calibrated airspeed; write e.g. 300 kt CAS')
    return speed.value


def _flap(source: Source, element: Element) -> FlapSetting:
    source.needed(element, "maximum-speed", "200 kt CAS")
    return FlapSetting(
        element.get("name", ""),
        _ratio(source, element, "position"),
        source.read(element, "maximum-speed", _cas, NAN),
        _ratio(source, element, "maximum-lift-coefficient"),
    )


def _speed(source: Source, element: Element) -> SpeedRule:
    name = element.get("name", "")
    fixed, ratio = element.get("value") is not None, element.get("stall-ratio") is not None
    if fixed == ratio:
        source.fault(
            f'the speed "{name}" needs either a value or a stall-ratio',
            element,
            remedy='write value="121 kt CAS", or stall-ratio="1.23" flaps="landing"',
        )
    if fixed:
        return SpeedRule(name, cas=source.read(element, "value", _cas, NAN))
    if ratio and element.get("flaps") is None:
        source.fault(
            f'the speed "{name}" has a stall-ratio but no flaps', element, remedy='add flaps="landing"'
        )
    return SpeedRule(
        name,
        stall_ratio=source.quantity(element, "stall-ratio", "ratio"),
        flaps=element.get("flaps", ""),
        plus=source.quantity(element, "plus", "speed", 0.0),
    )


def _cross_references(manual: FlightManual, source: Source) -> list[InputError]:
    """Speeds that name unknown flaps, and values no aircraft has."""
    flaps = {setting.name for setting in manual.flaps}
    for element in source.root.iterfind("speeds/speed[@stall-ratio]"):
        if element.get("flaps") not in flaps:
            name = element.get("flaps", "")
            source.fault(f'flaps="{name}" is not a flap setting', element, remedy=did_you_mean(name, flaps))
    for element in source.root.iterfind("flaps/setting"):
        setting = manual.flap(element.get("name", ""))
        if setting.maximum_lift_coefficient <= 0 or not 0 <= setting.position <= 1:
            source.fault(
                f'flap setting "{setting.name}" needs a lift coefficient above 0 and a position from 0 to 1',
                element,
            )
    for element in source.root.iterfind("thrust/setting"):
        if not -1 <= manual.thrust[element.get("name", "")] <= 1:
            source.fault(f'thrust setting "{element.get("name")}" has its lever outside -1 .. 1', element)
    for element in source.root.iterfind("limits/limit"):
        if LIMITS.get(element.get("name", "")) in ("mass", "cas", "area", "length", "mach") and not (
            manual.limits[element.get("name", "")] > 0
        ):
            source.fault(f'the limit "{element.get("name")}" must be more than zero', element)
    return source.faults
