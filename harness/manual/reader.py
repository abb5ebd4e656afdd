"""Reads aircraft/NAME/flight-manual.xml. Every fault has its file and line; one reading reports them all."""

from functools import lru_cache, partial
from pathlib import Path

from harness import resources
from harness.errors import InputError, InputErrors, did_you_mean
from harness.loading.envelope import read_envelope
from harness.manual.model import FlapSetting, FlightManual, Numbers, PropertySetting, SpeedRule
from harness.plan_reader import Words, check_emergencies, check_plans, read_emergency, read_phase
from harness.units import Quantity, UnitError, parse, parse_any, parse_quantity, parse_speed
from harness.xml_source import NAN, Element, Source, children

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


def read_manual(aircraft: str | Path) -> FlightManual:
    """Read and check the flight manual of an aircraft given by name, or a manual's file given as a Path.

    A file that has not changed is not read again: a flight of ten seconds would spend 3 % of its time on it. Raises
    InputErrors naming file and line of everything wrong in it.
    """
    file = _manual_file(aircraft)
    return _read(file, file.stat().st_mtime_ns if file.is_file() else 0)


@lru_cache(maxsize=8)
def _read(file: Path, changed: int) -> FlightManual:  # noqa: ARG001  `changed` is part of the key
    source = Source(file, "flight-manual.xsd", "flight-manual")
    source.validate()
    root = source.root
    gains = {
        element.get("name", ""): source.read(element, "value", parse_quantity, Quantity(NAN, ""))
        for element in _entries(source, "gains")
    }
    balance = source.one(root, "balance", needed=False)
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
            {name: gain.value for name, gain in gains.items()},
        ),
        phases={
            element.get("name", ""): read_phase(source, element) for element in _entries(source, "phases")
        },
        source_path=source.path,
        gain_units={name: gain.unit for name, gain in gains.items()},
        configurations={
            element.get("name", ""): _choices(source, element)
            for element in _entries(source, "configurations", needed=False)
        },
        failures={
            element.get("name", ""): _property_setting(source, element)
            for element in _entries(source, "failures", needed=False)
        },
        balance=None if balance is None else read_envelope(source, balance),
        emergencies=tuple(
            read_emergency(source, element) for element in _entries(source, "emergencies", needed=False)
        ),
    )
    source.finish()
    words = words_of(manual)
    faults = [
        *_cross_references(manual, source),
        *check_plans(manual.phases.values(), words),
        *check_emergencies(manual.emergencies, words),
    ]
    if faults:
        raise InputErrors(faults)
    return manual


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


def _entries(source: Source, section: str, *, needed: bool = True) -> list[Element]:
    parent = source.one(source.root, section, needed=needed)
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


def _choices(source: Source, element: Element) -> dict[str, PropertySetting]:
    choices = list(children(element, "choice"))
    source.distinct(choices, "name")
    return {choice.get("name", ""): _property_setting(source, choice) for choice in choices}


def _property_setting(source: Source, element: Element) -> PropertySetting:
    file, line = source.place(element)
    return PropertySetting(
        element.get("property", ""),
        source.quantity(element, "value", "ratio"),
        file,
        line or 0,
        element.get("inner-modes") == "yes",
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
