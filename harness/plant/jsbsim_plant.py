"""A JSBSim aircraft as a plant: takes Commands, flies some pilot steps of frames, hands back a State."""

from collections.abc import Callable, Mapping, Sequence
from itertools import repeat, starmap
from math import ceil, degrees, nan
from operator import call
from typing import NamedTuple

import jsbsim

from harness.errors import InputError, NumericalError
from harness.loading.balance import Item, combined, four_points
from harness.log import Inputs
from harness.log.inputs import AT_START, BEFORE, Write
from harness.plant.hangar import Sort, fresh, refused
from harness.plant.impact import IMPACT_SINK, impact
from harness.plant.instruments import Instruments
from harness.plant.properties import COMMANDS, PSF, SENSED, STATE
from harness.plant.stance import stance
from harness.state import LOW, MEDIUM_PERIOD, SLOW_PERIOD, Commands, State, rest, rolling_period
from harness.units import FT, LB

INTEGRATORS = {
    # Adams-Bashforth 2 for both rates, Buss 2 for attitude, Adams-Bashforth 3 for position: second order, and quiet
    # on the ground. JSBSim's default rotation is first order (errors of degrees in 30 s of tumbling).
    "simulation/integrator/rate/rotational": 3.0,
    "simulation/integrator/rate/translational": 3.0,
    "simulation/integrator/position/rotational": 7.0,
    "simulation/integrator/position/translational": 4.0,
}
TERRAIN_PERIOD = (
    240  # pilot steps between two looks at the terrain; below LOW its elevation stays what it was
)
MOST_CONTACTS = 32  # gear units and structure contacts an aircraft may have
STANDING_HEIGHT = 4.0  # m, first guess of the CG above the ground; the ground trim finds the true one
GROUND_TRIM = 2.0  # JSBSim's trim mode for an aircraft on its wheels
FIXED, MOVABLE = 1, 5  # point masses: the first of the four that stay, and the first of those that leave
INCH = FT / 12
WARM_UP = 10.0  # s until every sensor shows what it senses: five time constants of the slowest
BELOW_GROUND = -2.0  # m: no strut is that short


class Placement(NamedTuple):
    """Where the aircraft stands at the beginning. Radians; elevation of the ground in metres."""

    latitude: float
    longitude: float
    heading: float
    elevation: float


class Loads(NamedTuple):
    """What is put on board: fuel in each tank (kg), a payload of which only the mass is known, and things with a place.

    Those in `released` can leave in flight, each with the drag area of its extraction parachute, m2.
    """

    fuel: Sequence[float]
    payload: float = 0.0
    fixed: Sequence[Item] = ()
    released: Sequence[tuple[Item, float]] = ()


class Air(NamedTuple):
    """The day: deviation from ISA in K, QNH in Pa, and the velocity of the air towards north and east in m/s."""

    isa_deviation: float
    qnh: float
    north: float
    east: float


