"""Several take-offs at once, on processes: the same results in the same order as one after the other."""

import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import get_context
from typing import TypeVar

from harness.errors import HarnessError
from harness.fork import forked
from harness.manual import read_manual
from harness.plant.hangar import Sort, parked
from harness.resources import root
from harness.takeoff.case import TakeOff

Case = TypeVar("Case")
Result = TypeVar("Result")


def cpus() -> int:
    """Processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def fly_all(
    fly: Callable[[Case], Result],
    cases: Sequence[Case],
    workers: int,
    like: TakeOff,
    meanwhile: Iterable[Callable[[], object]] = (),
) -> list[Result]:
    """`fly` of each case, on `workers` processes; `meanwhile` is done here while they fly.

    Each is flown in a fork of its own, with an aircraft that was loaded before: that of `like`. Raises what `fly`
    raises, and HarnessError when a process died.
    """
    workers = min(workers, len(cases))
    with parked(Sort(root(), like.aircraft, like.rate, own_rates=True)):
        read_manual(like.aircraft)  # every fork knows it then
        if workers <= 1:
            for act in meanwhile:
                act()
            return [_apart(fly, case) for case in cases]
        # Forked where the system can: the workers have everything imported already, which is most of a short study.
        context = get_context("fork" if hasattr(os, "fork") else "spawn")
        with ProcessPoolExecutor(workers, mp_context=context) as pool:
            futures = [pool.submit(_apart, fly, case) for case in cases]
            for act in meanwhile:
                act()
            try:
                return [future.result() for future in futures]
            except BrokenProcessPool as error:
                raise HarnessError("a process that flew take-offs has died") from error


def _apart(fly: Callable[[Case], Result], case: Case) -> Result:
    return forked(lambda: fly(case))
