"""What an aircraft can fly, loaded as for one mission and on its day: speeds and levels."""

from typing import NamedTuple

from harness.manual import FlightManual
from harness.mission.model import Mission
from harness.units import Level, Speed
from harness.world import airspeed, atmosphere

STALL_MARGIN = 1.2  # of the clean stall speed, for a leg
SLOWEST_DECISION = 0.8  # of the stall speed with those flaps: the slipstream lifts too, but not that much

DECISION_SPEEDS = {"V1": "take-off", "VR": "take-off", "V2": "take-off", "VREF": "landing", "VAPP": "landing"}
"""Speeds flown with these flaps, where the manual has both."""


class Airspeeds(NamedTuple):
    """One airspeed as calibrated airspeed (m/s) and as Mach number."""

    cas: float
    mach: float


class Envelope:
    """The speeds and levels open to one mission. `manual` has the mission's own speeds and phases in it."""

    def __init__(self, mission: Mission, manual: FlightManual) -> None:
        self.manual = manual.with_mission(mission)
        self.limits = manual.limits
        self.mass = mission.loading.total(manual.limits["operating-empty-mass"])
        self.isa_deviation = mission.environment.isa_deviation
        self.qnh = mission.environment.qnh

    @property
    def slowest(self) -> float:
        """The lowest airspeed of a leg, clean, m/s CAS."""
        return STALL_MARGIN * self.manual.stall_speed(self.mass, "up")

    def decision_range(self, name: str) -> tuple[float, float]:
        """The lowest and the highest value of a named speed, m/s CAS."""
        flaps = DECISION_SPEEDS.get(name, "up")
        setting = next((setting for setting in self.manual.flaps if setting.name == flaps), None)
        if setting is None:
            return 0.0, self.limits["VMO"]
        slowest = SLOWEST_DECISION * self.manual.stall_speed(self.mass, flaps)
        return slowest, min(self.limits["VMO"], setting.maximum_speed)

    def airspeeds(self, speed: Speed, level: Level) -> Airspeeds:
        """A speed at a level, as CAS and Mach number. A level out of reach counts as the nearest in reach."""
        altitude = min(max(self._pressure_altitude(level), -1000.0), self.limits["maximum-altitude"])
        pressure = atmosphere.pressure(altitude)
        if speed.kind == "CAS":
            return Airspeeds(speed.value, airspeed.mach_from_cas(speed.value, pressure))
        mach = speed.value
        if speed.kind == "TAS":
            mach = airspeed.mach_from_tas(speed.value, atmosphere.temperature(altitude, self.isa_deviation))
        return Airspeeds(airspeed.cas_from_mach(mach, pressure), mach)

    def altitude(self, level: Level) -> float:
        """The altitude above mean sea level of a level, m."""
        return level.altitude - (atmosphere.pressure_altitude(self.qnh) if level.kind == "FL" else 0.0)

    def _pressure_altitude(self, level: Level) -> float:
        return level.altitude + (0.0 if level.kind == "FL" else atmosphere.pressure_altitude(self.qnh))
