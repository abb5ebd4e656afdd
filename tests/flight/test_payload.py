"""Mass, balance and inertia in the simulator against closed forms, and a load that leaves over the ramp."""

import itertools
from collections.abc import Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import jsbsim
import numpy as np
import pytest
from airborne import Flight, named
from numpy.typing import NDArray

from harness import flight
from harness.session import Session

Vector = NDArray[np.float64]
FT, INCH, LB, SLUG = 0.3048, 0.0254, 0.45359237, 14.59390294
G0 = 9.80665
LOAD = 8000.0  # kg
RAMP_END = 33.2  # m


def parallel_axis(mass: float, place: Vector, centre: Vector) -> Vector:
    """The inertia tensor of a point, by Huygens and Steiner, structural axes."""
    away = place - centre
    return mass * (away @ away * np.eye(3) - np.outer(away, away))


def expected(
    repository: Path, load: list[tuple[float, Vector, Vector]], tanks: list[float]
) -> tuple[float, Vector, Vector]:
    """Mass, centre and inertia tensor from the XML files and this load: (mass, place, own inertia about its axes)."""
    balance = ET.parse(repository / "aircraft/gta/mass-balance.xml").getroot()

    def place(element: ET.Element) -> Vector:
        return np.array([float(element.findtext(f"location/{axis}") or "nan") for axis in "xyz"])

    own = {name: float(balance.findtext(name) or 0.0) for name in ("ixx", "iyy", "izz", "ixz")}
    empty = np.diag([own["ixx"], own["iyy"], own["izz"]])
    empty[0, 2] = empty[2, 0] = -own["ixz"]  # x z has the same sign in both axes: both are turned round
    parts = [(float(balance.findtext("emptywt") or "nan"), place(balance), empty), *load]
    where = ET.parse(repository / "aircraft/gta/propulsion.xml").getroot().findall("tank")
    parts += [(mass, place(tank), np.zeros((3, 3))) for mass, tank in zip(tanks, where, strict=True)]
    total = sum(mass for mass, _, _ in parts)
    centre = sum((mass * at for mass, at, _ in parts), np.zeros(3)) / total
    tensor = sum((inertia + parallel_axis(mass, at, centre) for mass, at, inertia in parts), np.zeros((3, 3)))
    return total, centre, tensor


def measured(fdm: jsbsim.FGFDMExec) -> tuple[float, Vector, Vector]:
    """The same of the simulator, in structural axes: its x and z are turned round against them.

    JSBSim's ixy and iyz are the integrals of x y and y z, its ixz is minus that of x z: so a point mass tells.
    """
    inertia = {
        name: fdm[f"inertia/{name}-slugs_ft2"] * SLUG * FT**2
        for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    }
    tensor = np.diag([inertia["ixx"], inertia["iyy"], inertia["izz"]])
    tensor[0, 2] = tensor[2, 0] = inertia["ixz"]
    tensor[0, 1] = tensor[1, 0] = inertia["ixy"]
    tensor[1, 2] = tensor[2, 1] = inertia["iyz"]
    centre = np.array([fdm[f"inertia/cg-{axis}-in"] * INCH for axis in "xyz"])
    return fdm["inertia/mass-slugs"] * SLUG, centre, tensor


def cylinder(mass: float, x: float) -> tuple[float, Vector, Vector]:
    """A pallet: 1.1 m radius, 2.74 m long, its centre 3.2 m above the ground."""
    across = mass * (3 * 1.1**2 + 2.74**2) / 12
    return mass, np.array([x, 0.0, 3.2]), np.diag([mass * 1.1**2 / 2, across, across])


def seat(x: float, y: float) -> tuple[float, Vector, Vector]:
    return 110.0, np.array([x, y, 2.7]), np.zeros((3, 3))


BULK = 9400.0 * np.diag([1.6**2 / 2, (3 * 1.6**2 + 144) / 12, (3 * 1.6**2 + 144) / 12])
LOADS = {
    "bulk": ("hop", ["loading/take-off-mass=96 t"], [(9400.0, np.array([19.0, 0.0, 3.2]), BULK)]),
    "pallets and seats": (
        "airdrop",
        [],
        [
            cylinder(8000.0, 21.0),
            cylinder(3000.0, 17.0),
            *(seat(10.8 + 0.6 * row, y) for row in range(6) for y in (-1.75, 1.75)),
        ],
    ),
    "all to one side": (
        "airdrop",
        ["loading/seats=1A-27A 1B-20B", "loading/pallet[vehicle]/position=26 m"],
        [
            cylinder(8000.0, 26.0),
            cylinder(3000.0, 17.0),
            *(seat(10.8 + 0.6 * row, -1.75) for row in range(27)),
            *(seat(10.9 + 0.53 * row, -0.35) for row in range(20)),
        ],
    ),
}


