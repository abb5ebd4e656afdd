"""Chart symbols of radio aids, after the ones of ICAO Annex 4 as far as they can be told apart when small."""

from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from harness.navigation.database import Station
from harness.units import DEG

SYMBOLS: dict[str, tuple[tuple[str, float], ...]] = {
    "VOR": (("h", 9.0),),
    "VOR-DME": (("s", 11.5), ("h", 9.0)),
    "VORTAC": (("h", 10.5), ("1", 10.5)),
    "TACAN": (("^", 9.0),),
    "DME": (("s", 8.0),),
    "NDB": (("o", 9.0),),
    "NDB-DME": (("s", 11.0), ("o", 9.0)),
}
"""Markers and sizes (points) laid over each other for each kind of station; a dot in the middle is added."""


def symbol(kind: str, colour: str, scale: float) -> tuple[Line2D, ...]:
    """Return the marks of a kind of station, to be laid over each other."""
    return tuple(
        Line2D(
            [],
            [],
            linestyle="none",
            marker=marker,
            markersize=scale * size,
            markerfacecolor=colour if marker == "." else "white",
            markeredgecolor=colour,
        )
        for marker, size in (*SYMBOLS[kind], (".", 3.0))
    )


def draw_station(axes: Axes, station: Station, colour: str, scale: float, zorder: float) -> None:
    """Draw a station on axes of degrees longitude and latitude."""
    for mark in symbol(station.kind, colour, scale):
        mark.set_data([station.longitude / DEG], [station.latitude / DEG])
        mark.set_zorder(zorder)
        axes.add_line(mark)
