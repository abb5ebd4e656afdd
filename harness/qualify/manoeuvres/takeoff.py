"""Take-off, and the lowest speed on the runway at which a dead engine can be held.

Source of the minimum control speed: CS-25.149(e): primary controls alone, no nose wheel steering, at most 30 ft aside.
"""

from math import radians
from typing import NamedTuple

import numpy as np

from harness.analysis.panel import Curve, Panel
from harness.plant.bench import Record
from harness.qualify.condition import Condition
from harness.qualify.manoeuvres.ground import Driver, standing
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import FT, KT

ROTATION = radians(12.0)  # pitch attitude held to the screen, at 3 deg/s; fitted, see docs/assumptions.md
ASIDE = 30 * FT  # CS-25.149(e)
DEGREE = radians(1.0)


def take_off(aircraft: Aircraft, condition: Condition) -> Outcome:
    """From standstill with full power to the screen height; rotation at the condition's speed."""
    bench = standing(aircraft, condition, lever=condition.lever)
    driver = Driver(bench)
    bench.brakes(0.0)
    ground = bench["height"]
    lift_off: list[float] = []

    def pilot(_: float) -> None:
        driver.steer(nose_wheel=bench["nose_on_ground"] > 0)
        if bench["cas"] >= condition.cas:
            bench.put("ap/pitch-mode", 1.0)
            bench.put("ap/pitch-target-rad", ROTATION)
        if bench["main_on_ground"] == 0 and bench["cas"] > condition.cas and not lift_off:
            lift_off.append(bench["distance"])
            bench.put("ap/yaw-mode", 1.0)

    start = bench["distance"]
    record = bench.record(
        90.0,
        ("distance", "height", "cas", "tas", "pitch", "thrust", "alpha"),
        pilot=pilot,
        until=lambda: bench["height"] - ground > condition.screen,
    )
    record["height"] -= ground
    record["distance"] -= start

    def at_screen(name: str) -> float:
        return float(np.interp(condition.screen, record["height"][-20:], record[name][-20:]))

    return Outcome(
        {
            "distance to the screen": at_screen("distance"),
            "speed at the screen": at_screen("tas"),
            "lift-off distance": lift_off[0] - start if lift_off else float("nan"),
        },
        [
            Panel(
                "distance, m",
                "height, m",
                [Curve("wheels", record["distance"].tolist(), record["height"].tolist())],
                [("screen", condition.screen)],
            ),
            Panel(
                "distance, m",
                "CAS, kt",
                [Curve("CAS", record["distance"].tolist(), (record["cas"] / KT).tolist())],
            ),
            Panel(
                "distance, m",
                "pitch, deg",
                [Curve("pitch", record["distance"].tolist(), (record["pitch"] / DEGREE).tolist())],
            ),
        ],
    )


class Cut(NamedTuple):
    """A take-off run with an engine cut: how far aside it went on its wheels (m), and its history."""

    aside: float
    record: Record


def minimum_control_speed_ground(aircraft: Aircraft, condition: Condition) -> Outcome:
    """The lowest speed of an engine cut from which the aircraft stays within 30 ft of its line, by bisection."""
    remark = ""

    def cut(cas: float) -> Cut:
        nonlocal remark
        bench = standing(aircraft, condition, lever=condition.lever)
        driver = Driver(bench)
        if bench.has("failure/steering"):
            bench.put("failure/steering", 1.0)
        else:
            remark = "the nose wheel stands straight and carries side force: it cannot be let free"
        bench.brakes(0.0)
        failed: list[float] = []  # when
        asides: list[float] = []

        def pilot(_: float) -> None:
            driver.steer(nose_wheel=False)
            asides.append(driver.aside())
            if bench["cas"] >= cas and not failed:
                failed.append(bench["time"])
                bench.fail(condition.failed - 1)

        record = bench.record(
            60.0,
            ("cas", "rudder", "propeller rpm", "main_on_ground"),
            pilot=pilot,
            until=lambda: bool(failed) and bench["time"] > failed[0] + 10.0,
        )
        record["aside"] = np.array([*asides, driver.aside()])
        rolling = record["main_on_ground"] > 0
        return Cut(float(np.abs(record["aside"][rolling]).max()), record)

    slow, fast = 70 * KT, 130 * KT
    while fast - slow > 1.0 * KT:
        middle = (slow + fast) / 2
        slow, fast = (slow, middle) if cut(middle).aside <= ASIDE else (middle, fast)
    flown = cut(fast)
    return Outcome(
        {"speed": fast / KT, "aside": flown.aside},
        [
            history(flown.record, "aside, m", ("aside", 1.0), marks=[("30 ft", -ASIDE)]),
            history(flown.record, "CAS, kt", ("cas", KT), marks=[("VMCG", fast / KT)]),
            history(flown.record, "rudder, deg", ("rudder", DEGREE)),
        ],
        remark,
    )
