"""The airframe's XML files have the shape and the figures they claim."""

import itertools
import math
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

CLEAN, TAKE_OFF, LANDING = range(3)


@pytest.fixture(scope="module")
def aerodynamics(repository: Path) -> ET.Element:
    return ET.parse(repository / "aircraft/gta/aerodynamics.xml").getroot()


@pytest.fixture(scope="module")
def configuration(repository: Path) -> ET.Element:
    return ET.parse(repository / "systems/configuration.xml").getroot()


def function(root: ET.Element, name: str) -> ET.Element:
    return next(f for f in root.iter() if f.tag.endswith("function") and f.get("name") == name)


def rows(table: ET.Element) -> list[list[float]]:
    lines = (table.findtext("tableData") or "").split("\n")
    return [[float(word) for word in line.split()] for line in lines if line.strip()]


@pytest.fixture(scope="module")
def lift(aerodynamics: ET.Element) -> list[list[float]]:
    table = next(function(aerodynamics, "aero/cl-basic").iter("table"))
    return rows(table)[1:]  # the first row holds the flap positions


def interpolate(table: list[list[float]], x: float, column: int = 1) -> float:
    for low, high in itertools.pairwise(table):
        if low[0] <= x <= high[0]:
            return low[column] + (high[column] - low[column]) * (x - low[0]) / (high[0] - low[0])
    raise AssertionError(x)


def test_table_arguments_rise(repository: Path):
    gear = [repository / "systems" / name for name in ("gear.xml", "wheels.xml")]
    for path in [*(repository / "aircraft/gta").glob("*.xml"), *gear]:
        for table in ET.parse(path).getroot().iter("table"):
            body = [row for row in rows(table) if len(row) == len(rows(table)[-1])]
            arguments = [row[0] for row in body]
            assert arguments == sorted(set(arguments)), path.name


@pytest.mark.parametrize("flap", [CLEAN, TAKE_OFF, LANDING])
def test_lift_rises_to_one_maximum_and_falls_beyond(lift: list[list[float]], flap: int):
    values = [row[flap + 1] for row in lift if row[0] >= -0.25]
    peak = values.index(max(values))
    assert values[:peak] == sorted(values[:peak])
    assert values[peak:] == sorted(values[peak:], reverse=True)


@pytest.mark.parametrize(("flap", "zero", "maximum"), [(0, 0.45, 1.55), (1, 1.00, 2.15), (2, 1.45, 2.50)])
def test_lift_at_zero_incidence_its_slope_and_maximum_are_the_facts(
    lift: list[list[float]], flap: int, zero: float, maximum: float
):
    column = flap + 1
    at_zero = interpolate(lift, 0.0, column)
    slope = (interpolate(lift, math.radians(6), column) - at_zero) / math.radians(6)
    trim_loss = 0.12  # the up elevator takes this much of the untrimmed maximum
    assert at_zero == pytest.approx(zero)
    assert slope == pytest.approx(5.2, rel=0.001)
    assert maximum < max(row[column] for row in lift) < maximum + trim_loss


def test_flaps_add_lift_below_the_stall(lift: list[list[float]]):
    for row in lift:
        if -0.1 <= row[0] <= 0.25:
            assert row[1] < row[2] < row[3]


def test_the_alpha_of_warning_lies_below_the_alpha_of_stall(configuration: ET.Element):
    stall = rows(next(function(configuration, "aero/alpha-stall-rad").iter("table")))
    warning = rows(next(function(configuration, "aero/alpha-warning-rad").iter("table")))
    protection_margin = 0.06
    for (_, at_stall), (_, at_warning) in zip(stall, warning, strict=True):
        assert at_warning < at_stall - protection_margin


def test_drag_increments_are_positive_and_rise(configuration: ET.Element):
    for table in function(configuration, "aero/cd-profile").iter("table"):
        values = [row[1] for row in rows(table) if row[0] >= 0]
        assert min(values) >= 0
        assert values == sorted(values)


def test_wing_and_tail_give_the_static_stability_of_the_facts(aerodynamics: ET.Element):
    pitch = function(aerodynamics, "aero/pitch-lbsft")
    wing = rows(next(pitch.iter("table")))[1:]
    slope = (interpolate(wing, 0.2) - interpolate(wing, 0.0)) / 0.2
    tail, downwash_slope = 4.24, 0.057 * 5.2
    assert slope - tail * (1 - downwash_slope) == pytest.approx(-1.5, abs=0.02)


