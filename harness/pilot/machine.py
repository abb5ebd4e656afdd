"""The graph of flight phases, and nothing else (AIAA 2010-7777 Figs. 4 to 6)."""

from functools import cache
from typing import Any

from transitions.extensions import HierarchicalGraphMachine, HierarchicalMachine
from transitions.extensions.nesting import NestedState

from harness.vocabulary import EDGES, PHASES

START = "TXY.out"
END = "END"


class _PhaseState(NestedState):
    separator = "."


class _PhaseMachine(HierarchicalMachine):
    state_cls = _PhaseState


class _DrawnPhaseMachine(HierarchicalGraphMachine):
    state_cls = _PhaseState


def _states() -> list[str | dict[str, Any]]:
    """PHASES as transitions wants them: groups with their sub-phases as children."""
    groups: dict[str, list[str]] = {}
    for phase in PHASES:
        group, _, child = phase.partition(".")
        groups.setdefault(group, [])
        if child:
            groups[group].append(child)
    return [
        {"name": group, "children": children} if children else group for group, children in groups.items()
    ]


def _arguments() -> dict[str, Any]:
    return {
        "states": _states(),
        "transitions": [{"trigger": f"enter {b}", "source": a, "dest": b} for a, b in EDGES],
        "initial": START,
        "auto_transitions": False,
        "send_event": False,
    }


@cache
def _machine() -> _PhaseMachine:
    """One for all flights of this process: making it takes as long as all the rest of a pilot."""
    return _PhaseMachine(model=None, **_arguments())


class PhaseGraph:
    """Where in the mission the pilot is. Only the edges of the graph can be taken."""

    state: str

    def __init__(self) -> None:
        machine = _machine()
        machine.add_model(self, initial=START)
        machine.remove_model(self)  # it acts on this model all the same, and does not keep it

    def enter(self, phase: str) -> None:
        """Move along the edge to `phase`.

        Raises transitions.MachineError when there is no such edge from the present phase.
        """
        self.trigger(f"enter {phase}")  # type: ignore[attr-defined]


def diagram() -> str:
    """The phase graph as Mermaid text, drawn from the machine itself."""
    model = PhaseGraph.__new__(PhaseGraph)
    machine = _DrawnPhaseMachine(model=model, graph_engine="mermaid", **_arguments())
    graph: Any = machine.get_combined_graph()
    return str(graph.source)
