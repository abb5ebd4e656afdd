"""The full law protects and holds, the direct law does neither but damps; the pilot's inner modes stand in for it."""

from pathlib import Path

import pytest
from airborne import DEG, Flight, named

FULL, DIRECT = 0.0, 1.0
AIRBORNE = ("approach", "circuit", "FL230", "FL370")


def by_stick(repository: Path, name: str, law: float) -> Flight:
    """In trim, stick where it holds the surfaces, hands on it."""
    flight = Flight(repository, named(name))
    fdm = flight.fdm
    if law == DIRECT:
        elevator = fdm["fcs/elevator-pos-rad"]
        fdm["fcs/elevator-cmd-norm"] = elevator / (0.436 if elevator < 0 else 0.30)
        fdm["fcs/aileron-cmd-norm"] = fdm["fcs/aileron-pos-rad"] / 0.436
    fdm["fcs/law"] = law
    for axis in ("pitch", "roll", "yaw"):
        fdm[f"ap/{axis}-mode"] = 0
    return flight


@pytest.mark.parametrize("name", AIRBORNE)
def test_full_aft_stick_never_stalls_and_never_breaks(repository: Path, name: str):
    flight = by_stick(repository, name, FULL)
    flight.fdm["fcs/elevator-cmd-norm"] = -1
    history = flight.run(40, "aero/alpha-stall-margin-rad", "accelerations/Nz")
    assert all(margin > 0 for _, margin, _ in history)
    assert min(margin for _, margin, _ in history) < 4 * DEG  # it was really asked
    assert all(-0.1 < load < 2.5 for *_, load in history)


@pytest.mark.parametrize("name", AIRBORNE)
def test_full_forward_stick_stops_short_of_no_load(repository: Path, name: str):
    flight = by_stick(repository, name, FULL)
    flight.fdm["fcs/elevator-cmd-norm"] = 1
    history = flight.run(6, "accelerations/Nz", "attitude/theta-rad")
    assert all(load > -0.1 for _, load, _ in history)
    assert min(pitch for *_, pitch in history) > -18 * DEG


@pytest.mark.parametrize("name", AIRBORNE)
def test_full_lateral_stick_stops_at_sixty_degrees(repository: Path, name: str):
    flight = by_stick(repository, name, FULL)
    flight.fdm["fcs/aileron-cmd-norm"] = 1
    history = flight.run(8, "attitude/phi-rad")
    assert max(bank for _, bank in history) < 65 * DEG
    assert history[-1][1] == pytest.approx(60 * DEG, abs=3 * DEG)


@pytest.mark.parametrize("law", [FULL, DIRECT])
@pytest.mark.parametrize(("name", "time"), [("approach", 2.5), ("circuit", 2.3), ("FL230", 2.3)])
def test_thirty_degrees_of_bank_by_stick_in_level_1_time(
    repository: Path, name: str, time: float, law: float
):
    # MIL-F-8785C 3.3.4.1, class III: 30 deg in 2.5 s in flight phase category C, 2.3 s in B
    flight = by_stick(repository, name, law)
    flight.fdm["fcs/aileron-cmd-norm"] = 1
    history = flight.run(4, "attitude/phi-rad")
    assert next(after for after, bank in history if bank > 30 * DEG) <= time


@pytest.mark.parametrize("name", AIRBORNE)
def test_the_full_law_holds_what_the_stick_left(repository: Path, name: str):
    flight = by_stick(repository, name, FULL)
    fdm = flight.fdm
    fdm["fcs/aileron-cmd-norm"], fdm["fcs/elevator-cmd-norm"] = 0.5, -0.1
    flight.run(1.5)
    fdm["fcs/aileron-cmd-norm"] = fdm["fcs/elevator-cmd-norm"] = 0
    flight.run(3)
    pitch, bank = fdm["attitude/theta-rad"], fdm["attitude/phi-rad"]
    history = flight.run(10, "attitude/theta-rad", "attitude/phi-rad", "aero/beta-rad")
    assert bank > 8 * DEG
    for _, theta, phi, beta in history:
        assert theta == pytest.approx(pitch, abs=0.5 * DEG)
        assert phi == pytest.approx(bank, abs=0.5 * DEG)
        assert abs(beta) < 3 * DEG


def test_the_direct_law_protects_nothing(repository: Path):
    flight = by_stick(repository, "circuit", DIRECT)
    flight.fdm["fcs/elevator-cmd-norm"] = -1
    stalled = flight.run(8, "aero/alpha-stall-margin-rad")
    assert min(margin for _, margin in stalled) < 0
    flight = by_stick(repository, "circuit", DIRECT)
    flight.fdm["fcs/aileron-cmd-norm"] = 1
    banked = flight.run(6, "attitude/phi-rad")
    assert max(bank for _, bank in banked) > 70 * DEG


@pytest.mark.parametrize("name", AIRBORNE)
def test_in_the_direct_law_the_pilots_inner_modes_hold_attitudes(repository: Path, name: str):
    flight = Flight(repository, named(name))
    fdm = flight.fdm
    fdm["fcs/law"] = DIRECT
    flight.run(3)
    pitch = fdm["attitude/theta-rad"]
    fdm["ap/pitch-target-rad"], fdm["ap/bank-target-rad"] = pitch + 2 * DEG, 20 * DEG
    flight.run(6)
    assert fdm["fcs/full-law"] == 0
    history = flight.run(6, "attitude/theta-rad", "attitude/phi-rad", "aero/beta-rad", "accelerations/Nz")
    for _, theta, phi, beta, load in history:
        assert theta == pytest.approx(pitch + 2 * DEG, abs=0.5 * DEG)
        assert phi == pytest.approx(20 * DEG, abs=1.5 * DEG)
        assert abs(beta) < 2 * DEG
        assert 0.8 < load < 1.4


def test_changing_the_law_in_flight_does_not_kick(repository: Path):
    flight = Flight(repository, named("circuit"))
    before = flight.fdm["accelerations/Nz"]
    for law in (DIRECT, FULL):
        flight.fdm["fcs/law"] = law
        history = flight.run(4, "accelerations/Nz", "attitude/phi-rad")
        assert all(abs(load - before) < 0.06 and abs(bank) < 2 * DEG for _, load, bank in history)
