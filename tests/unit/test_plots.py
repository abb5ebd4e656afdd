"""The pictures of a flight, drawn from a made-up one: complete, deterministic, nothing outside the paper."""

from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from matplotlib import style

from harness.analysis import plots
from harness.analysis.plots.annunciator import fitting, joined
from harness.analysis.plots.look import RC, save
from harness.analysis.plots.timeline import spread
from harness.analysis.spans import Span, spans
from harness.log import Passage, Run
from harness.mission.model import Arrival, Departure, Environment, Fix, Leg, Loading, Mission
from harness.navigation import database
from harness.units import DEG, FT, KT, NM, Level, Speed
from harness.world import airspeed, atmosphere, earth

NAV = database.load()
STEP = 0.5
ROUTE = [  # station, course, distance, level, speed: the reconstructed mission of the paper
    ("COL", None, None, 5000, 253),
    ("RID", 148, None, 23000, 170),
    ("RID", 124, 45, 23000, 170),
    ("NSN", None, None, 15000, 262),
    ("ILM", None, None, 5000, 253),
    ("ANS", None, None, 5000, 253),
    ("RTB", None, None, 5000, 243),
    ("ALB", None, None, 5000, 243),
    ("WLD", 185, None, 12000, 243),
    ("MBG", 89, None, 12000, 243),
    ("MBG", 202, 8, 12000, 223),
    ("MDF", None, None, 12000, 214),
]


def a_mission():
    legs = []
    for number, (ident, course, distance, level, speed) in enumerate(ROUTE, 1):
        station = NAV.station(ident)
        true = None if course is None else course * DEG + station.declination
        position = (station.latitude, station.longitude)
        if distance is not None:
            position = earth.direct(*position, true, distance * NM)
        fix = Fix(*position, station, None if distance is None else distance * NM)
        mode = "homing" if course is None else "tracking"
        levels = Level("FL", level * FT)
        legs.append(
            Leg(f"WP{number}", fix, mode, true, Speed("CAS", speed * KT), levels, "fly-over", (), number)
        )
    return Mission(
        name="cologne-munich",
        description="",
        aircraft="gta",
        speeds={},
        loading=Loading(100e3, None, 12e3),
        environment=Environment(),
        departure=Departure("EDDK", "13L", None, ()),
        legs=tuple(legs),
        arrival=Arrival("EDDM", "26L", (), None),
        phases={},
        source_path=Path("cologne-munich.xml"),
        text="",
    )


