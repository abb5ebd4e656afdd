"""A kind of case that costs nothing, and can misbehave: the fuel in kg says how. For tests of studies."""

import os
import time
from pathlib import Path

from harness.errors import FlightError
from harness.mission.reader import read_mission

CRASH, HANG, FAIL, BUG, EXIT = 9001.0, 9002.0, 9003.0, 9004.0, 9005.0
DELAY = "STUB_DELAY"  # of the environment: seconds a case takes
MARKS = "STUB_MARKS"  # of the environment: a file that grows by one byte with each case that ends


def run_case(subject, overrides, seed):
    values = {override.path: override.value for override in overrides}
    fuel = float(values["loading/fuel"].split()[0])
    time.sleep(float(os.environ.get(DELAY, "0")))
    if fuel == CRASH:
        os.abort()
    if fuel == EXIT:
        os._exit(3)
    if fuel == HANG:
        time.sleep(1000)
    if fuel == FAIL:
        raise FlightError("flown into a test", time=1.0, phase="T/O.run")
    if fuel == BUG:
        raise ZeroDivisionError("a mistake of ours")
    if MARKS in os.environ:
        with Path(os.environ[MARKS]).open("ab") as marks:
            marks.write(b".")
    return {
        "double": 2 * fuel,
        "word": f"w{fuel:g}",
        "noise": seed / 2**60,
        "nested": {"list": [{"name": "a.b", "x": fuel}]},
    }


def probe(subject, overrides):
    read_mission(subject.file, overrides, text=subject.text)


def make_ready():
    pass


def outputs():
    return frozenset({"double", "word", "noise", "nested.list[a.b].x"})
