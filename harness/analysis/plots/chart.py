"""The route as planned and the track as flown, on a plain north-up map (AIAA 2010-7777, Fig. 12)."""

from collections.abc import Sequence
from math import atan2, cos, hypot, sin, tau
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend_handler import HandlerTuple
from matplotlib.lines import Line2D

from harness.analysis.plots.labels import FONT, GAP, Box, alignment, box_of, directions, outward
from harness.analysis.plots.look import FAINT, HALO, INK, PHASES, phase_colour, phase_group
from harness.analysis.plots.symbols import SYMBOLS, draw_station, symbol
from harness.analysis.plots.view import Point, View, draw_scale, view_of
from harness.analysis.spans import spans
from harness.log import Run
from harness.mission.model import Leg, Mission
from harness.navigation import database
from harness.navigation.database import Runway
from harness.numerics import wrap
from harness.units import DEG, NM

MAP_WIDTH = 9.0  # inches
LEFT, RIGHT, BELOW, ABOVE = 0.75, 2.5, 0.55, 0.35  # around the map: axis labels, legend and title; inches
SHORT_LEG = 40.0  # points; the course of a shorter leg is written level beside it
COURSE_GAP = 5.0  # from the leg to its course, points
PLANNED: dict[str, Any] = {"color": "#666666", "linewidth": 0.9, "dashes": (5, 3)}


def route_map(run: Run, mission: Mission) -> Figure:
    """Draw the stations, the planned legs, the runways and the track coloured by phase."""
    navigation = database.load()
    departure = navigation.runway(mission.departure.airport, mission.departure.runway)
    arrival = navigation.runway(mission.arrival.airport, mission.arrival.runway)
    airports = {name: navigation.runways(name) for name in (departure.airport, arrival.airport)}
    route = [
        (departure.end_longitude / DEG, departure.end_latitude / DEG),
        *((leg.fix.longitude / DEG, leg.fix.latitude / DEG) for leg in mission.legs),
        (arrival.longitude / DEG, arrival.latitude / DEG),
    ]
    track = list(zip(run.history["longitude"] / DEG, run.history["latitude"] / DEG, strict=True))
    view = view_of([*route, *track, (departure.longitude / DEG, departure.latitude / DEG)])

    map_height = MAP_WIDTH * view.steepness
    wide, high = LEFT + MAP_WIDTH + RIGHT, BELOW + map_height + ABOVE
    figure = Figure(figsize=(wide, high))
    axes = figure.add_axes((LEFT / wide, BELOW / high, MAP_WIDTH / wide, map_height / high))
    axes.set(xlim=(view.west, view.east), ylim=(view.south, view.north), aspect=view.stretch)
    axes.set(xlabel="longitude, deg east", ylabel="latitude, deg north")
    axes.set_title(f"{mission.name}: planned route and flown track", loc="left")
    names = [_airport(axes, view, name, runways) for name, runways in airports.items()]
    kinds = _stations(axes, view, mission)
    axes.plot(*zip(*route, strict=True), zorder=3, **PLANNED)
    groups = _flown(axes, run)
    _names(axes, view, mission.legs, route, names)
    _legend(axes, groups, kinds)
    draw_scale(figure, view, MAP_WIDTH, (wide - RIGHT + 0.3, BELOW + 0.05))
    return figure


def _airport(axes: Axes, view: View, name: str, runways: tuple[Runway, ...]) -> Box:
    """Draw the runways of an airport and its name; return the place the name takes."""
    for runway in runways:
        axes.plot(
            [runway.longitude / DEG, runway.end_longitude / DEG],
            [runway.latitude / DEG, runway.end_latitude / DEG],
            color="#444444",
            linewidth=3.2,
            solid_capstyle="butt",
            zorder=2,
        )
    middle = float(np.mean([runway.longitude for runway in runways])) / DEG
    under = (middle, min(runway.latitude for runway in runways) / DEG)
    axes.annotate(
        name,
        under,
        (0, -GAP),
        textcoords="offset points",
        ha="center",
        va="top",
        weight="bold",
        path_effects=HALO,
        zorder=8,
    )
    x, y = view.on_paper(under, MAP_WIDTH * 72)
    return box_of(f" {name} ", (x, y - GAP), "center", "top")


def _stations(axes: Axes, view: View, mission: Mission) -> list[str]:
    """Draw the stations of the route in ink and others in view faintly; return the kinds of the former."""
    used = [leg.fix.station for leg in mission.legs if leg.fix.station]
    for station in database.load().stations():
        if view.holds(station.latitude, station.longitude) and station not in used:
            draw_station(axes, station, FAINT, 0.55, zorder=1)
    for station in used:
        draw_station(axes, station, INK, 1.0, zorder=6)
    return [kind for kind in SYMBOLS if any(station.kind == kind for station in used)]


