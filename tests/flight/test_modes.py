"""The natural modes of the bare airframe and with its dampers, against the validation points and MIL-F-8785C."""

from math import radians
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from scipy.linalg import expm

from harness.plant.bench import Attitude, Bench
from harness.plant.trim import release, trim
from harness.qualify.linear import (
    LATERAL,
    SYMMETRIC,
    Linear,
    decay,
    lateral,
    linearise,
    load_factor_per_alpha,
    longitudinal,
)
from harness.units import FT


class Case(NamedTuple):
    """A flight condition and the targets V28 to V33; None: no target."""

    altitude: float  # m
    tas: float  # m/s
    mass: float
    flap: float
    short_period: tuple[float, float, float] | None  # rad/s, -, 1/g s2: CAP
    phugoid: float | None  # s
    dutch_roll: float  # s
    spiral: float  # s to double, at least


CASES = {
    "FL230 M0.40": Case(7010.4, 124.88, 110e3, 0.0, (1.32, 0.50, 0.34), 62.0, 7.7, 20.0),
    "FL310 M0.68": Case(9448.8, 205.21, 120e3, 0.0, None, 100.0, 6.0, 20.0),
    "approach": Case(300.0, 67.84, 100e3, 1.0, (1.18, 0.70, 0.43), None, 8.3, 12.0),
}


@pytest.fixture(scope="module", params=CASES)
def measured(request: pytest.FixtureRequest, repository: Path) -> tuple[Bench, Case, Linear]:
    case = CASES[request.param]
    bench = Bench(repository, "gta")
    bench.load(case.mass)
    bench.configure(flap=case.flap, gear=case.flap)
    trim(bench, case.altitude, Attitude(case.tas, alpha=radians(4.0)))
    return bench, case, linearise(bench)


def test_short_period(measured: tuple[Bench, Case, Linear]):
    _, case, model = measured
    mode, _ = longitudinal(model)
    anticipation = mode.frequency**2 / load_factor_per_alpha(model, case.tas)
    assert 0.35 < mode.damping < 1.30
    assert 0.16 < anticipation < 3.6
    if case.short_period:
        frequency, damping, parameter = case.short_period
        assert mode.frequency == pytest.approx(frequency, rel=0.10)
        assert mode.damping == pytest.approx(damping, rel=0.10)
        assert anticipation == pytest.approx(parameter, rel=0.15)


def test_phugoid(measured: tuple[Bench, Case, Linear]):
    _, case, model = measured
    _, mode = longitudinal(model)
    assert mode.damping > 0.04
    if case.phugoid:
        assert mode.period == pytest.approx(case.phugoid, rel=0.15)


def test_lateral_modes(measured: tuple[Bench, Case, Linear]):
    _, case, model = measured
    dutch_roll, roll, spiral = lateral(model)
    assert dutch_roll.period == pytest.approx(case.dutch_roll, rel=0.10)
    assert 0.04 < dutch_roll.damping < 0.12
    assert 0.9 < roll.time_constant < 1.4
    assert spiral.doubling < 0 or spiral.doubling > case.spiral


@pytest.mark.parametrize(
    ("states", "disturbed", "step", "watched"),
    [(SYMMETRIC, "w", 2.0, "pitch"), (LATERAL, "v", 2.0, "roll")],
)
def test_the_linear_model_is_the_aircraft(
    measured: tuple[Bench, Case, Linear], states: tuple[str, ...], disturbed: str, step: float, watched: str
):
    bench, _, model = measured
    start = np.zeros(len(states))
    start[states.index(disturbed)] = step
    paths = []
    for kick in (0.0, step):
        linearise(bench)  # back to the trim
        bench.put("simulation/integrator/rate/rotational", 0.0)
        speed = bench.get(f"velocities/{disturbed}-fps") + kick / FT
        bench.put(f"ic/{disturbed}-fps", speed)
        bench.initialise()
        release(bench)
        paths.append(bench.record(8.0, [watched], steps=4)[watched])
    flown = paths[1] - paths[0]
    angle = states.index("theta" if watched == "pitch" else "phi")
    matrix = expm(model.part(states) * 4 / bench.rate)
    expected, state = [0.0], start
    for _ in flown[1:]:
        state = matrix @ state
        expected.append(state[angle])
    assert np.max(np.abs(flown - expected)) < 0.10 * np.max(np.abs(expected))


@pytest.mark.parametrize("law", [0.0, 1.0])
def test_with_dampers_the_dutch_roll_is_level_1(measured: tuple[Bench, Case, Linear], law: float):
    # MIL-F-8785C table VI, category B: damping 0.08, damping times frequency 0.15 rad/s, frequency 0.4 rad/s
    bench, _, _ = measured
    linearise(bench)
    bench.put("fcs/law", law)
    bench.put("fcs/augmentation", 1.0)
    bench.put("ic/v-fps", 3.0 / FT)
    bench.initialise()
    release(bench)
    record = bench.record(20.0, ["beta"], steps=12)
    modes = [mode for mode in decay(record["time"], record["beta"], 6) if 0.3 < mode.frequency < 3.0]
    assert modes
    for mode in modes[:1]:
        assert mode.damping > 0.08
        assert mode.damping * mode.frequency > 0.15
    bench.put("fcs/law", 1.0)
    bench.put("fcs/augmentation", 0.0)


def test_two_known_modes_are_read_from_their_sum():
    time = np.arange(0, 20, 0.05)
    values = np.exp(-0.2 * time) * np.cos(1.5 * time) + 0.5 * np.exp(-time)
    modes = decay(time, values, 4)
    assert modes[0].eigenvalue == pytest.approx(-0.2 + 1.5j, abs=0.01)
    assert modes[1].eigenvalue == pytest.approx(-1.0, abs=0.05)
