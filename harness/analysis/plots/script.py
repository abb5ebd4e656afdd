"""A replayed script: its ground track, and what any aircraft has against time."""

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from harness.analysis.plots.look import plain_grid
from harness.log import Run
from harness.log.run import History
from harness.units import DEG, FT, KN, KT
from harness.world.local import LocalFrame

SIZE = (11.0, 11.0)  # inches
BREEZE = 10.0  # m/s
BLUE, ORANGE, GREEN = "#0072b2", "#d55e00", "#009e73"
PANELS: tuple[tuple[str, tuple[tuple[str, str, float, str], ...]], ...] = (
    ("altitude, ft", (("altitude", "above sea level", FT, BLUE), ("height", "above ground", FT, ORANGE))),
    ("speed, kt", (("cas", "CAS", KT, BLUE), ("tas", "TAS", KT, ORANGE))),
    (
        "attitude, deg",
        (("pitch", "pitch", DEG, BLUE), ("roll", "bank", DEG, ORANGE), ("alpha", "incidence", DEG, GREEN)),
    ),
    ("thrust, kN", (("thrust", "thrust", KN, BLUE),)),
    (
        "controls, %",
        (
            ("command_elevator", "elevator", 0.01, BLUE),
            ("command_aileron", "aileron", 0.01, ORANGE),
            ("command_rudder", "rudder", 0.01, GREEN),
            ("command_throttle", "throttle", 0.01, "#7b52ab"),
        ),
    ),
)
"""The label of each panel, and its lines: column, name, unit in SI, colour."""


def script_profile(run: Run) -> Figure:
    """Draw altitude, speed, attitude, thrust and controls, with the script's events."""
    history = run.history
    figure = Figure(figsize=SIZE, layout="constrained")
    panels: list[Axes] = list(figure.subplots(len(PANELS), 1, sharex=True))
    for axes, (label, lines) in zip(panels, PANELS, strict=True):
        for column, name, unit, colour in lines:
            if column in history:
                axes.plot(history["time"], _drawn(history, column) / unit, color=colour, label=name)
        axes.set_ylabel(label)
        plain_grid(axes)
        for event in run.events:
            axes.axvline(event.time, color="#777777", linewidth=0.6, dashes=(1, 2), zorder=1)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(loc="lower right", bbox_to_anchor=(1.0, 0.98), ncols=len(lines), borderpad=0.2)
    _name_events(panels[0], run)
    panels[-1].set_xlabel("time, s")
    figure.suptitle(f"{run.summary.get('script', '')}: as replayed", x=0.01, ha="left", fontsize=11)
    return figure


def _drawn(history: History, column: str) -> np.ndarray:
    """The finite values of a column; incidence only where there is enough wind to have one."""
    shown = np.isfinite(history[column])
    if column == "alpha":
        shown &= history["tas"] > BREEZE
    return np.where(shown, history[column], np.nan)


def _name_events(axes: Axes, run: Run) -> None:
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + 0.25 * (high - low))
    for number, event in enumerate(run.events[:20]):
        axes.annotate(
            event.name[:40],
            (event.time, 0.98 - 0.07 * (number % 3)),
            (3, 0),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            va="top",
            fontsize=7.0,
            color="#555555",
        )


def ground_track(run: Run) -> Figure:
    """Draw the track over ground, metres from the start."""
    east, north = _offsets(run.history)
    figure = Figure(figsize=(7.0, 7.0), layout="constrained")
    axes = figure.subplots()
    span = max(np.ptp(east), np.ptp(north))
    unit, name = (1000.0, "km") if span > 20_000 else (1.0, "m")
    style: dict[str, Any] = {"markersize": 6, "linestyle": "none"}
    axes.plot(east / unit, north / unit, color=BLUE)
    axes.plot(east[0] / unit, north[0] / unit, "o", color=GREEN, label="start", **style)
    axes.plot(east[-1] / unit, north[-1] / unit, "s", color=ORANGE, label="end", **style)
    axes.set(xlabel=f"east, {name}", ylabel=f"north, {name}")
    half = max(span / unit * 0.55, 1.0)
    for setter, column in ((axes.set_xlim, east), (axes.set_ylim, north)):
        middle = float(np.max(column) + np.min(column)) / 2 / unit
        setter(middle - half, middle + half)
    axes.set_aspect("equal")
    axes.legend(frameon=False)
    plain_grid(axes)
    axes.set_title(f"{run.summary.get('script', '')}: ground track", loc="left")
    return figure


def _offsets(history: History) -> tuple[np.ndarray, np.ndarray]:
    known = np.isfinite(history["latitude"] + history["longitude"])
    track = zip(history["latitude"][known].tolist(), history["longitude"][known].tolist(), strict=True)
    frame = LocalFrame(float(history["latitude"][0]), float(history["longitude"][0]))
    points = [frame.point(latitude, longitude) for latitude, longitude in track]
    north, east = np.array(points).T[:2]
    return east, north
