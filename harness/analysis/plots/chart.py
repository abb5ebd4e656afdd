"""The route as planned and the track as flown, on a plain north-up map (AIAA 2010-7777, Fig. 12)."""

from math import atan2, cos, hypot, sin, tau
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke

from harness.analysis.plots.look import FAINT, INK, PHASES, phase_colour, phase_group
from harness.analysis.spans import spans
from harness.log import Run
from harness.mission.model import Leg, Mission
from harness.navigation import database
from harness.navigation.database import Runway
from harness.numerics import wrap
from harness.units import DEG, KM, NM

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

WIDTH = 10.5  # inches
LEGEND_WIDTH = 2.9  # with the axis labels, inches
HEIGHTS = (5.0, 11.0)  # inches
PLANNED = {"color": "#666666", "linewidth": 0.9, "dashes": (5, 3)}
SMALLEST_VIEW = 12 * KM
HALO = [withStroke(linewidth=2.2, foreground="white")]
LABEL_GAP = 11.0  # points from a waypoint to its label


Point = tuple[float, float]  # on the map: east, north


class View(NamedTuple):
    """The map's edges in degrees, and its stretch: how much longer a degree of latitude is than one of longitude."""

    west: float
    east: float
    south: float
    north: float
    stretch: float

    def holds(self, latitude: float, longitude: float) -> bool:
        """Whether a point (rad) is on the map."""
        return self.west < longitude / DEG < self.east and self.south < latitude / DEG < self.north


def route_map(run: Run, mission: Mission) -> Figure:
    """Draw the stations, the planned legs, the runways and the track coloured by phase."""
    navigation = database.load()
    departure = navigation.runway(mission.departure.airport, mission.departure.runway)
    arrival = navigation.runway(mission.arrival.airport, mission.arrival.runway)
    view = _view(run, mission, (departure, arrival))
    high = (WIDTH - LEGEND_WIDTH) * (view.north - view.south) * view.stretch / (view.east - view.west)
    figure = Figure(figsize=(WIDTH, min(max(high + 0.9, HEIGHTS[0]), HEIGHTS[1])), layout="constrained")
    axes = figure.add_subplot()
    axes.set(xlim=(view.west, view.east), ylim=(view.south, view.north), aspect=view.stretch)
    axes.set(xlabel="longitude, deg east", ylabel="latitude, deg north")
    axes.set_title(f"{mission.name}: planned route and flown track", loc="left")
    for airport in dict.fromkeys((departure.airport, arrival.airport)):
        _runways(axes, view, navigation.runways(airport))
    kinds = _stations(axes, view, mission)
    _planned(axes, mission, departure, arrival)
    groups = _flown(axes, run)
    _waypoints(axes, mission, departure, arrival)
    _scale(axes, view)
    _legend(axes, groups, kinds)
    return figure


def _view(run: Run, mission: Mission, runways: tuple[Runway, ...]) -> View:
    latitudes = [*run.history["latitude"], *(leg.fix.latitude for leg in mission.legs)]
    longitudes = [*run.history["longitude"], *(leg.fix.longitude for leg in mission.legs)]
    for runway in runways:
        latitudes += [runway.latitude, runway.end_latitude]
        longitudes += [runway.longitude, runway.end_longitude]
    south, north = min(latitudes) / DEG, max(latitudes) / DEG
    west, east = min(longitudes) / DEG, max(longitudes) / DEG
    stretch = 1.0 / cos((south + north) / 2 * DEG)
    smallest = SMALLEST_VIEW / (60 * NM)
    grow_high = max(0.07 * (north - south), (smallest - (north - south)) / 2)
    grow_wide = max(0.06 * (east - west), (smallest * stretch - (east - west)) / 2)
    high, wide = north - south + 2 * grow_high, (east - west + 2 * grow_wide) / stretch
    # A route in one line would give a strip with no room for its labels.
    grow_high += max(0.0, 0.45 * wide - high) / 2
    grow_wide += max(0.0, 0.9 * high - wide) / 2 * stretch
    return View(west - grow_wide, east + grow_wide, south - grow_high, north + grow_high, stretch)


