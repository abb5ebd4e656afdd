"""Legs, wheels, brakes and surfaces against closed forms; places and stiffnesses are those of the aircraft's files."""

from collections.abc import Callable
from math import atan, cos, degrees, hypot, pi, radians, sin, sqrt, tan
from pathlib import Path
from statistics import pstdev

import jsbsim
import pytest

from harness.plant.jsbsim_plant import INTEGRATORS
from harness.units import FT, KT, LB
from harness.world.atmosphere import GRAVITY

LBF = LB * GRAVITY
SLUG = LBF / FT
RATE = 120
EAST = pi / 2
EARTH, EARTH_RATE = 6378137.0, 7.292115e-5  # m, rad/s
NOSE_X, MAIN_X = 6.66, 20.06
MAIN_STIFFNESS, NOSE_STIFFNESS = 660e3, 800e3
RADIUS, INERTIA = 0.52, 12.0
TREAD_MASS = INERTIA / RADIUS**2  # a main wheel as its tread feels it
NOSE_TREAD_MASS = 5.0 / 0.42**2
LEGS, WHEELS = range(1, 7), range(2, 14)
FUEL = 31400.0  # kg, makes 110 t
SHARES = (11.4, 13.4, 13.4, 3.0, 2.2, 2.2, 3.0)  # of the tanks, about as they are large
STANDING = 4.333  # m, the centre of gravity above the ground at 110 t
DRY, WET, GRAVEL, GRASS, SOFT = range(5)
ROLLING = {DRY: 0.02, WET: 0.02, GRAVEL: 0.04, GRASS: 0.05, SOFT: 0.10}
BRAKING = {GRAVEL: 0.30, GRASS: 0.40, SOFT: 0.20}  # Raymer, table 17.1

Aircraft = jsbsim.FGFDMExec
Start = Callable[..., Aircraft]


@pytest.fixture
def start(repository: Path) -> Start:
    """A new aircraft at 110 t: on its wheels, or with a ground speed in m/s, height and sink rate."""

    def make(
        speed: float = 0.0,
        *,
        surface: int = DRY,
        height: float = STANDING,
        sink: float = 0.0,
        rate: int = RATE,
    ) -> Aircraft:
        fdm = jsbsim.FGFDMExec(str(repository))
        fdm.set_debug_level(0)
        fdm.set_dt(1 / rate)
        assert fdm.load_model("gta")
        fdm.disable_output()
        for name, value in INTEGRATORS.items():
            fdm[name] = value
        for tank, share in enumerate(SHARES):
            fdm[f"propulsion/tank[{tank}]/contents-lbs"] = FUEL * share / sum(SHARES) / LB
        fdm["ground/surface"] = surface
        fdm["ic/psi-true-deg"] = degrees(EAST)
        fdm["ic/h-agl-ft"] = height / FT
        fdm["ic/ve-fps"], fdm["ic/vd-fps"] = speed / FT, sink / FT
        fdm.run_ic()
        if not speed and height == STANDING:
            fdm.do_trim(2)
        for engine in range(4):
            fdm[f"propulsion/engine-run[{engine}]"] = 0
        return fdm

    return make


@pytest.fixture
def rolling(start: Start) -> Start:
    """The aircraft two seconds after it began to roll at a speed, its wheels turning."""

    def make(speed: float, surface: int = DRY) -> Aircraft:
        fdm = start(speed, surface=surface)
        for wheel in range(14):
            fdm[f"gear/wheel-speed-mps[{wheel}]"] = speed
        fly(fdm, 2.0)
        return fdm

    return make


def steered(fdm: Aircraft) -> None:
    """One frame, held on a course to the east."""
    error = fdm["attitude/psi-rad"] - EAST
    fdm["fcs/steer-cmd-norm"] = max(-1.0, min(1.0, -6.0 * error - 2.0 * fdm["velocities/r-rad_sec"]))
    fdm.run()


def fly(fdm: Aircraft, seconds: float) -> None:
    for _ in range(round(seconds * RATE)):
        steered(fdm)


