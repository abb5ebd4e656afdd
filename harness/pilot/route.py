"""The navigation computer: from radio aids and position to the course, speed and level of the moment (Fig. 11)."""

from collections.abc import Callable, Sequence
from math import cos, hypot, inf, pi, sin, sqrt, tan
from typing import NamedTuple

from harness.mission.model import Leg
from harness.navigation import receivers
from harness.navigation.database import Ils, Runway
from harness.numerics import wrap
from harness.state import State
from harness.units import DEG
from harness.world import airspeed, earth
from harness.world.atmosphere import GRAVITY, pressure_altitude

HOMING_PASSAGE_RANGE = (
    5000.0  # m: a station further abeam than this was not passed, the aircraft is still turning to it
)
LONGEST_LEAD_TURN = 120 * DEG  # a fly-by turn is begun no earlier than this change of course asks for
ROLL_IN_TIME = 2.0  # s of flight between the order to bank and the turn: led before a fly-by waypoint


class Line(NamedTuple):
    """A course line: through a point at a true course there, ending `end` metres past the point."""

    latitude: float
    longitude: float
    course: float
    end: float


class Guidance(NamedTuple):
    """Where the wanted line or station lies."""

    homing: bool
    bearing_error: float  # homing: angle from the nose to the station, positive right
    cross_track: float  # otherwise: metres right of the line
    course: float  # true course of the line here


