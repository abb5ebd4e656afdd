"""The attitude loops hold what they are told, from approach to cruise, light and heavy."""

from pathlib import Path

import jsbsim
import pytest
from airborne import CONDITIONS, DEG, FT, Condition, Flight, named


@pytest.fixture(params=CONDITIONS, ids=lambda condition: condition.name)
def flight(request: pytest.FixtureRequest, repository: Path) -> Flight:
    return Flight(repository, request.param)


def test_a_pitch_step_settles_soon_without_overshoot(flight: Flight):
    before, step = flight.fdm["attitude/theta-rad"], 2 * DEG
    flight.fdm["ap/pitch-target-rad"] = before + step
    history = flight.run(6, "attitude/theta-rad", "accelerations/Nz")
    share = [(time, (pitch - before) / step) for time, pitch, _ in history]
    settling = max(time for time, value in share if abs(value - 1) > 0.1)
    assert settling < 2.7  # the load factor limit slows the step where the aircraft is fast
    assert max(value for _, value in share) < 1.10
    assert all(0.6 < load < 1.4 for *_, load in history)


def test_thirty_degrees_of_bank_take_less_than_four_seconds(flight: Flight):
    flight.fdm["ap/bank-target-rad"] = 30 * DEG
    history = flight.run(8, "attitude/phi-rad", "velocities/phidot-rad_sec", "aero/beta-rad")
    arrival = next(time for time, bank, *_ in history if bank > 28 * DEG)
    assert arrival < 4
    assert max(bank for _, bank, *_ in history) < 32 * DEG
    assert max(rate for _, _, rate, _ in history) < 13 * DEG  # the reference's 10, and catching up with it
    assert max(abs(sideslip) for *_, sideslip in history) < 4 * DEG
    assert history[-1][1] == pytest.approx(30 * DEG, abs=1 * DEG)


def test_switching_a_mode_off_and_on_does_not_kick(repository: Path):
    flight = Flight(repository, named("circuit"))
    elevator = flight.fdm["fcs/elevator-pos-rad"]
    flight.fdm["fcs/elevator-cmd-norm"] = elevator / (0.436 if elevator < 0 else 0.30)
    before = flight.fdm["accelerations/Nz"]
    flight.fdm["ap/pitch-mode"] = 0
    history = flight.run(1, "accelerations/Nz")
    flight.fdm["ap/pitch-target-rad"] = flight.fdm["attitude/theta-rad"]
    flight.fdm["ap/pitch-mode"] = 1
    history += flight.run(3, "accelerations/Nz")
    assert all(abs(load - before) < 0.03 for _, load in history)


def test_pulling_for_ever_stops_short_of_the_stall(repository: Path):
    flight = Flight(repository, named("circuit"))
    for engine in range(4):
        flight.fdm[f"fcs/throttle-cmd-norm[{engine}]"] = 0.1
    flight.fdm["ap/pitch-target-rad"] = 20 * DEG
    history = flight.run(60, "aero/alpha-stall-margin-rad")
    assert all(margin > 0.5 * DEG for _, margin in history)
    assert min(margin for _, margin in history) < 5 * DEG  # it was really asked


def test_the_loss_of_an_outer_engine_is_coordinated(repository: Path):
    condition = Condition("climb", 300, {"vc-kts": 125}, 110e3, 0.5, 12.0, 1.0)
    flight = Flight(repository, condition)
    flight.fdm["propulsion/engine-run[0]"] = 0
    history = flight.run(20, "attitude/phi-rad", "aero/beta-rad")
    assert all(abs(bank) < 3 * DEG and abs(sideslip) < 8 * DEG for _, bank, sideslip in history)
    assert abs(history[-1][2]) < 0.5 * DEG


def test_all_modes_on_a_parked_aircraft_are_quiet(repository: Path):
    fdm = jsbsim.FGFDMExec(str(repository))
    fdm.set_debug_level(0)
    fdm.set_dt(1 / 120)
    assert fdm.load_model("gta")
    fdm["ic/h-agl-ft"] = 4.1 / FT
    fdm.run_ic()
    fdm["fcs/left-brake-cmd-norm"] = fdm["fcs/right-brake-cmd-norm"] = 1
    for axis in ("pitch", "roll", "yaw"):
        fdm[f"ap/{axis}-mode"] = 1
    surfaces = [f"fcs/{surface}-pos-rad" for surface in ("elevator", "aileron", "rudder")]
    for frame in range(60 * 120):
        assert fdm.run()
        if frame > 20 * 120:  # settled on its wheels, engines running
            assert all(abs(fdm[surface]) < 3 * DEG for surface in surfaces)


def test_the_frame_rate_makes_no_difference(repository: Path):
    ends = []
    for rate in (120, 480):
        flight = Flight(repository, named("circuit"), rate)
        flight.fdm["ap/pitch-target-rad"] = 6 * DEG
        flight.fdm["ap/bank-target-rad"] = 25 * DEG
        ends.append(flight.run(1.5, "attitude/theta-rad", "attitude/phi-rad")[-1])
    two_frames = 2 / 120 * 10 * DEG  # at the roll rate limit
    assert ends[0][1] == pytest.approx(ends[1][1], abs=two_frames)
    assert ends[0][2] == pytest.approx(ends[1][2], abs=two_frames)
