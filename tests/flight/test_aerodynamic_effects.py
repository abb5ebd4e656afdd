"""Each effect the aerodynamics name, on and off, against its closed form; the aircraft held still in moving air."""

from math import exp, pi, radians, sqrt
from pathlib import Path

import pytest

from harness.plant.bench import Attitude, Bench
from harness.plant.trim import fly_by_hand
from harness.units import FT, KT

DISC = pi * 5.33**2 / 4
LBF = 4.4482216152605
STALL = ("cl-basic", "roll-damping-norm", "alpha-stall-margin-rad", "stall-warning")


@pytest.fixture
def bench(repository: Path) -> Bench:
    """The aircraft at 140 kt at sea level, all controls neutral, half power."""
    bench = Bench(repository, "gta")
    bench.load(100e3)
    fly_by_hand(bench)
    bench.configure(flap=0.0, gear=0.0)
    bench.levers(0.6)
    bench.place(0.0, Attitude(140 * KT, alpha=radians(5.0)))
    bench.run_up()
    return bench


def moved(bench: Bench, switch: str, quantity: str) -> tuple[float, float]:
    """The quantity with the effect on and off."""
    found = []
    for on in (1.0, 0.0):
        bench.put(f"aero/effect/{switch}", on)
        bench.run(3.0)
        found.append(bench.get(quantity))
    bench.put(f"aero/effect/{switch}", 1.0)
    return found[0], found[1]


def near_the_ground(bench: Bench) -> float:
    """Bring the ground up to 6 m below the reference point and give McCormick's factor there."""
    height = bench.get("position/h-agl-ft") * FT
    ground = bench.get("position/terrain-elevation-asl-ft") + (height - 6.0) / FT
    bench.put("position/terrain-elevation-asl-ft", ground)
    bench.run(0.5)
    wing = 16 * (bench.get("aero/h_b-mac-ft") + 0.028)
    return wing**2 / (1 + wing**2)


def test_the_ground_adds_lift_and_takes_induced_drag(bench: Bench):
    factor = near_the_ground(bench)
    bench.levers(0.0)
    bench.run(8)
    bench.put("aero/effect/slipstream-lift", 0.0)
    lift, free_lift = moved(bench, "ground", "aero/cl-basic")
    assert lift / free_lift == pytest.approx(1.15 - 0.15 * factor, rel=1e-6)
    drag, free_drag = moved(bench, "ground", "aero/drag-lbs")
    pressure = bench.get("aero/qbar-psf") * bench.get("metrics/Sw-sqft")
    induced = 0.0491 * (free_lift**2 - factor * lift**2)
    assert (free_drag - drag) / pressure == pytest.approx(induced, rel=1e-3)
    assert 0.2 < factor < 0.9


def test_the_slipstream_adds_lift_by_smelt_and_davies(bench: Bench):
    lift, without = moved(bench, "slipstream-lift", "aero/cl-total")
    thrust = bench.get("propulsion/engine[0]/thrust-lbs") * LBF
    pressure = bench.get("aero/qbarUW-psf") * LBF / FT**2
    law = 1 + 0.55 * (sqrt(1 + thrust / (pressure * DISC)) - 1)
    assert lift / without == pytest.approx(law, rel=0.02)  # faded by 20/q^2 = 0.5 %
    assert law > 1.1


def test_one_dead_engine_rolls_the_aircraft_by_its_slipstream(bench: Bench):
    both, none = moved(bench, "slipstream-roll", "aero/roll-lbsft")
    assert both == pytest.approx(none, rel=0.02, abs=100)
    bench.fail(0)
    bench.run(15)
    dead, none = moved(bench, "slipstream-roll", "aero/roll-lbsft")
    lift = bench.get("aero/qbar-psf") * bench.get("metrics/Sw-sqft") * bench.get("aero/cl-basic")
    arm = (
        (none - dead) / lift * FT
    )  # m, at which the wing's lift acts because of the asymmetry: left wing down
    loading = bench.get("propulsion/engine[3]/thrust-lbs") / (bench.get("aero/qbarUW-psf") * DISC / FT**2)
    ratio = sqrt(1 + loading) - 1
    assert arm == pytest.approx(0.55 / 4 * 12.3 * ratio, rel=0.1)
    assert arm > 0.1


def test_downwash_unloads_the_tail(bench: Bench):
    moment, without = moved(bench, "downwash", "aero/pitch-lbsft")
    pressure = bench.get("aero/qbarUW-psf") * bench.get("metrics/Sw-sqft") * bench.get("metrics/cbarw-ft")
    expected = 4.24 * 0.057 * bench.get("aero/cl-basic")
    assert (moment - without) / pressure == pytest.approx(expected, rel=0.01)


def test_downwash_arrives_a_tail_arm_later(bench: Bench):
    start = bench.get("aero/downwash-rad")
    bench.put("fcs/flap-cmd-norm", 1.0)
    bench.put("fcs/flap-pos-norm", 1.0)
    bench.run(0.1)  # the slow channels have seen the flaps
    wanted = 0.057 * bench.get("aero/cl-basic")
    begin = bench.get("aero/downwash-rad")
    delay = 21.5 / (140 * KT)
    bench.run(0.3)
    left = (wanted - bench.get("aero/downwash-rad")) / (wanted - begin)
    assert left == pytest.approx(exp(-0.3 / delay), abs=0.04)
    bench.put("aero/effect/downwash-lag", 0.0)
    bench.run(0.05)
    assert bench.get("aero/downwash-rad") == pytest.approx(0.057 * bench.get("aero/cl-basic"), rel=1e-4)
    assert wanted > start


