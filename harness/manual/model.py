"""The flight manual as it is looked up: SI and radians."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import sqrt
from pathlib import Path
from typing import NamedTuple, Protocol

from harness.errors import InputError, did_you_mean
from harness.loading.envelope import Envelope
from harness.plan import Emergency, PhasePlan
from harness.units import G0, Quantity, Speed
from harness.world.atmosphere import SEA_LEVEL_DENSITY


class FlapSetting(NamedTuple):
    """A flap setting: position 0 up .. 1 landing, highest airspeed (m/s CAS), power-off lift coefficient."""

    name: str
    position: float
    maximum_speed: float
    maximum_lift_coefficient: float


class SpeedRule(NamedTuple):
    """A named speed: fixed (`cas`, m/s), or `stall_ratio` times the stall speed with `flaps`, `plus` m/s."""

    name: str
    cas: float | None = None
    stall_ratio: float = 0.0
    flaps: str = ""
    plus: float = 0.0


class PropertySetting(NamedTuple):
    """What a word of the mission does to the aircraft: `property` of the simulator is put to `value`.

    With `inner_modes` it leaves holding attitudes to the pilot's inner modes.
    """

    property: str
    value: float
    file: str
    line: int | None
    inner_modes: bool = False


class Numbers(dict[str, float]):
    """Numbers by name, from one file. A name that is not there is refused with an InputError that says which are."""

    def __init__(self, what: str, file: Path, numbers: Mapping[str, float]) -> None:
        super().__init__(numbers)
        self._what = what
        self._file = file

    def __missing__(self, name: str) -> float:
        raise _unknown(self._file, self._what, name, self)


class Changes(Protocol):
    """What a mission may change in the manual."""

    @property
    def speeds(self) -> dict[str, Speed]:
        """Named speeds."""

    @property
    def gains(self) -> dict[str, Quantity]:
        """Gains, SI."""

    @property
    def phases(self) -> dict[str, PhasePlan]:
        """What is laid over the phases of the manual."""


@dataclass(frozen=True)
class FlightManual:
    """What a pilot looks up. SI and radians; MMO is a Mach number; thrust settings are levers, -1..1.

    `configurations` says what each choice does to the aircraft, `failures` what each failure does. `gain_units` are
    the SI units of the gains.
    """

    aircraft: str
    limits: Mapping[str, float]
    flaps: tuple[FlapSetting, ...]
    thrust: Mapping[str, float]
    speeds: Mapping[str, SpeedRule]
    gains: Mapping[str, float]
    phases: Mapping[str, PhasePlan]
    source_path: Path
    gain_units: Mapping[str, str] = field(default_factory=dict)
    configurations: Mapping[str, Mapping[str, PropertySetting]] = field(default_factory=dict)
    failures: Mapping[str, PropertySetting] = field(default_factory=dict)
    balance: Envelope | None = None
    emergencies: tuple[Emergency, ...] = ()

    def flap(self, name: str) -> FlapSetting:
        """The flap setting of that name. Raises InputError."""
        for setting in self.flaps:
            if setting.name == name:
                return setting
        raise _unknown(self.source_path, "flap setting", name, [setting.name for setting in self.flaps])

    def stall_speed(self, mass: float, flaps: str) -> float:
        """The power-off 1-g stall speed in m/s CAS at `mass` (kg). CAS is taken as EAS: it is, when slow.

        Source: lift equals weight, CS 25.103.
        """
        lift = self.limits["wing-area"] * self.flap(flaps).maximum_lift_coefficient * SEA_LEVEL_DENSITY / 2
        return sqrt(mass * G0 / lift)

    def speed(self, name: str, mass: float) -> float:
        """A named speed in m/s CAS at `mass` (kg). Raises InputError for a name the manual does not have."""
        rule = self.speeds.get(name)
        if rule is None:
            raise _unknown(self.source_path, "speed", name, self.speeds)
        if rule.cas is not None:
            return rule.cas
        return rule.stall_ratio * self.stall_speed(mass, rule.flaps) + rule.plus

    def chosen(self, configuration: Mapping[str, str]) -> list[PropertySetting]:
        """What a mission's choices do to the aircraft."""
        return [self.configurations[name][choice] for name, choice in configuration.items()]

    def with_mission(self, mission: Changes) -> "FlightManual":
        """This manual with the mission's speeds, gains and phases in place of its own."""
        speeds = {name: SpeedRule(name, cas=speed.value) for name, speed in mission.speeds.items()}
        phases = dict(self.phases)
        for name, change in mission.phases.items():
            phases[name] = phases.get(name, PhasePlan(name, (), ())).changed_by(change)
        gains = {name: gain.value for name, gain in mission.gains.items()}
        return replace(
            self,
            speeds={**self.speeds, **speeds},
            gains=Numbers("gain", self.source_path, {**self.gains, **gains}),
            phases=phases,
        )


def _unknown(file: Path, what: str, name: str, known: Iterable[str]) -> InputError:
    return InputError(f'has no {what} "{name}"', file=file, remedy=did_you_mean(name, known))