def a_run(mission):
    """A point that flies from fix to fix at the legs' speeds: no flight mechanics, but the shape of a log."""
    departure, arrival = NAV.runway("EDDK", "13L"), NAV.runway("EDDM", "26L")
    rows, passages = [], []
    here, altitude, cas, time, fuel = (departure.latitude, departure.longitude), 300 * FT, 0.0, 0.0, 12e3
    target, goal, wanted = np.nan, np.nan, np.nan

    def fly(phase, to, modes, throttle, seconds=None):
        nonlocal here, altitude, cas, time, fuel
        begin = time
        while True:
            azimuth, _, distance = earth.inverse(*here, *to)
            if (seconds is not None and time - begin >= seconds) or distance < max(cas, 1) * STEP:
                return
            cas += np.clip(goal - cas, -1.0 * STEP, 2.0 * STEP)
            climb = np.clip((wanted - altitude) / 8, -8, 9) if cas > 60 else 0.0
            altitude += climb * STEP
            tas = airspeed.tas_from_cas(cas, atmosphere.pressure(altitude), atmosphere.temperature(altitude))
            here = earth.direct(*here, azimuth, tas * STEP)
            fuel -= 0.7 * STEP
            time += STEP
            name = phase
            if phase == "ENR":
                away = wanted - altitude
                name = "ENR.CLB" if away > 100 * FT else "ENR.DES" if away < -100 * FT else "ENR.CRS"
            rows.append(
                (time, *here, altitude, cas, tas, azimuth, climb, fuel, name, throttle, target, goal, modes)
            )

    ground = ("DIRECT thrust", "PILOT", "OFF", "NAV runway", "ATT")
    climbing = ("CONTROLLER", "AIRCRAFT", "PITCH leg-speed", "NAV route", "PATH by-speed")
    cruising = ("CONTROLLER", "AIRCRAFT", "THR leg-speed", "NAV route", "NAV level")
    goal, wanted = 8.0, altitude
    fly("TXY.out", departure.point(300), ground, 0.2, 30)
    goal = 66.0
    fly("T/O.run", departure.point(2500), ground, 1.0, 32)
    lift_off, wanted, goal = time, 5000 * FT, 90.0
    fly("T/O.rotation", departure.point(9000), ground, 1.0, 3)
    fly("T/O.lift-off", departure.point(9000), ("DIRECT thrust", "PILOT", "OFF", "NAV runway", "ATT"), 1.0, 5)
    fly("T/O.transition", departure.point(9000), climbing, 1.0, 12)
    fly("DEP", departure.point(12000), climbing, 0.9, 60)
    for leg in mission.legs:
        goal, wanted, target = leg.speed.value, leg.level.altitude, leg.level.altitude
        modes = climbing if wanted > altitude + 100 else cruising
        fly("ENR", (leg.fix.latitude, leg.fix.longitude), modes, 0.62, None)
        passages.append(
            Passage(
                leg.name, time, *here, altitude, altitude, cas, cas, 0.4, time * 130, 12e3 - fuel, 9e4, 100.0
            )
        )
    approach = ("CONTROLLER", "AIRCRAFT", "THR VREF", "NAV localizer", "NAV glide-slope")
    goal, wanted, target = 80.0, 5000 * FT, 5000 * FT
    fly("APP.intermediate", arrival.point(-12 * NM), cruising, 0.4)
    goal, wanted, target = 65.0, 1500 * FT, np.nan
    fly("APP.final", arrival.point(0), approach, 0.45)
    fly("LDG.flare", arrival.point(400), ("CONTROLLER", "PILOT", "OFF", "NAV align", "PATH flare"), 0.0)
    touchdown, goal = time, 10.0
    fly("LDG.roll-out", arrival.point(1500), ground, -0.5)
    fly("TXY.in", arrival.point(2500), ground, 0.15, 90)

    columns = list(zip(*rows, strict=True))
    history = {
        name: np.array(column, dtype=float)
        for name, column in zip(
            ("time", "latitude", "longitude", "altitude", "cas", "tas", "heading", "vertical_speed", "fuel"),
            columns[:9],
            strict=True,
        )
    }
    seconds = history["time"]
    history |= {
        "pressure_altitude": history["altitude"],
        "mach": history["tas"] / 320,
        "pitch": 0.03 + history["vertical_speed"] / 120,
        "roll": np.clip(np.gradient(np.unwrap(history["heading"])) * 4, -0.5, 0.5),
        "fuel_flow": 0.4 + 0.9 * np.array(columns[10], dtype=float).clip(0),
        "thrust": 220e3 * np.array(columns[10], dtype=float),
        "command_throttle": np.array(columns[10], dtype=float),
        "target_level_error": np.array(columns[11], dtype=float) - history["altitude"],
        "target_cas": np.array(columns[12], dtype=float),
        "phase": np.array(columns[9]),
        "load_factor": 1 + 0.02 * np.sin(seconds),
    }
    for name, words in zip(("CTRL", "INN", "SPD", "HP", "VP"), zip(*columns[13], strict=True), strict=True):
        history[f"mode_{name}"] = np.array(words)
    summary = {"mission": mission.name, "lift_off_s": lift_off, "touchdown_s": touchdown}
    return Run(history, (), tuple(passages), summary, "")


@pytest.fixture(scope="module")
def mission():
    return a_mission()