def brake(fdm: Aircraft, pedal: float) -> None:
    fdm["fcs/left-brake-cmd-norm"] = fdm["fcs/right-brake-cmd-norm"] = pedal


def levers(fdm: Aircraft, position: float) -> None:
    for engine in range(4):
        fdm[f"propulsion/engine-run[{engine}]"] = 1
        fdm[f"fcs/throttle-cmd-norm[{engine}]"] = position


def speed(fdm: Aircraft) -> float:
    return fdm["velocities/vg-fps"] * FT


def mass(fdm: Aircraft) -> float:
    return fdm["inertia/mass-slugs"] * SLUG


def loads(fdm: Aircraft) -> list[float]:
    return [fdm[f"gear/leg-load-n[{leg}]"] for leg in range(7)]


def from_the_air(fdm: Aircraft) -> float:
    """Aerodynamic force and thrust along the aircraft, N."""
    return sum(fdm[f"forces/fbx-{part}-lbs"] for part in ("aero", "prop", "external")) * LBF


def deceleration(fdm: Aircraft, frames: int = 12) -> float:
    before = speed(fdm)
    fly(fdm, frames / RATE)
    return (before - speed(fdm)) * RATE / frames


def place(fdm: Aircraft) -> tuple[float, float]:
    latitude = fdm["position/lat-geod-rad"]
    return latitude * EARTH, fdm["position/long-gc-rad"] * EARTH * cos(latitude)


def test_the_weight_rests_on_the_legs_as_the_lever_rule_says(start: Start):
    fdm = start()
    fly(fdm, 3.0)
    nose, *main = loads(fdm)
    spin = EARTH_RATE**2 * EARTH  # JSBSim's gravity is that of the mass alone; it stands on the equator
    weight = mass(fdm) * (fdm["accelerations/gravity-ft_sec2"] * FT - spin)
    centre = fdm["inertia/cg-x-in"] * 0.0254
    assert nose + sum(main) == pytest.approx(weight, rel=0.001)
    assert nose / weight == pytest.approx((MAIN_X - centre) / (MAIN_X - NOSE_X), abs=0.002)
    assert sum(main[:3]) == pytest.approx(sum(main[3:]), rel=0.005)
    assert main[0] * 3 == pytest.approx(sum(main[:3]), rel=0.01)
    for leg, stiffness in [(0, NOSE_STIFFNESS), *((leg, MAIN_STIFFNESS) for leg in LEGS)]:
        assert fdm[f"gear/leg-stroke-m[{leg}]"] == pytest.approx(loads(fdm)[leg] / stiffness, rel=0.002)


def test_in_a_drop_the_legs_take_up_the_energy_of_the_fall(start: Start):
    sink = 2.0
    fdm = start(height=STANDING + 0.4, sink=sink)
    kinetic, work, lowest, height = 0.0, 0.0, 0.0, 0.0
    strokes, previous = [0.0] * 7, [0.0] * 7
    for _ in range(3 * RATE):
        if not fdm["gear/main-wow"]:  # as it was before the first force
            kinetic = 0.5 * mass(fdm) * (fdm["velocities/h-dot-fps"] * FT) ** 2
            height = fdm["position/h-sl-ft"] * FT
        fdm.run()
        new = [fdm[f"gear/leg-stroke-m[{leg}]"] for leg in range(7)]
        work += sum(
            (a + b) / 2 * (q - p) for a, b, p, q in zip(previous, loads(fdm), strokes, new, strict=True)
        )
        strokes, previous = new, loads(fdm)
        if fdm["velocities/h-dot-fps"] >= 0:
            lowest = height - fdm["position/h-sl-ft"] * FT
            break
    potential = mass(fdm) * GRAVITY * lowest
    assert 2.0 < sqrt(2 * kinetic / mass(fdm)) < 3.5
    assert work == pytest.approx(kinetic + potential, rel=0.03)
    undamped = MAIN_STIFFNESS * 6 + NOSE_STIFFNESS
    weight = mass(fdm) * GRAVITY
    assert max(strokes[1:]) < (weight + sqrt(weight**2 + 2 * undamped * kinetic)) / undamped


