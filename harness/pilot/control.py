"""The control system of Fig. 11: from modes, targets and settings to commands."""

from collections.abc import Mapping, Sequence
from math import hypot, inf
from typing import NamedTuple

from harness.manual import FlightManual
from harness.navigation.database import Runway
from harness.numerics import LowPass, approach, clamp, quantised
from harness.pilot.ground import Centreline, GroundSteering, TaxiPath
from harness.pilot.modes.horizontal import HorizontalMode
from harness.pilot.modes.speed import SpeedMode
from harness.pilot.modes.vertical import VerticalMode
from harness.pilot.route import NavigationComputer
from harness.plan_reader import parse_reference
from harness.state import Commands, State, new_commands
from harness.units import parse
from harness.vocabulary import CONTROLS, INNER_MODES
from harness.world.local import LocalFrame

LEVER_RATE = 0.1  # 1/s, while taxiing
BRAKE_RATE = 0.5  # 1/s, while taxiing
HARDEST_TAXI_BRAKE = 0.5
STANDING_BRAKE = 0.4  # holds the aircraft at the end of a taxi path
_FIELDS = {"ground-spoilers": "spoiler", "brakes": "brake"}  # settings whose Commands field has another name


class TaxiGains(NamedTuple):
    """The gains of the flight manual whose names begin with `taxi-`, SI."""

    speed: float
    turn_radius: float
    look_ahead: float
    look_ahead_time: float
    lever_gain: float
    lever_limit: float
    brake_gain: float