@pytest.mark.parametrize(
    ("moment", "motion", "sign"),
    [
        ("aero/roll-lbsft", "aero/roll-rate-norm", -1),  # damps
        ("aero/pitch-lbsft", "velocities/q-aero-rad_sec", -1),
        ("aero/yaw-lbsft", "aero/yaw-rate-norm", -1),
        ("aero/yaw-lbsft", "aero/beta-rad", 1),  # turns into the wind
        ("aero/side-lbs", "aero/beta-rad", -1),
        ("aero/pitch-lbsft", "fcs/elevator-pos-rad", -1),  # trailing edge down: nose down
        ("aero/roll-lbsft", "fcs/aileron-pos-rad", 1),  # right wing down
        ("aero/yaw-lbsft", "fcs/rudder-pos-rad", -1),  # trailing edge left: nose left
    ],
)
def test_derivatives_have_the_right_sign(aerodynamics: ET.Element, moment: str, motion: str, sign: int):
    for product in function(aerodynamics, moment).iter("product"):
        names = [p.text for p in product.findall("property")]
        numbers = [float(v.text or "") for v in (*product.findall("value"), *product.findall("sum/value"))]
        if motion in names and len(numbers) == 1:
            assert math.copysign(1, numbers[0]) == sign
            return
    raise AssertionError(f"no term of {motion} in {moment}")


def test_wheels_are_symmetric_and_counted_as_the_systems_count_them(repository: Path):
    contacts = ET.parse(repository / "aircraft/gta/ground-reactions.xml").getroot().findall("contact")
    wheels, structure = contacts[:3], contacts[3:]
    assert [contact.get("type") for contact in contacts] == ["BOGEY"] * 3 + ["STRUCTURE"] * 3
    places = [tuple(float(c.findtext(f"location/{axis}") or "") for axis in "xyz") for c in wheels]
    assert sorted(places) == sorted((x, -y if y else y, z) for x, y, z in places)
    assert structure[2].get("name") == "LOWER_WING"  # contact/unit[5], which systems/gear.xml moves


def legs(text: str) -> list[str]:
    """The blocks of systems/wheels.xml that describe one main leg, with its indices and place replaced."""
    blocks = []
    for number, block in re.findall(r"<!-- leg ([1-6]), [^>]*-->(.*?)(?=<!--|</channel>)", text, re.DOTALL):
        leg, side = int(number), 1 + int(number) // 4
        alike = re.sub(rf"\b(leg-\w+(?:-\w+)?|bump-m|tyre-drag-n)\[{leg}\]", r"\1[leg]", block)
        alike = re.sub(rf"(strut-damping-n|side-stroke-m|applied-share)\[{side}\]", r"\1[side]", alike)
        for wheel in (0, 1):
            alike = alike.replace(f"twin-speed-mps[{2 * side + wheel}]", f"twin-speed-mps[{wheel}]")
            alike = re.sub(rf"(\w+)\[{2 * leg + wheel}\]", rf"\1[wheel {wheel}]", alike)
        blocks.append(re.sub(r"<value>(18\.860|20\.060|21\.260)</value>", "<value>x</value>", alike))
    return [" ".join(block.split()) for block in blocks]


def test_tyre_friction_over_slip_follows_burckhardt_s_curve(repository: Path):
    """Dry asphalt, 1.2801 (1 - exp(-23.99 s)) - 0.52 s, normalised to a peak of 1."""
    text = (repository / "systems/wheels.xml").read_text("utf-8")
    shape = re.search(r'"gear/tyre-compliance\[2\]">(.*?)</fcs_function>', text, re.DOTALL)
    assert shape
    constant, linear, square = (float(value) for value in re.findall(r"<value>(0\.\d+)</value>", shape[1]))
    slips = [i / 1000 for i in range(1, 1001)]
    reference = [1.2801 * (1 - math.exp(-23.99 * s)) - 0.52 * s for s in slips]
    ours = [s / (constant + s * (linear + square * s)) for s in slips]
    assert max(ours) == pytest.approx(1.0, abs=0.002)
    for value, theirs in zip(ours, reference, strict=True):
        assert value == pytest.approx(theirs / max(reference), abs=0.03)


def test_the_six_main_legs_are_alike(repository: Path):
    blocks = legs((repository / "systems/wheels.xml").read_text("utf-8"))
    assert len(blocks) == 18  # stroke; wheels; tyres and swing
    assert len(set(blocks)) == 3


def test_payload_is_the_first_point_mass_and_near_the_reference_centre_of_gravity(repository: Path):
    mass = ET.parse(repository / "aircraft/gta/mass-balance.xml").getroot()
    first = mass.findall("pointmass")[0]
    assert first.get("name") == "payload"
    assert float(first.findtext("location/x") or "") == pytest.approx(18.988, abs=0.1)


def test_aircraft_files_open_no_sockets_and_write_no_files(repository: Path):
    for folder in ("aircraft/gta", "systems"):
        for path in (repository / folder).glob("*.xml"):
            root = ET.parse(path).getroot()
            assert root.find("output") is None, path.name
            assert root.find("input") is None, path.name


def test_every_airframe_file_opens_by_saying_what_it_is(repository: Path):
    for name in (
        "gear",
        "high-lift",
        "interference",
        "configuration",
        "attitude-hold",
        "direct-law",
        "inner-modes",
        "extremes",
    ):
        text = (repository / f"systems/{name}.xml").read_text()
        assert re.match(r"<\?xml[^>]*>\s*<!--", text), name
        for word in ("inputs", "output", "gains", "ource"):
            assert word in text.split("-->")[0], (name, word)
