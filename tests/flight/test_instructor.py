"""Failures and configurations of a mission reach the aircraft, at their moment, and only if it has them."""

from dataclasses import replace
from pathlib import Path

import pytest

from harness import resources
from harness.errors import InputError
from harness.flight import fly_mission, prepare
from harness.instructor import configure
from harness.log import Event, Reporter
from harness.manual import PropertySetting, read_manual
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.session import Session
from harness.state import Commands, State
from harness.units import KT

FAILURES = """<failures>
  <failure name="engine 4"><when quantity="cas" at-least="70 kt"/><when quantity="time" at-least="5 s"/></failure>
  <failure name="engine 1" phase="T/O.run"><when quantity="cas" at-least="69 kt"/></failure>
  <failure name="engine 2" phase="ENR.CRS"/>
</failures>"""


class Enough(Exception):  # noqa: N818  ends a flight that has shown what was wanted
    """Seen enough."""


class Witness:
    """Notes failures and the airspeed at them, until both have happened."""

    def __init__(self) -> None:
        self.failures: list[Event] = []
        self.speeds: list[float] = []

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        if len(self.speeds) < len(self.failures):
            self.speeds.append(state.cas)
        if len(self.speeds) == 2:
            raise Enough

    def note(self, event: Event) -> None:
        if event.kind == "failure":
            self.failures.append(event)


@pytest.fixture
def mission(tmp_path: Path) -> Path:
    text = resources.missions()["circuit"].read_text("utf-8")
    path = tmp_path / "failing.xml"
    path.write_text(text.replace("</mission>", f"{FAILURES}</mission>"), "utf-8")
    return path


@pytest.fixture(scope="module")
def plant() -> JSBSimPlant:
    session = Session("circuit")
    return prepare(session.mission, session.manual, rate=120)[1]


def test_failures_happen_when_their_conditions_hold(mission: Path) -> None:
    session, witness = Session(mission), Witness()
    with pytest.raises(Enough):
        fly_mission(session.mission, session.manual, observers=[witness])
    one, four = witness.failures  # and not the one that belongs to the cruise
    assert (one.name, one.phase, four.name) == ("engine 1", "T/O.run", "engine 4")
    assert four.time >= 5.0
    assert 70 * KT <= witness.speeds[1] < 70.5 * KT
    assert four.reason.startswith("70.")


def test_a_failure_can_be_moved_from_the_command_line(mission: Path) -> None:
    session = Session(mission, ["failures/failure[engine 1]/phase=T/O.rotation"])
    assert session.mission.failures[1].phase == "T/O.rotation"


def test_every_configuration_and_failure_of_the_manual_is_a_property_of_the_aircraft(
    plant: JSBSimPlant,
) -> None:
    manual = read_manual("gta")
    for choices in manual.configurations.values():
        configure(plant, list(choices.values()))
    for setting in manual.failures.values():
        assert plant.setter(setting.property)


def test_a_property_the_aircraft_does_not_have_is_refused_with_its_row(plant: JSBSimPlant) -> None:
    with pytest.raises(InputError, match=r"manual\.xml:7: the aircraft has no property failure/wing"):
        configure(plant, [PropertySetting("failure/wing", 1.0, "manual.xml", 7)])
    with pytest.raises(InputError, match="velocities/vc-kts cannot be written"):
        configure(plant, [PropertySetting("velocities/vc-kts", 1.0, "manual.xml", 7)])


def test_a_gain_of_the_mission_reaches_the_pilot() -> None:
    session = Session("circuit", ["aircraft/gain[taxi-speed]/value=7 m/s"])
    pilot, _ = prepare(session.mission, session.manual, rate=120)
    assert pilot.manual.gains["taxi-speed"] == 7.0
    assert replace(pilot.manual, gains=session.manual.gains) == replace(session.manual)
