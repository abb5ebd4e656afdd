"""The documentation says what is there: generated parts are up to date, examples are accepted, keys are all named."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

from harness.log import FlightLog, Inputs, conclude
from harness.mission.check import check_file
from harness.studies.cases import Cases
from harness.studies.reader import read_study
from harness.vocabulary import EDGES, PHASES

EXAMPLE = re.compile(r"```xml\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def generate(repository: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location("generate", repository / "docs" / "generate.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_generated_parts_are_up_to_date(generate: ModuleType) -> None:
    for page in generate.pages():
        made = generate.renewed(page)
        assert made.count("<!-- end -->") == made.count("<!-- generated: ")
        assert page.read_text("utf-8") == made, "run .venv/bin/python docs/generate.py"


def test_the_graph_of_the_machine_has_every_phase_and_edge(generate: ModuleType) -> None:
    graph = generate.graph()
    arrows = re.findall(r"(\w+) --> (\w+)", graph)
    assert sorted(arrows) == sorted(tuple(re.sub(r"\W", "_", phase) for phase in edge) for edge in EDGES)
    assert "[*] --> TXY_out" in graph
    assert set(re.findall(r"as (\w+)", graph)) >= {re.sub(r"\W", "_", phase) for phase in PHASES}


def test_the_examples_of_the_mission_file_are_fit_to_fly(repository: Path, tmp_path: Path) -> None:
    example, loading, variant = EXAMPLE.findall((repository / "docs" / "mission-file.md").read_text("utf-8"))
    (tmp_path / "to-nuremberg.xml").write_text(example, "utf-8")
    (tmp_path / "to-nuremberg-heavy.xml").write_text(variant, "utf-8")
    mission = check_file(tmp_path / "to-nuremberg.xml")
    assert {leg.mode for leg in mission.legs} == {"homing", "tracking", "direct"}
    assert [failure.name for failure in mission.failures] == ["engine 2"]
    assert check_file(tmp_path / "to-nuremberg-heavy.xml").loading.takeoff_mass == 110_000.0
    listed = example.replace('<loading take-off-mass="95 t" fuel="8 t"/>', loading.strip())
    (tmp_path / "listed.xml").write_text(listed, "utf-8")
    assert len(check_file(tmp_path / "listed.xml").loading.items) == 12
    override = "phase[DEP]/checklist[ENR.CLB]/item[clear of the town]/at-least=2500 ft"
    assert (
        check_file(tmp_path / "to-nuremberg.xml", [override]).phases["DEP"].checklists[0].items[0].required
        == "2500 ft"
    )


def test_every_key_of_the_summary_is_described(repository: Path) -> None:
    run = conclude(
        FlightLog(),
        Inputs(),
        identity=dict.fromkeys(
            (
                "mission",
                "mission_file",
                "aircraft",
                "aircraft_sha256",
                "harness_version",
                "frame_rate_hz",
                "seed",
            )
        ),
        fixes={},
        last_waypoint="",
        mission_text="",
        wall_time=1.0,
        outcome="stopped",
        reason="nothing was flown",
    )
    text = (repository / "docs" / "summary-schema.md").read_text("utf-8")
    described = {
        key for row in re.findall(r"^\| (`.*?) \|", text, re.MULTILINE) for key in re.findall(r"`(\w+)`", row)
    }
    assert run.summary.keys() - described == set()
    assert text.startswith(f"# summary.json, schema {run.summary['schema']}")


def test_the_example_of_the_study_file_is_fit_to_run(repository: Path, tmp_path: Path) -> None:
    (example,) = EXAMPLE.findall((repository / "docs" / "study.md").read_text("utf-8"))
    (tmp_path / "example.xml").write_text(example, "utf-8")
    assert Cases(read_study(tmp_path / "example.xml")).count == 6
