"""One take-off, flown: from brake release to the screen, with every distance between two pilot steps interpolated."""

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from harness.errors import FlightError
from harness.flight import fly, prepare
from harness.log import Event, Reporter
from harness.manual import FlightManual, read_manual
from harness.pilot.pilot import Pilot
from harness.plant.jsbsim_plant import JSBSimPlant
from harness.plant.preset import IDLE, TAKE_OFF, lined_up, slope
from harness.state import Commands, State
from harness.takeoff import technique
from harness.takeoff.case import NOTHING, Happening, TakeOff, check
from harness.units import FT, G0, LB

Floats = NDArray[np.float64]

SCREEN = 35.0  # m, of the paper
CS25_SCREEN = 35 * FT  # CS 25.113
RUNWAY = 9000.0  # m: nobody shall run out of it here
TIME_LIMIT = 300.0  # s
STOPPED = 0.2  # m/s
WET = 1.0  # systems/wheels.xml
NOSE_UP = (
    3.0  # m: so much lower the wheels may hang than State's height, that of a level aircraft on its wheels
)
INCH = FT / 12
WEAR = (
    "gear/brake-energy-peak-mj",
    "gear/brake-energy-limit-mj",
    "gear/tyre-speed-max-mps",
    "gear/tyre-speed-limit-mps",
)
COLUMNS = (
    "time",
    "along",
    "across",
    "above_ground",
    "pitch",
    "cas",
    "ground_speed",
    "vertical_speed",
    "thrust",
    "load",
)


@dataclass(frozen=True, eq=False)
class Flown:
    """A flown take-off: one value a pilot step from brake release on, SI. `height` is of the lowest main wheel.

    `along` is the distance from brake release; `events` are what the pilot did.
    """

    case: TakeOff
    vr: float
    time: Floats
    along: Floats
    across: Floats
    height: Floats
    pitch: Floats
    cas: Floats
    ground_speed: Floats
    vertical_speed: Floats
    thrust: Floats
    load: Floats  # on the wheels, N
    events: tuple[Event, ...]
    wear: dict[str, float]

    def when(self, kind: str, name: str) -> float:
        """The index, with a fraction, of an event. Raises LookupError when it did not happen."""
        for event in self.events:
            if (event.kind, event.name) == (kind, name):
                return self.at_time(event.time)
        raise LookupError(f"no {kind} {name}")

    @property
    def liftoff(self) -> float:
        """The index, with a fraction, at which the last main wheel loses contact, from the load on the wheels."""
        last = int(np.flatnonzero(self.load > 0.0)[-1])
        before, load = float(self.load[last - 1]), float(self.load[last])
        return last + min(load / max(before - load, load), 1.0)

    def at_height(self, height: float) -> float:
        """The index, with a fraction, at which the wheels pass `height` (m) for good. Raises FlightError."""
        below = np.flatnonzero(self.height < height)
        if below[-1] == len(self.height) - 1:
            raise FlightError(
                f"the flight ended below {height:.1f} m", time=float(self.time[-1]), phase="take-off"
            )
        return self._crossing(self.height, height, int(below[-1]))

    def speed_at(self, height: float) -> float:
        """CAS where the wheels pass `height` (m) for good, m/s. Raises FlightError."""
        return self.at(self.at_height(height), "cas")

    def at_speed(self, cas: float) -> float:
        """The index, with a fraction, at which `cas` (m/s) is first reached."""
        reached = int(np.argmax(self.cas >= cas))
        return self._crossing(self.cas, cas, max(reached - 1, 0))

    def at_time(self, time: float) -> float:
        """The index, with a fraction, at `time` (s from brake release)."""
        return float(np.interp(time, self.time, np.arange(len(self.time))))

    def at(self, index: float, column: str) -> float:
        """A column at an index with a fraction."""
        return float(np.interp(index, np.arange(len(self.time)), getattr(self, column)))

    def _crossing(self, values: Floats, value: float, before: int) -> float:
        low, high = float(values[before]), float(values[before + 1])
        return before + (value - low) / (high - low)


