"""A flight of ours as one JSBSim script that the stock program replays bit for bit.

Script events run at the head of a frame, where a value written by Python between two frames is first seen. So every
property that the flight wrote often is set at each of the pilot's steps, by one event, from a table that holds each
value until the next (two breakpoints between the same two frames: the interpolation never shows); what was written a
few times gets an event for each time. Values are written with all their digits.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence
from itertools import pairwise
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

from harness.errors import InputError, OutputError
from harness.log import Inputs, Run
from harness.log.inputs import AT_START, BEFORE, Write

INITIAL = "replay"  # aircraft/NAME/replay.xml: the initial file the scripts name, empty on purpose
CLOCK = "replay/frame-of-step"  # 1 in the first frame of each pilot step: only then may something change
FEW = 4
"""A property written more often than this is set from a table in every frame; others by events. Few events cost less
than the table and leave what the aircraft itself writes to the property alone."""

SET_BACK = frozenset({"payload/release"})
"""Commands that the aircraft itself sets back when they are carried out: never held by a table."""

Series = list[tuple[int, float]]
"""Steps and the values written there."""


def script_of(run: Run, inputs: Inputs) -> str:
    """Return the script of a flight. `run` gives its name and aircraft, `inputs` what it wrote.

    Raises InputError when nothing was flown.
    """
    if not inputs.steps:
        raise InputError(f"the run {run.folder} flew no step", remedy="fly the mission again")
    aircraft, name = str(run.summary["aircraft"]), str(run.summary["mission"])
    dt = 1.0 / inputs.rate
    frames = inputs.steps * inputs.frames_per_step
    series = _series(inputs.writes)
    often = {name: steps for name, steps in series.items() if len(steps) > FEW and name not in SET_BACK}
    rarely = [write for write in inputs.writes if write.step > 0 and write.name not in often]
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>',
        f"<runscript name={quoteattr(f'{name}, as flown')}>",
        f"<description>{escape(_description(run, inputs))}</description>",
        f'<use aircraft={quoteattr(aircraft)} initialize="{INITIAL}"/>',
        f'<run start="0" end="{frames * dt!r}" dt="{dt!r}">',
        f'<property value="0">{CLOCK}</property>',
        *(f'<property value="{w.value!r}">{w.name}</property>' for w in inputs.writes if w.step == BEFORE),
        *_event("start", 0.0, (w for w in inputs.writes if w.step in (AT_START, 0))),
        *_rare_events(rarely, inputs, dt),
        *_tables(often, inputs, dt),
        "</run>",
        "</runscript>",
    ]
    return "\n".join(lines) + "\n"


def write_script(text: str, path: Path) -> None:
    """Write a script. Raises OutputError."""
    try:
        path.write_text(text, "utf-8")
    except OSError as error:
        raise OutputError(
            f"cannot be written: {error.strerror}", path=path, remedy="choose another file: --out FILE"
        ) from error


def _description(run: Run, inputs: Inputs) -> str:
    """What the script is, and how the stock program replays it."""
    facts = run.summary
    return (
        f"{facts['mission']} as flown by harness {facts['harness_version']}. "
        f"Aircraft {facts['aircraft']}, SHA-256 {facts['aircraft_sha256']}. "
        f"Replay: jsbsim --root=ROOT --script=THIS --simulation-rate={inputs.rate}"
    )


def _series(writes: Iterable[Write]) -> dict[str, Series]:
    """The values of each property written while flying, where they change."""
    series: dict[str, Series] = defaultdict(list)
    for step, name, value in writes:
        if step == BEFORE:
            continue
        held = series[name]
        if held and held[-1][0] == step:
            held.pop()
        if not held or held[-1][1] != value:
            held.append((step, value))
    return series


def _event(name: str, time: float, writes: Iterable[Write]) -> Iterator[str]:
    yield f'<event name="{name}"><condition>simulation/sim-time-sec ge {time:.6f}</condition>'
    for write in writes:
        yield f'<set name="{write.name}" value="{write.value!r}"/>'
    yield "</event>"


def _rare_events(writes: Sequence[Write], inputs: Inputs, dt: float) -> Iterator[str]:
    """One event for each step in which something seldom written was written."""
    steps: dict[int, list[Write]] = defaultdict(list)
    for write in writes:
        steps[write.step].append(write)
    for step, together in steps.items():
        # A frame's events see its end as the time: that of the first frame of a step is one frame past the step's.
        yield from _event(f"step {step}", (step * inputs.frames_per_step + 0.5) * dt, together)


def _tables(often: dict[str, Series], inputs: Inputs, dt: float) -> Iterator[str]:
    """An event that comes at each pilot step; properties written alike, such as four throttles, share a table."""
    if not often:
        return
    yield '<event name="clock" continuous="true"><condition>simulation/sim-time-sec ge 0</condition>'
    yield (
        f'<set name="{CLOCK}"><function><mod><property>simulation/frame</property>'
        f"<value>{inputs.frames_per_step}</value></mod></function></set></event>"
    )
    yield f'<event name="pilot" persistent="true"><condition>{CLOCK} eq 1</condition>'
    names: dict[tuple[tuple[int, float], ...], str] = {}
    for name, series in often.items():
        key = tuple(series)
        if key in names:
            body = f"<property>{names[key]}</property>"
        else:
            names[key] = f"replay/table-{len(names)}"
            rows = "\n".join(_rows(series, inputs.frames_per_step, dt))
            body = (
                "<table><independentVar>simulation/sim-time-sec</independentVar>"
                f"<tableData>\n{rows}\n</tableData></table>"
            )
        title = "" if body.startswith("<property>") else f' name="{names[key]}"'
        yield f'<set name="{name}"><function{title}>{body}</function></set>'
    yield "</event>"


def _rows(series: Series, frames_per_step: int, dt: float) -> Iterator[str]:
    """Rows of the table that holds each value until the frame after the next was written."""
    for (_, before), (step, after) in pairwise(series):
        frame = step * frames_per_step
        yield f"{(frame + 0.35) * dt:.6f} {before!r}"
        yield f"{(frame + 0.65) * dt:.6f} {after!r}"
