"""The flight manual is read whole, and refused with file and line where it is wrong."""

from pathlib import Path
from typing import ClassVar

import pytest

from harness.errors import InputError
from harness.manual import FlightManual, read_manual
from harness.plan import Checklist, Condition, PhasePlan, Step
from harness.plan_reader import Reference, parse_reference
from harness.units import DEG, FPM, FT, KT, Quantity, Speed, UnitError

MANUAL = Path(__file__).parents[1] / "data" / "flight-manual.xml"


@pytest.fixture(scope="module")
def manual() -> FlightManual:
    return read_manual(MANUAL)


def refusal(tmp_path: Path, old: str, new: str) -> str:
    text = MANUAL.read_text("utf-8")
    assert old in text
    path = tmp_path / "flight-manual.xml"
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(InputError) as refused:
        read_manual(path)
    message = str(refused.value)
    assert message.startswith(f"{path}:")
    return message


def test_limits_flaps_thrust_and_gains_are_si(manual: FlightManual) -> None:
    assert manual.aircraft == "gta"
    assert manual.limits["VMO"] == pytest.approx(300 * KT)
    assert manual.limits["MMO"] == 0.72
    assert manual.limits["maximum-altitude"] == pytest.approx(37000 * FT)
    assert manual.limits["maximum-bank"] == pytest.approx(30 * DEG)
    assert manual.flap("take-off").position == 0.5
    assert manual.thrust["TOGA"] == 1.0
    assert manual.gains["altitude-time-constant"] == 12.0
    assert manual.gains["pitch-per-speed"] == pytest.approx(0.5 * DEG / KT)


def test_a_gain_or_thrust_setting_the_manual_does_not_have_is_refused(manual: FlightManual) -> None:
    with pytest.raises(
        InputError, match='has no gain "altitude-time"\n    did you mean altitude-time-constant'
    ) as refused:
        manual.gains["altitude-time"]
    assert str(refused.value).startswith(str(MANUAL))
    with pytest.raises(InputError, match='has no thrust setting "TOGO"'):
        manual.thrust["TOGO"]


def test_the_stall_speed_carries_the_weight_at_maximum_lift(manual: FlightManual) -> None:
    speed = manual.stall_speed(100_000.0, "up")
    assert 0.5 * 1.225 * speed**2 * 221.5 * 1.55 == pytest.approx(100_000 * 9.80665, rel=1e-4)


def test_a_speed_is_fixed_or_follows_the_stall_speed(manual: FlightManual) -> None:
    assert manual.speed("VR", 100_000.0) == pytest.approx(121 * KT)
    light, heavy = (manual.speed("VREF", mass) for mass in (90_000.0, 120_000.0))
    assert heavy / light == pytest.approx((120 / 90) ** 0.5)
    assert manual.speed("V2", 1e5) == pytest.approx(1.13 * manual.stall_speed(1e5, "take-off") + 5 * KT)
    with pytest.raises(InputError, match="did you mean VREF"):
        manual.speed("VRFE", 100_000.0)


def test_procedures_and_checklists_keep_their_words_and_lines(manual: FlightManual) -> None:
    plan = manual.phases["T/O.run"]
    assert [step.name for step in plan.steps] == ["thrust levers to TOGA", "steer by hand", "airspeed alive"]
    assert plan.steps[0].action == {"set": "thrust", "to": "TOGA"}
    assert plan.steps[2].when[0][:4] == ("airspeed alive", "cas", "at-least", "60 kt")
    (checklist,) = plan.checklists
    assert checklist.to == "T/O.rotation"
    assert checklist.items[0][:4] == ("rotation speed", "cas", "at-least", "VR")
    line = MANUAL.read_text("utf-8").splitlines()[checklist.items[0].line - 1]
    assert 'name="rotation speed"' in line


