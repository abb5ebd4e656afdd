"""The engines on the aircraft, its motion frozen: an engine test stand at any speed and height."""

from harness.plant.bench import Attitude, Bench
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import KN
from harness.world.airspeed import mach_from_tas
from harness.world.atmosphere import SEA_LEVEL_PRESSURE, SEA_LEVEL_TEMPERATURE, pressure, temperature

LEVER_STEP = 10.0  # s that are watched after the lever moved
MW = 1e6
TAKE_OFF_POWER = 7.971e6  # W: EASA TCDS E.033 Iss. 08
FLAT, HOT = 1.525, 1.1  # with the other exponents: docs/assumptions.md, Propulsion


def running(aircraft: Aircraft, condition: Condition) -> Bench:
    """Engines steady at a condition's lever, the aircraft held still in the air."""
    bench = aircraft.loaded(condition)
    bench.levers(condition.lever)
    bench.place(condition.altitude, Attitude(max(condition.tas, 0.1)))
    bench.run_up()
    return bench


def thrust_at_speed(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Thrust and power of all engines at a speed; the diagram shows them run up from idle."""
    bench = running(aircraft, condition)
    values = {
        "thrust": bench["thrust"] / KN,
        "power": bench["power"] / MW,
        "propeller speed": bench["propeller rpm"],
    }
    bench.levers(0.0)
    bench.run(15.0)
    bench.levers(condition.lever)
    record = bench.record(LEVER_STEP, ("thrust", "power", "propeller rpm"))
    return Outcome(
        values,
        [
            history(record, "thrust, kN", ("thrust", KN), marks=[("steady", values["thrust"])]),
            history(record, "power an engine, MW", ("power", MW)),
            history(record, "propeller, rpm", ("propeller rpm", 1.0)),
        ],
    )


def lever_step(aircraft: Aircraft, condition: Condition) -> Outcome:
    """How far the propeller speed leaves what its governor holds when the lever is moved at once."""
    bench = running(aircraft, condition)
    wanted = bench.get("fadec/governor-rpm")
    bench.levers(condition.step)
    record = bench.record(LEVER_STEP, ("propeller rpm", "power", "thrust"), steps=1)
    error = 100 * abs(record["propeller rpm"] / wanted - 1).max()
    return Outcome(
        {"largest deviation": float(error)},
        [
            history(record, "propeller, rpm", ("propeller rpm", 1.0), marks=[("governed", wanted)]),
            history(record, "power an engine, MW", ("power", MW)),
        ],
    )


def rating(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Power at full lever against the flat-rating law, computed here from the standard atmosphere."""
    bench = running(aircraft, condition)
    mach, altitude = (
        mach_from_tas(condition.tas, temperature(condition.altitude, condition.isa)),
        condition.altitude,
    )
    ram = 1 + 0.2 * mach**2
    theta = temperature(altitude, condition.isa) / SEA_LEVEL_TEMPERATURE * ram
    delta = pressure(altitude) / SEA_LEVEL_PRESSURE * ram**3.5
    hot = 1.0 - condition.isa / temperature(altitude, condition.isa)
    law = TAKE_OFF_POWER * min(1.0, FLAT * delta**0.92 * theta**-0.45 * hot**HOT)
    bench.levers(0.0)
    bench.run(15.0)
    bench.levers(condition.lever)
    record = bench.record(LEVER_STEP, ("power", "thrust"))
    return Outcome(
        {
            "power": float(record["power"][-1]) / MW,
            "power over the law": 100 * float(record["power"][-1]) / law,
        },
        [
            history(record, "power an engine, MW", ("power", MW), marks=[("law", law / MW)]),
            history(record, "thrust, kN", ("thrust", KN)),
        ],
    )
