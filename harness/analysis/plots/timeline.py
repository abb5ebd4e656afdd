"""A flight against time: altitude, speed, attitude, thrust and fuel (AIAA 2010-7777, Fig. 13)."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from harness.analysis.plots.look import INK, PHASES, phase_colour, phase_group, plain_grid
from harness.analysis.spans import Span, spans
from harness.log import Passage, Run
from harness.units import DEG, FT, KN, KT, MIN, TONNE

SIZE = (11.0, 11.5)  # inches
BLUE, ORANGE = "#0072b2", "#d55e00"
TARGET: dict[str, Any] = {"color": INK, "linewidth": 0.9, "dashes": (4, 2), "zorder": 2.1}
LETTER = 0.036  # of the altitude scale: room above the lines for each letter of a waypoint's name
CLOSEST_LABELS = 0.017  # of the time axis, between two labels of phases


def profile(run: Run) -> Figure:
    """Draw altitude, airspeed and Mach number, pitch and bank, thrust and fuel, with phases and waypoints."""
    history = run.history
    minutes = history["time"] / MIN
    figure = Figure(figsize=SIZE, layout="constrained")
    panels: Sequence[Axes] = figure.subplots(5, 1, sharex=True, height_ratios=(1.5, 1.3, 1.1, 0.8, 0.9))
    altitude, speed, attitude, thrust, fuel = panels
    altitude.set_xlim(minutes[0], minutes[-1])

    altitude.plot(minutes, history["pressure_altitude"] / FT, color=BLUE, label="pressure altitude")
    on_level = np.isin(history["phase"], ("APP.final", "LDG.flare", "LDG.roll-out"), invert=True)
    level = np.where(on_level, history["pressure_altitude"] + history["target_level_error"], np.nan)
    altitude.plot(minutes, level / FT, label="level to fly", **TARGET)
    altitude.set_ylabel("altitude, ft")
    low, high = altitude.get_ylim()
    letters = max((len(passage.name) for passage in run.passages), default=0)
    altitude.set_ylim(low, high + min(0.05 + letters * LETTER, 0.4) * (high - low))

    speed.plot(minutes, history["cas"] / KT, color=BLUE, label="CAS")
    speed.plot(minutes, history["target_cas"] / KT, label="CAS to fly", **TARGET)
    mach = _beside(speed, "Mach number", ORANGE)
    mach.plot(minutes, history["mach"], color=ORANGE, linewidth=1.0, label="Mach")
    _floor(mach, history["mach"])
    speed.set_ylabel("CAS, kt")
    speed.set_ylim(bottom=0)

    attitude.plot(minutes, history["roll"] / DEG, color=ORANGE, linewidth=0.9, label="bank, right positive")
    attitude.plot(minutes, history["pitch"] / DEG, color=BLUE, label="pitch")
    attitude.set_ylabel("attitude, deg")

    thrust.plot(minutes, history["thrust"] / KN, color=BLUE, label="thrust")
    thrust.set_ylabel("thrust, kN")
    lever = _beside(thrust, "thrust lever, %", ORANGE)
    lever.plot(minutes, history["command_throttle"] * 100, color=ORANGE, linewidth=1.0, label="thrust lever")

    fuel.plot(minutes, history["fuel"] / TONNE, color=BLUE, label="fuel on board")
    fuel.set_ylabel("fuel, t")
    fuel.set_ylim(bottom=0)
    flow = _beside(fuel, "fuel flow, kg/min", ORANGE)
    flow.plot(minutes, history["fuel_flow"] * MIN, color=ORANGE, linewidth=1.0, label="fuel flow")
    _floor(flow, history["fuel_flow"] * MIN)
    fuel.set_xlabel("time, min")

    groups = [phase_group(phase) for phase in history["phase"].tolist()]
    stretches = spans(minutes, groups)
    for axes in panels:
        plain_grid(axes)
        _bands(axes, stretches, run.passages)
        _legend(axes, below=axes is altitude)
    _phase_names(altitude, stretches)
    _waypoint_names(altitude, run.passages)
    title = f"{run.summary.get('mission', '')}: altitude, speed, attitude, thrust and fuel"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    return figure


def _beside(axes: Axes, label: str, colour: str) -> Axes:
    """Return a second scale on the right, in the colour of its line."""
    right = axes.twinx()
    right.set_ylabel(label, color=colour)
    right.tick_params(axis="y", colors=colour)
    right.spines["right"].set_visible(True)
    return right


def _floor(axes: Axes, values: NDArray[np.float64]) -> None:
    """Begin a scale at zero, with headroom so that its line keeps clear of the legend."""
    axes.set_ylim(0, 1.15 * float(np.max(values)) or 1.0)


def _bands(axes: Axes, stretches: list[Span], passages: Sequence[Passage]) -> None:
    for span in stretches:
        axes.axvspan(span.begin, span.end, color=phase_colour(span.word), alpha=0.10, linewidth=0, zorder=0)
    for passage in passages:
        axes.axvline(passage.time / MIN, color="#777777", linewidth=0.6, dashes=(1, 2), zorder=1)


def _legend(axes: Axes, *, below: bool) -> None:
    """Put one row of labels for both scales on top of the panel; below it where the phases are named on top."""
    twins = [twin for twin in axes.figure.axes if twin is not axes and twin.bbox.bounds == axes.bbox.bounds]
    handles = [handle for each in (axes, *twins) for handle in each.get_legend_handles_labels()[0]]
    top = twins[-1] if twins else axes
    top.legend(
        handles=handles,
        loc="upper left" if below else "lower right",
        bbox_to_anchor=(0.0, 0.0) if below else (1.0, 0.98),
        ncols=len(handles),
        frameon=False,
        borderpad=0.2,
    )


def _phase_names(axes: Axes, stretches: list[Span]) -> None:
    """Name the phases above the panel; names of short phases are moved apart, and tied to their bands."""
    begin, end = axes.get_xlim()
    wanted = [((span.begin + span.end) / 2 - begin) / (end - begin) for span in stretches]
    for span, at, x in zip(stretches, wanted, spread(wanted, CLOSEST_LABELS), strict=True):
        axes.annotate(
            span.word,
            (at, 1.0),
            (x, 1.07),
            xycoords="axes fraction",
            rotation=90,
            ha="center",
            va="bottom",
            fontsize=8,
            color=phase_colour(span.word) if span.word in PHASES else INK,
            weight="bold",
            arrowprops={"arrowstyle": "-", "linewidth": 0.6, "color": "#999999", "shrinkA": 0, "shrinkB": 0},
            annotation_clip=False,
        )


def _waypoint_names(axes: Axes, passages: Sequence[Passage]) -> None:
    begin, end = axes.get_xlim()
    wanted = [(passage.time / MIN - begin) / (end - begin) for passage in passages]
    for passage, x in zip(passages, spread(wanted, CLOSEST_LABELS), strict=True):
        axes.annotate(
            passage.name,
            (x, 0.985),
            xycoords="axes fraction",
            rotation=90,
            ha="right",
            va="top",
            fontsize=7.5,
            color="#555555",
        )


def spread(wanted: Sequence[float], gap: float) -> list[float]:
    """Return positions at least `gap` apart, in the order of `wanted` (ascending) and close to it.

    Neighbours too close form a block that sits at the mean of what its members want: the least-squares
    solution (pool adjacent violators).
    """
    blocks: list[tuple[float, int]] = []  # mean of (wanted - index * gap), members
    for index, position in enumerate(wanted):
        mean, count = position - index * gap, 1
        while blocks and blocks[-1][0] > mean:
            other, others = blocks.pop()
            mean = (mean * count + other * others) / (count + others)
            count += others
        blocks.append((mean, count))
    means = [mean for mean, count in blocks for _ in range(count)]
    return [mean + index * gap for index, mean in enumerate(means)]
