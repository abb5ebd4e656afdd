"""Handling qualities: the modes of motion after a small disturbance, and rolling.

The aircraft is trimmed and let free with its controls where they are. Small disturbances of several kinds are given in
turn; the modes are identified from the recorded motion. The bare airframe has no inner loop and no damper; its state is
the four of the textbook and the downwash on its way to the tail. Augmented is the direct law with its dampers; then the
actuators and what the law asks of them, which it does every fourth frame, belong to the state.
"""

from collections.abc import Sequence
from math import degrees, log, nan, radians

from harness.plant.bench import Attitude, Bench, Record
from harness.plant.trim import Trim, fly_by_hand, release, trim
from harness.qualify.condition import Condition
from harness.qualify.identify import modes
from harness.qualify.linear import Mode
from harness.qualify.outcome import Aircraft, Outcome, history

LONGITUDINAL = ("tas", "alpha", "pitch_rate", "pitch", "altitude", "aero/downwash-rad")
LATERAL = ("beta", "roll_rate", "yaw_rate", "roll", "aero/downwash-rad")
PULSE = 0.5  # s
STEPS = 4  # frames between two records: the direct law's own step
KICK = 0.03  # of full stick or pedal: motions of a degree or two, small enough to be linear
DEGREE = radians(1.0)
NEVER = 999.0  # s: a spiral that converges does not double


def _free(bench: Bench, condition: Condition) -> Trim:
    """Trimmed, loops off; the augmentation stays only where the condition wants it."""
    balanced = trim(
        bench,
        condition.altitude,
        Attitude(condition.tas, alpha=radians(5.0), path=radians(-3.0 if condition.gear else 0.0)),
        controls={"throttle": 0.4},
    )
    fly_by_hand(bench)
    bench.put("fcs/augmentation", condition.augmented)
    return balanced


def disturbed(
    aircraft: Aircraft,
    condition: Condition,
    kicks: Sequence[tuple[str, float]],
    states: Sequence[str],
    seconds: float,
) -> list[Record]:
    """Free motions, one after each kick: a pulse on a control, from the same trim."""
    records = []
    for control, size in kicks:
        bench = aircraft.loaded(condition)
        balanced = _free(bench, condition)
        release(bench)
        bench.put("fuel/freeze", 1.0)
        name = f"fcs/{control}-cmd-norm"
        bench.put(name, balanced.controls[control] + size)
        bench.run(PULSE)
        bench.put(name, balanced.controls[control])
        bench.run(1.0)  # until the actuators are back
        records.append(bench.record(seconds, (*states, "load_factor"), steps=STEPS))
    return records


def longitudinal(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Short period and phugoid, stick fixed; CAP from the frequency and the lift slope as flown."""
    records = disturbed(
        aircraft, condition, (("elevator", -3 * KICK), ("elevator", 3 * KICK)), LONGITUDINAL, 40.0
    )
    pairs, _ = modes(records, LONGITUDINAL)
    short, phugoid = pairs[0], pairs[-1]
    bench = aircraft.loaded(condition)
    slope = _load_factor_slope(bench, condition)
    return Outcome(
        {
            "short-period frequency": short.frequency,
            "short-period damping": short.damping,
            "control anticipation parameter": short.frequency**2 / slope,
            "phugoid period": phugoid.period,
            "phugoid damping": phugoid.damping,
        },
        [
            history(records[0], "pitch, deg", ("pitch", DEGREE)),
            history(records[0], "pitch rate, deg/s", ("pitch_rate", DEGREE)),
            history(records[0], "true airspeed, m/s", ("tas", 1.0)),
        ],
        f"load factor {slope:.1f} a radian of incidence",
    )


def _load_factor_slope(bench: Bench, condition: Condition) -> float:
    """Load factor per incidence at constant speed, 1/rad, from the forces on the aircraft held still."""
    balanced = _free(bench, condition)
    loads = []
    for change in (-1.0, 1.0):
        attitude = balanced.attitude._replace(alpha=balanced.attitude.alpha + change * DEGREE)
        bench.place(condition.altitude, attitude)
        bench.move(False)
        bench.run(1.0)
        loads.append(bench["load_factor"])
    return (loads[1] - loads[0]) / (2 * DEGREE)


def lateral(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Dutch roll, roll and spiral, controls fixed, with the yaw damper where the condition says augmented."""
    states = (
        LATERAL[:4] if not condition.augmented else (*LATERAL[:4], "rudder", "actuator/rudder-rate-rad_sec")
    )
    records = disturbed(
        aircraft, condition, (("rudder", KICK), ("aileron", KICK), ("rudder", -2 * KICK)), states, 20.0
    )
    pairs, singles = modes(records, states)
    dutch = min(pairs, key=lambda mode: abs(log(mode.frequency)), default=Mode(complex(nan)))  # near 1 rad/s
    roll = next((mode for mode in singles if 0.4 < mode.time_constant < 5.0), Mode(complex(nan)))
    spiral = singles[-1] if singles else Mode(complex(nan))
    grows = spiral.time_constant < 0
    return Outcome(
        {
            "dutch-roll frequency": dutch.frequency,
            "dutch-roll damping": dutch.damping,
            "dutch-roll period": dutch.period,
            "dutch-roll zeta omega": dutch.damping * dutch.frequency,
            "roll time constant": roll.time_constant,
            "spiral time to double": spiral.doubling if grows else NEVER,
        },
        [
            history(records[0], "deg", ("beta", DEGREE), ("roll", DEGREE)),
            history(records[0], "deg/s", ("roll_rate", DEGREE), ("yaw_rate", DEGREE)),
        ],
        "" if grows else "the spiral converges",
    )


def bank_change(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Full stick from wings level: time to 30 deg of bank."""
    bench = aircraft.loaded(condition)
    _free(bench, condition)
    release(bench)
    bench.run(0.5)
    level = bench["roll"]
    bench.put("fcs/aileron-cmd-norm", 1.0)
    record = bench.record(
        8.0, ("roll", "roll_rate", "aileron"), steps=1, until=lambda: bench["roll"] - level > radians(30)
    )
    return Outcome(
        {"time": float(record["time"][-1]) if bench["roll"] - level > radians(30) else nan},
        [
            history(record, "bank, deg", ("roll", DEGREE), marks=[("30 deg", 30 + degrees(level))]),
            history(record, "roll rate, deg/s", ("roll_rate", DEGREE)),
            history(record, "aileron, deg", ("aileron", DEGREE)),
        ],
    )
