"""Panels one below the other, as one SVG text without anything that changes from run to run."""

from collections.abc import Sequence
from io import StringIO

from matplotlib import style
from matplotlib.figure import Figure

from harness.analysis.panel import Panel
from harness.analysis.plots.look import RC, plain_grid

WIDTH = 6.4  # inch
HEIGHT = 2.1  # inch a panel
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#7b52ab", "#555555")


def panels_svg(panels: Sequence[Panel]) -> str:
    """Draw the panels below each other; those with the same x label share it."""
    with style.context(["default", RC, {"svg.fonttype": "none"}]):
        figure = Figure(figsize=(WIDTH, HEIGHT * len(panels) + 0.3), layout="constrained")
        shared = len({panel.x for panel in panels}) == 1
        every = figure.subplots(len(panels), 1, sharex=shared, squeeze=False)[:, 0]
        for axes, panel in zip(every, panels, strict=True):
            plain_grid(axes)
            for curve, colour in zip(panel.curves, COLOURS * 2, strict=False):
                line = {"marker": curve.marker, "linestyle": "none"} if curve.marker else {}
                axes.plot(curve.x, curve.y, color=colour, label=curve.label, **line)
            for label, value in panel.marks:
                axes.axhline(value, color="#a50f15", linewidth=0.9, linestyle="--", label=label)
            axes.set_ylabel(panel.y)
            if not shared or axes is every[-1]:
                axes.set_xlabel(panel.x)
            if len(panel.curves) + len(panel.marks) > 1:
                axes.legend(loc="best")
        text = StringIO()
        figure.savefig(text, format="svg", metadata={"Date": None, "Creator": None})
    return text.getvalue()[text.getvalue().index("<svg") :]
