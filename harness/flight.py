"""fly_mission: the only place that knows both the pilot and the plant."""

from collections.abc import Callable, Mapping, Sequence
from math import cos, sin
from typing import Protocol

from harness.errors import FlightError, InputError, TimeLimitError
from harness.instructor import Instructor, check_kept, configure
from harness.loading.aircraft import read_stowage
from harness.log import Event, Inputs, Reporter
from harness.manual import FlightManual
from harness.mission.model import Mission
from harness.navigation.database import Ils, Runway, load
from harness.pilot.pilot import Pilot
from harness.plant.hangar import Sort
from harness.plant.jsbsim_plant import Air, JSBSimPlant, Loads, Placement
from harness.plant.properties import PILOT_GAINS
from harness.resources import root
from harness.state import Commands, State
from harness.world import earth

PILOT_RATE = 24  # pilot steps a second
RATES = (30, 60, 120, 240, 480)  # frames a second
TIME_LIMIT = 8 * 3600.0  # s: longer than the fuel of a transport aircraft of this class lasts at low level
LINE_UP = 30.0  # m past the threshold, where a mission without a stand begins


class Observer(Protocol):
    """Sees every event and what the pilot does; can change nothing."""

    def see(self, state: State, commands: Commands, pilot: Reporter) -> None:
        """Called at each pilot step at which the pilot acts: all near the runway, one or two a second elsewhere."""

    def note(self, event: Event) -> None:
        """Called when something happens, before the step it happens in is seen."""


def fly_mission(
    mission: Mission,
    manual: FlightManual,
    *,
    rate: int = 120,
    observers: Sequence[Observer] = (),
    time_limit: float = TIME_LIMIT,
    inputs: Inputs | None = None,
) -> str:
    """Fly `mission` from its beginning until the pilot is done, and return how it ended, one of `vocabulary.OUTCOMES`.

    `rate` is frames a second, one of RATES; `inputs` is filled with all that is written into the simulator.
    Raises FlightError when the flight cannot go on.
    """
    pilot, plant = prepare(mission, manual, rate=rate, inputs=inputs)
    fly(pilot, plant, observers=observers, time_limit=time_limit)
    check_kept(plant, mission.properties)
    return pilot.outcome


def never(state: State) -> bool:  # noqa: ARG001  as `until` of `fly`
    """Whether a flight is to end before its mission does: no."""
    return False


def fly(
    pilot: Pilot,
    plant: JSBSimPlant,
    *,
    observers: Sequence[Observer] = (),
    time_limit: float = TIME_LIMIT,
    until: Callable[[State], bool] = never,
) -> None:
    """Fly until the pilot is done, or `until` says so. Raises FlightError when the mission cannot be completed."""
    pilot.listeners.extend(observer.note for observer in observers)
    instructor = Instructor(pilot, plant, pilot.tell)
    watch = [observer.see for observer in observers]
    state = plant.state()
    beyond = int(time_limit / pilot.step) + 1  # the first step later than the limit
    try:
        while not pilot.done and not until(state):
            if instructor.waiting:
                instructor.act(state)
            commands = pilot.act(state)
            for see in watch:
                see(state, commands, pilot)
            rest = 1 if instructor.waiting else pilot.rest
            look = pilot.turns_next and rest == pilot.rest
            state = plant.advance(commands, min(rest, beyond - round(state.time / pilot.step)), look=look)
            if state.time > time_limit:
                raise TimeLimitError(
                    f"still flying after {time_limit:.0f} s", time=state.time, phase=pilot.phase
                )
        plant.renew()  # what is recorded at the end is the end
    except FlightError as error:
        error.phase = pilot.phase
        raise


def prepare(
    mission: Mission,
    manual: FlightManual,
    *,
    rate: int,
    pilot_rate: int = PILOT_RATE,
    runway: Runway | None = None,
    preset: Sequence[Mapping[str, float]] = (),
    inputs: Inputs | None = None,
    trimmed: bool = True,
    own_rates: bool = False,
) -> tuple[Pilot, JSBSimPlant]:
    """Make the pilot and the plant of a mission, ready for the first step.

    `pilot_rate` is pilot steps a second, a divisor of `rate`. `runway`, one that need not be in the database,
    replaces both of the mission's; `preset` are properties of the aircraft to put before the first frames
    (harness.plant.preset). `trimmed` False is for the aircraft whose brakes are held anyway until it stands still: see
    JSBSimPlant; `own_rates` is that of harness.plant.hangar.Sort. Raises InputError.
    """
    if rate not in RATES:
        raise InputError(f"{rate} frames a second are not possible", remedy=f"choose one of {RATES}")
    if rate % pilot_rate:
        raise InputError(f"a pilot does not look {pilot_rate} times a second at {rate} frames a second")
    manual = manual.with_mission(mission)
    departure, arrival = (runway, runway) if runway else _runways(mission)
    empty = manual.limits["operating-empty-mass"]
    day = mission.environment
    plant = JSBSimPlant(
        Sort(root(), mission.aircraft, rate, own_rates),
        frames_per_step=rate // pilot_rate,
        placement=_placement(mission, departure),
        loads=_loads(mission, empty),
        air=Air(
            day.isa_deviation,
            day.qnh,
            -day.wind_speed * cos(day.wind_from),
            -day.wind_speed * sin(day.wind_from),
        ),
        terrain=_Terrain(departure, arrival),
        inputs=inputs,
        preset=preset,
        trimmed=trimmed,
    )
    configure(plant, [*manual.chosen(mission.configuration), *mission.properties])
    for gain, name in PILOT_GAINS.items():
        plant.setter(name)(manual.gains[gain])
    plant.use_sensors()
    return Pilot(mission, manual, departure, Ils(arrival), 1.0 / pilot_rate), plant


def _runways(mission: Mission) -> tuple[Runway, Runway]:
    database = load()
    return (
        database.runway(mission.departure.airport, mission.departure.runway),
        database.runway(mission.arrival.airport, mission.arrival.runway),
    )


def _loads(mission: Mission, empty_mass: float) -> Loads:
    loading, released = mission.loading, mission.released
    fuel = [item.mass for item in read_stowage(mission.aircraft).fuel(loading.fuel)]
    if not loading.items:
        return Loads(fuel, loading.payload_of(empty_mass))
    pallets = {pallet.item.name: pallet for pallet in loading.pallets}
    return Loads(
        fuel,
        fixed=[item for item in loading.items if item.name not in released],
        released=[(pallets[name].item, pallets[name].parachute) for name in released],
    )


def _placement(mission: Mission, runway: Runway) -> Placement:
    stand = mission.departure.stand
    if stand is not None:
        return Placement(stand.latitude, stand.longitude, stand.heading, runway.elevation)
    latitude, longitude = runway.point(LINE_UP)
    return Placement(latitude, longitude, runway.true_heading, runway.elevation)


class _Terrain:
    """The ground at the elevation of the nearer of the two runways: flat at each airport."""

    def __init__(self, departure: Runway, arrival: Runway) -> None:
        self._departure = departure
        self._arrival = arrival

    def __call__(self, latitude: float, longitude: float) -> float:
        nearest = min(
            (self._departure, self._arrival),
            key=lambda runway: earth.inverse(latitude, longitude, runway.latitude, runway.longitude)[2],
        )
        return nearest.elevation
