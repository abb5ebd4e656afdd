"""Stalls, and the lowest speed at which a dead engine can be held.

Source of the method: CS-25.103 (VSR: the speed of the largest load-factor-corrected lift coefficient, entered at
1 kt/s) and CS-25.149 (VMC: straight flight with at most 5 deg of bank and full rudder).
"""

from dataclasses import replace
from math import degrees, radians, sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from harness.analysis.panel import Curve, Panel
from harness.plant.bench import LBF, Attitude, Bench, Record
from harness.plant.trim import release, trim
from harness.qualify.condition import Condition
from harness.qualify.control import Helm
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import FT, KT
from harness.world.atmosphere import GRAVITY, SEA_LEVEL_DENSITY

ENTRY = -1.0 * KT  # m/s2: CS-25.103(c)
FORWARD, BODY_X, BODY_Z = "accelerations/Nx", "forces/fbx-aero-lbs", "forces/fbz-aero-lbs"
LOST = radians(3.0)  # of heading: straight flight is no longer held


class Stall(NamedTuple):
    """A stall that was flown: speeds in m/s CAS, the flight, and the lift coefficient W nz / q S over it."""

    speed: float
    aerodynamic_speed: (
        float  # the stall speed that the aerodynamic lift alone would give, without the thrust's share
    )
    record: Record
    lift: NDArray[np.float64]


def flown_stall(bench: Bench, condition: Condition) -> Stall:
    """Fly a 1-g stall from the condition's speed on."""
    balanced = trim(
        bench,
        condition.altitude,
        Attitude(condition.tas, alpha=radians(6.0), path=radians(10.0 * condition.lever - 3.0)),
        ("alpha", "elevator", "path"),
        controls={"throttle": condition.lever},
    )
    release(bench)
    helm = Helm(bench, balanced, cas=condition.cas, rate=ENTRY)
    record = bench.record(
        60.0,
        ("cas", "alpha", "pitch", "load_factor", "mass", "elevator", FORWARD, BODY_X, BODY_Z),
        steps=2,
        pilot=helm.hold_speed_by_stick,
        until=lambda: bench["alpha"] > radians(25.0) or bench["cas"] < 40.0,
    )
    area = bench.get("metrics/Sw-sqft") * FT**2
    cosine, sine = np.cos(record["alpha"]), np.sin(record["alpha"])
    # the equivalent airspeed is the calibrated one within 0.1 % at these speeds and heights
    pressure = 0.5 * SEA_LEVEL_DENSITY * record["cas"] ** 2 * area
    lift = (record["load_factor"] * cosine + record[FORWARD] * sine) * record["mass"] * GRAVITY / pressure
    aerodynamic = (record[BODY_X] * sine - record[BODY_Z] * cosine) * LBF / pressure

    def speed(coefficient: NDArray[np.float64]) -> float:
        return sqrt(2 * record["mass"][0] * GRAVITY / (SEA_LEVEL_DENSITY * area * float(coefficient.max())))

    return Stall(speed(lift), speed(aerodynamic), record, lift)


def stall(aircraft: Aircraft, condition: Condition) -> Outcome:
    """The 1-g stall speed: CL reaches its maximum."""
    flown = flown_stall(aircraft.loaded(condition), condition)
    return Outcome(
        {"stall speed": flown.speed / KT, "maximum lift coefficient": float(flown.lift.max())},
        _panels(flown, ("1-g stall speed", flown.speed / KT)),
    )


def power_on_stall(aircraft: Aircraft, condition: Condition) -> Outcome:
    """How much less the stall speed is with power than without, both flown."""
    idle = flown_stall(aircraft.loaded(condition), replace(condition, lever=0.0))
    power = flown_stall(aircraft.loaded(condition), condition)
    whole = 100 * (power.speed / idle.speed - 1)
    return Outcome(
        {
            "reduction": whole,
            "reduction by lift": 100 * (power.aerodynamic_speed / idle.aerodynamic_speed - 1),
        },
        _panels(power, ("power on", power.speed / KT), ("idle", idle.speed / KT)),
        f"flown: power on {power.speed / KT:.1f} kt, idle {idle.speed / KT:.1f} kt, {whole:.1f} %; the reduction by "
        "lift leaves out the part of the weight that the thrust carries",
    )


def _panels(flown: Stall, *marks: tuple[str, float]) -> list[Panel]:
    time = flown.record["time"].tolist()
    degree = radians(1)
    return [
        history(flown.record, "CAS, kt", ("cas", KT), marks=marks),
        Panel("time, s", "CL (W nz / q S)", [Curve("CL", time, flown.lift.tolist())]),
        history(flown.record, "deg", ("alpha", degree), ("pitch", degree), ("elevator", degree)),
    ]


def minimum_control_speed_air(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Flown: an engine feathered, power on the others, banked into them, slowing down at 1 kt/s until full rudder no
    longer holds the heading.
    """
    bench = aircraft.loaded(condition)
    bench.fail(condition.failed - 1)
    bank = condition.bank if condition.failed <= 2 else -condition.bank
    balanced = trim(
        bench,
        condition.altitude,
        Attitude(condition.tas, alpha=radians(4.0), path=radians(6.0), bank=bank),
        ("alpha", "elevator", "path", "beta", "aileron", "rudder"),
        controls={"throttle": condition.lever},
    )
    release(bench)
    helm = Helm(bench, balanced, cas=condition.cas, rate=ENTRY, bank=bank)
    heading = bench["heading"]

    def turned() -> float:
        return (bench["heading"] - heading + np.pi) % (2 * np.pi) - np.pi

    def pilot(time: float) -> None:
        helm.hold_speed_by_stick(time)
        helm.hold_heading_by_pedals(2 / bench.rate)

    record = bench.record(
        90.0,
        ("cas", "rudder", "roll", "beta", "heading rate", "aileron", "alpha", "heading"),
        steps=2,
        pilot=pilot,
        until=lambda: abs(turned()) > LOST or bench["alpha"] > radians(20.0),
    )
    full = np.abs(record["rudder"]) >= 0.995 * float(np.abs(record["rudder"]).max())
    first = int(np.argmax(full))
    lost = abs(turned()) > LOST
    speed = float(record["cas"][first] if lost else record["cas"][-1])
    return Outcome(
        {"speed": speed / KT, "heading lost": float(lost)},
        [
            history(record, "CAS, kt", ("cas", KT), marks=[("VMCA", speed / KT)]),
            history(record, "deg", ("rudder", radians(1)), ("aileron", radians(1))),
            history(record, "deg", ("roll", radians(1)), ("beta", radians(1)), ("alpha", radians(1))),
        ],
        ""
        if lost
        else f"the heading is held down to {degrees(float(record['alpha'][-1])):.0f} deg of incidence",
    )
