"""Height over distance of take-offs, as Fig. 14 of the paper."""

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl
from matplotlib import style
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from harness.analysis.plots.look import FAINT, HALO, INK, RC, plain_grid, save

LOWEST = -1.0  # m


class Curve(NamedTuple):
    """One take-off: distance and height of every step (m), where the wheels left the ground, and how it is drawn."""

    label: str
    along: Sequence[float]
    height: Sequence[float]
    liftoff: float
    dashed: bool = False


class Screen(NamedTuple):
    """A screen height, m, and what it is called."""

    height: float
    label: str


class Point(NamedTuple):
    """A published distance to a height, m."""

    along: float
    height: float
    label: str


def take_offs(
    curves: Sequence[Curve], screens: Sequence[Screen], points: Sequence[Point], title: str, path: Path
) -> None:
    """Draw the curves into a PNG: solid ones in the order of a colour scale, dashed ones in grey beside them."""
    with style.context(["default", RC]):
        figure = Figure(figsize=(9.0, 4.8), layout="constrained")
        FigureCanvasAgg(figure)
        axes = figure.add_subplot()
        plain_grid(axes)
        solid = [curve for curve in curves if not curve.dashed]
        colours = mpl.colormaps["viridis"]
        shade = {curve.label: colours(0.9 * i / max(len(solid) - 1, 1)) for i, curve in enumerate(solid)}
        for curve in curves:
            colour = shade.get(curve.label, "#8c8c8c")
            axes.plot(
                curve.along,
                curve.height,
                color=colour,
                linestyle="--" if curve.dashed else "-",
                label=curve.label,
            )
            axes.annotate(
                "" if curve.dashed else curve.label,
                (curve.along[-1], curve.height[-1]),
                xytext=(2, 3),
                textcoords="offset points",
                ha="center",
                fontsize=8,
                color=colour,
                path_effects=HALO,
            )
            axes.plot(
                curve.liftoff,
                0.0,
                marker="^",
                markersize=7,
                color=colour,
                markeredgecolor="white",
                linestyle="none",
            )
        for screen in screens:
            axes.axhline(screen.height, color=FAINT, linewidth=0.9, zorder=1)
            axes.annotate(
                screen.label,
                (0.005, screen.height),
                xycoords=("axes fraction", "data"),
                xytext=(0, 3),
                textcoords="offset points",
                color="#555555",
                fontsize=8,
            )
        for point in points:
            axes.plot(
                point.along,
                point.height,
                marker="o",
                markersize=8,
                markerfacecolor="none",
                markeredgecolor=INK,
                markeredgewidth=1.4,
                linestyle="none",
                zorder=5,
            )
            axes.annotate(
                point.label,
                (point.along, point.height),
                xytext=(-9, -4),
                textcoords="offset points",
                ha="right",
                fontsize=8,
                path_effects=HALO,
            )
        top = max([screen.height for screen in screens] + [point.height for point in points])
        axes.set_ylim(LOWEST, top * 1.16)
        axes.set_xlim(0.0, 1.04 * max(curve.along[-1] for curve in curves))
        axes.set_xlabel("distance from brake release, m")
        axes.set_ylabel("height of the main wheels, m")
        axes.set_title(title, loc="left")
        axes.plot(
            [],
            [],
            marker="^",
            markersize=7,
            color="#555555",
            linestyle="none",
            label="main wheels leave the ground",
        )
        if points:
            axes.plot(
                [],
                [],
                marker="o",
                markersize=8,
                markerfacecolor="none",
                markeredgecolor=INK,
                linestyle="none",
                label="published, AIAA 2010-7777",
            )
        axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.86), ncols=1)
        save(figure, path)
