"""What is wrong with an aircraft's files is said with file and line, before JSBSim sees them."""

import shutil
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from harness import cli
from harness.errors import InputError, InputErrors
from harness.lint.aircraft import check
from harness.lint.words import OWN_PROPERTIES
from harness.plant.bench import Bench
from harness.plant.catalog import own_properties

Broken = Callable[..., list[InputError]]
HOME = "aircraft/gta"


@pytest.fixture
def root(tmp_path: Path, repository: Path) -> Path:
    for folder in ("aircraft", "engine", "systems"):
        shutil.copytree(repository / folder, tmp_path / folder)
    return tmp_path


@pytest.fixture
def broken(root: Path) -> Broken:
    """The faults of the aircraft with one piece of one file replaced."""

    def make(file: str, old: str, new: str) -> list[InputError]:
        path = root / file
        text = path.read_text("utf-8")
        assert old in text
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        with pytest.raises(InputError) as refused:
            check(root, "gta")
        error = refused.value
        return list(error.every) if isinstance(error, InputErrors) else [error]

    return make


def test_our_aircraft_has_no_fault(repository: Path) -> None:
    check(repository, "gta")


@pytest.mark.parametrize(
    ("file", "old", "new", "said", "remedy"),
    [
        (
            f"{HOME}/aerodynamics.xml",
            "<property>aero/beta-rad</property>",
            "<property>aero/betta-rad</property>",
            'nothing makes the property "aero/betta-rad"',
            "did you mean aero/beta-rad",
        ),
        (
            "systems/high-lift.xml",
            "<property>fcs/flap-cmd-norm",
            "<property>fcs/flap-cmd-nrm",
            'nothing makes the property "fcs/flap-cmd-nrm"',
            "did you mean fcs/flap-cmd-norm",
        ),
        (
            "systems/high-lift.xml",
            "<clipto><min>0</min>",
            "<clipto><min>fcs/flap-lowest</min>",
            'nothing makes the property "fcs/flap-lowest"',
            "",
        ),
        (
            f"{HOME}/gta.xml",
            '<system file="fuel.xml"/>',
            '<system file="fule.xml"/>',
            'no file "fule.xml"',
            "fuel",
        ),
        (
            f"{HOME}/propulsion.xml",
            'file="gta_turboprop"',
            'file="gta_turbofan"',
            "gta_turbofan",
            "gta_turboprop",
        ),
        (
            f"{HOME}/gta.xml",
            'file="metrics.xml"',
            'file="../gta/metrics.xml"',
            "leaves the folders",
            "file name",
        ),
        (f"{HOME}/gta.xml", 'file="metrics.xml"', 'file="/etc/passwd"', "leaves the folders", "file name"),
        (
            f"{HOME}/gta.xml",
            "<fileheader>",
            '<output name="/x.csv" type="CSV"/><fileheader>',
            "writes files",
            "delete",
        ),
        (f"{HOME}/gta.xml", "<fileheader>", '<input port="1137"/><fileheader>', "opens sockets", "delete"),
        (f"{HOME}/gta.xml", "<fileheader>", "<airframe/><fileheader>", "<airframe> is no part", ""),
        (f"{HOME}/mass-balance.xml", "> 78600 <", "> -78600 <", "<emptywt> is -78600", "above zero"),
        (
            f"{HOME}/mass-balance.xml",
            '<izz unit="KG*M2"> ',
            '<izz unit="KG*M2"> 9',
            "more than the two others",
            "no rigid body",
        ),
        (f"{HOME}/propulsion.xml", '<contents unit="KG"> ', '<contents unit="KG"> 9', "do not fit", "lower"),
    ],
)
def test_a_fault_is_told_with_its_place_and_remedy(  # noqa: PLR0917  the table's columns
    broken: Broken, root: Path, file: str, old: str, new: str, said: str, remedy: str
) -> None:
    line = (root / file).read_text("utf-8").split(old)[0].count("\n") + 1
    faults = broken(file, old, new)
    fault = next(fault for fault in faults if said in fault.what)
    assert fault.file == str(root / file)
    assert fault.line is not None
    assert abs(fault.line - line) <= 1 or "two others" in said or "fit" in said
    assert remedy in fault.remedy


def test_an_unknown_component_and_operation(root: Path) -> None:
    path = root / "systems" / "high-lift.xml"
    text = path.read_text("utf-8").replace("fcs_function", "fcs_funktion").replace("quotient>", "quotent>")
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputErrors) as refused:
        check(root, "gta")
    said = str(refused.value)
    assert "<fcs_funktion> is no component" in said
    assert "did you mean <fcs_function>" in said
    assert "did you mean <quotient>" in said


@pytest.mark.parametrize(
    ("rows", "said"),
    [
        ("1 2\n0 3", "do not rise at 0"),
        ("0 1\n0 2", "do not rise at 0"),
        ("0 1\n1 2\n2 3 4", "3 numbers, where the row before has 2"),
        ("0 1\n1 x", "is not a row of numbers"),
        (" 1 0\n 0 1 2\n 1 2 3", "columns of the table do not rise"),
    ],
)
def test_a_table_out_of_order(root: Path, rows: str, said: str) -> None:
    path = root / "systems" / "high-lift.xml"
    table = f"<table><independentVar>velocities/mach</independentVar><tableData>{rows}</tableData></table>"
    extra = f'<channel name="x"><fcs_function name="x/y"><function>{table}</function></fcs_function></channel></system>'
    path.write_text(path.read_text("utf-8").replace("</system>", extra), encoding="utf-8")
    with pytest.raises(InputErrors, match=said):
        check(root, "gta")


def test_the_command_line_checks_an_aircraft_by_its_name(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.main(["check", "gta"]) == 0
    assert "nothing in its files" in capsys.readouterr().out


def test_a_refused_aircraft_never_reaches_jsbsim(root: Path) -> None:
    path = root / HOME / "aerodynamics.xml"
    path.write_text(path.read_text("utf-8").replace("aero/qbarUW-psf", "aero/qbarXX-psf"), encoding="utf-8")
    with pytest.raises(InputError, match="qbarXX"):
        Bench(root, "gta")  # JSBSim itself would abort the process


@pytest.mark.parametrize("name", ["gtb", "../gta", "", "a/b"])
def test_an_aircraft_that_is_not_there(repository: Path, name: str) -> None:
    with pytest.raises(InputError, match="no aircraft"):
        check(repository, name)


def test_the_list_of_jsbsims_own_properties_is_that_of_this_jsbsim() -> None:
    assert set(own_properties()) == OWN_PROPERTIES


def test_a_second_look_costs_nothing(repository: Path) -> None:
    check(repository, "gta")
    begin = time.perf_counter()
    for _ in range(10):
        check(repository, "gta")
    assert (time.perf_counter() - begin) / 10 < 0.05