@pytest.mark.parametrize(
    ("ground_speed", "sink", "rate"), [(65.0, 1.0, 120), (65.0, 3.0, 120), (50.0, 0.5, 120), (65.0, 1.0, 480)]
)
def test_spinning_up_the_wheels_costs_the_aircraft_their_momentum(
    start: Start, ground_speed: float, sink: float, rate: int
):
    """The impulse of the ground on the aircraft, less rolling friction, is the sum of I w / r."""
    fdm = start(ground_speed, height=STANDING + 0.55, sink=sink, rate=rate)
    impulse, began, fastest = 0.0, -1, 0.0
    half_load = []
    for frame in range(3 * rate):
        fdm.run()
        along, down, pitch = fdm["forces/fbx-gear-lbs"], fdm["forces/fbz-gear-lbs"], fdm["attitude/theta-rad"]
        drag = -(along * cos(pitch) + down * sin(pitch)) * LBF
        load = (along * sin(pitch) - down * cos(pitch)) * LBF
        impulse += (drag - ROLLING[DRY] * max(load, 0.0)) / rate
        fastest = max(fdm[f"gear/wheel-speed-mps[{wheel}]"] for wheel in WHEELS)
        if began < 0 and loads(fdm)[3] > 100.0:
            began = frame
        if began >= 0 and fastest < 0.9 * ground_speed:
            half_load.append(loads(fdm)[3] / 2)
        if min(fdm[f"gear/wheel-speed-mps[{wheel}]"] for wheel in WHEELS) > 0.97 * speed(fdm):
            break
    fdm.run()  # the wheels take up a force one frame after the aircraft
    momentum = TREAD_MASS * sum(fdm[f"gear/wheel-speed-mps[{wheel}]"] for wheel in WHEELS)
    momentum += NOSE_TREAD_MASS * sum(fdm[f"gear/wheel-speed-mps[{wheel}]"] for wheel in (0, 1))
    assert momentum > 0.95 * 12 * TREAD_MASS * ground_speed
    assert impulse == pytest.approx(momentum, rel=0.005)
    # the time: I w / r of the aft wheels over a friction between a locked tyre's and the peak, give or take a frame
    friction = sum(half_load) / rate
    assert 0.85 * 0.65 * 0.75 * friction < TREAD_MASS * 0.9 * ground_speed < 1.15 * 0.75 * friction


def test_retraction_stops_the_wheels_and_puts_them_to_sleep(start: Start):
    fdm = start(70.0, height=3000.0)
    for wheel in range(14):
        fdm[f"gear/wheel-speed-mps[{wheel}]"] = 70.0
    fdm["gear/fastest-wheel-mps"] = 70.0
    fdm["gear/gear-cmd-norm"] = 0
    force = 0.15 * 25000 / RADIUS
    expected = 70.0 * TREAD_MASS / (0.72 * force)  # the brake's rolling torque is 0.72 of the standing one
    stopped = 0.0
    for frame in range(12 * RATE):
        fdm.run()
        if not stopped and fdm["gear/wheel-speed-mps[2]"] == 0:
            stopped = frame / RATE
    assert stopped == pytest.approx(expected, rel=0.05)
    assert fdm["gear/wheel-speed-mps[0]"] == 0
    assert (fdm["gear/gear-pos-norm"], fdm["gear/wheels-awake"], fdm["gear/main-wow"]) == (0, 0, 0)


@pytest.mark.parametrize("surface", [DRY, GRAVEL, SOFT])
def test_friction_and_air_slow_a_rolling_aircraft_and_its_wheels(rolling: Start, surface: int):
    fdm = rolling(40.0, surface)
    force = -from_the_air(fdm) + ROLLING[surface] * sum(loads(fdm))
    measured = deceleration(fdm, 120)
    force = (force - from_the_air(fdm) + ROLLING[surface] * sum(loads(fdm))) / 2
    carried = mass(fdm) + 12 * TREAD_MASS + 2 * NOSE_TREAD_MASS
    assert measured == pytest.approx(
        force / carried, rel=0.01 if surface == DRY else 0.04
    )  # bumps move the load