class ControlSystem:
    """The controllers, which of them are in command, and the standing settings.

    The loops turn in `turn_outer_loops`; what they ask for is followed by the pilot's faster laws in the simulator.
    """

    def __init__(
        self,
        manual: FlightManual,
        route: NavigationComputer,
        runway: Runway,
        loads: Sequence[str] = (),
        *,
        inner_modes: bool = False,
    ) -> None:
        """`runway` is the one in use at the beginning.

        `loads` are the names of what can be released, in the order of their numbers, from 1. `inner_modes`: the
        aircraft's flight control leaves holding attitudes to the pilot.
        """
        gains = manual.gains
        self.manual = manual
        self.route = route
        self._inner_modes = inner_modes
        self.speed = SpeedMode(gains)
        self.vertical = VerticalMode(gains)
        self.horizontal = HorizontalMode(gains)
        self.owners = dict.fromkeys(CONTROLS, "DIRECT")
        self.runway = Centreline(runway)
        self.target_cas = 0.0  # m/s
        self.taxi_distance = inf  # to the end of the taxi path, m
        self.failed_engines = 0  # those the pilot knows of, as State.engines_failed
        self._steering = GroundSteering(gains)
        self._settings = Commands()
        self._loads = {name: float(number) for number, name in enumerate(loads, 1)}
        self._taxi: TaxiPath | None = None
        self._taxiing = False
        self._taxi_brake = 0.0
        self._speed_words = "leg-speed"
        self._speed_value = 0.0
        self._climb_lever = manual.thrust["climb"]
        self._taxi_gains = TaxiGains(*(gains[f"taxi-{name.replace('_', '-')}"] for name in TaxiGains._fields))
        lag = gains["neuromuscular-lag"]
        self._limbs = [LowPass(lag), LowPass(lag), LowPass(lag), LowPass(lag, 1.0)] if lag else []
        self._moved_at = 0.0  # s
        self._meant = (0.0, 0.0, 0.0, 1.0)  # for lever, rudder, nose wheel and brakes
        self._bank = self._wheel = self._rudder = self._coordinate = 0.0
        self._standing: tuple[float, ...] = ()  # commands that procedures change; empty when they have

    # What procedures do.

    def set(self, name: str, to: str) -> None:
        """Put a setting (see `vocabulary.SETTINGS`) to a value."""
        self._standing = ()
        if name == "thrust":
            lever = self.manual.thrust[to]
            self.speed.put(lever)
            self.speed.highest_lever = max(lever, self._climb_lever)
        elif name == "flaps":
            self._settings = self._settings._replace(flap=self.manual.flap(to).position)
        elif name == "gear":
            self._settings = self._settings._replace(gear=float(to == "down"))
        elif name == "release":
            self._settings = self._settings._replace(release=self._loads[to])
        elif name == "course":
            self.horizontal.track = self.runway.heading
        elif name == "failed-engines":
            self._settings = self._settings._replace(shut_down=float(self.failed_engines))
        else:
            self._settings = self._settings._replace(**{_FIELDS.get(name, name): parse(to, "ratio")})

    def select(self, action: Mapping[str, str], state: State) -> None:
        """Select a sub-mode; `action` holds mode, to and the arguments of `vocabulary.MODES`."""
        self._standing = ()
        select = {
            "CTRL": self._select_owner,
            "SPD": self._select_speed,
            "HP": self._select_horizontal,
            "VP": self._select_vertical,
        }
        select[action["mode"]](action, state)
        self._taxiing = self.speed.sub_mode == "THR" and self._speed_words == "taxi"

    def _select_owner(self, action: Mapping[str, str], state: State) -> None:
        control, to = action["control"], action["to"]
        self.owners[control] = to
        if control == "thrust" and to == "DIRECT":
            self.speed.select("OFF")

    def _select_speed(self, action: Mapping[str, str], state: State) -> None:
        to = action["to"]
        self.speed.select(to)
        self.owners["thrust"] = "CONTROLLER" if to == "THR" else "DIRECT"
        if to == "OFF":
            return
        self._speed_words = words = action["speed"]
        if words not in ("leg-speed", "taxi"):
            reference = parse_reference(words, "speed-target")
            named = self.named_speed(reference.name, state.mass) if reference.name else 0.0
            self._speed_value = named + reference.offset

    def _select_horizontal(self, action: Mapping[str, str], state: State) -> None:
        horizontal = self.horizontal
        horizontal.sub_mode = action["to"]
        horizontal.guidance = action.get("guidance", "")
        if "bank" in action:
            horizontal.bank = parse(action["bank"], "angle")
        track = action.get("track")
        if track == "runway":
            horizontal.track = self.runway.heading
        elif track == "present":
            horizontal.track = state.heading
        elif track is not None:
            horizontal.track = parse(track, "angle")
        self.owners["aileron"] = "CONTROLLER"

    def _select_vertical(self, action: Mapping[str, str], state: State) -> None:
        vertical = self.vertical
        vertical.select(action["to"], state)
        vertical.guidance = action.get("guidance", "")
        if "pitch" in action:
            vertical.attitude = parse(action["pitch"], "angle")
        climb = action.get("vertical-speed")
        vertical.vertical_speed = None if climb is None else parse(climb, "vertical-speed")
        angle = action.get("angle")
        if angle is not None:
            vertical.angle = angle if angle in ("by-speed", "flare") else parse(angle, "angle")
        self.owners["elevator"] = "CONTROLLER"

    def named_speed(self, name: str, mass: float) -> float:
        """A speed or speed limit of the flight manual, m/s CAS, for an aircraft of `mass` kg."""
        return self.manual.limits[name] if name in self.manual.limits else self.manual.speed(name, mass)

    def use_runway(self, runway: Runway) -> None:
        """Steer by another runway from now on."""
        self.runway = Centreline(runway)
        self._steering.reset()

    def plan_taxi(self, points: Sequence[tuple[float, float]], state: State) -> None:
        """Taxi from here along `points` (latitude, longitude); without any, stay."""
        self._taxi, self.taxi_distance = None, 0.0
        if points:
            frame = LocalFrame(state.latitude, state.longitude)
            corners = [
                frame.point(state.latitude, state.longitude),
                *(frame.point(*point) for point in points),
            ]
            self._taxi = TaxiPath(frame, corners, self._taxi_gains.turn_radius, self._taxi_gains.speed)
            self.taxi_distance = inf

    @property
    def modes(self) -> dict[str, str]:
        """Each super-mode with its sub-mode, in a few words."""
        direct = [name for name, owner in self.owners.items() if owner == "DIRECT"]
        vertical, detail = self.vertical, self.vertical.guidance
        if vertical.sub_mode == "PATH":
            detail = "V/S" if vertical.vertical_speed is not None else str(vertical.angle)
        inner = [
            self._inner_modes and self.owners[control] == "CONTROLLER"
            for control in ("elevator", "aileron", "rudder")
        ]
        return {
            "CTRL": f"direct: {' '.join(direct)}" if direct else "controller",
            "INN": " ".join(name for name, on in zip(INNER_MODES, inner, strict=True) if on) or "OFF",
            "SPD": self.speed.sub_mode,
            "HP": f"{self.horizontal.sub_mode} {self.horizontal.guidance}".strip(),
            "VP": f"{vertical.sub_mode} {detail}".strip(),
        }

    # Flying.

    def turn_outer_loops(self, state: State, level_error: float, dt: float) -> None:
        """Renew what moves slowly; `dt` is the time since the last turn."""
        speed, route = self.speed, self.route
        words = self._speed_words
        self.target_cas = route.target_cas if words == "leg-speed" else self._speed_value
        self._bank = quantised(self.horizontal.update(state, route.guidance))
        speed.observe(state, dt)
        self.vertical.follow(state, dt)
        path = 0.0
        if speed.sub_mode != "THR":
            speed.move(dt)
            if speed.sub_mode == "PITCH":
                path = speed.path(state, self.target_cas)
        elif not self._taxiing:
            speed.update(state, self.target_cas, self.vertical.path_angle, dt)
        self.vertical.aim(state, level_error, route.glide_slope, route.distance_to_threshold, path)
        self._steer(state, dt)

    def _by_hand(self) -> tuple[float, float, float, float]:
        """What hands and feet are to do: thrust lever, rudder, nose wheel, brakes."""
        brake = self._taxi_brake if self._taxiing else self._settings.brake
        return self.speed.lever, self._rudder, self._wheel, brake

    def command(self, time: float) -> Commands:
        """All commands at `time` (s)."""
        lever, rudder, wheel, brake = self._by_hand()
        if self._limbs:
            dt, self._moved_at = time - self._moved_at, time
            moves = zip(self._limbs, self._meant, strict=True)  # until now: what was meant at the last look
            self._meant = (lever, rudder, wheel, brake)
            lever, rudder, wheel, brake = (quantised(limb.update(to, dt)) for limb, to in moves)
        self._standing = self._standing or self._stand()
        moving = (lever, self.vertical.wanted, self._bank, rudder, wheel, brake, self._coordinate)
        return new_commands(moving + self._standing)

    def _stand(self) -> tuple[float, ...]:
        settings, owners, vertical = self._settings, self.owners, self.vertical
        return (
            vertical.law,
            vertical.attitude,
            float(owners["elevator"] == "CONTROLLER"),
            settings.elevator,
            float(owners["aileron"] == "CONTROLLER"),
            settings.aileron,
            settings.flap,
            settings.gear,
            settings.speedbrake,
            settings.spoiler,
            settings.crossfeed,
            settings.ramp,
            settings.release,
            settings.shut_down,
        )

    def _steer(self, state: State, dt: float) -> None:
        wheel, rudder, self._coordinate = 0.0, self._settings.rudder, 0.0
        if self._taxiing:
            wheel = self._taxi_along(state, dt)
        elif self.owners["steering"] == "CONTROLLER":
            if state.main_on_ground:
                across = self.runway.offset(state)[1]
                wheel, rudder = self._steering.hold_line(state, self.runway.heading, across, dt)
            else:
                rudder = self._steering.align(state, self.runway.heading)
        elif self.owners["rudder"] == "CONTROLLER":
            self._coordinate = 1.0
        self._wheel, self._rudder = quantised(wheel), quantised(rudder)

    def _taxi_along(self, state: State, dt: float) -> float:
        """Set lever and brakes for the speed the taxi path allows, and return the nose wheel."""
        gains = self._taxi_gains
        speed = hypot(state.velocity_north, state.velocity_east)
        wheel, allowed = 0.0, 0.0
        if self._taxi is not None:
            look_ahead = max(gains.look_ahead, gains.look_ahead_time * speed)
            error, allowed, self.taxi_distance = self._taxi.follow(state, look_ahead)
            wheel = self._steering.pursue(state, error, look_ahead)
        self.target_cas = allowed
        excess = speed - allowed
        lever = clamp(-excess * gains.lever_gain, 0.0, gains.lever_limit)
        self.speed.lever = quantised(approach(self.speed.lever, lever, LEVER_RATE * dt))
        brake = clamp(excess * gains.brake_gain, 0.0, HARDEST_TAXI_BRAKE) if allowed else STANDING_BRAKE
        self._taxi_brake = quantised(approach(self._taxi_brake, brake, BRAKE_RATE * dt))
        return wheel
