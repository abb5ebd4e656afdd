"""One flight's columns and events: recorded while flying, kept in a folder, read back later.

`FlightLog` watches a flight, `conclude` makes a `Run` of it; `RunFolder`, `write_run` and `read_run` keep it.
"""

from harness.log.files import RunFolder, read_run, write_run
from harness.log.inputs import Inputs
from harness.log.record import FlightLog, Reporter
from harness.log.run import Event, Passage, Run
from harness.log.summary import conclude

__all__ = [
    "Event",
    "FlightLog",
    "Inputs",
    "Passage",
    "Reporter",
    "Run",
    "RunFolder",
    "conclude",
    "read_run",
    "write_run",
]