def _runways(axes: Axes, view: View, runways: tuple[Runway, ...]) -> None:
    for runway in runways:
        axes.plot(
            [runway.longitude / DEG, runway.end_longitude / DEG],
            [runway.latitude / DEG, runway.end_latitude / DEG],
            color="#444444",
            linewidth=3.2,
            solid_capstyle="butt",
            zorder=2,
        )
    southmost = min(runways, key=lambda runway: runway.latitude)
    if view.holds(southmost.latitude, southmost.longitude):
        axes.annotate(
            southmost.airport,
            (np.mean([r.longitude for r in runways]) / DEG, southmost.latitude / DEG),
            (0, -7),
            textcoords="offset points",
            ha="center",
            va="top",
            weight="bold",
            path_effects=HALO,
            zorder=8,
        )


def _stations(axes: Axes, view: View, mission: Mission) -> list[str]:
    """Draw the stations of the route in ink and the others in view faintly; return the kinds of the former."""
    used = {leg.fix.station.ident: leg.fix.station for leg in mission.legs if leg.fix.station}
    for station in database.load().stations():
        if view.holds(station.latitude, station.longitude) and station.ident not in used:
            _symbol(axes, station.kind, station.longitude / DEG, station.latitude / DEG, FAINT, 0.55)
    for station in used.values():
        _symbol(axes, station.kind, station.longitude / DEG, station.latitude / DEG, INK, 1.0)
    return [kind for kind in SYMBOLS if any(station.kind == kind for station in used.values())]


def _symbol(axes: Axes, kind: str, x: float, y: float, colour: str, scale: float) -> None:
    for line in _marks(kind, colour, scale):
        line.set_data([x], [y])
        line.set_zorder(6 if colour == INK else 1)
        axes.add_line(line)


def _marks(kind: str, colour: str, scale: float) -> tuple[Line2D, ...]:
    return tuple(
        Line2D(
            [],
            [],
            linestyle="none",
            marker=marker,
            markersize=scale * size,
            markerfacecolor="white" if marker != "." else colour,
            markeredgecolor=colour,
        )
        for marker, size in (*SYMBOLS[kind], (".", 3.0))
    )


def _planned(axes: Axes, mission: Mission, departure: Runway, arrival: Runway) -> None:
    """Draw the legs between the fixes, with the magnetic course of those that have one."""
    points = [
        (departure.end_longitude / DEG, departure.end_latitude / DEG),
        *((leg.fix.longitude / DEG, leg.fix.latitude / DEG) for leg in mission.legs),
        (arrival.longitude / DEG, arrival.latitude / DEG),
    ]
    axes.plot(*zip(*points, strict=True), zorder=3, **PLANNED)
    names = [(0.0, 0.0), *(_outward(*three) for three in zip(points, points[1:], points[2:], strict=False))]
    for leg, start, end, name, next_name in zip(
        mission.legs, points, points[1:], names, names[1:], strict=False
    ):
        if leg.course_true is not None:
            _course(axes, leg, start, end, (name[0] + next_name[0], name[1] + next_name[1]))


def _course(axes: Axes, leg: Leg, start: Point, end: Point, clear_of: Point) -> None:
    """Write a leg's course along its middle, on the side away from `clear_of`."""
    station = leg.fix.station
    course = (leg.course_true or 0.0) - (station.declination if station else 0.0)
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    stretch = 1.0 / cos(middle[1] * DEG)
    slant = atan2((end[1] - start[1]) * stretch, end[0] - start[0])
    upright = wrap(2 * slant) / 2  # the same line, read from left to right
    normal = (-sin(upright), cos(upright))
    above = normal[0] * clear_of[0] + normal[1] * clear_of[1] < 0.2
    gap = 5.0 if above else -5.0
    axes.annotate(
        f"{round(course % tau / DEG) % 360:03d}°{'' if station else ' true'}",
        middle,
        (gap * normal[0], gap * normal[1]),
        textcoords="offset points",
        rotation=upright / DEG,
        rotation_mode="anchor",
        ha="center",
        va="bottom" if above else "top",
        fontsize=8,
        path_effects=HALO,
        zorder=7,
    )


def _flown(axes: Axes, run: Run) -> list[str]:
    """Draw the track; return the phase groups in it, in the order of a flight."""
    history = run.history
    longitudes, latitudes = history["longitude"] / DEG, history["latitude"] / DEG
    groups = [phase_group(phase) for phase in history["phase"].tolist()]
    for span in spans(history["time"], groups):
        rows = slice(span.first, span.last + 1)
        axes.plot(
            longitudes[rows],
            latitudes[rows],
            color=phase_colour(span.word),
            linewidth=2.0,
            solid_capstyle="round",
            zorder=4,
        )
    return [group for group in PHASES if group in groups]


