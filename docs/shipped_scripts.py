"""Replay every script shipped with JSBSim, beside the stock program: `.venv/bin/python docs/shipped_scripts.py`.

Each runs to its end or to END, in processes of its own, once by `harness replay` and once by the `jsbsim` command at
the script's own step. The table of docs/scripts.md is made anew from what came out. It takes some minutes.
"""

import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

import jsbsim

from harness.errors import HarnessError
from harness.replay.player import Choices, replay
from harness.replay.script import read_script

PAGE = Path(__file__).with_name("scripts.md")
MADE = re.compile(r"(<!-- shipped scripts -->\n).*?(<!-- end -->)", re.DOTALL)
SHIPPED = Path(jsbsim.__file__).parent
END = 20.0  # s of simulated time
LIMIT = 120.0  # s of computing
STOCK = """
import json, sys
import jsbsim, jsbsim.script
made = []
make = jsbsim.FGFDMExec
def kept(*arguments):
    made.append(make(*arguments))
    return made[-1]
jsbsim.FGFDMExec = kept
path, sys.argv = sys.argv[1], ["jsbsim", *sys.argv[2:]]
said = ""
try:
    jsbsim.script.main()
except Exception as error:
    said = str(error)
if not made:
    sys.exit(said)
manager = made[0].get_property_manager()
names = [entry.split(" ")[0] for entry in made[0].query_property_catalog("").splitlines()]
state = {name: made[0].get_property_value(name) for name in names if manager.hasNode(name)}
json.dump({"state": state, "said": said}, open(path, "w"))
"""
"""Runs the stock program's own main() and keeps the properties it ends with."""


class Outcome(NamedTuple):
    """What a script ended with: properties, or the message with which it failed."""

    state: dict[str, float]
    message: str


class Pair(NamedTuple):
    """A script replayed and run by the stock program."""

    script: str
    aircraft: str
    step: float
    ours: Outcome
    stock: Outcome

    @property
    def same(self) -> bool:
        """Whether both ended in the same state, or both failed."""
        if self.ours.message or self.stock.message:
            return bool(self.ours.message and self.stock.message)
        return all(repr(value) == repr(self.stock.state.get(name)) for name, value in self.ours.state.items())


def main() -> None:
    """Bring the page up to date."""
    rows = [row(pair(script)) for script in sorted((SHIPPED / "scripts").glob("*.xml"))]
    head = (
        f"With jsbsim {jsbsim.__version__}, {END:.0f} s of simulated time at most.",
        "",
        "| script | aircraft | step, s | ends | as stock |",
        "|---|---|---|---|---|",
    )
    table = "\n".join((*head, *rows))
    PAGE.write_text(
        MADE.sub(lambda found: f"{found[1]}\n{table}\n\n{found[2]}", PAGE.read_text("utf-8")), "utf-8"
    )


def pair(script: Path, end: float = END) -> Pair:
    """Run a script both ways."""
    try:
        given = read_script(str(script), SHIPPED)
        aircraft, step = given.aircraft, given.dt or 1 / 120
    except HarnessError:
        aircraft, step = "", 1 / 120
    with tempfile.TemporaryDirectory() as folder:
        ours, stock = replayed(script, end, Path(folder)), by_stock(script, step, end, Path(folder))
    return Pair(script.stem, aircraft, step, ours, stock)


def replayed(script: Path, end: float, folder: Path) -> Outcome:
    """By `harness replay`."""
    try:
        run, stopped, _ = replay(str(script), folder, Choices(root=SHIPPED, end=end, limit=LIMIT))
    except HarnessError as error:
        return Outcome({}, str(error))
    return Outcome(dict(run.summary["end_state"]), str(stopped or ""))


def by_stock(script: Path, step: float, end: float, folder: Path) -> Outcome:
    """By the stock program's main()."""
    result = folder / "stock.json"
    arguments = (
        f"--root={SHIPPED}",
        f"--script={script}",
        f"--simulation-rate={step!r}",
        f"--end={end}",
        f"--outputpath={folder}",
        "--nohighlight",
    )
    command = [sys.executable, "-c", STOCK, str(result), *arguments]
    try:
        ended = subprocess.run(  # noqa: S603  the stock program
            command, cwd=folder, capture_output=True, text=True, timeout=LIMIT, check=False
        )
    except subprocess.TimeoutExpired:
        return Outcome({}, "no end")
    if not result.exists():
        return Outcome({}, f"exit code {ended.returncode}: {ended.stderr.strip()[-200:]}")
    found = json.loads(result.read_text("utf-8"))
    return Outcome(found["state"], found["said"])


def row(both: Pair) -> str:
    """A row of the table."""
    ends = f"fails: {shortened(both.ours.message)}" if both.ours.message else "ok"
    same = "yes" if both.same else f"no: {shortened(both.stock.message) or 'another end state'}"
    return f"| {both.script} | {both.aircraft} | {both.step:.6g} | {ends} | {same} |"


def shortened(message: str) -> str:
    """A message that fits a table."""
    text = " ".join(re.sub(r"(?<!\S)/\S*/(?=[^/\s]+)", "", message).split()).replace("|", "/")
    return text if len(text) < 160 else text[:157] + "..."


if __name__ == "__main__":
    main()
