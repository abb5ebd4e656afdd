"""The mission that is handed out as a JSBSim script, scripts/cologne-munich-as-flown.xml, is of the present aircraft.

Renew it when the aircraft or the pilot changes: `harness fly cologne-munich --json`, then
`harness export RUN --out scripts/cologne-munich-as-flown.xml`.
"""

from pathlib import Path

import pytest

from harness import resources
from harness.replay.player import Choices, replay
from harness.session import Session

SCRIPT = "cologne-munich-as-flown"
LARGEST = 5_000_000  # bytes


def test_the_exported_mission_is_of_the_present_aircraft() -> None:
    file = resources.scripts()[SCRIPT]
    assert resources.fingerprint("gta") in resources.description(file), "stale: export it anew"
    assert file.stat().st_size < LARGEST


@pytest.mark.slow
def test_the_exported_mission_is_the_flight_gate_to_gate(tmp_path: Path) -> None:
    flown, stopped = Session("cologne-munich").fly(out=tmp_path)
    assert stopped is None
    assert flown.folder is not None
    replayed, stopped, comparison = replay(SCRIPT, tmp_path, Choices(), flown.folder)
    assert stopped is None
    assert comparison is not None
    assert comparison.identical
    assert comparison.frames == len(flown.history["time"]) - 1
    assert replayed.summary["simulated_time_s"] == pytest.approx(float(flown.history["time"][-1]), abs=0.1)
