"""Text with a unit becomes SI; anything else is refused with what would be right."""

import math

import pytest

from harness import units
from harness.units import DEG, FT, KT, NM, Level, Speed, UnitError


@pytest.mark.parametrize(
    ("text", "kind", "value"),
    [
        ("120 m", "length", 120.0),
        ("5000 ft", "length", 1524.0),
        ("45 NM", "length", 83340.0),
        ("100 t", "mass", 100_000.0),
        ("1 lb", "mass", 0.45359237),
        ("36 km/h", "speed", 10.0),
        ("500 ft/min", "vertical-speed", 2.54),
        ("1013.25 hPa", "pressure", 101325.0),
        ("29.92 inHg", "pressure", 101320.7),
        ("-15 K", "temperature-difference", -15.0),
        ("90 deg", "angle", math.pi / 2),
        ("3 deg/s", "angular-speed", 3 * DEG),
        ("842 rpm", "angular-speed", 88.174),
        ("2 min", "time", 120.0),
        ("0.5", "ratio", 0.5),
        ("50 %", "ratio", 0.5),
        ("1.5e2kN", "force", 150_000.0),
        ("  12   s ", "time", 12.0),
    ],
)
def test_a_quantity_is_read_in_si(text: str, kind: str, value: float) -> None:
    assert units.parse(text, kind) == pytest.approx(value, rel=1e-5)


@pytest.mark.parametrize(
    ("text", "kind", "teaching"),
    [
        ("100", "mass", '"100" has no unit; a mass is wanted, e.g. 100 t'),
        ("130 m", "speed", '"130 m" is a length; a speed is wanted, e.g. 130 m/s'),
        ("12 tons", "mass", 'the unit "tons" is not known for a mass; known are kg, t, lb'),
        ("1 m", "ratio", "a number without unit is wanted"),
        ("heavy", "mass", "is not a number"),
        ("", "mass", "is not a number"),
        ("nan kg", "mass", "is not a number"),
        ("inf kg", "mass", "is not a number"),
        ("1e308 t", "mass", "beyond anything that flies"),
        ("1e999 t", "mass", "beyond anything that flies"),
        ("-1e30 m", "length", "beyond anything that flies"),
        ("٣ m", "length", "is not a number"),  # digits, but not ours
        ("1" * 500_000 + "\n", "length", "is not a number"),
        ("0x10 m", "length", "the unit"),
        ("1_000 m", "length", "the unit"),
    ],
)
def test_what_is_no_such_quantity_is_refused_with_what_would_be(text: str, kind: str, teaching: str) -> None:
    with pytest.raises(UnitError) as refused:
        units.parse(text, kind)
    assert teaching in str(refused.value)
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize(
    ("text", "speed"),
    [
        ("130 m/s CAS", Speed("CAS", 130.0)),
        ("140 kt TAS", Speed("TAS", 140 * KT)),
        ("M0.4", Speed("MACH", 0.4)),
        ("M .72", Speed("MACH", 0.72)),
    ],
)
def test_an_airspeed_says_its_kind(text: str, speed: Speed) -> None:
    assert units.parse_speed(text) == speed


@pytest.mark.parametrize(
    ("text", "teaching"),
    [
        ("130 m/s", "write 130 m/s CAS or 130 m/s TAS"),
        ("130 m", "an airspeed is wanted, e.g. 130 m/s CAS"),
        ("130 CAS", '"130" has no unit; an airspeed is wanted, e.g. 130 m/s CAS'),
        ("M9", "beyond anything that flies"),
        ("M0", "more than zero"),
        ("-130 m/s CAS", "more than zero"),
        ("CAS", "is not a number"),
    ],
)
def test_an_airspeed_without_kind_or_unit_is_refused(text: str, teaching: str) -> None:
    with pytest.raises(UnitError, match=teaching):
        units.parse_speed(text)


def test_a_level_is_a_flight_level_or_an_altitude() -> None:
    assert units.parse_level("FL230") == Level("FL", pytest.approx(23000 * FT))
    assert units.parse_level("5000 ft") == Level("ALT", pytest.approx(1524.0))
    with pytest.raises(UnitError, match="FL230 or 5000 ft"):
        units.parse_level("230")


def test_a_direction_says_its_north() -> None:
    assert units.parse_direction("148 deg magnetic") == (pytest.approx(148 * DEG), True)
    assert units.parse_direction("360 deg true") == (pytest.approx(0.0, abs=1e-12), False)
    with pytest.raises(UnitError, match="148 deg true or 148 deg magnetic"):
        units.parse_direction("148 deg")
    with pytest.raises(UnitError, match="between 0 deg and 360 deg"):
        units.parse_direction("400 deg true")


def test_a_gain_may_have_any_unit_and_units_may_be_divided() -> None:
    assert units.parse_any("0.7") == 0.7
    assert units.parse_any("12 s") == 12.0
    assert units.parse_any("0.5 deg/kt") == pytest.approx(0.5 * DEG / KT)
    with pytest.raises(UnitError, match='the unit "parsec" is not known'):
        units.parse_any("1 parsec")


def test_values_are_shown_at_the_door_in_the_units_of_the_trade() -> None:
    assert units.show(1524.0, "ft") == "5,000 ft"
    assert units.show(3 * NM, "NM", 1) == "3.0 NM"
    assert str(Speed("CAS", 130.0)) == "253 kt CAS"
    assert str(Speed("MACH", 0.4)) == "M0.4"
    assert str(Level("FL", 23000 * FT)) == "FL230"
    assert str(Level("ALT", 1524.0)) == "5000 ft"


def test_a_unit_means_the_same_in_every_kind() -> None:
    for kind in units.KINDS.values():
        for unit, factor in kind.units.items():
            assert units.FACTORS[unit] == factor
