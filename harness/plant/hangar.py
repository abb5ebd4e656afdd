"""Where aircraft come from: loaded when one is wanted, or before this process forks for the flights to come.

A flight needs a simulator that nobody has flown. Loading one takes as long as 10 s of a take-off run; a process forked
after `park` has it already, and flies its own copy of it.
"""

import ctypes
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

import jsbsim

from harness.errors import InputError
from harness.lint.aircraft import check
from harness.plant.cadence import own_rates
from harness.plant.messages import Messages


class Sort(NamedTuple):
    """What one aircraft has in common with another that it can stand in for.

    `rate` is frames a second; `own_rates` runs control laws, engines and systems as often as harness.plant.cadence
    says, whatever that is. Without it they go by frames, as in JSBSim's own program.
    """

    root: Path
    aircraft: str
    rate: int
    own_rates: bool = False


_parked: dict[Sort, jsbsim.FGFDMExec] = {}
_wanted: list[Sort] = []


def park(sort: Sort) -> None:
    """Have an aircraft of this sort ready, for the next flight of this process and of each forked from it.

    Raises InputError when JSBSim refuses it.
    """
    if sort not in _parked:
        _parked[sort] = load(sort)


def park_again() -> None:
    """Have the aircraft that was wanted last ready once more, if any was."""
    if _wanted:
        park(_wanted[-1])


@contextmanager
def parked(sort: Sort) -> Iterator[None]:
    """Have an aircraft of this sort parked as long as this lasts, and none after it: files may change.

    Raises InputError when JSBSim refuses it.
    """
    lasting = sort in _parked
    park(sort)
    try:
        yield
    finally:
        if not lasting:
            _parked.pop(sort, None)


def fresh(sort: Sort) -> jsbsim.FGFDMExec:
    """A simulator with an aircraft of this sort that nobody has flown. Raises InputError as `load`."""
    fdm = _parked.pop(sort, None) or load(sort)
    _wanted[:] = [sort]
    return fdm


def load(sort: Sort) -> jsbsim.FGFDMExec:
    """A simulator with an aircraft of this sort. Raises InputError when JSBSim refuses it."""
    check(sort.root, sort.aircraft)
    if sort.own_rates:
        with own_rates(sort.root, sort.aircraft, sort.rate) as folder:
            return _load(folder, sort)
    return _load(sort.root, sort)


def _load(folder: Path, sort: Sort) -> jsbsim.FGFDMExec:
    messages = Messages()
    jsbsim.set_logger(messages)
    fdm = jsbsim.FGFDMExec(str(folder))
    fdm.set_debug_level(0)
    fdm.set_dt(1.0 / sort.rate)  # before the model: filters and actuators keep the step they were loaded with
    try:
        loaded = fdm.load_model(sort.aircraft)
    except jsbsim.BaseError as error:
        raise refused(fdm, sort.aircraft, str(error).replace(str(folder), str(sort.root))) from error
    if not loaded:
        raise refused(fdm, sort.aircraft, "\n    ".join(messages.serious))
    fdm.disable_output()
    return fdm


def refused(fdm: jsbsim.FGFDMExec, aircraft: str, said: str) -> InputError:
    """What JSBSim said, as file, line and message where it gives them."""
    # Kept for ever: taking a half-loaded simulator down reads properties it never had, and aborts the process.
    ctypes.pythonapi.Py_IncRef(ctypes.py_object(fdm))
    what = f"JSBSim refuses the aircraft {aircraft}"
    found = re.search(r"In file (.+?):? line (\d+)\s*(.*)", said, re.DOTALL)
    if found:
        return InputError(f"{what}: {' '.join(found[3].split())}", file=found[1], line=int(found[2]))
    return InputError(f"{what}: {said.strip()}", remedy="systems/ shows how the others provide it")
