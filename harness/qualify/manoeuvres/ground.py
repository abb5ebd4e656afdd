"""On the runway: standing on the brakes, rolling, stopping, turning; and who keeps the aircraft on its line."""

from dataclasses import replace
from math import cos, pi, sin

import numpy as np

from harness.analysis.panel import Curve, Panel
from harness.plant.bench import WHEELS, Bench, Record
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import KN

START = 30.0  # s for the engines from rest to ground idle
RUN_UP = 10.0  # s on the brakes with the levers forward
STEER_PER_HEADING = 40.0  # 1/rad
STEER_PER_RATE = 12.0  # s
HEADING_PER_ASIDE = 0.02  # rad a metre beside the line, at most
LARGEST_CORRECTION = 0.1  # rad
EARTH = 6_371_000.0  # m, for distances of metres


def standing(aircraft: Aircraft, condition: Condition, *, lever: float = 0.0) -> Bench:
    """On the runway with brakes on and engines running, levers moved forward after the start."""
    bench = aircraft.loaded(replace(condition, gear=1.0))
    bench.park()
    bench.levers(0.0)
    bench.run(START)
    if lever > 0.0:
        bench.levers(lever)
        bench.run(RUN_UP)
    return bench


class Driver:
    """Keeps the line of the runway by nose wheel and rudder, wings level by the aircraft's roll loop."""

    def __init__(self, bench: Bench) -> None:
        self._bench = bench
        self._heading = bench["heading"]
        self._place = bench["latitude"], bench["longitude"]
        bench.put("ap/roll-mode", 1.0)
        bench.put("ap/bank-target-rad", 0.0)

    def astray(self) -> float:
        """How far the heading is to the right of the runway's, rad."""
        return (self._bench["heading"] - self._heading + pi) % (2 * pi) - pi

    def aside(self) -> float:
        """How far the aircraft is to the right of its line, m."""
        latitude, longitude = self._place
        north = (self._bench["latitude"] - latitude) * EARTH
        east = (self._bench["longitude"] - longitude) * EARTH * cos(latitude)
        return east * cos(self._heading) - north * sin(self._heading)

    def steer(self, *, nose_wheel: bool = True) -> None:
        """Correct the heading and the line."""
        bench = self._bench
        back = min(LARGEST_CORRECTION, max(-LARGEST_CORRECTION, HEADING_PER_ASIDE * self.aside()))
        wanted = -STEER_PER_HEADING * (self.astray() + back) - STEER_PER_RATE * bench["heading rate"]
        command = min(1.0, max(-1.0, wanted))
        bench.put("fcs/rudder-cmd-norm", command)
        bench.put("fcs/steer-cmd-norm", command if nose_wheel else 0.0)