class NavigationComputer:
    """Follows the legs of a mission and then the runway's centreline; see `update`."""

    def __init__(self, legs: Sequence[Leg], start: Runway, ils: Ils, qnh: float, turn_bank: float) -> None:
        """Begin at the runway `start`, end with `ils`; `qnh` in Pa; fly-by turns are led for `turn_bank` (rad)."""
        self.legs = legs
        self.ils = ils
        self.runway: Runway = ils.runway
        self.index = 0
        self.leg: Leg
        self.level: float  # wanted, as pressure altitude, m
        self.on_passage: Callable[[Leg], None] = lambda leg: None
        self.on_reception: Callable[[Leg, bool], None] = lambda leg, received: None
        self._horizon = (
            inf  # of the station the leg needs, m: inf if it needs none, or one below the horizon too
        )
        self._received = True
        self._turn_bank = turn_bank
        self._altimeter_setting = pressure_altitude(qnh)
        self._take(legs[0])
        self.waypoints_remaining = len(legs)
        self._line = Line(0.0, 0.0, 0.0, 0.0)
        self._begun = False
        self._after = self._distances_after()
        self.guidance = Guidance(False, 0.0, 0.0, 0.0)
        first = legs[0].fix
        _, _, self.remaining = earth.inverse(start.latitude, start.longitude, first.latitude, first.longitude)
        """Distance to the active waypoint, m."""
        self.until_passage = self.remaining
        """Distance along the track to where it is passed, m."""
        self.target_cas = 0.0
        self.localizer = receivers.NeedleReading(0.0, 0.0, False)
        self.glide_slope = receivers.NeedleReading(0.0, 0.0, False)
        self.distance_to_threshold = inf

    def fly(self, legs: Sequence[Leg]) -> None:
        """Follow other legs from now on, as after a missed approach."""
        self.legs = legs
        self.index = 0
        self.waypoints_remaining = len(legs)
        self._take(legs[0])
        self._after = self._distances_after()
        self._begun = False

    @property
    def distance_to_go(self) -> float:
        """Along the route to the threshold, m."""
        if self.waypoints_remaining == 0:
            return max(self.distance_to_threshold, 0.0)
        return max(self.remaining, 0.0) + self._after[self.index]

    @staticmethod
    def _cas_of(leg: Leg, state: State) -> float:
        """A leg's speed as CAS here, m/s."""
        kind, value = leg.speed
        if kind == "CAS":
            return value
        if kind == "MACH":
            return airspeed.cas_from_mach(value, state.pressure)
        return airspeed.cas_from_tas(value, state.pressure, state.temperature)

    def update(self, state: State) -> None:
        """Read the receivers, sequence the waypoints, and renew guidance and targets."""
        if not self._begun:
            self._begun = True
            self._begin(state.latitude, state.longitude)
        if self.waypoints_remaining:
            leg = self.leg
            if self._home(leg, state) if leg.mode == "homing" else self._track(leg, state):
                self._pass(leg, state)
                self.update(state)
                return
        self.target_cas = self._cas_of(self.leg, state)

    def update_approach(self, state: State) -> None:
        """Read the ILS of the destination."""
        self.localizer = receivers.localizer(self.ils, state.latitude, state.longitude)
        self.glide_slope = receivers.glide_slope(self.ils, state.latitude, state.longitude, state.altitude)
        along, across = self.runway.offset(state.latitude, state.longitude)
        self.distance_to_threshold = -along
        self.guidance = Guidance(False, 0.0, across, self.runway.true_heading)

    def _home(self, leg: Leg, state: State) -> bool:
        """Point the nose at the station; it is passed when it moves behind the wings."""
        station = leg.fix.station
        _, _, distance = earth.inverse(state.latitude, state.longitude, leg.fix.latitude, leg.fix.longitude)
        if station is not None and station.is_ndb:
            bearing_error = receivers.adf(station, state.latitude, state.longitude, state.heading)
        elif station is not None:
            reading = receivers.vor(station, state.latitude, state.longitude, state.altitude)
            bearing_error = wrap(reading.bearing + station.declination - state.heading)
        else:
            azimuth, _, _ = earth.inverse(
                state.latitude, state.longitude, leg.fix.latitude, leg.fix.longitude
            )
            bearing_error = wrap(azimuth - state.heading)
        self.remaining = self.until_passage = distance
        if not self._hear(distance, state):
            self.guidance = self._reckoned(state)
            return False
        self.until_passage = distance * cos(bearing_error)
        self.guidance = Guidance(True, bearing_error, 0.0, state.heading + bearing_error)
        return distance < HOMING_PASSAGE_RANGE and abs(bearing_error) > 0.5 * pi

    def _track(self, leg: Leg, state: State) -> bool:
        """Stay on the leg's line; the waypoint is passed abeam, or a turn's lead before it if flown by."""
        line, station = self._line, leg.fix.station
        latitude, longitude = state.latitude, state.longitude
        if station is not None and station.has_bearing and station.has_dme:
            radial, slant = receivers.vor_dme(station, latitude, longitude, state.altitude)
            azimuth = radial + station.declination
            distance = ground_range(slant, state.altitude - station.elevation, state.altitude)
        else:
            azimuth, _, distance = earth.inverse(line.latitude, line.longitude, latitude, longitude)
        along, across = earth.beside(distance, azimuth - line.course)
        self.remaining = self.until_passage = line.end - along
        if not self._hear(distance, state):
            self.guidance = self._reckoned(state)
            return False
        self.guidance = Guidance(False, 0.0, across, self._course_here(state))
        self.until_passage = self.remaining - (self._lead(state) if leg.turn == "fly-by" else 0.0)
        return self.until_passage <= 0.0

    def _course_here(self, state: State) -> float:
        """The true course of the leg's line: meridians converge, it is another here than at the reference point."""
        line = self._line
        convergence = (state.longitude - line.longitude) * sin(0.5 * (state.latitude + line.latitude))
        return (line.course + convergence) % (2 * pi)

    def _hear(self, distance: float, state: State) -> bool:
        """Whether the station of the leg, `distance` m away, is received."""
        received = distance <= self._horizon + receivers.horizon(state.altitude)
        if received != self._received:
            self._received = received
            self.on_reception(self.leg, received)
        return received

    def _reckoned(self, state: State) -> Guidance:
        """Dead reckoning: along the course of the leg, without knowing how far off its line."""
        return Guidance(False, 0.0, 0.0, self._course_here(state))

    def _lead(self, state: State) -> float:
        """How far before a fly-by waypoint the turn begins, m."""
        speed = hypot(state.velocity_north, state.velocity_east)
        if self.waypoints_remaining > 1:  # the turn is flown while the speed changes to that of the next leg
            speed *= 0.5 * (1.0 + self._cas_of(self.legs[self.index + 1], state) / max(state.cas, 1.0))
        turn = min(abs(wrap(self._next_course() - self._line.course)), LONGEST_LEAD_TURN)
        radius = speed * speed / (GRAVITY * tan(self._turn_bank))
        return radius * tan(0.5 * turn) + (ROLL_IN_TIME * speed if turn > 2 * DEG else 0.0)

    def _next_course(self) -> float:
        fix = self.legs[self.index].fix
        if self.index + 1 == len(self.legs):
            return self.runway.true_heading
        following = self.legs[self.index + 1]
        if following.course_true is not None:
            return following.course_true
        azimuth, _, _ = earth.inverse(
            fix.latitude, fix.longitude, following.fix.latitude, following.fix.longitude
        )
        return azimuth

    def _pass(self, leg: Leg, state: State) -> None:
        self.index += 1
        if leg.turn == "fly-by":
            self._begin(leg.fix.latitude, leg.fix.longitude)
        else:
            self._begin(state.latitude, state.longitude)
        self.on_passage(leg)

    def _begin(self, latitude: float, longitude: float) -> None:
        """Draw the line of the active leg; a leg without a course is flown from (latitude, longitude)."""
        self.waypoints_remaining = len(self.legs) - self.index
        if not self.waypoints_remaining:
            self.remaining = 0.0
            return
        self._take(self.legs[self.index])
        fix, course = self.leg.fix, self.leg.course_true
        needs_sight = self.leg.mode != "direct" and fix.station is not None and not fix.station.is_ndb
        self._horizon = receivers.horizon(fix.station.elevation) if needs_sight and fix.station else inf
        self._received = True
        if course is None:
            _, course, _ = earth.inverse(latitude, longitude, fix.latitude, fix.longitude)
            self._line = Line(fix.latitude, fix.longitude, course, 0.0)
        elif fix.station is not None:
            self._line = Line(fix.station.latitude, fix.station.longitude, course, fix.distance or 0.0)
        else:
            self._line = Line(fix.latitude, fix.longitude, course, 0.0)

    def _take(self, leg: Leg) -> None:
        """Make `leg` the active one: its speed and level are aimed at, after the last waypoint too."""
        self.leg = leg
        setting = 0.0 if leg.level.kind == "FL" else self._altimeter_setting
        self.level = leg.level.altitude + setting

    def _distances_after(self) -> list[float]:
        """For each leg, the distance from its fix along the rest of the route to the threshold."""
        points = [(leg.fix.latitude, leg.fix.longitude) for leg in self.legs]
        points.append((self.runway.latitude, self.runway.longitude))
        after = [0.0]
        for (lat_1, lon_1), (lat_2, lon_2) in zip(points[-2::-1], points[:0:-1], strict=True):
            after.append(after[-1] + earth.inverse(lat_1, lon_1, lat_2, lon_2)[2])
        return after[:0:-1]


def ground_range(slant: float, height: float, altitude: float) -> float:
    """Distance over the ground in metres from a slant range, at `height` metres above the station."""
    return sqrt(max(slant * slant - height * height, 0.0)) / (1.0 + altitude / earth.MEAN_RADIUS)
