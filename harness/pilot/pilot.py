"""The mathematical pilot: reads checklists, carries out procedures, and flies with the modes they select (Fig. 2)."""

from collections.abc import Callable, Mapping, Sequence
from math import hypot, inf, nan
from typing import NamedTuple

from harness.errors import OverrunError, StuckError
from harness.log.run import Event
from harness.manual import FlightManual
from harness.mission.model import Leg, Mission
from harness.navigation.database import Ils, Runway
from harness.numerics import approach, clamp, quantised, wrap
from harness.pilot.checklist import Item, OpenChecklist, item, prepared
from harness.pilot.ground import Centreline, GroundSteering, TaxiPath
from harness.pilot.machine import END, START, PhaseGraph
from harness.pilot.modes.horizontal import HorizontalMode
from harness.pilot.modes.speed import SpeedMode
from harness.pilot.modes.vertical import VerticalMode
from harness.pilot.route import NavigationComputer, Passage
from harness.plan import Step
from harness.plan_reader import parse_reference
from harness.state import MEDIUM_PERIOD, Commands, State, close_to_ground
from harness.units import parse
from harness.vocabulary import CONTROLS
from harness.world.local import LocalFrame

FAST = frozenset({"time-in-phase", "vertical-speed", "pitch"})
"""Quantities renewed at every pilot step; what waits for another one is read when the outer loops turn."""
ROUTE_TURNS = 2  # turns of the outer loops between two looks at the route, far from the next waypoint
NEAR_WAYPOINT = 15000.0  # m: more than the lead of any turn
LEVEL_REACHED = 30.0  # m: a level this near is captured however slowly it is approached
DEFAULT_TIME_LIMIT = 7200.0  # s in one phase, where the manual says nothing
OVERRUN_MARGIN = 5.0  # m past the end or the edge of the runway


class _ReadyStep(NamedTuple):
    """A procedure step with its conditions looked up."""

    step: Step
    when: tuple[Item, ...]