def _waypoints(axes: Axes, mission: Mission, departure: Runway, arrival: Runway) -> None:
    """Name each waypoint on the outer side of the turn made there, where there is neither leg nor track."""
    path = [
        (departure.longitude / DEG, departure.latitude / DEG),
        *((leg.fix.longitude / DEG, leg.fix.latitude / DEG) for leg in mission.legs),
        (arrival.longitude / DEG, arrival.latitude / DEG),
    ]
    for before, here, after, leg in zip(path, path[1:], path[2:], mission.legs, strict=False):
        away = _outward(before, here, after)
        if leg.fix.station is None or leg.fix.distance is not None:
            axes.plot(*here, "+", color=INK, markersize=7, zorder=6)
        axes.annotate(
            _waypoint_name(leg),
            here,
            (away[0] * LABEL_GAP, away[1] * LABEL_GAP),
            textcoords="offset points",
            ha="left" if away[0] > 0.35 else "right" if away[0] < -0.35 else "center",
            va="bottom" if away[1] > 0.35 else "top" if away[1] < -0.35 else "center",
            fontsize=8,
            linespacing=1.05,
            path_effects=HALO,
            zorder=8,
        )


def _waypoint_name(leg: Leg) -> str:
    station, distance = leg.fix.station, leg.fix.distance
    if station is None:
        return leg.name
    if distance is None:
        return f"{leg.name}\n{station.ident}"
    return f"{leg.name}\n{station.ident} {distance / NM:.0f} NM"


def _outward(before: Point, here: Point, after: Point) -> Point:
    """Return the unit vector on the map away from both neighbours; left of the leg where it does not turn."""
    stretch = 1.0 / cos(here[1] * DEG)
    one = _unit(here[0] - before[0], (here[1] - before[1]) * stretch)
    two = _unit(here[0] - after[0], (here[1] - after[1]) * stretch)
    x, y = one[0] + two[0], one[1] + two[1]
    return _unit(x, y) if hypot(x, y) > 0.2 else (-one[1], one[0])


def _unit(x: float, y: float) -> Point:
    length = hypot(x, y)
    return (x / length, y / length) if length else (0.0, 0.0)


def _scale(axes: Axes, view: View) -> None:
    """Draw a bar of kilometres over one of nautical miles in the south-west corner, and north above it."""
    across = (view.east - view.west) / view.stretch * 60 * NM
    x0, y0 = 0.03, 0.035
    for unit, name, y in ((KM, "km", y0 + 0.022), (NM, "NM", y0)):
        count = next(c for c in (200, 100, 50, 20, 10, 5, 2, 1) if c * unit < 0.25 * across or c == 1)
        x1 = x0 + count * unit / across
        axes.plot(
            [x0, x1],
            [y, y],
            transform=axes.transAxes,
            color=INK,
            linewidth=2.5,
            solid_capstyle="butt",
            zorder=9,
        )
        axes.text(
            x1 + 0.008,
            y,
            f"{count} {name}",
            transform=axes.transAxes,
            va="center",
            fontsize=8,
            path_effects=HALO,
            zorder=9,
        )
    axes.annotate(
        "N",
        (x0 + 0.008, y0 + 0.115),
        (x0 + 0.008, y0 + 0.045),
        xycoords="axes fraction",
        ha="center",
        weight="bold",
        arrowprops={"arrowstyle": "-|>", "color": INK},
        zorder=9,
    )


def _legend(axes: Axes, groups: list[str], kinds: list[str]) -> None:
    lines: list[Line2D | tuple[Line2D, ...]] = [
        Line2D([], [], color=phase_colour(g), linewidth=2.5) for g in groups
    ]
    names = [f"{group}  {PHASES[group][0]}" for group in groups]
    lines += [
        Line2D([], [], **PLANNED),
        *(_marks(kind, INK, 0.85) for kind in kinds),
        *_marks("NDB", FAINT, 0.55)[:1],
    ]
    names += ["planned, magnetic course", *kinds, "other stations"]
    axes.legend(
        lines,
        names,
        loc="center left",
        bbox_to_anchor=(1.0, 0.5),
        borderaxespad=0.6,
        handler_map={tuple: HandlerTuple(ndivide=1)},
    )
