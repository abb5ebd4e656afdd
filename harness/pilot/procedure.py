"""Procedures: the pilot carries their steps out, in order, each when its conditions hold (Fig. 10)."""

from collections.abc import Iterable
from math import inf
from typing import NamedTuple

from harness.pilot.checklist import Cockpit, Item, item
from harness.plan import Step
from harness.state import State

SAME_MOMENT = 1e-6  # s


class ReadyStep(NamedTuple):
    """A procedure step with its conditions looked up."""

    step: Step
    when: tuple[Item, ...]
    only_if: tuple[Item, ...]


class Procedure:
    """Steps still to be carried out.

    A step is carried out `reaction` seconds after its conditions began to hold, or the procedure began: the time a
    human takes to see it and to move.
    """

    def __init__(self, steps: Iterable[Step], pilot: Cockpit, mass: float, reaction: float) -> None:
        """Look up the numbers of the steps for an aircraft of `mass` kg."""
        self.steps = [
            ReadyStep(
                step,
                tuple(item(condition, pilot, mass) for condition in step.when),
                tuple(item(condition, pilot, mass) for condition in step.only_if),
            )
            for step in steps
        ]
        self._reaction = reaction
        self.ready_at = inf  # when the next step is carried out, if what it waits for holds until then, s

    def due(self, state: State) -> ReadyStep | None:
        """Take the step that is due now, if one is; those that do not apply are dropped."""
        while self.steps:
            ready = self.steps[0]
            if not all(entry.holds(state) for entry in ready.only_if):
                del self.steps[0]
                continue
            if not all(entry.holds(state) for entry in ready.when):
                self.ready_at = inf
                return None
            if self.ready_at == inf:
                self.ready_at = state.time + self._reaction
            if state.time < self.ready_at - SAME_MOMENT:
                return None
            return self.steps.pop(0)
        return None
