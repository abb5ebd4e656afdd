"""The phases and their edges are those of AIAA 2010-7777 Figs. 4 to 6."""

from gc import collect
from weakref import ref

import pytest
from transitions import MachineError

from harness.pilot.machine import END, START, PhaseGraph, diagram
from harness.vocabulary import EDGES, PHASES

NOMINAL = [
    "TXY.out",
    "T/O.run",
    "T/O.rotation",
    "T/O.lift-off",
    "T/O.transition",
    "DEP",
    "ENR.CLB",
    "ENR.CRS",
    "ENR.DES",
    "ENR.CRS",
    "APP.intermediate",
    "APP.final",
    "LDG.flare",
    "LDG.roll-out",
    "TXY.in",
    "END",
]


def test_a_nominal_mission_goes_through_the_graph() -> None:
    graph = PhaseGraph()
    assert graph.state == START
    for phase in NOMINAL[1:]:
        graph.enter(phase)
    assert graph.state == END


def test_two_flights_of_one_process_have_a_graph_each() -> None:
    first, second = PhaseGraph(), PhaseGraph()
    first.enter("T/O.run")
    assert (first.state, second.state) == ("T/O.run", START)
    gone = ref(first)
    del first
    collect()
    assert gone() is None


def test_rejected_take_off_and_missed_approach_are_edges() -> None:
    assert ("T/O.run", "RTO") in EDGES
    assert {start for start, to in EDGES if to == "M/A"} == {"APP.intermediate", "APP.final", "LDG.flare"}


def test_after_lift_off_there_is_no_way_to_a_rejected_take_off() -> None:
    graph = PhaseGraph()
    for phase in ("T/O.run", "T/O.rotation", "T/O.lift-off"):
        graph.enter(phase)
    with pytest.raises(MachineError):
        graph.enter("RTO")


def test_every_phase_can_be_reached_and_left() -> None:
    assert {to for _, to in EDGES} | {START} == set(PHASES)
    assert {start for start, _ in EDGES} | {END} == set(PHASES)


def test_the_diagram_is_drawn_from_the_machine() -> None:
    text = diagram()
    assert text.count("-->") >= len(EDGES)
    assert "T/O.run --> RTO" in text
