"""The mathematical pilot: reads checklists, carries out procedures, and flies with the modes they select (Fig. 2)."""

from collections.abc import Callable, Mapping, Sequence
from math import ceil, hypot, inf, nan

from harness.errors import StuckError
from harness.log.run import Event
from harness.manual import FlightManual
from harness.mission.model import Leg, Mission
from harness.navigation.database import Ils, Runway
from harness.numerics import wrap
from harness.pilot.balance import BalanceWatch
from harness.pilot.checklist import Item, Number, OpenChecklist, item, prepared
from harness.pilot.control import ControlSystem
from harness.pilot.go_around import circuit
from harness.pilot.machine import END, START, PhaseGraph
from harness.pilot.procedure import SAME_MOMENT, Procedure, ReadyStep
from harness.pilot.route import NavigationComputer
from harness.plan import Emergency, Step
from harness.state import Commands, State, rest, rolling_period
from harness.units import show
from harness.vocabulary import OUTCOMES

FAST = frozenset({"vertical-speed", "pitch"})
"""Quantities looked at in every pilot step by whoever waits for them; others when the outer loops turn."""
QUICKEST = 10.0  # m/s2: neither engines nor brakes change the airspeed on the runway faster
ROUTE_PERIOD = 48  # pilot steps between two looks at the route, far from the next waypoint
NEAR_WAYPOINT = 15000.0  # m: more than the lead of any turn
LEVEL_REACHED = 30.0  # m: a level this near is captured however slowly it is approached
DEFAULT_TIME_LIMIT = 7200.0  # s in one phase, where the manual says nothing