@pytest.mark.parametrize("case", LOADS)
def test_mass_centre_and_inertia_are_the_closed_form(case: str, repository: Path, tmp_path: Path) -> None:
    name, overrides, load = LOADS[case]
    source = repository / "missions" / f"{name}.xml"
    if case == "all to one side":
        source = tmp_path / "seats.xml"
        text = (repository / "missions/airdrop.xml").read_text("utf-8")
        source.write_text(text.replace(' passengers="12"', ' seats="1A"'), "utf-8")
    session = Session(source, overrides)
    _, plant = flight.prepare(session.mission, session.manual, rate=120)
    fdm = plant.fdm
    fdm.run()
    tanks = [fdm[f"propulsion/tank[{tank}]/contents-lbs"] * LB for tank in range(7)]
    mass, centre, tensor = measured(fdm)
    want_mass, want_centre, want_tensor = expected(repository, load, tanks)
    assert mass == pytest.approx(want_mass, rel=1e-7)
    assert centre == pytest.approx(want_centre, abs=1e-5)
    # JSBSim takes 1 kg m2 for 1.35594 slug ft2 backwards, 9e-5 off in what the XML states in KG*M2
    assert tensor == pytest.approx(want_tensor, rel=1.5e-4, abs=50.0)


class Weightless:
    """The aircraft coasting far above the air with its engines off, turning nose up."""

    def __init__(self, repository: Path, pitch_rate: float) -> None:
        self.fdm = fdm = jsbsim.FGFDMExec(str(repository))
        fdm.set_debug_level(0)
        fdm.set_dt(1 / 120)
        assert fdm.load_model("gta")
        for name, value in (("rate/rotational", 3), ("rate/translational", 3), ("position/rotational", 7)):
            fdm[f"simulation/integrator/{name}"] = value
        for engine in range(4):
            fdm[f"propulsion/engine-run[{engine}]"] = 0
        fdm["inertia/pointmass-weight-lbs[5]"] = LOAD / LB
        fdm["inertia/pointmass-location-X-inches[5]"] = 21.0 / INCH
        fdm["ic/h-sl-ft"], fdm["ic/u-fps"], fdm["ic/q-rad_sec"] = 300_000, 100.0, pitch_rate
        assert fdm.run_ic()
        fdm["payload/ramp-pos-norm"] = fdm["payload/ramp-cmd-norm"] = 1

    def release(self, speed: float) -> None:
        """Let the load go, with this speed along the floor."""
        self.fdm["payload/release"] = 1
        self.fdm["payload/speed-mps"] = speed
        self.fdm.run()

    def frames(self) -> Iterator[None]:
        """Until the load is gone."""
        while self.fdm["payload/dropped-kg"] == 0.0:
            yield
            assert self.fdm.run()

    @property
    def angular_momentum(self) -> float:
        """About the common centre of gravity, nose up: I q + m (rho x v), rho and v of the load."""
        fdm = self.fdm
        below = fdm["inertia/cg-z-in"] * INCH - 3.2
        inertia = fdm["inertia/iyy-slugs_ft2"] * SLUG * FT**2
        return inertia * fdm["velocities/q-rad_sec"] - LOAD * below * fdm["payload/speed-mps"]

    @property
    def velocity(self) -> Vector:
        """Of the common centre of gravity, north, east, down: the aircraft's there, and the load's share."""
        fdm = self.fdm
        pitch, share = fdm["attitude/theta-rad"], LOAD / (fdm["inertia/mass-slugs"] * SLUG)
        aft = fdm["payload/speed-mps"] * share * np.array([-np.cos(pitch), 0.0, np.sin(pitch)])
        return np.array([fdm[f"velocities/v-{way}-fps"] * FT for way in ("north", "east", "down")]) + aft


def test_angular_momentum_is_kept_while_a_load_rolls_aft(repository: Path) -> None:
    coasting = Weightless(repository, 0.1)
    coasting.release(5.0)
    before, rate = coasting.angular_momentum, coasting.fdm["velocities/q-rad_sec"]
    for _ in coasting.frames():
        if coasting.fdm["payload/dropped-kg"] == 0.0:
            assert coasting.angular_momentum == pytest.approx(before, rel=2e-3)
            last = coasting.fdm["velocities/q-rad_sec"]
    assert last < 0.85 * rate  # the inertia has grown by a fifth


def test_linear_momentum_is_kept_while_a_load_rolls_aft(repository: Path) -> None:
    """Against a twin whose load stays in its locks: both fall freely, so their centres of gravity move alike."""
    coasting, twin = Weightless(repository, 0.1), Weightless(repository, 0.1)
    coasting.release(5.0)
    twin.fdm.run()
    apart = coasting.velocity - twin.velocity
    load_share = LOAD * 5.0 / (twin.fdm["inertia/mass-slugs"] * SLUG)
    for _ in coasting.frames():
        if coasting.fdm["payload/dropped-kg"] == 0.0:
            assert coasting.velocity - twin.velocity - apart == pytest.approx(
                np.zeros(3), abs=0.01 * load_share
            )
        twin.fdm.run()