@pytest.fixture(scope="module")
def run(mission):
    return a_run(mission)


def drawings(run, mission):
    return {
        "route_map": plots.route_map(run, mission),
        "profile": plots.profile(run),
        "modes": plots.modes(run),
    }


@pytest.mark.parametrize("name", ["route_map", "profile", "modes"])
def test_nothing_is_drawn_outside_the_paper_and_no_two_labels_meet(run, mission, name):
    with style.context(["default", RC]):
        figure = drawings(run, mission)[name]
        figure.draw_without_rendering()
        paper = figure.bbox.padded(1.0)
        boxes = []
        for axes in figure.axes:
            for text in axes.texts:
                if text.get_text() and text.get_visible():
                    box = text.get_window_extent()
                    assert paper.fully_containsx(box.x0), text
                    assert paper.fully_containsx(box.x1), text
                    assert paper.fully_containsy(box.y0), text
                    assert paper.fully_containsy(box.y1), text
                    boxes.append((box.padded(-1.5), text))
        clashes = [
            (a.get_text(), b.get_text())
            for i, (box, a) in enumerate(boxes)
            for other, b in boxes[i + 1 :]
            if box.overlaps(other) and a.get_rotation() == b.get_rotation()
        ]
        assert not clashes


def test_the_same_log_gives_the_same_bytes(run, mission, tmp_path):
    run = replace(run, history={name: column[::40] for name, column in run.history.items()})
    pictures = []
    for attempt in ("first", "second"):
        with style.context(["default", RC]):
            for name, figure in drawings(run, mission).items():
                save(figure, tmp_path / f"{name}-{attempt}.png")
                pictures.append((tmp_path / f"{name}-{attempt}.png").read_bytes())
    assert pictures[:3] == pictures[3:]


def test_a_flight_cut_short_is_drawn_too(run, mission):
    for rows in (3, 200):
        cut = {name: column[:rows] for name, column in run.history.items()}
        short = Run(cut, (), (), {"mission": "cut", "lift_off_s": None, "touchdown_s": None}, "")
        for figure in drawings(short, mission).values():
            figure.draw_without_rendering()


def test_a_flight_of_no_rows_has_no_pictures(tmp_path):
    assert plots.draw_all(Run({"time": np.empty(0)}, (), (), {}, ""), tmp_path) == ()


@given(st.lists(st.floats(0, 1), max_size=30))
def test_spread_labels_keep_their_order_and_their_distance(wanted):
    wanted.sort()
    placed = spread(wanted, 0.02)
    assert all(b - a >= 0.02 - 1e-9 for a, b in pairwise(placed))
    if all(b - a >= 0.02 for a, b in pairwise(wanted)):
        assert placed == pytest.approx(wanted)


def test_stretches_follow_each_other_without_a_gap():
    found = spans(np.array([0.0, 1, 2, 3, 4]), ["a", "a", "b", "a", "a"])
    assert [(span.word, span.begin, span.end) for span in found] == [("a", 0, 2), ("b", 2, 3), ("a", 3, 4)]
    assert found[1].rows == slice(2, 3)
    assert spans(np.empty(0), []) == []


def test_short_stretches_join_the_one_before():
    stretches = [
        Span("a", 0, 10, 0, 1),
        Span("b", 10, 10.5, 1, 2),
        Span("a", 10.5, 20, 2, 3),
        Span("c", 20, 30, 3, 4),
    ]
    assert [(span.word, span.begin, span.end) for span in joined(stretches, 5, 25, 1.0)] == [
        ("a", 5, 20),
        ("c", 20, 25),
    ]


def test_a_mode_is_written_as_far_as_it_fits():
    assert fitting("THR leg-speed", 13) == "THR leg-speed"
    assert fitting("THR leg-speed", 12) == "THR"
    assert fitting("direct: rudder", 8) == "direct"
    assert fitting("THR leg-speed", 2) == ""
