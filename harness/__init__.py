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
    import pyarrow as pa

    from harness.flight import Observer
    from harness.log import Run
    from harness.studies.engine import Progress

__version__ = "0.2.0"
__all__ = ["__version__", "fly", "study"]


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


def study(
    study: str | PathLike[str],
    *,
    out: str | PathLike[str] | None = None,
    workers: int | None = None,
    cluster: str | None = None,
    resume: bool = False,
    progress: "Progress | None" = None,
) -> "pa.Table":
    """Run a study and return its table, one row a case.

    `study` is a name from `harness list` or the path of a study file. With `out`, that folder keeps the results, and
    `resume` continues what it holds; without, nothing is kept. `workers` are processes of this computer (all cores
    by default); `cluster` is the address of a Dask scheduler instead. `progress(done, total, failed)` is called now
    and then. Cases that did not succeed are rows too, with their status and reason.

    Raises InputError, OutputError.
    """
    from harness.studies.conduct import run

    return run(study, out=out, workers=workers, cluster=cluster, resume=resume, progress=progress)
