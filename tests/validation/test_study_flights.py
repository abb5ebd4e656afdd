"""Studies of real flights: the engine adds nothing to them and takes nothing away."""

from pathlib import Path

import pytest

import harness

pytestmark = pytest.mark.slow
STUDY = """<study name="two-hops" of="hop">
  <set path="environment/qnh" value="1000 hPa"/>
  <factor path="loading/take-off-mass" name="mass"><values list="90 t, 100 t"/></factor>
  <factor path="aircraft/property[metrics/Sw-sqft]/value" name="wing_sqft"><values list="2384.2"/></factor>
  <output name="fuel_burned_kg"/><output name="flight_time_s"/><output name="phases[T/O.run].distance"/>
</study>"""


def test_a_case_of_a_study_is_the_flight_that_fly_flies(tmp_path: Path) -> None:
    (tmp_path / "two.xml").write_text(STUDY, "utf-8")
    rows = harness.study(tmp_path / "two.xml", workers=2).to_pylist()
    assert [(row["mass_kg"], row["status"]) for row in rows] == [(90e3, "ok"), (100e3, "ok")]
    summary = harness.fly(
        "hop",
        overrides=[
            "environment/qnh=1000 hPa",
            "loading/take-off-mass=100 t",
            "aircraft/property[metrics/Sw-sqft]/value=2384.2",
        ],
    ).summary
    (run,) = [phase for phase in summary["phases"] if phase["name"] == "T/O.run"]
    assert rows[1]["fuel_burned_kg"] == summary["fuel_burned_kg"]
    assert rows[1]["flight_time_s"] == summary["flight_time_s"]
    assert rows[1]["phases[T/O.run].distance"] == run["distance"]
