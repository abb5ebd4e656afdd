"""Where aircraft come from: loaded when one is wanted, or before this process forks for the flights to come.

A flight needs a simulator that nobody has flown. Loading one takes as long as 10 s of a take-off run; a process forked
after `park` has it already, and flies its own copy of it.
"""

import ctypes
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import jsbsim

from harness.errors import InputError
from harness.lint.aircraft import check
from harness.plant.messages import Messages

_Sort = tuple[Path, str, int]
_parked: dict[_Sort, jsbsim.FGFDMExec] = {}
_wanted: list[_Sort] = []


def park(root: Path, aircraft: str, rate: int) -> None:
    """Have an aircraft of this sort ready, for the next flight of this process and of each forked from it.

    Raises InputError when JSBSim refuses it.
    """
    sort = (root, aircraft, rate)
    if sort not in _parked:
        _parked[sort] = load(*sort)


def park_again() -> None:
    """Have the aircraft that was wanted last ready once more, if any was."""
    if _wanted:
        park(*_wanted[-1])


@contextmanager
def parked(root: Path, aircraft: str, rate: int) -> Iterator[None]:
    """Have an aircraft of this sort parked as long as this lasts, and none after it: files may change.

    Raises InputError when JSBSim refuses it.
    """
    sort = (root, aircraft, rate)
    lasting = sort in _parked
    park(*sort)
    try:
        yield
    finally:
        if not lasting:
            _parked.pop(sort, None)


def fresh(root: Path, aircraft: str, rate: int) -> jsbsim.FGFDMExec:
    """A simulator with this aircraft that nobody has flown, `rate` frames a second. Raises InputError as `load`."""
    sort = (root, aircraft, rate)
    fdm = _parked.pop(sort, None) or load(*sort)
    _wanted[:] = [sort]
    return fdm


def load(root: Path, aircraft: str, rate: int) -> jsbsim.FGFDMExec:
    """A simulator with this aircraft, `rate` frames a second. Raises InputError when JSBSim refuses it."""
    check(root, aircraft)
    messages = Messages()
    jsbsim.set_logger(messages)
    fdm = jsbsim.FGFDMExec(str(root))
    fdm.set_debug_level(0)
    fdm.set_dt(1.0 / rate)  # before the model: filters and actuators keep the step they were loaded with
    try:
        loaded = fdm.load_model(aircraft)
    except jsbsim.BaseError as error:
        raise refused(fdm, aircraft, str(error)) from error
    if not loaded:
        raise refused(fdm, aircraft, "\n    ".join(messages.serious))
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
