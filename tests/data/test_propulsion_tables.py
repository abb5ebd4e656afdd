"""The propulsion files: shape of every table, capacities, symmetry, and that each says where it comes from."""

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SYSTEMS = ("propulsion-engines", "propulsion-fadec", "fuel")
FILES = (
    *(ROOT / "systems" / f"{name}.xml" for name in SYSTEMS),
    ROOT / "aircraft/gta/propulsion.xml",
    ROOT / "aircraft/gta/external-reactions.xml",
    ROOT / "engine/gta_turboprop.xml",
    ROOT / "engine/gta_propeller.xml",
)
FUEL_DENSITY = 0.785  # kg/l
USABLE_FUEL = 62267.0  # l, EASA TCDS A.169


def system(name: str) -> ET.Element:
    return ET.parse(ROOT / "systems" / f"{name}.xml").getroot()


def table_of(name: str, component: str) -> list[list[float]]:
    """Rows of the table inside the fcs_function `component`."""
    function = next(f for f in system(name).iter("fcs_function") if f.attrib["name"] == component)
    text = function.findtext(".//tableData") or ""
    return [[float(cell) for cell in line.split()] for line in text.strip().splitlines()]


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name)
def test_every_file_states_its_source_and_marks_its_estimates(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.index("<!--") < 60
    assert "estimate" in text or "GENERATED" in text or "EASA" in text


@pytest.mark.parametrize("name", SYSTEMS)
def test_every_system_opens_with_its_inputs_and_outputs(name: str) -> None:
    head = (ROOT / "systems" / f"{name}.xml").read_text(encoding="utf-8").partition("<system")[0]
    assert all(word in head for word in ("inputs", "outputs", "Sources"))


@pytest.mark.parametrize("name", SYSTEMS)
def test_tables_rise_in_their_first_column(name: str) -> None:
    for function in system(name).iter("fcs_function"):
        for table in function.iter("table"):
            columns = len(table.findall("independentVar"))
            lines = (table.findtext("tableData") or "").strip().splitlines()[columns - 1 :]
            keys = [float(line.split()[0]) for line in lines]
            assert keys == sorted(set(keys)), function.attrib["name"]


@pytest.mark.parametrize("name", SYSTEMS)
def test_the_four_engines_have_the_same_tables(name: str) -> None:
    tables: dict[str, set[str]] = {}
    for function in system(name).iter("fcs_function"):
        family, index, _ = function.attrib["name"].partition("[")
        text = function.findtext(".//tableData")
        if index and text is not None:
            tables.setdefault(family, set()).add(" ".join(text.split()))
    assert all(len(variants) == 1 for variants in tables.values()), tables


def test_more_lever_never_means_less_power() -> None:
    for column in (1, 2):
        powers = [row[column] for row in table_of("propulsion-engines", "propulsion/lever-power-norm[0]")[1:]]
        assert powers == sorted(powers)
        assert powers[-1] == 1.0


def test_the_ground_range_goes_from_reverse_through_flat_to_flight() -> None:
    stops = table_of("propulsion-fadec", "fadec/fine-stop-deg[0]")
    angles = [angle for _, angle in stops]
    assert angles == sorted(angles)
    assert angles[0] < -5.0 < 0.0 < angles[-1]


def test_the_propeller_speeds_are_the_public_ones() -> None:
    rows = table_of("propulsion-fadec", "fadec/governor-rpm")
    assert rows[0][1] == 842.0
    assert all(655.0 <= rpm <= 842.0 for _, rpm in rows)


def test_the_tanks_hold_the_certified_fuel() -> None:
    tanks = ET.parse(ROOT / "aircraft/gta/propulsion.xml").getroot().findall("tank")
    capacities = [float(tank.findtext("capacity") or "nan") for tank in tanks]
    assert sum(capacities) == pytest.approx(USABLE_FUEL * FUEL_DENSITY, abs=1.0)
    declared = {
        p.text.strip(): float(p.attrib["value"]) for p in system("fuel").findall("property") if p.text
    }
    assert [declared[f"fuel/tank-capacity-kg[{i}]"] for i in range(7)] == capacities
    assert sorted(declared[f"fuel/tank-fill-order[{i}]"] for i in range(7)) == [1, 1, 1, 1, 2, 2, 3]


def test_engines_and_tanks_mirror_left_and_right() -> None:
    root = ET.parse(ROOT / "aircraft/gta/propulsion.xml").getroot()
    engines = root.findall("engine")

    def place(element: ET.Element) -> tuple[float, ...]:
        return tuple(float(element.findtext(f".//location/{axis}") or "nan") for axis in "xyz")

    for left, right in ((0, 3), (1, 2)):
        (xl, yl, zl), (xr, yr, zr) = place(engines[left]), place(engines[right])
        assert (xl, yl, zl) == (xr, -yr, zr)
    senses = [float(engine.findtext("thruster/sense") or "nan") for engine in engines]
    assert senses == [1.0, -1.0, 1.0, -1.0]
    assert sum(place(tank)[1] for tank in root.findall("tank")) == pytest.approx(0.0)


def test_each_jet_pushes_behind_its_own_propeller() -> None:
    forces = ET.parse(ROOT / "aircraft/gta/external-reactions.xml").getroot().findall("force")
    engines = ET.parse(ROOT / "aircraft/gta/propulsion.xml").getroot().findall("engine")
    for index, (force, engine) in enumerate(zip(forces, engines, strict=True)):
        assert (force.findtext(".//property") or "").strip() == f"propulsion/jet-thrust-n[{index}]"
        assert float(force.findtext("location/y") or "nan") == float(
            engine.findtext(".//location/y") or "nan"
        )
        assert float(force.findtext("location/x") or "nan") > float(engine.findtext(".//location/x") or "nan")
