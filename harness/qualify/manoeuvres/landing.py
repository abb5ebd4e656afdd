"""The landing from the screen: glide, flare, reverse and brakes to a stop."""

from math import nan, radians

import numpy as np
from scipy.integrate import cumulative_trapezoid

from harness.analysis.panel import Curve, Panel
from harness.plant.bench import Attitude
from harness.plant.trim import release, trim
from harness.qualify.condition import Condition
from harness.qualify.manoeuvres.ground import Driver
from harness.qualify.outcome import Aircraft, Outcome
from harness.units import FT, KN, KT

GLIDE = radians(-3.0)
FLARE = 12.0  # m, wheels: the sink rate is reduced from here
FIRM = 1.5  # m/s of sink at touchdown: a landing for distance, half of what CS-25.473 allows
PITCH_PER_SINK = 0.045  # rad per m/s
ACTION = 1.0  # s
PITCH_INTEGRAL = 0.03  # rad per m


def landing(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Distance from the screen to standstill: idle in the flare, spoilers by themselves, then brakes and reverse.

    Each action of the pilot takes its second after touchdown, first the brakes, then reverse: the least that FAA
    AC 25-7 allows for a landing distance (recalled).
    """
    bench = aircraft.loaded(condition)
    bench.park()
    standing = bench["height"]
    balanced = trim(
        bench, 0.0, Attitude(condition.tas, alpha=radians(4.0), path=GLIDE), controls={"throttle": 0.3}
    )
    release(bench)
    ground = bench["altitude"] - standing - condition.screen
    bench.put("position/terrain-elevation-asl-ft", ground / FT)
    driver = Driver(bench)
    bench.put("fcs/law", 0.0)
    bench.put("ap/pitch-mode", 1.0)
    bench.put("ap/yaw-mode", 1.0)
    pitch = balanced.attitude.pitch
    held = [0.0]  # the part of the pitch attitude that stays, rad
    touched: list[float] = []  # the sink rate at touchdown, m/s, and when

    def pilot(time: float) -> None:
        height = bench["height"] - standing
        if bench["main_on_ground"] > 0 and not touched:
            touched.extend((-bench["vertical_speed"], time))
        if touched:
            bench.put("ap/pitch-target-rad", 0.0)
            bench.put("ap/yaw-mode", 0.0)
            bench.put("fcs/spoiler-cmd-norm", 1.0)
            driver.steer(nose_wheel=bench["nose_on_ground"] > 0)
            since = time - touched[1]
            if since >= ACTION and bench["nose_on_ground"] > 0:
                bench.brakes(1.0)
            if since >= 2 * ACTION:
                bench.levers(-1.0)
            return
        wanted = condition.tas * GLIDE
        if height < FLARE:
            bench.levers(0.0)
            wanted = -max(FIRM, -wanted * height / FLARE)
        error = wanted - bench["vertical_speed"]
        held[0] += PITCH_INTEGRAL * error * 5 / bench.rate
        bench.put("ap/pitch-target-rad", pitch + held[0] + PITCH_PER_SINK * error)

    record = bench.record(
        90.0,
        ("height", "cas", "thrust", "pitch", "ground speed", "vertical_speed", "main_on_ground"),
        pilot=pilot,
        until=lambda: bool(touched) and bench["ground speed"] < 1.0,
    )
    record["height"] -= standing
    way = cumulative_trapezoid(record["ground speed"], record["time"], initial=0.0)
    whole = float(way[-1])
    air = float(way[int(np.argmax(record["main_on_ground"] > 0))]) if touched else nan
    return Outcome(
        {
            "distance": whole if touched else nan,
            "air distance": air,
            "ground roll": whole - air,
            "sink": touched[0],
        },
        [
            Panel("distance, m", label, [Curve(name, way.tolist(), (record[name] / unit).tolist())])
            for label, name, unit in (
                ("height of the wheels, m", "height", 1.0),
                ("CAS, kt", "cas", KT),
                ("thrust, kN", "thrust", KN),
                ("pitch, deg", "pitch", radians(1.0)),
            )
        ],
        f"touches after {air:.0f} m at {touched[0]:.1f} m/s of sink, then rolls {whole - air:.0f} m",
    )