def _flown(axes: Axes, run: Run) -> list[str]:
    """Draw the track; return the phase groups in it, in the order of a flight."""
    history = run.history
    groups = [phase_group(phase) for phase in history["phase"].tolist()]
    for span in spans(history["time"], groups):
        rows = slice(span.first, span.last + 1)
        axes.plot(
            history["longitude"][rows] / DEG,
            history["latitude"][rows] / DEG,
            color=phase_colour(span.word),
            linewidth=2.0,
            solid_capstyle="round",
            zorder=4,
        )
    return [group for group in PHASES if group in groups]


def _names(axes: Axes, view: View, legs: Sequence[Leg], route: Sequence[Point], taken: Sequence[Box]) -> None:
    """Name the waypoints on the outer side of the turn there, and the courses of the legs on the other."""
    width = MAP_WIDTH * 72
    points = [view.on_paper(point, width) for point in route]
    outer = [(0.0, 0.0), *(outward(*three) for three in zip(points, points[1:], points[2:], strict=False))]
    boxes = [*taken]
    for number, leg in enumerate(legs):
        if leg.course_true is not None:
            busy = (outer[number][0] + outer[number + 1][0], outer[number][1] + outer[number + 1][1])
            middle = np.mean(route[number : number + 2], axis=0)
            boxes.append(_course(axes, leg, (middle[0], middle[1]), points[number : number + 2], busy))
    names = [_waypoint_name(leg) for leg in legs]
    away = directions(points, names, Box(0, 0, width, width * view.steepness), boxes)
    for leg, here, name, direction in zip(legs, route[1:], names, away, strict=False):
        if leg.fix.station is None or leg.fix.distance is not None:
            axes.plot(*here, "+", color=INK, markersize=7, zorder=6)
        horizontal, vertical = alignment(direction)
        axes.annotate(
            name,
            here,
            (direction[0] * GAP, direction[1] * GAP),
            textcoords="offset points",
            ha=horizontal,
            va=vertical,
            fontsize=FONT,
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


def _course(axes: Axes, leg: Leg, middle: Point, ends: Sequence[Point], busy: Point) -> Box:
    """Write the course of a leg along it, on the side away from `busy`; return the place it takes."""
    station = leg.fix.station
    course = (leg.course_true or 0.0) - (station.declination if station else 0.0)
    (x0, y0), (x1, y1) = ends
    slant = wrap(2 * atan2(y1 - y0, x1 - x0)) / 2  # the direction of the line, read from left to right
    side = 1.0 if cos(slant) * busy[1] - sin(slant) * busy[0] < 0.2 else -1.0
    away = (-side * sin(slant), side * cos(slant))
    place: dict[str, Any] = {"ha": "left" if away[0] > 0 else "right", "va": "center"}
    if hypot(x1 - x0, y1 - y0) > SHORT_LEG:
        place = {"ha": "center", "va": "bottom" if side > 0 else "top"}
        place |= {"rotation": slant / DEG, "rotation_mode": "anchor"}
    text = f"{round(course % tau / DEG) % 360:03d}°{'' if station else ' true'}"
    axes.annotate(
        text,
        middle,
        (COURSE_GAP * away[0], COURSE_GAP * away[1]),
        textcoords="offset points",
        fontsize=FONT,
        path_effects=HALO,
        zorder=7,
        **place,
    )
    anchor = ((x0 + x1) / 2 + COURSE_GAP * away[0], (y0 + y1) / 2 + COURSE_GAP * away[1])
    return box_of(text, anchor, place["ha"], place["va"])


def _legend(axes: Axes, groups: list[str], kinds: list[str]) -> None:
    """Explain the colours and the symbols beside the map."""
    explained: list[tuple[str, tuple[Line2D, ...]]] = [
        *(
            (f"{group}  {PHASES[group][0]}", (Line2D([], [], color=phase_colour(group), linewidth=2.5),))
            for group in groups
        ),
        ("planned, magnetic courses", (Line2D([], [], **PLANNED),)),
        *((kind, symbol(kind, INK, 0.85)) for kind in kinds),
        ("other stations", symbol("NDB", FAINT, 0.55)[:1]),
    ]
    names, marks = zip(*explained, strict=True)
    axes.legend(
        marks,
        names,
        loc="upper left",
        bbox_to_anchor=(1.02, 1.0),
        borderaxespad=0,
        handler_map={tuple: HandlerTuple(ndivide=1)},
    )