def wet_friction(ground_speed: float) -> float:
    """CS-25.109(c)(1), between its tyre pressures of 100 and 200 psi, at 130 psi."""
    v = ground_speed / 0.514444 / 100
    low = -0.0437 * v**3 + 0.320 * v**2 - 0.805 * v + 0.804
    high = -0.0331 * v**3 + 0.252 * v**2 - 0.658 * v + 0.692
    return low + 0.3 * (high - low)


def dry_brakes(legs: list[float]) -> float:
    """The force of the brakes of these legs on a dry runway: by torque, or by grip where the load is small."""
    return 2 * sum(min(18000 / RADIUS, 0.8 * 0.75 * load / 2) for load in legs)


@pytest.mark.parametrize("surface", [DRY, WET, GRAVEL, GRASS, SOFT])
def test_brakes_stop_the_aircraft_as_torque_and_surface_allow(rolling: Start, surface: int):
    fdm = rolling(50.0, surface)
    brake(fdm, 1.0)
    fly(fdm, 3.0)
    assert max(fdm[f"gear/tyre-slip[{wheel}]"] for wheel in WHEELS) < 0.2
    _, *main = loads(fdm)
    if surface == DRY:
        force = dry_brakes(main)
    else:
        grip = 0.8 * wet_friction(speed(fdm)) if surface == WET else BRAKING[surface]
        force = grip * sum(main)
        assert force < 12 * 18000 / RADIUS
    force += ROLLING[surface] * sum(loads(fdm)) - from_the_air(fdm)
    carried = mass(fdm) + 12 * TREAD_MASS
    assert deceleration(fdm) == pytest.approx(force / carried, rel=0.03 if surface in (DRY, WET) else 0.08)


