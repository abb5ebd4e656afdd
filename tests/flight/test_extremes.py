"""The aircraft's own memory of its extremes against a look at every frame."""

from pathlib import Path

import pytest
from airborne import DEG, Flight, named

LATCHES = {  # property, how Python forms it from a history of the property watched
    "extreme/nz-max": ("accelerations/Nz", max),
    "extreme/nz-min": ("accelerations/Nz", min),
    "extreme/bank-max-rad": ("attitude/phi-rad", lambda values: max(map(abs, values))),
    "extreme/alpha-max-rad": ("aero/alpha-rad", max),
}


@pytest.fixture(scope="module")
def flight(repository: Path) -> Flight:
    return Flight(repository, named("circuit"))


@pytest.mark.parametrize("latch", LATCHES)
def test_a_latch_holds_the_extreme_of_all_frames_since_it_was_reset(flight: Flight, latch: str):
    watched, extreme = LATCHES[latch]
    flight.fdm[latch] = flight.fdm[watched] if latch != "extreme/bank-max-rad" else 0.0
    flight.fdm["ap/bank-target-rad"] = -20 * DEG
    flight.fdm["ap/pitch-target-rad"] += 2 * DEG
    seen = flight.run(4, watched)
    flight.fdm["ap/bank-target-rad"] = 0.0
    flight.fdm["ap/pitch-target-rad"] -= 2 * DEG
    seen += flight.run(6, watched)
    values = [value for _, value in seen]
    assert max(values) - min(values) > 0.01  # there was something to hold
    assert flight.fdm[latch] == pytest.approx(extreme(values), abs=2e-3)  # every second frame is looked at


def test_the_stall_warning_once_sounded_stays_until_it_is_reset(flight: Flight):
    assert flight.fdm["extreme/stall-warning"] == 0
    flight.fdm["ap/pitch-target-rad"] = 14 * DEG
    for engine in range(4):
        flight.fdm[f"fcs/throttle-cmd-norm[{engine}]"] = 0.1
    flight.run(30)
    flight.fdm["ap/pitch-target-rad"] = 0.0
    flight.run(20)
    assert flight.fdm["aero/stall-warning"] == 0
    assert flight.fdm["extreme/stall-warning"] == 1
    flight.fdm["extreme/stall-warning"] = 0
    flight.run(1)
    assert flight.fdm["extreme/stall-warning"] == 0
