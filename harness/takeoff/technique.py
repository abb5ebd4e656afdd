"""How a take-off of a study is flown: the flight manual's phases, begun lined up with the engines running.

The mission of such a flight is made here, in memory: one far waypoint straight ahead that is never reached.
"""

from dataclasses import replace
from pathlib import Path

from harness.manual import FlightManual
from harness.mission.model import Arrival, Departure, Fix, Leg, Mission
from harness.navigation.database import Runway
from harness.plan import Checklist, Condition, Failure, PhasePlan, Step
from harness.takeoff.case import Happening, TakeOff
from harness.units import DEG, Level, Speed

PITCH = "12.5 deg"
"""Attitude rotated to and held to the screen. Calibrated, with `PITCH_RATE`, to the two distances of Fig. 14."""
PITCH_RATE = (
    3.0 * DEG
)  # rad/s, as transport aircraft are rotated; the manual's gain serves every change of attitude
FREE = 1e4
SLOWING = 240.0  # s: a heavy aircraft loses its speed by pitch in a minute and a half
SETTLE = (
    "2 s"  # until the struts carry what the engines, which run as harness.plant.preset has them, ask of them
)
REVERSE_OFF = "60 kt"  # as on landing
AHEAD = 100e3  # m
HERE = str(Path(__file__).name)


def mission(case: TakeOff, event: Happening, manual: FlightManual, runway: Runway) -> Mission:
    """The mission that flies `case` from `runway` and lets `event` happen."""
    failures = () if event.vef is None else (Failure(event.engine, "T/O.run", (_fast(event.vef),), HERE, 0),)
    vr = case.rotation_speed(manual)
    end = Fix(*runway.point(AHEAD))
    leg = Leg(
        "straight ahead",
        end,
        "direct",
        None,
        Speed("CAS", vr),
        Level("ALT", runway.elevation + 3000.0),
        "fly-by",
        (),
        0,
    )
    return Mission(
        name="take-off",
        description="",
        aircraft=case.aircraft,
        speeds={"VR": Speed("CAS", vr), "VLOF": Speed("CAS", vr)},
        loading=case.loading(manual),
        environment=case.environment,
        departure=Departure(runway.airport, runway.designator, None, ()),
        legs=(leg,),
        arrival=Arrival(runway.airport, runway.designator, (), None),
        phases={},
        source_path=Path(HERE),
        text="",
        failures=failures,
    )


def fitted(manual: FlightManual, case: TakeOff, event: Happening) -> FlightManual:
    """The manual with the study's technique in it."""
    phases = dict(manual.phases)
    phases["TXY.out"] = PhasePlan("TXY.out", (), (Checklist("T/O.run", (_when("time-in-phase", "0 s"),)),))
    phases["T/O.run"] = _run(phases["T/O.run"], case, event)
    phases["T/O.rotation"] = _with(phases["T/O.rotation"], "raise the nose", pitch=PITCH)
    phases["T/O.transition"] = _transition(phases["T/O.transition"], event)
    phases["RTO"] = _rejected(phases["RTO"], event)
    gains = {**manual.gains, "pitch-rate": PITCH_RATE}
    if event.slow_down:
        gains["time-limit T/O.transition"] = SLOWING
    if not event.steering:  # the pilot believes that a small command turns the wheel far
        gains |= {name: angle * FREE for name, angle in gains.items() if name.startswith("steering-angle")}
    return replace(manual, phases=phases, gains=gains)


def _run(plan: PhasePlan, case: TakeOff, event: Happening) -> PhasePlan:
    """The manual's take-off run with its last steps in the order of the start asked for, and one way on."""
    steps = {step.name: step for step in plan.steps}
    flaps, thrust, brakes = (
        steps.pop(name) for name in ("flaps take-off", "thrust lever TOGA", "brakes released")
    )
    flaps = flaps._replace(action={**flaps.action, "to": case.flaps})
    settled = (_when("time-in-phase", SETTLE),)
    if case.start == "rolling":
        last = (thrust._replace(when=settled), brakes)
    else:
        last = (thrust, brakes._replace(when=settled))
    if event.v1 is None:
        ways = tuple(way for way in plan.checklists if way.to == "T/O.rotation")
    else:
        ways = (Checklist("RTO", (_fast(event.v1),)),)
    return replace(plan, steps=(flaps, *steps.values(), *last), checklists=ways)


def _transition(plan: PhasePlan, event: Happening) -> PhasePlan:
    """The gear comes up; the attitude is held to the screen, but with an engine failed V2 is flown by pitch."""
    steps = {step.name: step for step in plan.steps}
    chosen = [steps["gear up"]] if event.gear_up else []
    if event.v2 is not None:
        by_pitch = steps["speed by pitch"]
        chosen += [
            by_pitch._replace(action={**by_pitch.action, "speed": f"{event.v2!r} m/s CAS"}, only_if=()),
            steps["climb with the speed"],
        ]
    if event.slow_down:
        chosen += SLOW_DOWN
    return PhasePlan("T/O.transition", tuple(chosen), ())


def _rejected(plan: PhasePlan, event: Happening) -> PhasePlan:
    """The manual's stop, with the reverse thrust asked for and no other."""
    steps = [step for step in plan.steps if not step.name.startswith("reverse thrust")]
    if event.reverse:
        steps += [
            _step("reverse thrust", set="thrust", to="reverse"),
            _step("reverse thrust off", _slow(REVERSE_OFF), set="thrust", to="idle"),
        ]
    return replace(plan, steps=tuple(steps))


def _with(plan: PhasePlan, name: str, **arguments: str) -> PhasePlan:
    steps = tuple(
        step._replace(action={**step.action, **arguments}) if step.name == name else step
        for step in plan.steps
    )
    return replace(plan, steps=steps)


def _step(name: str, *when: Condition, **action: str) -> Step:
    return Step(name, action, when, HERE, 0)


def _fast(cas: float) -> Condition:
    return Condition("speed", "cas", "at-least", f"{cas!r} m/s", HERE, 0)


def _slow(cas: str) -> Condition:
    return Condition("slow", "cas", "at-most", cas, HERE, 0)


def _when(quantity: str, at_least: str) -> Condition:
    return Condition(quantity, quantity, "at-least", at_least, HERE, 0)


SLOW_DOWN = (
    _step(
        "bank towards the live engines",
        Condition("up", "height", "at-least", "150 m", HERE, 0),
        mode="HP",
        to="ATT",
        bank="5 deg",
    ),
    _step("rudder by hand", mode="CTRL", control="rudder", to="DIRECT"),
    _step("full rudder", set="rudder", to="1"),
    _step("slow down", mode="SPD", to="PITCH", speed="40 m/s CAS"),
)
"""Towards VMCA, an engine on the left having failed: CS 25.149(b) allows 5 deg of bank."""
