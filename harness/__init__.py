"""Flies transport aircraft missions from XML, parking position to gate, on JSBSim.

```python
import harness

run = harness.fly("cologne-munich")
run.history["altitude"], run.units["altitude"], run.summary["flight_time_s"]
```
"""

from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from harness.flight import Observer
    from harness.log import Run

__version__ = "0.1.0"
__all__ = ["__version__", "fly"]


def fly(
    mission: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    overrides: Sequence[str] = (),
    rate: int = 120,
    realtime: bool = False,
    progress: "Observer | None" = None,
) -> "Run":
    """Fly a mission and return its run.

    `mission` is a name from `harness list` or the path of a mission file; `overrides` are `PATH=VALUE`
    changes to it, as for `--set`; `rate` is in frames a second (120, 240 or 480). With `out`, a new folder in
    that folder keeps the run (`run.folder`); without, nothing is written. `progress` sees every step and
    event.

    Raises InputError, OutputError before flying; FlightError when the flight cannot be completed: what was flown is
    its `run`, and kept in `out`.
    """
    from harness.errors import FlightError
    from harness.session import Session

    run, stopped = Session(mission, overrides).fly(out=out, rate=rate, realtime=realtime, progress=progress)
    if isinstance(stopped, FlightError):
        stopped.run = run
    if stopped is not None:
        raise stopped
    return run