@pytest.mark.parametrize(
    ("switch", "control", "lift", "drag"),
    [("flaps", "flap", 1.0, 0.075), ("speedbrakes", "speedbrake", -0.06 * 0.903, 0.025)],
)
def test_flaps_and_speed_brakes_change_lift_and_drag(
    bench: Bench, switch: str, control: str, lift: float, drag: float
):
    for name in (f"fcs/{control}-cmd-norm", f"fcs/{control}-pos-norm"):
        bench.put(name, 1.0)
    bench.run(0.5)
    on, off = moved(bench, switch, "aero/cl-basic")
    assert on - off == pytest.approx(lift, rel=0.02)
    on, off = moved(bench, switch, "aero/cd-profile")
    assert on - off == pytest.approx(drag, rel=0.01)


def test_roll_spoilers_roll_more_behind_flaps(bench: Bench):
    rolls = []
    for flap in (0.0, 1.0):
        bench.configure(flap=flap, gear=0.0)
        bench.put("fcs/aileron-cmd-norm", 1.0)
        bench.run(1.0)
        on, off = moved(bench, "roll-spoilers", "aero/roll-lbsft")
        span = bench.get("aero/qbar-psf") * bench.get("metrics/Sw-sqft") * bench.get("metrics/bw-ft")
        rolls.append((on - off) / span)
    assert rolls == pytest.approx([0.06 * 0.436, 1.5 * 0.06 * 0.436], rel=0.01)


def test_flaps_ease_the_dihedral_effect_and_stiffen_in_yaw(bench: Bench):
    stiffness = {}
    for flap in (0.0, 1.0):
        bench.configure(flap=flap, gear=0.0)
        moments = []
        for side in (1, -1):
            bench.place(0.0, Attitude(140 * KT, alpha=radians(2.0), beta=side * radians(3.0)))
            bench.run(0.5)
            span = bench.get("aero/qbar-psf") * bench.get("metrics/Sw-sqft") * bench.get("metrics/bw-ft")
            roll, yaw = (bench.get(f"aero/{axis}-lbsft") / span for axis in ("roll", "yaw"))
            moments.append((roll, yaw, bench.get("aero/cl-basic")))
        (roll, yaw, lift), (left_roll, left_yaw, _) = moments
        stiffness[flap] = ((roll - left_roll) / radians(6.0), (yaw - left_yaw) / radians(6.0), lift)
    for flap, (roll, yaw, lift) in stiffness.items():
        assert roll == pytest.approx(-0.08 - 0.06 * lift + 0.02 * flap, rel=0.03)
        assert yaw == pytest.approx(0.14 * (1 + 0.1 * flap), rel=0.03)


@pytest.mark.parametrize("flap", [0.0, 0.5, 1.0])
def test_beyond_the_stall_lift_drops_and_roll_damping_drives(bench: Bench, flap: float):
    bench.configure(flap=flap, gear=0.0)
    bench.levers(0.0)
    found = {}
    for degrees in range(2, 27):
        bench.place(0.0, Attitude(110 * KT, alpha=radians(degrees)))
        bench.run(0.2)
        found[degrees] = tuple(bench.get(f"aero/{name}") for name in STALL)
    peak = max(found, key=lambda degrees: found[degrees][0])
    lift = [row[0] for row in found.values()]
    assert found[peak + 8][0] < 0.88 * found[peak][0]
    assert lift[: peak - 1] == sorted(lift[: peak - 1])
    assert abs(found[peak][2]) < radians(1.0)
    assert found[peak - 3][1] == 1.0
    assert found[peak + 3][1] < 0.0  # a wing drops
    assert found[peak - 2][3] == 1.0
    assert found[2][3] == 0.0


def test_the_buffet_leaves_a_margin_in_cruise_and_none_at_the_maximum(bench: Bench):
    bench.place(9448.8, Attitude(205.3, alpha=radians(0.9)))  # FL310, Mach 0.68, 120 t
    bench.run(0.5)
    margin, lift = bench.get("aero/buffet-margin-cl"), bench.get("aero/cl-total")
    assert (margin + lift) / lift > 1.3
    bench.place(0.0, Attitude(110 * KT, alpha=radians(15.0)))
    bench.run(0.5)
    assert bench.get("aero/buffet-margin-cl") < 0.0


def test_inertia_with_load_is_that_of_the_radii_of_gyration(bench: Bench):
    bench.load(110e3)
    bench.run(0.1)
    span, length = 42.357, 45.091
    radii = {"ixx": 0.322 * span / 2, "iyy": 0.324 * length / 2, "izz": 0.456 * (span + length) / 4}
    for name, radius in radii.items():
        found = bench.get(f"inertia/{name}-slugs_ft2") * 1.3558179483
        assert found == pytest.approx(110e3 * radius**2, rel=0.03), name
