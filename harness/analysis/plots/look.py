"""What all pictures share: type, colours of the phases, and how a file is written."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke

DPI = 150
INK = "#222222"
FAINT = "#b8b8b8"
HALO = [withStroke(linewidth=2.2, foreground="white")]

RC: dict[str, object] = {
    "font.size": 9.0,
    "axes.titlesize": 11.0,
    "axes.labelsize": 9.0,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#555555",
    "text.color": INK,
    "axes.labelcolor": INK,
    "legend.frameon": False,
    "legend.fontsize": 8.0,
    "lines.linewidth": 1.3,
    "svg.hashsalt": "harness",
}

# Told apart by most colour-blind readers. Source: M. Okabe and K. Ito, Color universal design (2008); more
# colours were added.
PHASES: dict[str, tuple[str, str]] = {
    "TXY": ("taxi", "#8c8c8c"),
    "T/O": ("take-off", "#d55e00"),
    "DEP": ("departure", "#e69f00"),
    "CLB": ("climb", "#009e73"),
    "CRS": ("cruise", "#0072b2"),
    "DES": ("descent", "#7b52ab"),
    "APP": ("approach", "#cc79a7"),
    "LDG": ("landing", "#a50f15"),
    "M/A": ("missed approach", "#ff2fd0"),
    "RTO": ("rejected take-off", "#000000"),
    "END": ("end", "#555555"),
}


def phase_group(phase: str) -> str:
    """Return the name a phase is drawn under: `T/O.run` is T/O, `ENR.CLB` is CLB."""
    group, _, sub = phase.partition(".")
    return sub if group == "ENR" else group


def phase_colour(group: str) -> str:
    """Return the colour of a phase group; a phase we do not know is drawn in ink."""
    return PHASES.get(group, ("", INK))[1]


def plain_grid(axes: Axes) -> None:
    """Give axes a faint grid behind everything."""
    axes.grid(visible=True, color="#e3e3e3", linewidth=0.6)
    axes.set_axisbelow(True)


def save(figure: Figure, path: Path) -> None:
    """Write a figure as PNG, without the program's version in it."""
    figure.savefig(path, dpi=DPI, metadata={"Software": None})