@pytest.mark.parametrize("anti_skid_fails", [0, 1])
def test_the_energy_of_a_stop_is_in_brakes_tyres_and_air(rolling: Start, anti_skid_fails: int):
    fdm = rolling(50.0, WET)
    fdm["failure/anti-skid"] = anti_skid_fails
    brake(fdm, 1.0)
    energy = 0.5 * mass(fdm) * speed(fdm) ** 2 + 0.5 * 12 * TREAD_MASS * speed(fdm) ** 2
    spent, slipped, slip, before = 0.0, 0.0, 0.0, speed(fdm)
    while speed(fdm) > 0.2:
        steered(fdm)
        distance, before = (before + speed(fdm)) / 2 / RATE, speed(fdm)
        spent += (ROLLING[WET] * sum(loads(fdm)) - from_the_air(fdm)) * distance
        for wheel in WHEELS:
            sliding = fdm[f"gear/axle-speed-mps[{wheel}]"] - fdm[f"gear/wheel-speed-mps[{wheel}]"]
            slipped += loads(fdm)[wheel // 2] / 2 * fdm[f"gear/tyre-mu[{wheel}]"] * sliding / RATE
        if speed(fdm) > 10:
            slip = max(slip, fdm["gear/tyre-slip[4]"])
    brakes = sum(fdm[f"gear/brake-energy-mj[{leg}]"] for leg in LEGS) * 1e6
    assert brakes + slipped + spent == pytest.approx(energy, rel=0.01)
    if anti_skid_fails:  # locked wheels: the tyres take it
        assert slip == 1.0
        assert slipped > 0.8 * energy
    else:
        assert slip < 0.2
        assert brakes > 0.8 * energy
    assert fdm["gear/brake-energy-peak-mj"] == max(fdm[f"gear/brake-energy-mj[{leg}]"] for leg in LEGS)
    assert fdm["gear/brake-energy-peak-mj"] < fdm["gear/brake-energy-limit-mj"]
    assert 49.0 < fdm["gear/tyre-speed-max-mps"] < 50.5 < fdm["gear/tyre-speed-limit-mps"]


def test_locked_wheels_brake_with_the_friction_of_a_sliding_tyre(rolling: Start):
    fdm = rolling(50.0, WET)
    fdm["failure/anti-skid"] = 1
    brake(fdm, 1.0)
    fly(fdm, 2.0)
    assert fdm["gear/wheel-speed-mps[7]"] == 0
    force = 0.65 * wet_friction(speed(fdm)) * sum(loads(fdm)[1:])
    force += ROLLING[WET] * sum(loads(fdm)) - from_the_air(fdm)
    assert deceleration(fdm) == pytest.approx(force / mass(fdm), rel=0.02)


def test_a_leg_without_brakes_costs_its_share_and_pulls_to_the_other_side(rolling: Start):
    fdm = rolling(50.0)
    fdm["failure/brake[1]"] = 1
    brake(fdm, 1.0)
    start_north = place(fdm)[0]
    fly(fdm, 3.0)
    assert fdm["gear/brake-force-n[2]"] == fdm["gear/brake-energy-mj[1]"] == 0
    force = dry_brakes(loads(fdm)[2:]) + ROLLING[DRY] * sum(loads(fdm)) - from_the_air(fdm)
    assert deceleration(fdm) == pytest.approx(force / (mass(fdm) + 10 * TREAD_MASS), rel=0.03)
    assert place(fdm)[0] < start_north - 0.1  # heading east, the right is south


def test_steady_braking_swings_the_legs_as_their_stiffness_says(rolling: Start):
    fdm = rolling(50.0)
    brake(fdm, 1.0)
    fly(fdm, 3.0)
    leg = 2
    drag = fdm[f"gear/tyre-drag-n[{leg}]"] + ROLLING[DRY] * loads(fdm)[leg]
    assert drag > 60e3
    assert fdm[f"gear/leg-swing-rad[{leg}]"] == pytest.approx(
        drag / (640 * 2.2 * (2 * pi * 12) ** 2), rel=0.02
    )


def taxi(fdm: Aircraft, wanted: float, steer: float, seconds: float) -> tuple[float, float]:
    """Speed and rate of turn, the mean of the last three seconds, under a steering command."""
    history = []
    for _ in range(round(seconds * RATE)):
        now = speed(fdm)
        levers(fdm, max(-0.3, min(0.5, 0.25 * (wanted - now))))
        brake(fdm, max(0.0, min(1.0, 0.2 * (now - wanted - 0.2))))
        fdm["fcs/steer-cmd-norm"] = steer if now > 0.8 * wanted or history else 0.0
        fdm.run()
        history.append((speed(fdm), fdm["velocities/r-rad_sec"]))
    last = history[-3 * RATE :]
    return sum(v for v, _ in last) / len(last), sum(r for _, r in last) / len(last)


@pytest.mark.parametrize(("steer", "wanted"), [(0.1, 5.0), (-0.3, 4.0), (1.0, 2.0)])
def test_a_turn_on_the_ground_follows_the_steered_wheel(start: Start, steer: float, wanted: float):
    """QTG 1.a.1 (radius within 20 %) and 1.a.2 (rate of turn within 10 % or 2 deg/s), about the rear axle's centre."""
    fdm = start()
    moving, rate = taxi(fdm, wanted, steer, 25.0)
    angle = radians(fdm["fcs/steer-pos-deg[0]"])
    centre = fdm["inertia/cg-x-in"] * 0.0254
    slip = atan(
        (MAIN_X - centre) / (MAIN_X - NOSE_X) * tan(angle)
    )  # the speed is that of the centre of gravity
    kinematic = moving * cos(slip) * tan(angle) / (MAIN_X - NOSE_X)
    assert degrees(rate) == pytest.approx(degrees(kinematic), rel=0.10, abs=0.1)
    assert moving / rate == pytest.approx(moving / kinematic, rel=0.20)


def test_without_hydraulics_the_nose_wheels_caster(start: Start):
    fdm = start()
    fdm["failure/steering"] = 1
    _, rate = taxi(fdm, 4.0, 0.5, 20.0)
    assert abs(degrees(rate)) < 0.05
    assert abs(fdm["fcs/steer-pos-deg[0]"]) < 0.5


def wandered(fdm: Aircraft, seconds: float) -> tuple[float, float]:
    """How far the aircraft moved, m, and the angle it turned by, rad."""
    begun, heading = place(fdm), fdm["attitude/psi-rad"]
    for _ in range(round(seconds * RATE)):
        fdm.run()
    ended = place(fdm)
    return hypot(ended[0] - begun[0], ended[1] - begun[1]), abs(fdm["attitude/psi-rad"] - heading)


@pytest.mark.parametrize(("wind", "lever", "seconds"), [(0.0, 1.0, 60.0), (20.0, 0.0, 30.0)])
def test_brakes_hold_without_creep(start: Start, wind: float, lever: float, seconds: float):
    """JSBSim with our integrators drifts 7 to 10 mm a minute aft, engines off too: power and wind may not add to it."""
    fdm = start()
    fdm["gear/parking-brake"] = 1
    fdm["atmosphere/wind-north-fps"] = wind * KT / FT
    if lever:
        levers(fdm, lever)
    wandered(fdm, 20.0)
    moved, turned = wandered(fdm, seconds)
    assert not lever or fdm["propulsion/total-thrust-n"] > 450e3
    assert moved < 0.012 * seconds / 60
    assert degrees(turned) < 1e-3


def test_without_brakes_take_off_power_moves_it(start: Start):
    fdm = start()
    levers(fdm, 1.0)
    assert wandered(fdm, 30.0)[0] > 100.0


@pytest.mark.parametrize(
    ("part", "height", "pitch", "bank"),
    [
        ("tail", 4.3, 13.0, 0.0),
        ("belly", 2.9, 0.0, 0.0),
        ("wing", 4.3, 0.0, 13.0),
        ("wing", 4.3, 0.0, -13.0),
        ("wing", 6.0, 0.0, 30.0),
    ],
)
def test_a_strike_of_the_structure_is_felt(
    repository: Path, part: str, height: float, pitch: float, bank: float
):
    fdm = jsbsim.FGFDMExec(str(repository))
    fdm.set_debug_level(0)
    assert fdm.load_model("gta")
    fdm.disable_output()
    down = part != "belly"
    fdm["gear/gear-cmd-norm"] = fdm["gear/gear-pos-norm"] = float(down)
    for name, value in {
        "h-agl-ft": height / FT,
        "theta-deg": pitch,
        "phi-deg": bank,
        "vt-kts": 120.0,
    }.items():
        fdm[f"ic/{name}"] = value
    fdm.run_ic()
    struck = set()
    for _ in range(24):
        fdm.run()
        struck |= {i for i in (3, 4, 5) if fdm[f"contact/unit[{i}]/WOW"]}
    assert struck == {{"tail": 3, "belly": 4, "wing": 5}[part]}


def test_level_on_its_wheels_nothing_else_touches(start: Start):
    fdm = start()
    fly(fdm, 1.0)
    assert not any(fdm[f"contact/unit[{i}]/WOW"] for i in (3, 4, 5))


@pytest.mark.parametrize(("surface", "rms"), [(DRY, 0.0), (GRAVEL, 0.0099), (GRASS, 0.0197)])
def test_a_rough_surface_has_the_waves_of_its_class(rolling: Start, surface: int, rms: float):
    """ISO 8608: 256e-6 (class C), 1024e-6 m3 (D) at 0.1 cycles a metre, falling with the square, between 2 and 40 m."""
    fdm = rolling(50.0, surface)
    bumps, left_right = [], []
    for _ in range(6 * RATE):
        steered(fdm)
        bumps.append(fdm["gear/bump-m[1]"])
        left_right.append(bumps[-1] - fdm["gear/bump-m[4]"])
    assert pstdev(bumps) == pytest.approx(rms, rel=0.06)
    if surface != DRY:
        density = {GRAVEL: 256e-6, GRASS: 1024e-6}[surface]
        assert rms == pytest.approx(sqrt(density * 0.1**2 * (40 - 2)), rel=0.01)
        assert 0.3 * rms < pstdev(left_right) < 1.5 * rms
        fdm["ground/surface"] = DRY
        fly(fdm, 0.1)
        assert all(fdm[f"gear/bump-m[{leg}]"] == 0 for leg in range(7))
