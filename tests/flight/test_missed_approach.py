"""A missed approach climbs away, comes round and lands; a second one ends the flight."""

from pathlib import Path

from harness import resources
from harness.log import Run
from harness.session import Session
from harness.units import FT


def missed(folder: Path, items: str, expects: str) -> Run:
    """Fly a circuit that goes around at 300 ft when these items hold."""
    text = resources.missions()["circuit"].read_text("utf-8")
    text = text.replace('name="circuit"', f'name="circuit" expects="{expects}"', 1)
    change = f"""<phase name="APP.final"><checklist to="M/A">
      <item name="decision height" quantity="height" at-most="300 ft"/>
      <item name="off the localizer" remove="yes"/>{items}</checklist></phase>"""
    path = folder / "missed.xml"
    path.write_text(text.replace("</mission>", f"{change}</mission>"), "utf-8")
    run, stopped = Session(path).fly()
    assert stopped is None, stopped
    assert run.summary["outcome"] == expects
    return run


def test_the_second_approach_lands(tmp_path: Path) -> None:
    item = '<item name="the first time" quantity="approaches-missed" at-most="0"/>'
    run = missed(tmp_path, item, "completed")
    phases = [phase["name"] for phase in run.summary["phases"]]
    assert phases.count("APP.final") == 2
    assert phases.index("M/A") < phases.index("LDG.flare")
    again = next(phase["start"] for phase in run.summary["phases"] if phase["name"] == "M/A")
    lowest = run.history["height"][(run.history["time"] > again) & (run.history["time"] < again + 30.0)].min()
    assert lowest > 150 * FT
    assert run.summary["landing_mass_kg"] < run.summary["takeoff_mass_kg"]
    assert run.history["stall_warned"][-1] == 0.0


def test_missing_it_twice_ends_the_flight(tmp_path: Path) -> None:
    run = missed(tmp_path, "", "missed approach")
    assert [phase["name"] for phase in run.summary["phases"]].count("M/A") == 2
    assert run.at("height", run.history["time"][-1]) > 1400 * FT
