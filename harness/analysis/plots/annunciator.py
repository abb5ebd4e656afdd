"""The pilot's modes against time as strips, the way a flight mode annunciator shows them."""

from collections.abc import Sequence
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from harness.analysis.plots.look import INK, phase_colour, phase_group
from harness.analysis.spans import Span, spans
from harness.log import Run
from harness.units import MIN

WIDTH = 12.0  # inches
LANE = 0.38  # inches
FONT = 7.5  # points
LETTER = 0.62 * FONT / 72  # mean width of a letter, inches
THINNEST = 0.012  # inches; anything shorter joins what comes before it
LONG = 8 * MIN  # flights longer than this get a closer look at both ends
DEPARTURE = (-1.0 * MIN, 3.0 * MIN)  # around lift-off
ARRIVAL = (-3.0 * MIN, 1.0 * MIN)  # around touchdown
LANES = ("CTRL", "INN", "SPD", "HP", "VP")
SHADES = (
    "#56b4e9",
    "#f0a830",
    "#5cc4a0",
    "#e0a3c8",
    "#f2e05e",
    "#a79bd8",
    "#e88b72",
    "#b9c46a",
    "#9fb6c8",
    "#c9b39a",
)
OFF = "#e4e4e4"


class Lane(NamedTuple):
    """One strip: its name, its stretches, and the colour of each word."""

    name: str
    stretches: list[Span]
    colours: dict[str, str]


class Window(NamedTuple):
    """A part of the flight: its title, first and last second."""

    title: str
    begin: float
    end: float


def modes(run: Run) -> Figure:
    """Draw a strip for the phase and for each super-mode; long flights also close up on both ends."""
    time = run.history["time"]
    lanes = [_phase_lane(run), *(_lane(run, name) for name in LANES if f"mode_{name}" in run.history)]
    begin, end = float(time[0]), float(time[-1])
    windows = _closer(run, begin, end) if end - begin > LONG else []
    rows = 2 if windows else 1
    figure = Figure(figsize=(WIDTH, rows * (len(lanes) * LANE + 0.75) + 0.9), layout="constrained")
    grid = figure.add_gridspec(rows, max(len(windows), 1))
    whole = figure.add_subplot(grid[0, :])
    _strips(whole, lanes, Window("whole flight", begin, end), WIDTH - 1.2)
    for column, window in enumerate(windows):
        _strips(figure.add_subplot(grid[1, column]), lanes, window, WIDTH / len(windows) - 1.0)
    figure.suptitle(f"{run.summary.get('mission', '')}: flight modes", x=0.01, ha="left", fontsize=11)
    _legend(figure, lanes[1:])
    return figure


def _phase_lane(run: Run) -> Lane:
    groups = [phase_group(phase) for phase in run.history["phase"].tolist()]
    return Lane("phase", spans(run.history["time"], groups), {group: phase_colour(group) for group in groups})


def _lane(run: Run, name: str) -> Lane:
    stretches = spans(run.history["time"], run.history[f"mode_{name}"])
    words = list(dict.fromkeys(span.word for span in stretches))
    active = [word for word in words if word not in {"OFF", ""}]
    colours = {word: SHADES[index % len(SHADES)] for index, word in enumerate(active)}
    return Lane(name, stretches, {word: colours.get(word, OFF) for word in words})


def _closer(run: Run, begin: float, end: float) -> list[Window]:
    """Return the close-ups: as many of the two as were flown."""
    windows = []
    for title, moment, around in (
        ("departure", "lift_off_s", DEPARTURE),
        ("arrival", "touchdown_s", ARRIVAL),
    ):
        at = run.summary.get(moment)
        if at is not None:
            windows.append(Window(title, max(begin, at + around[0]), min(end, at + around[1])))
    return windows


def _strips(axes: Axes, lanes: Sequence[Lane], window: Window, width: float) -> None:
    """Draw every lane in a window of time; `width` is roughly that of the axes in inches."""
    inch = (window.end - window.begin) / width  # seconds
    for row, lane in enumerate(lanes):
        for span in joined(lane.stretches, window.begin, window.end, THINNEST * inch):
            _box(axes, row, span, lane.colours[span.word], letters=(span.end - span.begin) / inch / LETTER)
    axes.set_title(window.title, loc="left", fontsize=9)
    axes.set(xlim=(window.begin / MIN, window.end / MIN), ylim=(len(lanes) - 0.5, -0.5), xlabel="time, min")
    axes.set_yticks(range(len(lanes)), [lane.name for lane in lanes])
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)


def _box(axes: Axes, row: int, span: Span, colour: str, *, letters: float) -> None:
    """Draw one stretch with as much of its word as `letters` of width hold."""
    axes.broken_barh(
        [(span.begin / MIN, (span.end - span.begin) / MIN)],
        (row - 0.42, 0.84),
        facecolor=colour,
        edgecolor="white",
        linewidth=0.5,
    )
    is_phase = row == 0
    axes.text(
        (span.begin + span.end) / 2 / MIN,
        row,
        fitting(span.word, letters),
        ha="center",
        va="center",
        fontsize=FONT,
        color="white" if is_phase else INK,
        weight="bold" if is_phase else "normal",
    )


def fitting(words: str, letters: float) -> str:
    """Return as much of a mode's name as fits into a width: all of it, its first word, or nothing."""
    for text in (words, words.partition(" ")[0].rstrip(":")):
        if len(text) <= letters:
            return text
    return ""


def joined(stretches: Sequence[Span], begin: float, end: float, shortest: float) -> list[Span]:
    """Cut the stretches to a window, and let those shorter than `shortest` join the one before them."""
    result: list[Span] = []
    for span in stretches:
        first, last = max(span.begin, begin), min(span.end, end)
        if last <= first:
            continue
        if result and (last - first < shortest or result[-1].word == span.word):
            result[-1] = result[-1]._replace(end=last)
        else:
            result.append(span._replace(begin=first, end=last))
    return result


def _legend(figure: Figure, lanes: Sequence[Lane]) -> None:
    """List the colours lane by lane, one column for each lane."""
    most = max((len(lane.colours) for lane in lanes), default=0)
    handles = []
    for lane in lanes:
        patches = [
            Patch(facecolor=colour, label=f"{lane.name} {word}") for word, colour in lane.colours.items()
        ]
        blank = [Patch(facecolor="none", edgecolor="none", label=" ")] * (most - len(patches))
        handles += patches + blank
    if handles:
        figure.legend(handles=handles, loc="outside lower center", ncols=len(lanes), handlelength=1.4)