@pytest.mark.parametrize(
    ("old", "new", "teaching"),
    [
        ('<limit name="MMO" value="M0.72"/>', "", 'has no limit "MMO"'),
        ('name="MMO"', 'name="VMO"', "is here twice"),
        ('value="M0.72"', 'value="0.72"', 'value="0.72"'),
        ('value="300 kt CAS" source', 'value="300 kt" source', "write 300 kt CAS or 300 kt TAS"),
        ('value="141 t"', 'value="141"', '"141" has no unit'),
        ('value="141 t"', 'value="-141 t"', "must be more than zero"),
        ("<gains>", "<gain>", "not well-formed"),
        ('lever="0.9"', 'lever="9"', "outside -1 .. 1"),
        ('lever="0.9"', "", 'lacks its "lever"'),
        ('stall-ratio="1.23" flaps="landing"', 'stall-ratio="1.23" flaps="landig"', "did you mean landing?"),
        ('stall-ratio="1.23" flaps="landing"', "", "either a value or a stall-ratio"),
        ('maximum-lift-coefficient="1.55"', 'maximum-lift-coefficient="0"', "lift coefficient above 0"),
        ('value="12 s"', 'value="12 parsec"', "is not known"),
        ('quantity="cas" at-least="VR"', 'quantity="cass" at-least="VR"', "did you mean cas?"),
        ('quantity="cas" at-least="VR"', 'quantity="cas" at-least="VRR"', "did you mean VR"),
        ('quantity="cas" at-least="VR"', 'quantity="cas" at-least="VR" at-most="V2"', "exactly one of"),
        ('at-least="60 kt"', 'at-least="60"', '"60" has no unit'),
        ('at-least="200 ft/min"', 'at-least="200 ft"', '"200 ft" is a length'),
        ('is="yes"', 'is="perhaps"', "neither yes nor no"),
        ('at-most="up"', 'at-most="upp"', "did you mean up?"),
        ('set="thrust" to="TOGA"', 'set="thrust" to="TOGO"', "did you mean TOGA?"),
        ('set="gear" to="up"', 'set="geer" to="up"', "did you mean gear?"),
        ('set="gear" to="up"', 'set="gear"', "does not say what to do"),
        ('mode="SPD" to="PITCH"', 'mode="SPD" to="PICH"', "did you mean PITCH?"),
        ('speed="V2 + 10 kt"', 'speed="V3 + 10 kt"', '"V3" is not'),
        ('speed="V2 + 10 kt"', "", "needs its argument"),
        ('control="steering"', 'contrl="steering"', "did you mean control?"),
        ('name="DEP"', 'name="DEPP"', "did you mean DEP?"),
        ('checklist to="ENR.CLB"', 'checklist to="RTO"', "no way leads"),
        ("<flaps>", "<flaps>42", "has text inside"),
        ("<speeds>", '<speeds><sped name="x" value="1 kt CAS"/>', "did you mean <speed>?"),
    ],
)
def test_a_wrong_manual_is_refused_with_what_would_be_right(
    tmp_path: Path, old: str, new: str, teaching: str
) -> None:
    assert teaching in refusal(tmp_path, old, new)


def test_every_fault_of_one_reading_is_told_with_its_line(tmp_path: Path) -> None:
    text = (
        MANUAL.read_text("utf-8")
        .replace('value="141 t"', 'value="141"')
        .replace('value="12 s"', 'value="12 z"')
    )
    path = tmp_path / "manual.xml"
    path.write_text(text, "utf-8")
    with pytest.raises(InputError) as refused:
        read_manual(path)
    assert len(refused.value.faults) == 2


def change(name: str, *, remove: bool = False, required: str = "100 kt") -> Condition:
    return Condition(name, "cas", "at-least", required, "m.xml", 1, remove)


def test_a_mission_replaces_adds_and_removes_by_name(manual: FlightManual) -> None:
    class Changes:
        speeds: ClassVar = {"VR": Speed("CAS", 60.0)}
        gains: ClassVar = {"altitude-time-constant": Quantity(9.0, "s")}
        phases: ClassVar = {
            "T/O.run": PhasePlan(
                "T/O.run",
                (
                    Step("steer by hand", {}, (), "m.xml", 1, remove=True),
                    Step("thrust levers to TOGA", {"set": "thrust", "to": "climb"}, (), "m.xml", 2),
                    Step("a new step", {"set": "brakes", "to": "0"}, (), "m.xml", 3),
                ),
                (
                    Checklist(
                        "T/O.rotation", (change("rotation speed"), change("on the ground", remove=True))
                    ),
                    Checklist("RTO", (change("too slow"),)),
                ),
            )
        }

    changed = manual.with_mission(Changes())
    assert changed.gains["altitude-time-constant"] == 9.0
    assert manual.gains["altitude-time-constant"] == 12.0
    plan = changed.phases["T/O.run"]
    assert changed.speed("VR", 1e5) == 60.0
    assert [step.name for step in plan.steps] == ["thrust levers to TOGA", "airspeed alive", "a new step"]
    assert plan.steps[0].action["to"] == "climb"
    assert [(checklist.to, [item.name for item in checklist.items]) for checklist in plan.checklists] == [
        ("T/O.rotation", ["rotation speed"]),
        ("RTO", ["too slow"]),
    ]
    assert plan.checklists[0].items[0].required == "100 kt"
    assert changed.phases["DEP"] is manual.phases["DEP"]
    assert manual.speed("VR", 1e5) == pytest.approx(121 * KT)  # the manual itself is unchanged


def test_a_right_hand_side_is_a_number_or_a_name_with_an_offset() -> None:
    assert parse_reference("200 ft/min", "vertical-speed") == Reference("", pytest.approx(200 * FPM))
    assert parse_reference("VR", "speed") == Reference("VR", 0.0)
    assert parse_reference("V2 + 10 kt", "speed") == Reference("V2", pytest.approx(10 * KT))
    assert parse_reference("VREF - 5 kt", "speed") == Reference("VREF", pytest.approx(-5 * KT))
    assert parse_reference("120 kt CAS", "speed") == Reference("", pytest.approx(120 * KT))
    assert parse_reference("yes", "yes-no") == Reference("", 1.0)
    with pytest.raises(UnitError, match="is a length"):
        parse_reference("V2 + 10 ft", "speed")