def test_loads_wait_for_the_ramp_and_for_each_other(repository: Path) -> None:
    coasting = Weightless(repository, 0.2)
    fdm = coasting.fdm
    fdm["inertia/pointmass-weight-lbs[6]"] = LOAD / LB
    fdm["inertia/pointmass-location-X-inches[6]"] = 22.0 / INCH
    fdm["payload/ramp-pos-norm"] = fdm["payload/ramp-cmd-norm"] = 0.5
    fdm["payload/release"] = 1
    for _ in range(120):
        fdm.run()
    assert fdm["inertia/pointmass-location-X-inches[5]"] * INCH == pytest.approx(21.0)
    fdm["payload/ramp-cmd-norm"] = 1
    for _ in range(720):
        fdm.run()
    assert fdm["payload/ramp-pos-norm"] == pytest.approx(1.0)  # half of its 10 s
    assert fdm["payload/speed-mps"] > 0.0
    fdm["payload/release"] = 2
    leaving = []
    for _ in range(60 * 120):
        fdm.run()
        leaving.append((fdm["payload/active"], fdm["payload/dropped-kg"]))
    order = [load for load, _ in itertools.groupby(load for load, _ in leaving)]
    assert order == [1.0, 0.0, 2.0, 0.0]
    assert leaving[-1][1] == pytest.approx(2 * LOAD)
    assert fdm["payload/release"] == 0.0


@pytest.fixture(scope="module")
def drop(repository: Path) -> dict[str, Vector]:
    """Eight tonnes pulled out at the approach speed, wheels up, the elevator stuck: what happens in each frame."""
    flying = Flight(repository, named("circuit"))
    fdm = flying.fdm
    fdm["inertia/pointmass-weight-lbs[0]"] = max(0.0, fdm["inertia/pointmass-weight-lbs[0]"] - LOAD / LB)
    fdm["inertia/pointmass-weight-lbs[5]"] = LOAD / LB
    fdm["inertia/pointmass-location-X-inches[5]"] = 19.0 / INCH
    fdm["payload/ramp-cmd-norm"] = 1
    fdm["payload/parachute-m2[0]"] = 20.0
    flying.run(15)
    fdm["failure/elevator"] = 1
    fdm["payload/release"] = 1
    names = {
        "time": "simulation/sim-time-sec",
        "nz": "accelerations/Nz",
        "q": "velocities/q-rad_sec",
        "qdot": "accelerations/qdot-rad_sec2",
        "speed": "payload/speed-mps",
        "x": "inertia/pointmass-location-X-inches[5]",
        "cg": "inertia/cg-x-in",
        "mass": "inertia/mass-slugs",
        "iyy": "inertia/iyy-slugs_ft2",
        "dropped": "payload/dropped-kg",
        "pitch": "attitude/theta-rad",
        "qbar": "aero/qbar-psf",
        "leaving": "payload/release",
    }
    history = flying.run(4, *names.values())
    return dict(zip(("clock", *names), np.array(history).T, strict=True))


def test_the_load_is_gone_once_and_the_aircraft_lighter_by_it(drop: dict[str, Vector]) -> None:
    assert drop["dropped"][-1] == pytest.approx(LOAD)
    assert (drop["mass"][0] - drop["mass"][-1]) * SLUG == pytest.approx(LOAD, abs=20.0)  # and what was burned
    assert drop["leaving"][-1] == 0.0
    assert drop["speed"][-1] == 0.0


def test_the_load_accelerates_as_its_forces_say(drop: dict[str, Vector]) -> None:
    """Energy along the deck: the parachute less friction over the way, with the deck's slope; 3 % for what pitches."""
    moving = drop["speed"] > 0
    way = RAMP_END - 19.0
    pull = float(np.mean(drop["qbar"][moving])) * 47.880259 * 20.0 / LOAD
    deck = G0 * float(np.mean(np.sin(drop["pitch"][moving])))
    friction = 0.03 * G0 * float(np.mean(drop["nz"][moving]))
    assert max(drop["speed"]) ** 2 / 2 == pytest.approx((pull + deck - friction) * way, rel=0.05)


def test_the_load_factor_steps_with_the_mass_at_the_exit(drop: dict[str, Vector]) -> None:
    """Lift is what it was the frame before: n M is kept."""
    exit_frame = int(np.argmax(drop["dropped"] > 0)) + 1
    before, after = exit_frame - 2, exit_frame + 1
    weight = drop["nz"] * drop["mass"]
    assert weight[after] == pytest.approx(weight[before], rel=0.02)
    assert drop["nz"][after] > 1.05 * drop["nz"][before]


def test_the_nose_rises_as_the_moving_weight_turns_it(drop: dict[str, Vector]) -> None:
    """I q is the impulse of m g x, until the tail and its damping work against it; after the exit the nose falls."""
    steps = np.diff(drop["time"], prepend=drop["time"][0])
    lever = (drop["x"] - drop["cg"]) * INCH
    turned = np.cumsum(LOAD * G0 * (lever - lever[0]) / (drop["iyy"] * SLUG * FT**2) * steps)
    rate = drop["q"] - drop["q"][0]
    early = int(np.argmax(turned > 0.003))
    assert rate[early] == pytest.approx(turned[early], rel=0.1)
    last = int(np.argmax(drop["dropped"] > 0)) - 1
    assert 0.4 * turned[last] < rate[last] < turned[last]
    assert np.mean(drop["qdot"][last + 3 : last + 30]) < 0.0
