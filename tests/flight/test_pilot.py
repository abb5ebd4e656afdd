"""What the pilot does in a whole flight: the circuit, flown once."""

from itertools import pairwise

import pytest

from harness.flight import fly_mission
from harness.log import Event, FlightLog, Reporter
from harness.session import Session
from harness.state import Commands, State, close_to_ground
from harness.vocabulary import EDGES, INNER_MODES, MODES

FIG_10 = (
    "thrust control direct",
    "thrust lever TOGA",
    "elevator control direct",
    "elevator zero",
    "NAV mode",
    "course runway direction",
    "front-wheel steering",
    "gear lever down",
    "brakes released",
    "flaps take-off",
)


class Witness:
    """Sees everything."""

    def __init__(self) -> None:
        self.events: list[Event] = []
        self.modes: list[dict[str, str]] = []
        self.times: list[float] = []
        self.near: list[bool] = []  # on or just above the runway

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        self.times.append(state.time)
        self.near.append(close_to_ground(state.height, state.cas))
        if not self.modes or self.modes[-1] != dict(pilot.modes):
            self.modes.append(dict(pilot.modes))

    def note(self, event: Event) -> None:
        self.events.append(event)


@pytest.fixture(scope="module")
def witness() -> Witness:
    session, witness = Session("circuit"), Witness()
    fly_mission(session.mission, session.manual, observers=[FlightLog(), witness])
    return witness


def test_the_take_off_procedure_is_that_of_the_paper_item_by_item(witness: Witness) -> None:
    done = [event.name for event in witness.events if event.kind == "procedure" and event.phase == "T/O.run"]
    assert tuple(done) == FIG_10


def test_phases_follow_the_edges_of_the_graph(witness: Witness) -> None:
    phases = [event.name for event in witness.events if event.kind == "phase"]
    assert set(pairwise(phases)) <= set(EDGES)
    assert phases[-1] == "END"


def test_every_phase_change_is_preceded_by_its_checklist_items(witness: Witness) -> None:
    for before, event in pairwise(witness.events):
        if event.kind == "phase":
            assert before.kind == "checklist"
            assert event.reason.endswith(before.name)


def test_rotation_and_lift_off_are_decided_by_the_checklists_of_figure_7(witness: Witness) -> None:
    items = [(event.phase, event.name) for event in witness.events if event.kind == "checklist"]
    assert ("T/O.run", "rotation speed") in items
    assert ("T/O.rotation", "lift-off speed") in items
    assert ("T/O.rotation", "main gear off the ground") in items


def test_each_super_mode_has_exactly_one_sub_mode_at_any_time(witness: Witness) -> None:
    for modes in witness.modes:
        assert set(modes) == set(MODES)
        for name in ("SPD", "HP", "VP"):
            assert modes[name].split()[0] in MODES[name]
        assert modes["INN"] == "OFF" or set(modes["INN"].split()) <= set(INNER_MODES)


def test_every_mode_change_says_why(witness: Witness) -> None:
    changes = [event for event in witness.events if event.kind == "mode"]
    assert len(changes) > 20
    assert all("; was " in event.reason for event in changes)


def test_the_pilot_looks_24_times_a_second_at_the_runway_and_once_or_twice_elsewhere(
    witness: Witness,
) -> None:
    """Half as often when he rolls slowly; elsewhere sooner only where he waits for a climb, or for a moment."""
    pauses = [(after - before) * 24 for before, after in pairwise(witness.times)]
    close = [round(pause) for pause, near in zip(pauses, witness.near, strict=False) if near]
    assert set(close) == {1, 2}
    assert 0.1 < close.count(2) / len(close) < 0.7
    elsewhere = [pause for pause, near in zip(pauses, witness.near, strict=False) if not near]
    assert 12 in {round(pause) for pause in elsewhere}
    assert max(elsewhere) <= 24 + 1e-6
    assert sum(pause < 11.5 for pause in elsewhere) < 0.2 * len(elsewhere)