class Track:
    """Watches a take-off: the columns of Flown from the moment at which the brakes are released."""

    def __init__(self, plant: JSBSimPlant, pilot: Pilot) -> None:
        self.events: list[Event] = []
        self.rows: list[tuple[float, ...]] = []
        self._plant = plant
        self._centreline = pilot.control.runway
        self._wheels = Wheels(plant, pilot.manual)

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:  # noqa: ARG002  an observer
        """Keep this step, once the brakes are off."""
        if commands.brake and not self.rows:
            return
        along, across = self._centreline.offset(state)
        if self.rows and along == self.rows[-1][1]:
            return  # the position is not renewed at every look
        speed = (state.velocity_north**2 + state.velocity_east**2) ** 0.5
        self.rows.append(
            (
                state.time,
                along,
                across,
                state.height,
                state.pitch,
                state.cas,
                speed,
                state.vertical_speed,
                state.thrust,
                -self._plant.fdm["forces/fbz-gear-lbs"] * LB * G0 if state.main_on_ground else 0.0,
            )
        )

    def note(self, event: Event) -> None:
        """Keep what the pilot did."""
        self.events.append(event)

    def flown(self, case: TakeOff, vr: float) -> Flown:
        """What was seen; times count from the release of the brakes."""
        columns = dict(zip(COLUMNS, np.array(self.rows).T.copy(), strict=True))
        begin = float(columns["time"][0])
        columns["time"] -= begin
        columns["along"] -= columns["along"][0]
        columns["height"] = self._wheels.height(columns.pop("above_ground"), columns["pitch"])
        events = tuple(event._replace(time=event.time - begin) for event in self.events)
        return Flown(case, vr, events=events, wear=self._wear(), **columns)

    def _wear(self) -> dict[str, float]:
        """What the take-off did to brakes and tyres, and what they bear: MJ a leg, m/s."""
        manager = self._plant.fdm.get_property_manager()
        nodes = {name: manager.get_node(name) for name in WEAR}
        return {name: node.get_double_value() for name, node in nodes.items() if node is not None}


class Wheels:
    """Where the hindmost main wheels are, from where the aircraft is: their legs taken as hanging out."""

    def __init__(self, plant: JSBSimPlant, manual: FlightManual) -> None:
        fdm = plant.fdm
        self._above = fdm["position/h-agl-ft"] * FT - plant.state().height
        self._behind = manual.limits["main-wheel-x"] - fdm["inertia/cg-x-in"] * INCH
        self._below = fdm["inertia/cg-z-in"] * INCH - manual.limits["main-wheel-z"]

    def height(self, above_ground: Floats, pitch: Floats) -> Floats:
        """Their height, of State.height and pitch: negative by as much as the legs are compressed."""
        return above_ground + self._above - np.sin(pitch) * self._behind - np.cos(pitch) * self._below


def fly_take_off(
    case: TakeOff, event: Happening = NOTHING, manual: FlightManual | None = None, *, height: float = SCREEN
) -> Flown:
    """Fly `case` until the wheels are at `height` (m), or the aircraft has stopped. Raises InputErrors, FlightError."""
    pilot, plant, track = prepared(case, event, manual)

    def over(state: State) -> bool:
        if pilot.phase == "RTO":
            return hypot(state.velocity_north, state.velocity_east) < STOPPED
        return state.height > height + NOSE_UP

    fly(pilot, plant, observers=(track,), time_limit=TIME_LIMIT, until=over)
    return track.flown(case, case.rotation_speed(pilot.manual))


def prepared(
    case: TakeOff, event: Happening = NOTHING, manual: FlightManual | None = None
) -> tuple[Pilot, JSBSimPlant, Track]:
    """The pilot, the aircraft at the beginning of its take-off and what watches it. Raises InputErrors."""
    manual = manual or read_manual(case.aircraft)
    check(case, manual)
    runway = case.runway(RUNWAY)
    preset, running = lined_up(
        manual.flap(case.flaps).position, IDLE if case.start == "rolling" else TAKE_OFF, case.rate
    )
    if case.surface == "wet":
        preset["ground/surface"] = WET
    if case.friction != 1.0:
        preset["ground/rolling_friction-factor"] = case.friction
    if case.slope:
        preset |= slope(case.slope, case.mass, case.heading)
    pilot, plant = prepare(
        technique.mission(case, event, manual, runway),
        technique.fitted(manual, case, event),
        rate=case.rate,
        pilot_rate=case.pilot_rate,
        runway=runway,
        preset=(preset, running),
        trimmed=False,
        own_rates=True,
    )
    return pilot, plant, Track(plant, pilot)
