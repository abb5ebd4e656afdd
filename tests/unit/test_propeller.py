"""The propeller tables against momentum theory, the public thrust figures and their own generator."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from harness.design import blade_element
from harness.design.blade_element import ADVANCE, ANGLES, BLADE_FILE, DIAMETER, PROPELLER_FILE, Array

SEA_LEVEL_DENSITY = 1.225
TAKEOFF_POWER = 7.971e6
TAKEOFF_SPEED = 842.0 / 60.0
JET_THRUST = {0.0: 5.0e3, 72.0: 3.7e3}
ROUNDING = 2e-4
"""Two units of the last digit in the file."""


@pytest.fixture(scope="module")
def tables() -> dict[str, Array]:
    """The committed coefficient tables, rows over ADVANCE and columns over ANGLES."""
    tables = {}
    for table in ET.parse(PROPELLER_FILE).getroot().findall("table"):
        lines = (table.findtext("tableData") or "").strip().splitlines()
        assert [float(text) for text in lines[0].split()] == pytest.approx(np.degrees(ANGLES).tolist())
        rows = np.array([[float(text) for text in line.split()] for line in lines[1:]])
        assert rows[:, 0].tolist() == pytest.approx(ADVANCE.tolist())
        tables[table.attrib["name"]] = rows[:, 1:]
    return tables


def governed_thrust(
    tables: dict[str, Array], speed: float, power: float, turning: float, density: float
) -> float:
    """Thrust, N, at the blade angle where the propeller absorbs `power`; linear in the tables, as JSBSim is."""
    advance = speed / (turning * DIAMETER)
    at = {
        name: np.array([np.interp(advance, ADVANCE, column) for column in table.T])
        for name, table in tables.items()
    }
    wanted = power / (density * turning**3 * DIAMETER**5)
    governed = slice(int(np.argmin(at["C_POWER"])), int(np.searchsorted(ANGLES, math.radians(65.0))))
    thrust = np.interp(wanted, at["C_POWER"][governed], at["C_THRUST"][governed])
    return float(thrust) * density * turning**2 * DIAMETER**4


def test_the_committed_file_is_what_the_generator_writes(tables: dict[str, Array]) -> None:
    text = blade_element.propeller(blade_element.read_blade(BLADE_FILE))
    committed = PROPELLER_FILE.read_text(encoding="utf-8")
    assert text.partition("<table")[0] == committed.partition("<table")[0]
    for table in ET.fromstring(text).findall("table"):
        lines = (table.findtext("tableData") or "").strip().splitlines()[1:]
        rows = np.array([[float(cell) for cell in line.split()[1:]] for line in lines])
        np.testing.assert_allclose(rows, tables[table.attrib["name"]], atol=ROUNDING)


def test_no_thrust_beats_the_actuator_disc(tables: dict[str, Array]) -> None:
    thrust, power = tables["C_THRUST"], tables["C_POWER"]
    advance = ADVANCE[:, np.newaxis]
    pulling = thrust > 0.0
    induced = 0.5 * (np.sqrt(advance**2 + 8.0 / math.pi * np.where(pulling, thrust, 0.0)) - advance)
    assert np.all(power[pulling] >= (thrust * (advance + induced))[pulling] - ROUNDING)


def test_takeoff_thrust_is_that_of_the_public_methods(tables: dict[str, Array]) -> None:
    """Four engines: 450 kN -10..+10 % at rest, 310 kN within 5 % at 72 m/s (HS CR-2066, PropFan map)."""
    total = {
        speed: 4.0 * (jet + governed_thrust(tables, speed, TAKEOFF_POWER, TAKEOFF_SPEED, SEA_LEVEL_DENSITY))
        for speed, jet in JET_THRUST.items()
    }
    assert total[0.0] == pytest.approx(450e3, rel=0.10)
    assert total[72.0] == pytest.approx(310e3, rel=0.05)


def test_cruise_efficiency_is_that_of_a_modern_propeller(tables: dict[str, Array]) -> None:
    speed, power = 205.0, 4.7e6  # M 0.68 at FL310
    thrust = governed_thrust(tables, speed, power, 780.0 / 60.0, 0.4417)
    assert 0.80 <= thrust * speed / power <= 0.84


def test_more_angle_absorbs_more_power_where_the_governor_works(tables: dict[str, Array]) -> None:
    """Otherwise raising the angle would let the propeller run away: from windmilling up to beyond take-off power."""
    for advance, power in zip(ADVANCE, tables["C_POWER"], strict=True):
        if 0.3 <= advance <= 3.2:
            working = power[int(np.argmin(power)) :]
            working = working[working < 0.6]
            assert np.all(np.diff(working) > 0.0), f"J {advance:.1f}"


def test_flat_blades_brake_and_reversed_blades_push_back(tables: dict[str, Array]) -> None:
    landing = int(np.argmin(np.abs(ADVANCE - 0.8)))
    degrees = np.degrees(ANGLES).round()
    thrust, power = tables["C_THRUST"], tables["C_POWER"]
    assert power[landing, degrees == 6] < 0.0 > thrust[landing, degrees == 6]  # driven by the air
    assert power[landing, degrees == -12] > 0.0 > thrust[landing, degrees == -12]  # driven by the engine
    assert thrust[0, degrees == -12] < 0.0


def test_a_feathered_propeller_does_not_windmill(tables: dict[str, Array]) -> None:
    feather = int(np.argmin(np.abs(np.degrees(ANGLES) - 84.0)))
    assert np.all(tables["C_POWER"][:, feather] > 0.0)


def test_the_blade_is_as_wide_as_its_sources_say() -> None:
    """Activity factor 141 per blade and integrated design lift 0.41 (project facts), within 3 %."""
    radius = np.linspace(0.2, 1.0, 801)
    blade = blade_element.read_blade(BLADE_FILE, stations=200)
    chord = np.interp(radius, blade.radius, blade.chord)
    lift = np.interp(radius, blade.radius, blade.design_lift)
    assert 1e5 / 16.0 * np.trapezoid(chord * radius**3, radius) == pytest.approx(141.0, rel=0.03)
    assert 4.0 * np.trapezoid(lift * radius**3, radius) == pytest.approx(0.41, rel=0.05)


def test_finer_stations_change_nothing_that_matters() -> None:
    advance, angle = np.array([0.0, 0.96, 2.96]), np.radians([28.0, 31.6, 52.4])
    coarse = blade_element.coefficients(advance, angle, blade_element.read_blade())
    fine = blade_element.coefficients(advance, angle, blade_element.read_blade(stations=96))
    np.testing.assert_allclose(coarse, fine, rtol=0.02)


def test_interpolation_between_the_grid_lines_is_close(tables: dict[str, Array]) -> None:
    blade = blade_element.read_blade()
    row, column = 9, 25  # J 0.9 to 1.0, 30 to 32 deg: take-off
    advance = np.array([0.5 * (ADVANCE[row] + ADVANCE[row + 1])])
    angle = np.array([0.5 * (ANGLES[column] + ANGLES[column + 1])])
    thrust, _ = blade_element.coefficients(advance, angle, blade)
    around = tables["C_THRUST"][row : row + 2, column : column + 2]
    assert np.mean(around) == pytest.approx(float(thrust[0]), rel=0.01)