class Pilot:
    """Flies one mission with one flight manual. `act` is called once a pilot step and remembers what it needs."""

    def __init__(
        self, mission: Mission, manual: FlightManual, departure: Runway, arrival: Ils, step: float
    ) -> None:
        """`step` is the time between two calls of `act`, s."""
        self.mission = mission
        self.manual = manual
        self.step = step
        gains = dict(manual.gains)
        self.route = NavigationComputer(mission.legs, arrival, mission.environment.qnh, gains["bank-limit"])
        self.route.on_passage = self._passed
        self.speed_mode = SpeedMode(gains)
        self.vertical = VerticalMode(gains, step)
        self.horizontal = HorizontalMode(gains)
        self.steering = GroundSteering(gains)
        self.controls = dict.fromkeys(CONTROLS, "DIRECT")
        self.inner = "AIRCRAFT"
        self.phase_begin = 0.0
        self.target_cas = 0.0
        self.taxi_distance = inf
        self.level_error = 0.0  # height of the wanted level above the aircraft, m
        self.listeners: list[Callable[[Event], None]] = []
        self._graph = PhaseGraph()
        self.phase = START
        self.done = False  # the mission is complete
        self._departure = departure
        self._arrival = arrival.runway
        self._runway = departure
        self._centreline = Centreline(departure.latitude, departure.longitude, departure.true_heading)
        self._taxi: TaxiPath | None = None
        self._settings = Commands()
        self._braking = 0.0  # taxi brakes
        self._wheel = 0.0
        self._rudder = 0.0
        self._coordinate = 0.0
        self._speed_words = "leg-speed"
        self._speed_value = 0.0
        self._pending: list[_ReadyStep] = []
        self._checklists: Sequence[OpenChecklist] = ()
        self._deadline = inf
        self._period = 1
        self._route_turns = 0
        self._airborne_route = False
        self._approaching = False
        self._bank = 0.0
        self._wanted_path = 0.0
        self._begun = False
        self._countdown = 1  # pilot steps until the outer loops turn
        self._alert = False
        self._commands = self._settings
        self._modes: dict[str, str] = {}
        self._state: State | None = None
        self._rename_modes()

    @property
    def modes(self) -> Mapping[str, str]:
        """Each super-mode with its sub-mode."""
        return self._modes

    @property
    def targets(self) -> Mapping[str, float]:
        """What the pilot aims at, SI; NaN where nothing is aimed at."""
        airborne = self._airborne_route
        return {
            "cas": self.target_cas if self.speed_mode.sub_mode != "OFF" else nan,
            "level": self.route.leg.level.altitude if airborne else nan,
            "level_error": self.level_error if airborne else nan,
            "cross_track": self.route.guidance.cross_track if airborne else nan,
            "localizer_dots": self.route.localizer.dots if self._approaching else nan,
            "glide_slope_dots": self.route.glide_slope.dots if self._approaching else nan,
            "distance_to_go": self.route.distance_to_go if airborne else nan,
        }

    @property
    def waiting(self) -> Sequence[tuple[str, Sequence[Item]]]:
        """For each way out of the phase, the checklist items that are still open."""
        if self._state is None:
            return ()
        return [(checklist.to, checklist.waiting(self._state)) for checklist in self._checklists]

    def act(self, state: State) -> Commands:
        """Decide, from the aircraft's state, what to command now.

        Raises StuckError when a phase lasts too long, OverrunError when the runway has been left.
        """
        self._state = state
        self._countdown -= 1
        if self._countdown > 0 and not self._alert:
            commands = self._commands
            pitch = self.vertical.fly(state.vertical_speed, state.pitch)
            if pitch != commands.pitch:
                commands = self._commands = Commands(commands.throttle, pitch, *commands[2:])
            return commands
        return self._act_fully(state)

    def _act_fully(self, state: State) -> Commands:
        outer = self._countdown <= 0
        if outer:
            if not self._begun:
                self._begun = True
                self._enter(START, state, "start of the mission")
            self._navigate(state)
            self.level_error = self.route.level - state.pressure_altitude
        for checklist in self._checklists:
            if checklist.complete(state):
                self._proceed(checklist, state)
                break
        else:
            if state.time > self._deadline:
                self._give_up(state)
        while self._pending and all(entry.holds(state) for entry in self._pending[0].when):
            self.carry_out(self._pending.pop(0).step, state)
            self._watch()
        if outer:
            period = 1 if close_to_ground(state.height, state.cas) else MEDIUM_PERIOD
            self._turn_outer_loops(state, self._period * self.step)
            self._countdown = self._period = period
        self._commands = self._control(state)
        return self._commands

    def _watch(self) -> None:
        """Note whether anything waited for changes faster than the outer loops turn."""
        waited = [entry for checklist in self._checklists for entry in checklist.items]
        if self._pending:
            waited.extend(self._pending[0].when)
        self._alert = any(entry.condition.quantity in FAST for entry in waited)

    # What conditions measure.

    def level_captured(self, state: State) -> bool:
        """Whether the wanted level is near enough to round out towards it."""
        reach = abs(state.vertical_speed) * self.manual.gains["level-time-constant"]
        return abs(self.level_error) <= max(reach, LEVEL_REACHED)

    def runway_offset(self, state: State) -> tuple[float, float]:
        """Return (metres past the threshold, metres right of the centreline) of the runway in use."""
        return self._centreline.offset(state)

    def heading_error(self, state: State) -> float:
        """Angle from the runway's direction to the nose."""
        return wrap(state.heading - self._centreline.heading)

    def named_speed(self, name: str, mass: float) -> float:
        """A speed or speed limit of the flight manual, m/s CAS."""
        return self.manual.limits[name] if name in self.manual.limits else self.manual.speed(name, mass)

    # Procedures.

    def carry_out(self, step: Step, state: State) -> None:
        """Do one step of a procedure."""
        action = step.action
        if "set" in action:
            self._set(action["set"], action["to"], state)
        else:
            self._select(action, state)
        words = " ".join(f"{key}={value}" for key, value in action.items())
        self._note("procedure", step.name, words)

    def _set(self, name: str, to: str, state: State) -> None:
        if name == "thrust":
            lever = self.manual.thrust[to]
            self.speed_mode.lever = lever
            self.speed_mode.highest_lever = max(lever, self.manual.thrust["climb"])
        elif name == "flaps":
            self._settings = self._settings._replace(flap=self.manual.flap(to).position)
        elif name == "gear":
            self._settings = self._settings._replace(gear=float(to == "down"))
        elif name == "course":
            self.horizontal.track = self._centreline.heading
        else:
            field = {"ground-spoilers": "spoiler", "brakes": "brake"}.get(name, name)
            self._settings = self._settings._replace(**{field: parse(to, "ratio")})

    def _select(self, action: Mapping[str, str], state: State) -> None:
        mode, to = action["mode"], action["to"]
        if mode == "CTRL":
            self.controls[action["control"]] = to
            if action["control"] == "thrust" and to == "DIRECT":
                self.speed_mode.select("OFF")
        elif mode == "INN":
            self.inner = to
        elif mode == "SPD":
            self.speed_mode.select(to)
            self.controls["thrust"] = "CONTROLLER" if to == "THR" else "DIRECT"
            if to != "OFF":
                self._aim_speed(action["speed"], state.mass)
        elif mode == "HP":
            self.horizontal.select(to, state)
            self.horizontal.guidance = action.get("guidance", "")
            if to == "ATT":
                self.horizontal.bank = parse(action["bank"], "angle")
            elif to == "PATH":
                self._aim_track(action["track"], state)
            self.controls["aileron"] = "CONTROLLER"
        else:
            self.vertical.select(to, state)
            self.vertical.guidance = action.get("guidance", "")
            if to == "ATT":
                self.vertical.attitude = parse(action["pitch"], "angle")
            elif to == "PATH":
                self._aim_path(action)
            self.controls["elevator"] = "CONTROLLER"
        self._rename_modes()

    def _aim_speed(self, words: str, mass: float) -> None:
        self._speed_words = words
        if words not in ("leg-speed", "taxi"):
            reference = parse_reference(words, "speed-target")
            named = self.named_speed(reference.name, mass) if reference.name else 0.0
            self._speed_value = named + reference.offset

    def _aim_track(self, words: str, state: State) -> None:
        if words == "runway":
            self.horizontal.track = self._centreline.heading
        elif words == "present":
            self.horizontal.track = state.heading
        else:
            self.horizontal.track = parse(words, "angle")

    def _aim_path(self, action: Mapping[str, str]) -> None:
        self.vertical.vertical_speed = None
        if "vertical-speed" in action:
            self.vertical.vertical_speed = parse(action["vertical-speed"], "vertical-speed")
        elif action["angle"] in ("by-speed", "flare"):
            self.vertical.angle = action["angle"]
        else:
            self.vertical.angle = parse(action["angle"], "angle")

    # Phases.

    def _proceed(self, checklist: OpenChecklist, state: State) -> None:
        for entry in checklist.items:
            reason = f"{entry.achieved(state)}, {entry.wanted(state)}"
            self._note("checklist", entry.condition.name, reason)
        self._graph.enter(checklist.to)
        names = ", ".join(entry.condition.name for entry in checklist.items)
        self._enter(checklist.to, state, names)

    def _enter(self, phase: str, state: State, reason: str) -> None:
        self.phase = phase
        self.done = phase == END
        self.phase_begin = state.time
        self._note("phase", phase, reason)
        if phase.startswith(("APP", "LDG")) and self._runway is not self._arrival:
            self._use_runway(self._arrival)
        if phase.startswith("TXY"):
            self._plan_taxi(phase, state)
        plan = self.manual.phases.get(phase)
        self._pending = []
        self._checklists = ()
        self._deadline = state.time + self.manual.gains.get(f"time-limit {phase}", DEFAULT_TIME_LIMIT)
        self._airborne_route = phase.startswith(("DEP", "ENR", "M/A", "APP"))
        self._approaching = phase.startswith(("APP", "LDG"))
        self.level_error = self.route.level - state.pressure_altitude
        if plan is not None:
            self._pending = [
                _ReadyStep(step, tuple(item(when, self, state.mass) for when in step.when))
                for step in plan.steps
            ]
            self._checklists = [prepared(checklist, self, state.mass) for checklist in plan.checklists]
        self._watch()

    def _use_runway(self, runway: Runway) -> None:
        self._runway = runway
        self._centreline = Centreline(runway.latitude, runway.longitude, runway.true_heading)
        self.steering.reset()

    def _plan_taxi(self, phase: str, state: State) -> None:
        out = phase == "TXY.out"
        points = self.mission.departure.taxi if out else self.mission.arrival.taxi
        stand = None if out else self.mission.arrival.stand
        ends = [*points, *([(stand.latitude, stand.longitude)] if stand else [])]
        if not ends:
            self._taxi, self.taxi_distance = None, 0.0
            return
        frame = LocalFrame(state.latitude, state.longitude)
        corners = [frame.point(state.latitude, state.longitude), *(frame.point(*point) for point in ends)]
        gains = self.manual.gains
        self._taxi = TaxiPath(frame, corners, gains["taxi-turn-radius"], gains["taxi-speed"])

    def _give_up(self, state: State) -> None:
        # Of several ways out, the one with the fewest open items is the one the flight was on.
        ways = [checklist.waiting(state) for checklist in self._checklists]
        open_items = min(ways, key=len) if ways else []
        first = open_items[0] if open_items else None
        raise StuckError(
            f"not over after {state.time - self.phase_begin:.0f} s",
            time=state.time,
            phase=self.phase,
            waiting=first.condition.name if first else "",
            required=first.wanted(state) if first else "",
            achieved=first.achieved(state) if first else "",
            knob=f"{first.condition.file}:{first.condition.line} states the item; change it, the mass or the thrust"
            if first
            else "",
        )

    def _passed(self, leg: Leg, passage: Passage) -> None:
        self._note("waypoint", leg.name, f"{leg.mode}, {leg.speed}, {leg.level}")
        for step in leg.actions:
            if self._state is not None:
                self.carry_out(step, self._state)

    # Flying.

    def _navigate(self, state: State) -> None:
        if self._approaching:
            self.route.update_approach(state)
        elif self._airborne_route:
            if self.route.waypoints_remaining:
                # Far from a waypoint nothing on the route changes fast.
                self._route_turns -= 1
                if self._route_turns <= 0 or self.route.remaining < NEAR_WAYPOINT:
                    self._route_turns = ROUTE_TURNS
                    self.route.update(state)
            else:
                self.route.update_approach(state)

    def _control(self, state: State) -> Commands:
        pitch = self.vertical.fly(state.vertical_speed, state.pitch)
        lever, settings = self.speed_mode.lever, self._settings
        brake = self._braking if self._taxiing else settings.brake
        return Commands(
            lever,
            pitch,
            self._bank,
            self._rudder,
            self._wheel,
            brake,
            self._pitch_hold,
            settings.elevator,
            self._bank_hold,
            settings.aileron,
            self._coordinate,
            settings.flap,
            settings.gear,
            settings.speedbrake,
            settings.spoiler,
        )

    def _turn_outer_loops(self, state: State, dt: float) -> None:
        """Renew what moves slowly; `dt` is the time since the last turn."""
        speed = self.speed_mode
        words = self._speed_words
        self.target_cas = self.route.target_cas if words == "leg-speed" else self._speed_value
        self._bank = quantised(self.horizontal.update(state, self.route.guidance))
        speed.observe(state, dt)
        if speed.sub_mode == "PITCH":
            self._wanted_path = speed.path(state, self.target_cas)
        elif speed.sub_mode == "THR" and not self._taxiing:
            speed.update(state, self.target_cas, self.vertical.path_error(state), dt)
        wheel, rudder, self._coordinate = 0.0, self._settings.rudder, 0.0
        if self._taxiing:
            wheel = self._taxi_along(state, dt)
        elif self._steering:
            wheel, rudder = self._along_runway(state, dt)
        elif self._coordinated:
            self._coordinate = 1.0
        self._wheel, self._rudder = quantised(wheel), quantised(rudder)
        route = self.route
        self.vertical.aim(
            state, self.level_error, route.glide_slope, route.distance_to_threshold, self._wanted_path
        )

    def _along_runway(self, state: State, dt: float) -> tuple[float, float]:
        """Return (nose wheel, rudder) that keep the centreline."""
        along, across = self._centreline.offset(state)
        if not state.main_on_ground:
            return 0.0, self.steering.align(state, self._centreline.heading)
        if (
            along > self._runway.length + OVERRUN_MARGIN
            or abs(across) > 0.5 * self._runway.width + OVERRUN_MARGIN
        ):
            end = along > self._runway.length + OVERRUN_MARGIN
            raise OverrunError(
                f"left the {'end' if end else 'side'} of runway {self._runway.airport} {self._runway.designator}",
                time=state.time,
                phase=self.phase,
                achieved=f"{along:.0f} m past the threshold, {across:.0f} m right of the centreline",
                required=f"within {self._runway.length:.0f} m and {0.5 * self._runway.width:.0f} m",
                knob="less mass, a longer runway, or more brake",
            )
        return self.steering.hold_line(state, self._centreline.heading, across, dt)

    def _taxi_along(self, state: State, dt: float) -> float:
        """Set lever and brakes for the speed the taxi path allows, and return the nose wheel."""
        gains = self.manual.gains
        speed = hypot(state.velocity_north, state.velocity_east)
        wheel, allowed = 0.0, 0.0
        if self._taxi is not None:
            look_ahead = max(gains["taxi-look-ahead"], 2.0 * speed)
            error, allowed, self.taxi_distance = self._taxi.follow(state, look_ahead)
            wheel, _ = self.steering.pursue(state, error, look_ahead)
            if self._taxi.finished:
                allowed = 0.0
        self.target_cas = allowed
        excess = speed - allowed
        lever = clamp(-excess * gains["taxi-lever-gain"], 0.0, gains["taxi-lever-limit"])
        self.speed_mode.lever = quantised(approach(self.speed_mode.lever, lever, 0.1 * dt))
        wanted = clamp(excess * gains["taxi-brake-gain"], 0.0, 0.5) if allowed > 0.0 else 0.4
        self._braking = quantised(approach(self._braking, wanted, 0.5 * dt))
        return wheel

    def _rename_modes(self) -> None:
        self._taxiing = self.speed_mode.sub_mode == "THR" and self._speed_words == "taxi"
        self._steering = self.controls["steering"] == "CONTROLLER"
        self._coordinated = self.controls["rudder"] == "CONTROLLER"
        self._pitch_hold = float(self.controls["elevator"] == "CONTROLLER")
        self._bank_hold = float(self.controls["aileron"] == "CONTROLLER")
        direct = [name for name, owner in self.controls.items() if owner == "DIRECT"]
        vertical = self.vertical
        path = "V/S" if vertical.vertical_speed is not None else vertical.angle
        names = {
            "CTRL": f"direct: {' '.join(direct)}" if direct else "controller",
            "INN": self.inner,
            "SPD": self.speed_mode.sub_mode,
            "HP": f"{self.horizontal.sub_mode} {self.horizontal.guidance}".strip(),
            "VP": f"{vertical.sub_mode} {vertical.guidance}".strip(),
        }
        if vertical.sub_mode == "PATH":
            names["VP"] = f"PATH {path}" if isinstance(path, str) else "PATH"
        for name, sub_mode in names.items():
            if self._modes and self._modes[name] != sub_mode:
                self._note("mode", f"{name} {sub_mode}", f"was {self._modes[name]}")
        self._modes = names

    def _note(self, kind: str, name: str, reason: str) -> None:
        event = Event(self._state.time if self._state else 0.0, kind, name, self.phase, reason)
        for listener in self.listeners:
            listener(event)