class JSBSimPlant:
    """One aircraft, one flight: JSBSim keeps state that no reset clears, so each flight makes its own."""

    def __init__(
        self,
        sort: Sort,
        *,
        frames_per_step: int,
        placement: Placement,
        loads: Loads,
        air: Air,
        terrain: Callable[[float, float], float],
        inputs: Inputs | None = None,
        preset: Sequence[Mapping[str, float]] = (),
        trimmed: bool = True,
    ) -> None:
        """`terrain(latitude, longitude)` is the elevation in metres; `inputs` is filled with all that is written into
        the simulator.

        `preset` are properties to put before the first frame, and before each of the next, which are flown here, see
        harness.plant.preset. Not `trimmed`, the aircraft stands as statics say, see harness.plant.stance.

        Raises InputError when the aircraft cannot be loaded or lacks a property that the pilot needs.
        """
        self._frames = frames_per_step
        self._step = frames_per_step / sort.rate
        self._rolling = rolling_period(self._step)
        self._terrain = terrain
        self._inputs = inputs or Inputs()
        self._inputs.rate, self._inputs.frames_per_step = sort.rate, frames_per_step
        self._wrote = self._inputs.writes.append
        self._steps = BEFORE
        self._aircraft = sort.aircraft
        self._fdm = fresh(sort)
        self._manager = self._fdm.get_property_manager()
        self._initialise(placement, loads, air, trimmed=trimmed)
        for frame, properties in enumerate(preset):
            if frame:
                self._fdm.run()
            for name, value in properties.items():
                self._put(name, value)
        self._true_height = self._node("position/h-agl-ft").get_double_value
        self._standing_height = self._true_height() * FT
        self._bind({})
        self._next_look = MEDIUM_PERIOD  # pilot step at which more than a glance is taken
        self._setters = [[self.setter(name) for name in COMMANDS[field]] for field in Commands._fields]
        shut_down = Commands._fields.index("shut_down")
        self._setters[shut_down] = [_fuel_lever(*engine) for engine in enumerate(self._setters[shut_down])]
        self._set_terrain = self.setter("position/terrain-elevation-asl-ft")
        self._written = Commands(*[nan] * len(Commands._fields))
        self._structure = self._contacts()
        self._run = self._fdm.run
        self._terrain_seen = 0
        self._elevation = placement.elevation
        self._whole_period = SLOW_PERIOD
        self._sink = 0.0
        self._write(Commands())
        self._steps = 0
        self._look(whole=True)

    @property
    def fdm(self) -> jsbsim.FGFDMExec:
        """The simulator itself, for tools that look at more than State."""
        return self._fdm

    def use_sensors(self) -> None:
        """Let State come from the aircraft's sensors from now on, where it has one, if they are on."""
        if self._read("sensor/active"):
            self._fly(round(WARM_UP / self._step))
            self._bind(SENSED)
            self._look(whole=True)

    def state(self) -> State:
        """The aircraft as it is now, renewed in place by `advance`."""
        return self._state

    def advance(self, commands: Commands, steps: int = 1, *, look: bool = False) -> State:
        """Fly `steps` pilot steps under `commands`, no more than `rest` says if State is to be renewed.

        `look` renews all of Motion, whatever is due.
        Raises NumericalError when the state is no longer finite, GroundImpactError when the aircraft hit the ground.
        """
        if commands is not self._written:
            self._write(commands)
        self._fly(steps)
        if look or self._steps >= self._next_look:
            return self._look_around()
        if not self._instruments.glance(self._steps * self._step):
            raise self._not_finite()
        return self._state

    def renew(self) -> None:
        """Renew all of State, whatever was due. Raises NumericalError."""
        self._look(whole=True)

    def _fly(self, steps: int) -> None:
        # `all` calls without a line of Python between two frames, and ends when the aircraft ends the simulation.
        going = all(starmap(self._run, repeat((), steps * self._frames)))
        self._steps += steps
        if not going:
            self._steps = ceil(self._fdm.get_sim_time() / self._step - 1e-6)
        self._inputs.steps = self._steps
        if not going:
            raise self._not_finite()

    def _look_around(self) -> State:
        """Read more of State, and see whether it is still the state of an aircraft."""
        self._look(whole=self._steps % self._whole_period == 0)
        state = self._state
        sink, self._sink = self._sink, -state.vertical_speed
        pause = rest(state, self._steps, self._rolling)
        self._next_look = self._steps + pause
        self._whole_period = self._rolling if pause <= self._rolling else SLOW_PERIOD
        height = self._true_height() * FT - self._standing_height
        if height < LOW:
            struck = any(map(call, self._structure)) or height < BELOW_GROUND
            if struck or (state.main_on_ground and sink > IMPACT_SINK):
                raise impact(state, sink, struck=struck)
        elif self._steps - self._terrain_seen >= TERRAIN_PERIOD:
            self._terrain_seen = self._steps
            elevation = self._terrain(state.latitude, state.longitude)
            if elevation != self._elevation:
                self._elevation = elevation
                self._set_terrain(elevation / FT)
        return state

    def _bind(self, sensed: Mapping[str, str]) -> None:
        """Read State from the true values, but for those that are `sensed` by another property."""
        getters = [self._getter(sensed.get(binding.name, binding.name)) for binding in STATE]
        self._instruments = Instruments(getters, [binding.factor for binding in STATE], self._standing_height)
        self._state = self._instruments.state

    def _look(self, *, whole: bool) -> None:
        if not self._instruments.look(self._steps * self._step, whole=whole):
            raise self._not_finite()

    def _contacts(self) -> list[Callable[[], float]]:
        """Whether each part of the structure touches the ground: fuselage, wing tips, propellers."""
        nodes = [self._manager.get_node(f"contact/unit[{i}]/WOW") for i in range(MOST_CONTACTS)]
        return [node.get_double_value for node in nodes if node is not None]

    def _not_finite(self) -> NumericalError:
        return NumericalError(
            "the state of the aircraft is no longer finite",
            time=self._steps * self._step,
            phase="in the simulator",
            required="finite numbers",
            achieved=", ".join(self._instruments.lost()[:5]),
            knob="look at the last rows of the time history; a mass, inertia or wind out of all bounds does this",
        )

    def _initialise(self, placement: Placement, loads: Loads, air: Air, *, trimmed: bool) -> None:
        put = self._put
        for name, value in INTEGRATORS.items():
            put(name, value)
        # The day before the initial conditions: speeds and heights are converted with it.
        put("atmosphere/delta-T", air.isa_deviation * 1.8)
        put("atmosphere/P-sl-psf", air.qnh / PSF)
        put("ic/terrain-elevation-ft", placement.elevation / FT)
        put("ic/lat-geod-deg", degrees(placement.latitude))
        put("ic/long-gc-deg", degrees(placement.longitude))
        put("ic/psi-true-deg", degrees(placement.heading))
        self._load(loads)
        put("ic/h-agl-ft", STANDING_HEIGHT / FT)
        self._set_initial_conditions()
        if not trimmed:
            standing = stance(self._read)
            put("ic/h-agl-ft", standing.height / FT)
            put("ic/theta-deg", degrees(standing.pitch))
            self._set_initial_conditions()
        self._steps = AT_START
        if trimmed:
            put("simulation/do_simple_trim", GROUND_TRIM)
        put("atmosphere/wind-north-fps", air.north / FT)
        put("atmosphere/wind-east-fps", air.east / FT)

    def _set_initial_conditions(self) -> None:
        try:
            ready = self._fdm.run_ic()
        except jsbsim.BaseError as error:
            raise refused(self._fdm, self._aircraft, str(error)) from error
        if not ready:
            raise InputError("JSBSim could not set the initial conditions")

    def _load(self, loads: Loads) -> None:
        self._put("inertia/pointmass-weight-lbs[0]", loads.payload / LB)
        lump = combined(loads.fixed)
        for i, place in enumerate(four_points(lump) if lump.mass else ()):
            self._put_mass(FIXED + i, lump.mass / 4, place)
        for i, (item, parachute) in enumerate(loads.released):
            self._put_mass(MOVABLE + i, item.mass, (item.x, item.y, item.z))
            self._put(f"payload/parachute-m2[{i}]", parachute)
        for i, contents in enumerate(loads.fuel):
            self._put(f"propulsion/tank[{i}]/contents-lbs", contents / LB)

    def _put_mass(self, number: int, mass: float, place: tuple[float, float, float]) -> None:
        self._put(f"inertia/pointmass-weight-lbs[{number}]", mass / LB)
        for axis, value in zip("XYZ", place, strict=True):
            self._put(f"inertia/pointmass-location-{axis}-inches[{number}]", value / INCH)

    def _write(self, commands: Commands) -> None:
        written = self._written
        for i in _MOVING if commands[_STANDING:] == written[_STANDING:] else _EVERY:
            value = commands[i]
            if value != written[i]:
                for setter in self._setters[i]:
                    setter(value)
        self._written = commands

    def _read(self, name: str) -> float:
        return self._node(name).get_double_value()

    def _put(self, name: str, value: float) -> None:
        self.setter(name)(value)

    def _node(self, name: str) -> jsbsim.FGPropertyNode:
        node = self._manager.get_node(name)
        if node is None:
            raise InputError(
                f"the aircraft has no property {name}", remedy="systems/ shows how the others provide it"
            )
        return node

    def _getter(self, name: str) -> Callable[[], float]:
        node = self._node(name)
        return node.get_double_value

    def setter(self, name: str) -> Callable[[float], object]:
        """What writes a property. Raises InputError when there is no such property, or it cannot be written."""
        node = self._node(name)
        if not node.get_attribute(jsbsim.Attribute.WRITE):
            raise InputError(f"property {name} cannot be written")
        put, wrote = node.set_double_value, self._wrote

        def write(value: float) -> None:
            wrote(Write(self._steps, name, value))
            put(value)

        return write


_STANDING = Commands._fields.index("vertical")  # from here on commands change by procedures only
_EVERY = range(len(Commands._fields))
_MOVING = range(_STANDING)


def _fuel_lever(engine: int, run: Callable[[float], object]) -> Callable[[float], object]:
    """What opens or closes the fuel of one engine, from the sum that tells which are shut down."""
    return lambda shut_down: run(float(not int(shut_down) >> engine & 1))
