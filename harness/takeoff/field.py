"""Field lengths of CS 25.109 and 25.113 from flights."""

from collections.abc import Sequence
from dataclasses import replace
from math import isnan, nan
from typing import NamedTuple

from harness.manual import FlightManual, read_manual
from harness.takeoff.case import TakeOff
from harness.takeoff.climb import Gradients, climbs, gradients
from harness.takeoff.field_flights import FieldFlights, Guess, Runway
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import CS25_SCREEN, Flown
from harness.takeoff.speeds import ControlSpeeds, Speeds, control_speeds

AEO_FACTOR = 1.15  # CS 25.113(a)(2), (c)(1)(ii), (c)(2)(ii): on the distances with all engines
TYRES = ("gear/tyre-speed-max-mps", "gear/tyre-speed-limit-mps")


class Field(NamedTuple):
    """Speeds (m/s CAS) and distances (m) of one take-off, as CS-25 defines them. Required ones include every factor."""

    speeds: Speeds
    v1: float
    slowest_v1: float  # for VMCG
    vef: float
    vlof: float
    v_35ft: float  # with an engine failed
    take_off_run: float  # with a clearway; without one it is the take-off distance
    take_off_distance: float
    accelerate_stop: float
    accelerate_go_oei: float
    accelerate_stop_oei: float
    accelerate_stop_aeo: float
    accelerate_stop_reverse: float  # not required on a dry runway; what reverse thrust would give
    take_off_distance_aeo: float  # with its factor
    take_off_run_aeo: float
    v1_set_by: str  # balance, VR, VMCG or brake energy
    v1_balanced: (
        float  # what it would be if VMCG did not matter, and the two distances there; NaN if beyond control
    )
    balanced_stop: float
    balanced_go: float
    gradients: Gradients
    brake_energy: float  # of its limit
    tyre_speed: float  # of its limit
    dry_v1: float  # on a wet runway: those of the dry one, below which the required ones are not; NaN on a dry one
    dry_take_off_distance: float
    dry_accelerate_stop: float


def field_of(
    case: TakeOff,
    runway: Runway | None = None,
    manual: FlightManual | None = None,
    control: ControlSpeeds | None = None,
    *,
    workers: int = 1,
    guess: Guess | None = None,
) -> Field:
    """The field at the V1 for this runway, or the balanced one. Raises InputErrors, FlightError.

    With a `guess` from another mass it is found in fewer flights, and what reverse thrust would give on a dry runway
    is left out. A wet runway has its own V1, and the dry one's distances as a floor: CS 25.109(b), 25.113(b).
    """
    manual = manual or read_manual(case.aircraft)
    control = control or control_speeds(case, manual, workers)
    dry_guess = guess and guess._replace(v1_over_vr=guess.dry_v1_over_vr)
    dry_flights = FieldFlights(replace(case, surface="dry"), manual, control, workers, dry_guess)
    dry = _flown(dry_flights, runway, whole=guess is None)
    if case.surface == "dry":
        return dry
    wet_flights = FieldFlights(replace(case, vr=dry.speeds.vr), manual, control, workers, guess)
    # Aloft at the same speeds the surface no longer matters.
    wet = _flown(wet_flights, runway, climb=dry.gradients)
    return wet._replace(
        take_off_distance=max(wet.accelerate_go_oei, dry.take_off_distance),
        accelerate_stop=max(wet.accelerate_stop, dry.accelerate_stop),
        brake_energy=max(wet.brake_energy, dry.brake_energy),
        dry_v1=dry.v1,
        dry_take_off_distance=dry.take_off_distance,
        dry_accelerate_stop=dry.accelerate_stop,
    )


def fields_of(cases: Sequence[TakeOff], workers: int = 1) -> list[Field]:
    """The balanced field of take-offs that differ in mass alone. Raises InputErrors, FlightError."""
    manual = read_manual(cases[0].aircraft)
    control = control_speeds(cases[0], manual, workers)
    inner = 1 if len(cases) > 1 else workers
    return fly_all(_field, [(case, manual, control, inner) for case in cases], workers, cases[0])


def _field(asked: tuple[TakeOff, FlightManual, ControlSpeeds, int]) -> Field:
    case, manual, control, workers = asked
    return field_of(case, None, manual, control, workers=workers)


def _flown(
    flights: FieldFlights, runway: Runway | None, *, whole: bool = True, climb: Gradients | None = None
) -> Field:
    v1, set_by, balanced = flights.decision_speed(runway)
    stops = [flights.stopping(v1, failure=failure) for failure in (True, False)]
    reversing = [flights.stopping(v1, failure=True, reverse=True)] if whole else []
    flights.fly(flights.going(v1), *stops, *reversing, *(() if climb else climbs(flights, v1)))
    everyone, go = flights.all_engines, flights.fly(flights.going(v1))
    lift, distance = go.at(go.liftoff, "along"), flights.accelerate_go(v1)
    all_distance = everyone.at(everyone.at_height(CS25_SCREEN), "along")
    all_run = AEO_FACTOR * 0.5 * (everyone.at(everyone.liftoff, "along") + all_distance)
    # To half-way between lift-off and 35 ft, on a wet runway to the 15 ft: CS 25.113(c)(1)(i), (2)(i).
    run = distance if flights.wet else 0.5 * (lift + distance)
    oei, aeo = (flights.accelerate_stop(v1, failure=failure) for failure in (True, False))
    return Field(
        speeds=flights.speeds,
        v1=v1,
        slowest_v1=flights.slowest_v1,
        vef=flights.vef(v1),
        vlof=everyone.at(everyone.liftoff, "cas"),
        v_35ft=go.speed_at(CS25_SCREEN),
        take_off_run=max(run, all_run),
        take_off_distance=max(distance, AEO_FACTOR * all_distance),
        accelerate_stop=max(oei, aeo),
        accelerate_go_oei=distance,
        accelerate_stop_oei=oei,
        accelerate_stop_aeo=aeo,
        accelerate_stop_reverse=flights.accelerate_stop(v1, reverse=True) if whole else nan,
        take_off_distance_aeo=AEO_FACTOR * all_distance,
        take_off_run_aeo=all_run,
        v1_set_by=set_by,
        v1_balanced=balanced,
        balanced_stop=nan if isnan(balanced) else flights.longest_stop(balanced),
        balanced_go=nan if isnan(balanced) else flights.accelerate_go(balanced),
        gradients=climb or gradients(flights, v1),
        brake_energy=flights.brake_energy(v1),
        tyre_speed=_share(everyone, *TYRES),
        dry_v1=nan,
        dry_take_off_distance=nan,
        dry_accelerate_stop=nan,
    )


def _share(flown: Flown, quantity: str, limit: str) -> float:
    return flown.wear[quantity] / flown.wear[limit] if {quantity, limit} <= flown.wear.keys() else nan
