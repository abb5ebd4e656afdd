"""The test guide: what it refuses, how it judges, what it prints; flown tests are in test_qualify.py."""

from math import inf, nan
from pathlib import Path

import pytest

from harness.analysis.panel import Curve, Panel
from harness.errors import InputError
from harness.qualify.condition import read
from harness.qualify.guide import COLUMNS, bounds, read_guide, select
from harness.qualify.judge import Verdict
from harness.qualify.manoeuvres import MANOEUVRES
from harness.qualify.report import number, table, write_page
from harness.units import UnitError

GOOD = "T1,A title,cruise,mass=110 t; level=FL230; speed=M0.40,thrust,77.7,kN,±5 %,a rule,a book,no"


def guide(tmp_path: Path, *rows: str) -> Path:
    path = tmp_path / "qualification.csv"
    path.write_text("\n".join((",".join(COLUMNS), *rows)) + "\n", encoding="utf-8")
    return path


def test_the_guide_of_every_aircraft_can_be_read_and_names_its_sources(repository: Path) -> None:
    for path in (repository / "aircraft").glob("*/qualification.csv"):
        rows = read_guide(path, MANOEUVRES)
        assert len(rows) > 30
        assert all(len(row.source) > 5 and len(row.tolerance_source) > 5 for row in rows)


def test_the_guide_of_the_gta_has_all_validation_points(repository: Path) -> None:
    rows = read_guide(repository / "aircraft" / "gta" / "qualification.csv", MANOEUVRES)
    points = {row.id[:3] for row in rows if row.id.startswith("V")}
    assert points == {f"V{number:02d}" for number in range(1, 35)}


@pytest.mark.parametrize(
    ("target", "tolerance", "expected"),
    [
        (200.0, "±5 %", (190.0, 210.0)),
        (-13.0, "±4 %", (-13.52, -12.48)),
        (30.0, "±1.5", (28.5, 31.5)),
        (450.0, "-10 +5 %", (405.0, 472.5)),
        (3.0, "at least", (3.0, inf)),
        (1.4, "at most", (-inf, 1.4)),
        (0.5, "0.3 to 2.0", (0.3, 2.0)),
    ],
)
def test_tolerances(target: float, tolerance: str, expected: tuple[float, float]) -> None:
    assert bounds(target, tolerance) == pytest.approx(expected)


@pytest.mark.parametrize("tolerance", ["", "5 %", "±", "about 5", "±5 kt", "1 to", "+5 -10 %"])
def test_what_is_no_tolerance_is_refused(tolerance: str) -> None:
    with pytest.raises(UnitError, match="is not a tolerance"):
        bounds(1.0, tolerance)


@pytest.mark.parametrize(
    ("row", "said"),
    [
        (GOOD.replace("cruise", "cruse"), 'no manoeuvre "cruse"; did you mean cruise'),
        (GOOD.replace("110 t", "110"), "has no unit"),
        (GOOD.replace("mass=", "mas="), '"mas" is not a part of a condition'),
        (GOOD.replace("±5 %", "5"), "is not a tolerance"),
        (GOOD.replace("77.7", "much"), "is not a number"),
        (GOOD.replace("a book", ""), "says nothing about source"),
        (GOOD.removesuffix("no") + "yes", "which parameters were fitted"),
        (GOOD.removesuffix("no") + "perhaps", "calibrated_on says"),
        (GOOD.replace("level=FL230", "mass=90 t"), "twice"),
    ],
)
def test_a_wrong_row_is_refused_with_its_line(tmp_path: Path, row: str, said: str) -> None:
    with pytest.raises(InputError, match=said) as refused:
        read_guide(guide(tmp_path, GOOD.replace("T1", "T0"), row), MANOEUVRES)
    assert refused.value.line == 3


def test_an_id_twice_and_a_wrong_heading_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="stands there twice"):
        read_guide(guide(tmp_path, GOOD, GOOD), MANOEUVRES)
    path = tmp_path / "other.csv"
    path.write_text("a,b\n1,2\n")
    with pytest.raises(InputError, match="columns"):
        read_guide(path, MANOEUVRES)
    with pytest.raises(InputError, match="no test guide"):
        read_guide(tmp_path / "none.csv", MANOEUVRES)


def test_a_test_is_chosen_by_its_number_with_all_its_letters(tmp_path: Path) -> None:
    rows = read_guide(guide(tmp_path, *(GOOD.replace("T1", i) for i in ("V1a", "V1b", "V10"))), MANOEUVRES)
    assert [row.id for row in select(rows, ["V1"])] == ["V1a", "V1b"]
    assert [row.id for row in select(rows, ["V1b", "V10"])] == ["V1b", "V10"]
    with pytest.raises(InputError, match='no test "V2"'):
        select(rows, ["V2"])


def test_what_could_not_be_measured_is_outside(tmp_path: Path) -> None:
    (row,) = read_guide(guide(tmp_path, GOOD), MANOEUVRES)
    missing = Verdict(row, nan, "not flown: no power", [])
    assert not missing.inside
    assert missing.as_data()["result"] is None
    assert "OUTSIDE" in table([missing])
    assert Verdict(row, 78.0, "", []).inside


def test_the_page_is_one_file_without_network_and_the_same_every_time(tmp_path: Path) -> None:
    (row,) = read_guide(guide(tmp_path, GOOD.replace("A title", "<b>A & title</b>")), MANOEUVRES)
    panels = [Panel("time, s", "kN", [Curve("thrust", [0, 1], [70, 78])], [("target", 77.7)])]
    verdict = Verdict(row, 78.0, "a <remark>", panels)
    first = write_page([verdict], "gta", "0" * 64, tmp_path / "a").read_bytes()
    assert first == write_page([verdict], "gta", "0" * 64, tmp_path / "b").read_bytes()
    text = first.decode()
    assert "&lt;b&gt;A &amp; title" in text
    assert "a &lt;remark&gt;" in text
    assert "<svg" in text
    assert "src=" not in text
    assert "@import" not in text
    assert 'href="http' not in text.replace('xlink:href="http', "")


def test_a_condition_speaks_units() -> None:
    condition = read("mass=110 t; level=FL230; speed=M0.40; isa=15 K; bank=5 deg; failed=2")
    assert condition.mass == 110e3
    assert condition.altitude == pytest.approx(7010.4)
    assert condition.tas == pytest.approx(0.40 * 322.6, rel=1e-2)  # ISA + 15 K
    assert condition.failed == 2


@pytest.mark.parametrize(
    ("value", "shown"),
    [(0.00123, "0.00123"), (0.5, "0.500"), (12.345, "12.35"), (468.62, "468.6"), (1234.5, "1234")],
)
def test_numbers_have_the_digits_they_deserve(value: float, shown: str) -> None:
    assert number(value) == shown
