"""The propeller tables against momentum theory, the public thrust figures and their own generator."""

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from harness.design import blade_element
from harness.design.blade import Array, read_blade
from harness.design.blade_element import ADVANCE, ANGLES, DIAMETER, PROPELLER_FILE

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
    for name in ("C_THRUST", "C_POWER"):
        table = ET.parse(PROPELLER_FILE).getroot().find(f"table[@name='{name}']")
        assert table is not None
        lines = (table.findtext("tableData") or "").strip().splitlines()
        assert [float(text) for text in lines[0].split()] == pytest.approx(np.degrees(ANGLES).tolist())
        rows = np.array([[float(text) for text in line.split()] for line in lines[1:]])
        assert rows[:, 0].tolist() == pytest.approx(ADVANCE.tolist())
        tables[name] = rows[:, 1:]
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


def test_the_committed_file_is_what_the_generator_writes() -> None:
    text = blade_element.propeller(read_blade())
    committed = PROPELLER_FILE.read_text(encoding="utf-8")
    assert text.partition("<table")[0] == committed.partition("<table")[0]
    for new, old in zip(
        ET.fromstring(text).iter("tableData"), ET.fromstring(committed).iter("tableData"), strict=True
    ):
        cells = [np.array([float(cell) for cell in (part.text or "").split()]) for part in (new, old)]
        np.testing.assert_allclose(*cells, atol=ROUNDING)


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


HAMILTON_STANDARD = {  # advance ratio: C_P, C_T
    0.0: ((0.1141, 0.2221), (0.1783, 0.3054), (0.2599, 0.3831)),
    0.5: ((0.2441, 0.2841), (0.3947, 0.4056), (0.5803, 0.5157)),
    1.0: ((0.2134, 0.1685), (0.4266, 0.3172), (0.6708, 0.4526), (0.9519, 0.5655)),
    1.5: ((0.3942, 0.2193), (0.7416, 0.3870), (1.1207, 0.5312)),
    2.0: ((0.8315, 0.3447), (1.3494, 0.5165), (1.890, 0.6454)),
    3.0: ((0.9088, 0.2552), (1.3783, 0.3830), (1.8424, 0.4933), (2.306, 0.5899)),
}
"""Generalised method for eight blades of activity factor 150 and integrated design lift 0.5 without compressibility:
Worobel and Mayo, NASA CR-2066 (1972), base tables as published in NASA Aviary."""


@pytest.mark.parametrize("advance", HAMILTON_STANDARD)
def test_the_blade_elements_agree_with_the_hamilton_standard_method(advance: float) -> None:
    """Thrust at given power, light to heavy loading: an independent method, and nothing was fitted to these points."""
    blade = read_blade()
    blade = blade._replace(chord=blade.chord * 150.0 / 141.0, design_lift=blade.design_lift * 0.5 / 0.41)
    tolerance = 0.08 if advance == 0.0 else 0.06
    for power, thrust in HAMILTON_STANDARD[advance]:
        isolated = blade_element.governed_thrust(advance, power, blade, 0.3) / blade_element.INSTALLATION
        assert isolated == pytest.approx(thrust, rel=tolerance), (advance, power)


@pytest.mark.parametrize("density", [1.1, 1.0, 0.9])
def test_thin_air_takes_static_thrust_between_stall_and_momentum(
    tables: dict[str, Array], density: float
) -> None:
    """At take-off power from a hot, high field: momentum theory loses with the cube root of the density, stalled blades
    with the density itself (constant C_T), and no propeller is worse."""
    there, here = (
        governed_thrust(tables, 0.0, TAKEOFF_POWER, TAKEOFF_SPEED, air)
        for air in (density, SEA_LEVEL_DENSITY)
    )
    ratio = density / SEA_LEVEL_DENSITY
    assert ratio < there / here < ratio ** (1.0 / 3.0)


def test_compressibility_costs_thrust_only_in_fast_cruise() -> None:
    mach, factor = blade_element.compressibility(read_blade())
    assert np.all(np.diff(mach) > 0.0)
    assert np.all(np.diff(factor) <= 0.0)
    assert np.interp(0.95, mach, factor) == pytest.approx(1.0, abs=1e-3)
    assert 0.90 < np.interp(1.06, mach, factor) < 0.98


def test_reverse_never_brakes_harder_than_a_wall(tables: dict[str, Array]) -> None:
    """A disc that stops all air has a drag coefficient of 1.2 to 2 (Hoerner, flat plate; parachute): at speed the
    reverse map stays below it, whatever the blade angle the FADEC uses."""
    used = (np.degrees(ANGLES) >= -11.0) & (np.degrees(ANGLES) <= 0.0)
    fast = (ADVANCE >= 0.8) & (ADVANCE <= 1.6)
    drag = -tables["C_THRUST"][np.ix_(fast, used)] / (0.5 * ADVANCE[fast, np.newaxis] ** 2 * 0.25 * math.pi)
    assert np.all(drag > 0.0)
    assert np.all(drag < 2.0)


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
    blade = read_blade(stations=200)
    chord = np.interp(radius, blade.radius, blade.chord)
    lift = np.interp(radius, blade.radius, blade.design_lift)
    assert 1e5 / 16.0 * np.trapezoid(chord * radius**3, radius) == pytest.approx(141.0, rel=0.03)
    assert 4.0 * np.trapezoid(lift * radius**3, radius) == pytest.approx(0.41, rel=0.05)


def test_finer_stations_change_nothing_that_matters() -> None:
    advance, angle = np.array([0.0, 0.96, 2.96]), np.radians([28.0, 31.6, 52.4])
    coarse = blade_element.coefficients(advance, angle, read_blade())
    fine = blade_element.coefficients(advance, angle, read_blade(stations=96))
    np.testing.assert_allclose(coarse, fine, rtol=0.02)


def test_interpolation_between_the_grid_lines_is_close(tables: dict[str, Array]) -> None:
    blade = read_blade()
    row, column = 9, 25  # J 0.9 to 1.0, 30 to 32 deg: take-off
    advance = np.array([0.5 * (ADVANCE[row] + ADVANCE[row + 1])])
    angle = np.array([0.5 * (ANGLES[column] + ANGLES[column + 1])])
    thrust, _ = blade_element.coefficients(advance, angle, blade)
    around = tables["C_THRUST"][row : row + 2, column : column + 2]
    assert np.mean(around) == pytest.approx(float(thrust[0]), rel=0.01)