def brake_hold(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Full power on the brakes: thrust at standstill, and how far the aircraft creeps in half a minute."""
    bench = standing(aircraft, condition, lever=condition.lever)
    bench.run(5.0)
    start = bench["distance"]
    record = bench.record(30.0, ("distance", "thrust", "propeller rpm", "power"))
    record["distance"] -= start
    return Outcome(
        {"creep": 1000 * float(np.ptp(record["distance"])), "thrust": float(record["thrust"].mean()) / KN},
        [
            history(record, "way, mm", ("distance", 1e-3)),
            history(record, "thrust, kN", ("thrust", KN)),
            history(record, "propeller, rpm", ("propeller rpm", 1.0)),
        ],
    )


def rolling(aircraft: Aircraft, condition: Condition) -> Bench:
    """On the runway, rolling at the condition's true airspeed, engines stopped and propellers feathered."""
    bench = aircraft.loaded(replace(condition, gear=1.0))
    bench.put_all("propulsion/engine-run", 0.0)
    bench.park(speed=condition.tas)
    bench.brakes(0.0)
    return bench


def coast_down(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Rolls free, engines off, from the condition's speed to a stop."""
    bench = rolling(aircraft, condition)
    driver = Driver(bench)
    record = bench.record(
        400.0,
        ("distance", "ground speed"),
        pilot=lambda _: driver.steer(),
        until=lambda: bench["ground speed"] < 0.1,
    )
    return Outcome(
        {
            "distance": float(record["distance"][-1] - record["distance"][0]),
            "time": float(record["time"][-1]),
        },
        [
            history(record, "ground speed, m/s", ("ground speed", 1.0)),
            history(record, "distance, m", ("distance", 1.0)),
        ],
    )


def stopping(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Full brakes from the condition's speed, engines off: the brakes alone."""
    bench = rolling(aircraft, condition)
    driver = Driver(bench)
    bench.brakes(1.0)
    bench.put("fcs/spoiler-cmd-norm", 1.0)
    bench.put("fcs/spoiler-pos-norm", 1.0)
    record = bench.record(
        60.0,
        ("distance", "ground speed"),
        pilot=lambda _: driver.steer(),
        until=lambda: bench["ground speed"] < 0.5,
    )
    distance = float(record["distance"][-1] - record["distance"][0])
    return Outcome(
        {"distance": distance, "mean deceleration": float(record["ground speed"][0] ** 2 / 2 / distance)},
        [history(record, "ground speed, m/s", ("ground speed", 1.0))],
    )


def spin_up(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Wheels at rest set on the runway at speed: the momentum they take, against the same run with turning wheels."""

    def run(wheels: float) -> Record:
        bench = rolling(aircraft, condition)
        bench.put_all("gear/wheel-speed-mps", wheels, WHEELS)
        return bench.record(
            1.0, ("ground speed", "mass", "gear/wheel-speed-mps[6]", "forces/fbx-gear-lbs"), steps=1
        )

    still, turning = run(0.0), run(condition.tas)
    lost = (turning["ground speed"][-1] - still["ground speed"][-1]) * still["mass"][0]
    bench = aircraft.bench()
    taken = sum(
        count * bench.get(f"gear/{name}-wheel-inertia-kgm2") / bench.get(f"gear/{name}-tyre-radius-m") ** 2
        for name, count in (("main", 12), ("nose", 2))
    )
    return Outcome(
        {"impulse": 100 * float(lost) / (taken * float(still["ground speed"][-1]))},
        [
            history(still, "tread of a main wheel, m/s", ("gear/wheel-speed-mps[6]", 1.0)),
            history(still, "gear force ahead, kN", ("forces/fbx-gear-lbs", 1000 / 4.4482216)),
        ],
        f"{float(lost) / 1000:.1f} kN s",
    )


def turn(aircraft: Aircraft, condition: Condition) -> Outcome:
    """A steady turn on the ground: radius of the main wheels' track against the nose wheel's angle."""
    bench = standing(aircraft, condition, lever=0.06)
    bench.brakes(0.0)
    bench.put("fcs/steer-cmd-norm", condition.ratio)

    def pace(_: float) -> None:
        fast = bench["ground speed"] > condition.tas
        bench.brakes(0.3 if fast else 0.0)
        bench.levers(0.0 if fast else 0.1)

    record = bench.record(
        60.0, ("ground speed", "heading rate", "latitude", "longitude", "fcs/steer-pos-deg[0]"), pilot=pace
    )
    last = record["time"] > 40.0
    radius = float((record["ground speed"][last] / np.abs(record["heading rate"][last])).mean())
    east = (record["longitude"] - record["longitude"][0]) * EARTH * cos(float(record["latitude"][0]))
    north = (record["latitude"] - record["latitude"][0]) * EARTH
    wheel = float(record["fcs/steer-pos-deg[0]"][-1])
    return Outcome(
        {"radius": radius, "turn rate": float(np.degrees(np.abs(record["heading rate"][last]).mean()))},
        [
            Panel("east, m", "north, m", [Curve("centre of gravity", east.tolist(), north.tolist())]),
            history(record, "nose wheel, deg", ("fcs/steer-pos-deg[0]", 1.0)),
        ],
        f"nose wheel at {wheel:.1f} deg, {float(record['ground speed'][-1]):.1f} m/s",
    )