class Pilot:
    """Flies one mission with one flight manual. `act` is called when `rest` is over and remembers what it needs."""

    def __init__(
        self, mission: Mission, manual: FlightManual, departure: Runway, arrival: Ils, step: float
    ) -> None:
        """`step` is the shortest time between two calls of `act`, s."""
        self.mission = mission
        self.manual = manual
        self.step = step
        self.route = NavigationComputer(
            mission.legs, departure, arrival, mission.environment.qnh, manual.gains["bank-limit"]
        )
        self.route.on_passage = self._passed
        self.route.on_reception = self._heard
        inner_modes = any(setting.inner_modes for setting in manual.chosen(mission.configuration))
        self.control = ControlSystem(manual, self.route, departure, mission.released, inner_modes=inner_modes)
        self.phase = START
        self.phase_begin = 0.0
        self.done = False
        self.approaches = 0  # that were missed
        self.outcome = ""  # how the flight ended, one of OUTCOMES
        self.level_error = 0.0  # height of the wanted level above the aircraft, m
        self.modes: Mapping[str, str] = self.control.modes
        self.listeners: list[Callable[[Event], None]] = []
        self._balance = BalanceWatch(manual.balance)
        self._graph = PhaseGraph()
        self._arrival: Runway | None = arrival.runway  # until it is in use
        self._procedures: list[Procedure] = [Procedure((), self, 0.0, 0.0)]  # of the phase, of emergencies
        self._emergencies: list[tuple[Emergency, tuple[Item, ...]]] = []  # that have not come up
        self._recognition_time = manual.gains["recognition-time"]
        self._reaction_time = manual.gains["reaction-time"]
        self._warning = 0.0  # engines that show as failed
        self._warned_at = 0.0
        self._checklists: Sequence[OpenChecklist] = ()
        self._deadline = inf
        self._airborne_route = False
        self._approaching = False
        self._on_runway = False
        self._alert = False  # something waited for changes at every step
        self._moments: list[float] = []  # times that are waited for, s
        self._speeds: list[Number] = []  # CAS that are waited for, m/s
        self._steps = 0  # of the pilot, since the first frame
        self._turn = 0  # the step at which the outer loops turn
        self._next = 0  # the step at which something is to be done
        self._rolling = rolling_period(step)
        self._period = 1
        self._route_rest = 0
        self._commands = Commands()
        self._state: State | None = None

    @property
    def targets(self) -> Mapping[str, float]:
        """What the pilot aims at, SI; NaN where nothing is aimed at."""
        airborne = self._airborne_route
        levelled = airborne and self.phase != "APP.final"
        return {
            "cas": self.control.target_cas if self.control.speed.sub_mode != "OFF" else nan,
            "level": self.route.leg.level.altitude if levelled else nan,
            "level_error": self.level_error if levelled else nan,
            "cross_track": self.route.guidance.cross_track if airborne else nan,
            "localizer_dots": self.route.localizer.dots if self._approaching else nan,
            "glide_slope_dots": self.route.glide_slope.dots if self._approaching else nan,
            "distance_to_go": self.route.distance_to_go,
        }

    @property
    def waiting(self) -> str:
        """What the pilot waits for: the first open item of the checklist that is nearest to complete."""
        item = self._open_item()
        if item is None or self._state is None:
            return ""
        return f"{item.condition.name}: {item.achieved(self._state)}, {item.wanted(self._state)}"

    def _open_item(self) -> Item | None:
        if self._state is None:
            return None
        ways = [checklist.waiting(self._state) for checklist in self._checklists]
        return min((items for items in ways if items), key=len, default=[None])[0]

    @property
    def rest(self) -> int:
        """Pilot steps from the last call of `act` until it has to be called again."""
        return max(self._next - self._steps, 1)

    @property
    def turns_next(self) -> bool:
        """Whether the outer loops turn at the next call: they need all of Motion."""
        return self._next >= self._turn

    def act(self, state: State) -> Commands:
        """Decide, from the aircraft's state, what to command now.

        Raises StuckError when a phase lasts too long, OverrunError when the runway has been left.
        """
        self._steps = round(state.time / self.step)
        if self._steps >= self._next:
            self._decide(state)
            self._next = self._next_look(state)
        return self._commands

    def _decide(self, state: State) -> None:
        outer = self._steps >= self._turn
        if outer:
            self._look_around(state)
        for checklist in self._checklists:
            if checklist.complete(state):
                self._proceed(checklist, state)
                break
        else:
            if state.time > self._deadline:
                self._give_up(state)
        for procedure in self._procedures:
            while procedure.steps and (ready := procedure.due(state)) is not None:
                self._carry_out(ready, state)
                self._watch()
        if outer:
            self.control.turn_outer_loops(state, self.level_error, self._period * self.step)
            if state.main_on_ground and self._on_runway:
                self.control.runway.check(state, self.phase)
            self._period = self._until_turn(state)
            self._turn = self._steps + self._period
        self._commands = self.control.command(state.time)

    def _until_turn(self, state: State) -> int:
        """Steps until the outer loops turn: no later than the next waypoint is passed."""
        period = rest(state, self._steps, self._rolling)
        if self._airborne_route and self.route.waypoints_remaining and self.route.until_passage > 0.0:
            speed = max(hypot(state.velocity_north, state.velocity_east), 1.0)
            period = max(min(period, int(self.route.until_passage / speed / self.step)), 1)
        return period

    def _next_look(self, state: State) -> int:
        """The step at which the outer loops turn, or something before it is waited for."""
        if self._alert:
            return self._steps + 1
        step = self._turn
        soonest, now = step * self.step, state.time - SAME_MOMENT
        for moment in (*self._moments, *[procedure.ready_at for procedure in self._procedures]):
            if now <= moment < soonest:
                soonest, step = moment, ceil(moment / self.step - SAME_MOMENT)
        if self._speeds and self._on_runway and state.main_on_ground:
            gap = min([abs(speed(state) - state.cas) for speed in self._speeds])
            step = min(step, self._steps + int(gap / (QUICKEST * self.step)))
        return max(step, self._steps + 1)

    def _look_around(self, state: State) -> None:
        """Renew what is known of route, level and engines."""
        if self._state is None:
            self._state = state
            self._emergencies = [
                (emergency, tuple(item(condition, self, state.mass) for condition in emergency.when))
                for emergency in self.manual.emergencies
            ]
            self._enter(START, state, "start of the mission")
        self._navigate(state)
        self.level_error = self.route.level - state.pressure_altitude
        if balance := self._balance.change(state):
            self._note("limit", "centre of gravity", balance)
        if state.engines_failed != self.control.failed_engines:
            self._recognise(state)
        for emergency, when in self._emergencies:
            if all(entry.holds(state) for entry in when):
                self._declare(emergency, when, state)
                break

    def _watch(self) -> None:
        """Note whether anything waited for changes faster than the outer loops turn."""
        waited = [entry for checklist in self._checklists for entry in checklist.items]
        for procedure in self._procedures:
            if procedure.steps:
                waited.extend(procedure.steps[0].when)
        self._alert = any(entry.condition.quantity in FAST for entry in waited)
        begin = {"time": 0.0, "time-in-phase": self.phase_begin}
        self._moments = [
            begin[entry.condition.quantity] + entry.required(self._state)
            for entry in waited
            if entry.condition.quantity in begin and self._state is not None
        ]
        self._speeds = [entry.required for entry in waited if entry.condition.quantity == "cas"]

    # What conditions measure.

    def level_captured(self, state: State) -> bool:
        """Whether the wanted level is near enough to round out towards it."""
        reach = abs(state.vertical_speed) * self.manual.gains["level-time-constant"]
        return abs(self.level_error) <= max(reach, LEVEL_REACHED)

    def heading_error(self, state: State) -> float:
        """Angle from the runway's direction to the nose."""
        return wrap(state.heading - self.control.runway.heading)

    # Procedures.

    def _carry_out(self, ready: ReadyStep, state: State) -> None:
        conditions = [f"{item.achieved(state)}, {item.wanted(state)}" for item in ready.when]
        at_once = state.time == self.phase_begin
        otherwise = f"on entering {self.phase}" if at_once else "after the step before it"
        self._do(ready.step, state, "; ".join(conditions) or otherwise)

    def _do(self, step: Step, state: State, reason: str) -> None:
        """Do one step of a procedure, or an action at a waypoint."""
        action = step.action
        if "set" in action:
            self.control.set(action["set"], action["to"])
        else:
            self.control.select(action, state)
        self._note(
            "procedure", step.name, reason, " ".join(f"{key}={value}" for key, value in action.items())
        )
        modes = self.control.modes
        for name, sub_mode in modes.items():
            if self.modes[name] != sub_mode:
                self._note("mode", f"{name} {sub_mode}", f"{step.name}; was {self.modes[name]}")
        self.modes = modes

    # Phases.

    def _proceed(self, checklist: OpenChecklist, state: State) -> None:
        for entry in checklist.items:
            reason = f"{entry.achieved(state)}, {entry.wanted(state)}"
            self._note("checklist", entry.condition.name, reason)
        if checklist.to == END:
            self.outcome = OUTCOMES[self.phase]
        self._graph.enter(checklist.to)
        names = ", ".join(entry.condition.name for entry in checklist.items)
        self._enter(checklist.to, state, names)

    def _enter(self, phase: str, state: State, reason: str) -> None:
        self.phase = phase
        self.done = phase == END
        self.phase_begin = state.time
        self._note("phase", phase, reason)
        self._airborne_route = phase.startswith(("DEP", "ENR", "M/A", "APP"))
        self._approaching = phase.startswith(("APP", "LDG"))
        self._on_runway = phase.startswith(("T/O", "LDG", "RTO"))
        if self._approaching and self._arrival is not None:
            self.control.use_runway(self._arrival)
            self._arrival = None
        if phase == "M/A":
            self.approaches += 1
            if self.approaches == 1:
                self.route.fly(circuit(self.route.runway, self.manual.speed("VCLEAN", state.mass)))
        if phase.startswith("TXY"):
            self._plan_taxi(phase, state)
        plan = self.manual.phases.get(phase)
        self._checklists = ()
        self._deadline = state.time + self.manual.gains.get(f"time-limit {phase}", DEFAULT_TIME_LIMIT)
        self.level_error = self.route.level - state.pressure_altitude
        if plan is not None:
            self._procedures[0] = Procedure(plan.steps, self, state.mass, self._reaction_time)
            self._checklists = [prepared(checklist, self, state.mass) for checklist in plan.checklists]
        self._watch()

    def _plan_taxi(self, phase: str, state: State) -> None:
        if phase == "TXY.out":
            self.control.plan_taxi(self.mission.departure.taxi, state)
            return
        arrival = self.mission.arrival
        end = [(arrival.stand.latitude, arrival.stand.longitude)] if arrival.stand else []
        self.control.plan_taxi([*arrival.taxi, *end], state)

    def _give_up(self, state: State) -> None:
        first = self._open_item()
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

    def _passed(self, leg: Leg) -> None:
        self._note("waypoint", leg.name, f"{leg.mode}, {leg.speed}, {leg.level}")
        for step in leg.actions:
            if self._state is not None:
                self._do(step, self._state, f"at waypoint {leg.name}")

    def _heard(self, leg: Leg, received: bool) -> None:
        ident = leg.fix.station.ident if leg.fix.station else leg.name
        if received:
            self._note("navigation", f"{ident} received", f"within line of sight, on the leg to {leg.name}")
        else:
            reason = f"beyond the horizon; dead reckoning on the leg to {leg.name}"
            self._note("navigation", f"{ident} out of range", reason)

    def _navigate(self, state: State) -> None:
        if self._approaching:
            self.route.update_approach(state)
        elif self._airborne_route:
            if self.route.waypoints_remaining:
                # Far from a waypoint nothing on the route changes fast.
                self._route_rest -= self._period
                if self._route_rest <= 0 or self.route.remaining < NEAR_WAYPOINT:
                    self._route_rest = ROUTE_PERIOD
                    self.route.update(state)
            else:
                self.route.update_approach(state)

    # Emergencies.

    def _recognise(self, state: State) -> None:
        """Take in, some time after it shows, that an engine has failed, or runs again."""
        control = self.control
        if state.engines_failed != self._warning:
            self._warning, self._warned_at = state.engines_failed, state.time
        if state.time - self._warned_at < self._recognition_time - SAME_MOMENT:
            return
        changed = int(self._warning) ^ control.failed_engines
        control.failed_engines = int(self._warning)
        for engine in range(changed.bit_length()):
            if changed >> engine & 1:
                word = "failed" if control.failed_engines >> engine & 1 else "runs again"
                reason = f"recognised {state.time - self._warned_at:.2f} s after the warning"
                self._note(
                    "warning", f"engine {engine + 1} {word}", f"{reason}, at {show(state.cas, 'kt', 1)}"
                )

    def _declare(self, emergency: Emergency, when: tuple[Item, ...], state: State) -> None:
        """Begin the procedure of an emergency, besides that of the phase."""
        self._emergencies.remove((emergency, when))
        reason = "; ".join(f"{entry.achieved(state)}, {entry.wanted(state)}" for entry in when)
        self._note("emergency", emergency.name, reason)
        self._procedures.append(Procedure(emergency.steps, self, state.mass, self._reaction_time))
        self._watch()

    def _note(self, kind: str, name: str, reason: str, detail: str = "") -> None:
        self.tell(Event(self._state.time if self._state else 0.0, kind, name, self.phase, reason, detail))

    def tell(self, event: Event) -> None:
        """Let everyone who listens know."""
        for listener in self.listeners:
            listener(event)
