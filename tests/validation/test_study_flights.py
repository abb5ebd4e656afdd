"""Studies of real flights: the engine adds nothing to them and takes nothing away."""

from pathlib import Path
from typing import Any

import pytest

import harness
from harness import resources
from harness.studies import flight

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


REJECTED = """<study name="rejected" of="rejecting">
  <factor path="loading/take-off-mass" name="mass"><values list="90 t, 100 t"/></factor>
  <output name="rejected_take_off.accelerate_stop_distance_m" column="accelerate_stop_m"/>
  <output name="rejected_take_off.accelerate_distance_m" column="accelerate_m"/>
  <output name="rejected_take_off.braking_distance_m" column="brake_m"/>
  <output name="phases[RTO].distance" column="rto_km"/><output name="phases[DEP].fuel" column="departure"/>
  <output name="outcome"/>
</study>"""
REJECT = """<phase name="T/O.run"><checklist to="RTO">
  <item name="engine failure" remove="yes"/><item name="reject" quantity="cas" at-least="100 kt"/>
</checklist></phase></mission>"""


def test_what_is_deep_in_a_summary_can_be_kept_and_is_null_where_the_flight_did_not_come_to_it(
    tmp_path: Path,
) -> None:
    circuit = resources.missions()["circuit"].read_text("utf-8")
    rejecting = circuit.replace('name="circuit"', 'name="rejecting" expects="rejected take-off"')
    (tmp_path / "rejecting.xml").write_text(rejecting.replace("</mission>", REJECT), "utf-8")
    (tmp_path / "rejected.xml").write_text(REJECTED, "utf-8")
    rows = harness.study(tmp_path / "rejected.xml").to_pylist()
    assert [(row["status"], row["outcome"]) for row in rows] == [("ok", "rejected take-off")] * 2
    assert rows[0]["accelerate_stop_m"] < rows[1]["accelerate_stop_m"]
    for row in rows:  # the brakes go on at the decision
        assert row["accelerate_stop_m"] == pytest.approx(row["accelerate_m"] + row["brake_m"])
        assert row["rto_km"] * 1000 == pytest.approx(row["brake_m"], abs=1.0)
    assert [row["departure"] for row in rows] == [None, None]
    summary = harness.fly(tmp_path / "rejecting.xml").summary
    same_in_all = {"mission_file", "harness_version", "aircraft_sha256", "seed"}
    assert _leaves(summary) - flight.MACHINE - same_in_all <= flight.outputs()
    not_come_to = flight.outputs() - _leaves(summary)
    assert all(path.startswith("phases[") and "RTO" not in path for path in not_come_to)


def _leaves(summary: dict[str, Any]) -> set[str]:
    """The paths of the numbers and words of a summary."""
    found = summary.keys() - flight.NESTED
    found |= {f"rejected_take_off.{name}" for name in summary["rejected_take_off"]}
    return found | {f"phases[{p['name']}].{name}" for p in summary["phases"] for name in p.keys() - {"name"}}
