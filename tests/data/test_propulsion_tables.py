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
LEVER = "fcs/throttle-cmd-norm[0]"


def system(name: str) -> ET.Element:
    return ET.parse(ROOT / "systems" / f"{name}.xml").getroot()


def table_of(name: str, component: str, over: str) -> list[list[float]]:
    """Rows of the last table over the property `over` inside the fcs_function `component`."""
    function = next(f for f in system(name).iter("fcs_function") if f.attrib["name"] == component)
    tables = [t for t in function.iter("table") if (t.findtext("independentVar") or "").strip() == over]
    text = tables[-1].findtext("tableData") or ""
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


def test_the_four_engines_are_written_alike() -> None:
    """All that differs between them is the number."""
    for name in ("propulsion-engines", "propulsion-fadec"):
        families: dict[str, set[str]] = {}
        for component in (*system(name).iter("fcs_function"), *system(name).iter("switch")):
            family, index, rest = component.attrib["name"].partition("[")
            if index:
                text = ET.tostring(component, encoding="unicode").replace(f"[{rest}", "[i]")
                families.setdefault(family, set()).add(" ".join(text.split()))
        assert families
        assert all(len(variants) == 1 for variants in families.values()), families


def test_more_lever_never_means_less_power() -> None:
    rows = table_of("propulsion-engines", "propulsion/engine-power-kw[0]", LEVER)[1:]
    for column in (1, 2):
        powers = [row[column] for row in rows]
        assert powers == sorted(powers)
        assert powers[-1] == 1.0


def test_flatter_blades_are_given_less_power() -> None:
    powers = [
        power
        for _, power in table_of(
            "propulsion-engines", "propulsion/engine-power-kw[0]", "fadec/blade-angle-deg[0]"
        )
    ]
    assert powers == sorted(powers)
    assert powers[-1] > 7971.0


def test_the_ground_range_goes_from_reverse_through_flat_to_flight() -> None:
    reverse, forward = (
        [
            [float(cell) for cell in line.split()]
            for line in (table.findtext("tableData") or "").strip().splitlines()
        ]
        for function in system("propulsion-fadec").iter("fcs_function")
        if function.attrib["name"] == "fadec/ground-stop-deg[0]"
        for table in function.iter("table")
        if (table.findtext("independentVar") or "").strip() == LEVER
    )
    angles = [angle for _, angle in (*reverse, *forward[2:])]
    assert angles == sorted(angles)
    assert angles[0] < -5.0 < 0.0 < angles[-1]
    assert forward[1] == reverse[-1]  # idle is the same from both sides


def test_the_propeller_speeds_are_the_public_ones() -> None:
    rows = table_of("propulsion-fadec", "fadec/governor-rpm", "velocities/mach")[1:]
    assert rows[0][1:] == [842.0, 655.0]
    assert all(655.0 <= rpm <= 842.0 for row in rows for rpm in row[1:])


def test_the_tanks_hold_the_certified_fuel() -> None:
    tanks = ET.parse(ROOT / "aircraft/gta/propulsion.xml").getroot().findall("tank")
    capacities = [float(tank.findtext("capacity") or "nan") for tank in tanks]
    assert sum(capacities) == pytest.approx(USABLE_FUEL * FUEL_DENSITY, abs=1.0)
    text = (ROOT / "systems/fuel.xml").read_text(encoding="utf-8")
    for capacity in capacities[1:]:  # the centre is filled by none
        assert f"<value> {capacity / 10:.4f} </value>" in text


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


def test_the_jets_push_behind_their_propellers() -> None:
    """One force and one moment do what four forces at the hubs' arms would."""
    engines = ET.parse(ROOT / "aircraft/gta/propulsion.xml").getroot().findall("engine")
    arms = [float(engine.findtext(".//location/y") or "nan") for engine in engines]
    yaw = next(
        f
        for f in system("propulsion-engines").iter("fcs_function")
        if f.attrib["name"] == "propulsion/jet-yaw-nm"
    )
    coefficients = [0.0] * 4
    for product in yaw.iter("product"):
        arm = float(product.findtext("value") or "nan")
        left, right = (int((p.text or "").strip()[-2]) for p in product.iter("property"))
        coefficients[left], coefficients[right] = arm, -arm
    assert coefficients == [-arm for arm in arms]
    reactions = ET.parse(ROOT / "aircraft/gta/external-reactions.xml").getroot()
    jets = [part for part in reactions if part.attrib["name"].startswith("jet")]
    assert [float(jet.findtext("location/y") or "nan") for jet in jets if jet.tag == "force"] == [0.0]
    assert [(element.findtext(".//property") or "").strip() for element in jets] == [
        "propulsion/jet-total-n",
        "propulsion/jet-yaw-nm",
    ]
