"""Field lengths of CS 25.109 and 25.113 from flights, and V1 by brackets on them."""

from collections.abc import Callable
from dataclasses import replace
from math import isnan, nan
from typing import NamedTuple

import numpy as np
from scipy.optimize import brentq

from harness.errors import OverrunError
from harness.manual import FlightManual, read_manual
from harness.takeoff.case import Happening, TakeOff
from harness.takeoff.flight import CS25_SCREEN, Flown, fly_take_off
from harness.takeoff.speeds import Speeds, take_off_speeds
from harness.units import FT, G0

RECOGNITION = 1.0  # s from the failure to the first action, AMC 25.107(a)(2)
AT_V1 = 2.0  # s at V1 that CS 25.109(a) adds to the stop
AEO_FACTOR = 1.15  # CS 25.113(a)(2), (c)(2): on the distances with all engines
WET_SCREEN = 15 * FT  # CS 25.113(b)(1), with an engine failed on a wet runway
BALANCED = 0.5  # m: the brackets on V1 stop here
ROUGHLY = 5.0  # m, and here in a search
TOLERANCE = 0.02  # m/s, likewise
VR_TRIALS, SHORT = 4, 0.1  # m/s short of V2 at 35 ft is no longer taken to be short
STEP = 2.0  # m/s, in which V1 is looked for downwards from VR
FIRST_SEGMENT, SECOND_SEGMENT, FINAL_SEGMENT = (
    0.005,
    0.03,
    0.017,
)  # CS 25.121(a)(3), (b)(3), (c)(3): four engines
CLIMB_HEIGHT = 120.0  # m: 400 ft, where the second segment ends
CLIMB_OVER = 4.0  # s before it, over which the gradient is taken


class Gradients(NamedTuple):
    """Climb gradients with an engine failed, per unit, and the speed they were flown at, m/s CAS."""

    first: float
    second: float
    cas: float


class Field(NamedTuple):
    """Speeds (m/s CAS) and distances (m) of one take-off, as CS-25 defines them. Required ones include every factor."""

    speeds: Speeds
    v1: float
    slowest_v1: float  # for VMCG
    vef: float
    vlof: float
    v_35ft: float  # with an engine failed
    take_off_run: float
    take_off_distance: float
    accelerate_stop: float
    accelerate_go_oei: float
    accelerate_stop_oei: float
    accelerate_stop_aeo: float
    accelerate_stop_reverse: float  # not required on a dry runway; what reverse thrust would give
    take_off_distance_aeo: float  # with its factor
    take_off_run_aeo: float
    v1_set_by: str  # balance, VR or VMCG
    v1_balanced: (
        float  # what it would be if VMCG did not matter, and the two distances there; NaN if beyond control
    )
    balanced_stop: float
    balanced_go: float
    gradients: Gradients
    brake_energy: float  # of its limit
    tyre_speed: float  # of its limit


class Runway(NamedTuple):
    """Distances available, m."""

    run: float
    distance: float
    stop: float


class Decision(NamedTuple):
    """V1 (m/s CAS), what sets it, and the V1 that would balance the distances if VMCG did not matter."""

    v1: float
    set_by: str  # balance, VR or VMCG
    balanced: float


class FieldFlights:
    """The flights of one take-off: each is flown once."""

    def __init__(
        self,
        case: TakeOff,
        manual: FlightManual | None = None,
        *,
        roughly: bool = False,
        vmcg_known: float | None = None,
    ) -> None:
        """`case` at 120 pilot steps a second, or V1 and VR are up to 0.1 m/s and the distances 3 m late.

        VR, if the case has none, is the least of CS 25.107(e): V2 is reached by 35 ft with an engine failed. `roughly`
        is for a search: V1 to 5 m, with the engine failed; `vmcg_known` spares the flights for VMCG.
        """
        self._roughly = roughly
        self.manual = manual or read_manual(case.aircraft)
        self.speeds = take_off_speeds(replace(case, pilot_rate=24, surface="dry"), self.manual, vmcg_known)
        self._flown: dict[tuple[Happening, float], Flown] = {}
        self._rotate_at(case, self.speeds.vr)
        for _ in range(VR_TRIALS if case.vr is None else 0):
            short = self.speeds.v2 - self.go(self.speeds.vr - STEP).speed_at(CS25_SCREEN)
            if short <= SHORT:
                break
            self._rotate_at(case, self.speeds.vr + short)
        if case.vr is None and self.slowest_v1 > self.speeds.vr:  # VR is at least V1, CS 25.107(e)(1)(i)
            self._rotate_at(case, self.slowest_v1)

    def _rotate_at(self, case: TakeOff, vr: float) -> None:
        self.speeds = self.speeds._replace(vr=vr)
        self.case = replace(case, vr=vr)
        self._flown.clear()
        self.all_engines = fly_take_off(self.case, manual=self.manual)

    def fly(self, happening: Happening, height: float = CS25_SCREEN) -> Flown:
        """One of them."""
        key = happening, height
        if key not in self._flown:
            self._flown[key] = fly_take_off(self.case, happening, self.manual, height=height)
        return self._flown[key]

    def vef(self, v1: float) -> float:
        """The failure speed from which V1 is not reached before it is recognised, m/s CAS."""
        flown = self.all_engines
        index = flown.at_speed(v1)
        before = flown.at_time(flown.at(index, "time") - RECOGNITION)
        return flown.at(before, "cas")

    def go(self, v1: float) -> Flown:
        """The take-off continued after an engine failed at VEF."""
        return self.fly(Happening(vef=self.vef(v1), v2=self.speeds.v2))

    def stop(self, v1: float, *, failure: bool, reverse: bool) -> Flown:
        """The take-off rejected at V1, with the engine failed at VEF or all of them running."""
        return self.fly(Happening(vef=self.vef(v1) if failure else None, v1=v1, reverse=reverse))

    def accelerate_go(self, v1: float) -> float:
        """Distance to 35 ft, on a wet runway 15 ft, with an engine failed at VEF, m."""
        flown = self.go(v1)
        return flown.at(flown.at_height(self.screen), "along")

    def accelerate_stop(self, v1: float, *, failure: bool = True, reverse: bool | None = None) -> float:
        """Distance to the stop and 2 s at V1, m. Reverse thrust counts on a wet runway only, CS 25.109(f)."""
        flown = self.stop(v1, failure=failure, reverse=self.wet if reverse is None else reverse)
        decided = flown.when("phase", "RTO")
        return float(flown.along[-1]) + AT_V1 * flown.at(decided, "ground_speed")

    @property
    def wet(self) -> bool:
        """Whether the rules of a wet runway apply."""
        return self.case.surface == "wet"

    @property
    def screen(self) -> float:
        """The screen height with an engine failed, m."""
        return WET_SCREEN if self.wet else CS25_SCREEN

    def decision_speed(self, runway: Runway | None = None) -> Decision:
        """V1 at which what is left of the stop and of the take-off distance is the same: without a runway, they are.

        VMCG and VR bound it.
        """
        longer = 0.0 if runway is None else runway.stop - runway.distance

        def excess(v1: float) -> float:
            return self.longest_stop(v1) - self.accelerate_go(v1) - longer

        high = self.speeds.vr
        if excess(high) <= 0.0:
            return Decision(high, "VR", high)
        try:
            low = self._go_first(excess, high)
        except OverrunError:  # so slow that the aircraft is not kept on the runway: far below VMCG
            balanced = nan
        else:
            balanced = self._bracketed(excess, low, min(low + STEP, high))
        slowest = min(self.slowest_v1, high)
        return (
            Decision(balanced, "balance", balanced)
            if balanced >= slowest
            else Decision(slowest, "VMCG", balanced)
        )

    def _go_first(self, excess: Callable[[float], float], high: float) -> float:
        """A V1 at which going takes more than stopping, found downwards."""
        v1 = high
        while excess(v1) > 0.0:
            v1 -= STEP
        return v1

    def longest_stop(self, v1: float) -> float:
        """Accelerate-stop distance, m: with the engine failed or with all of them, CS 25.109(a)."""
        return max(
            self.accelerate_stop(v1, failure=failure)
            for failure in ((True,) if self._roughly else (True, False))
        )

    def _bracketed(self, excess: Callable[[float], float], low: float, high: float) -> float:
        """The best V1 flown: between two steps of the pilot distances jump by up to a metre."""
        flown: dict[float, float] = {}

        def seen(v1: float) -> float:
            flown[v1] = excess(v1)
            return 0.0 if abs(flown[v1]) < (ROUGHLY if self._roughly else BALANCED) else flown[v1]

        brentq(seen, low, high, xtol=TOLERANCE)
        return min(flown, key=lambda v1: abs(flown[v1]))

    @property
    def slowest_v1(self) -> float:
        """VMCG and what is gained until a failure there is recognised: CS 25.107(a)(1), m/s CAS."""
        flown = self.all_engines
        index = flown.at_speed(self.speeds.vmcg)
        return flown.at(flown.at_time(flown.at(index, "time") + RECOGNITION), "cas")

    def gradients(self, v1: float) -> Gradients:
        """Climb with the engine failed, from what the excess power would climb at constant speed: CS 25.121."""
        base = Happening(vef=self.vef(v1), v2=self.speeds.v2)
        first = self.fly(replace(base, gear_up=False), CLIMB_HEIGHT)
        second = self.fly(base, CLIMB_HEIGHT)
        return Gradients(_gradient(first), _gradient(second), float(second.cas[-1]))

    def field(self, runway: Runway | None = None) -> Field:
        """Everything, at the V1 for this runway, or the balanced one."""
        v1, set_by, balanced = self.decision_speed(runway)
        flown, go = self.all_engines, self.go(v1)
        screen, lift = go.at_height(self.screen), go.liftoff
        aeo_screen = flown.at(flown.at_height(CS25_SCREEN), "along")
        aeo_lift = flown.at(flown.liftoff, "along")
        go_distance = go.at(screen, "along")
        # Half-way from lift-off to 35 ft; on a wet runway to lift-off: CS 25.113(c).
        go_run = go.at(lift, "along") if self.wet else 0.5 * (go.at(lift, "along") + go_distance)
        aeo_run = AEO_FACTOR * 0.5 * (aeo_lift + aeo_screen)
        oei = self.accelerate_stop(v1)
        aeo = self.accelerate_stop(v1, failure=False)
        stop = self.stop(v1, failure=True, reverse=self.wet)
        return Field(
            speeds=self.speeds,
            v1=v1,
            slowest_v1=self.slowest_v1,
            vef=self.vef(v1),
            vlof=flown.at(flown.liftoff, "cas"),
            v_35ft=go.speed_at(CS25_SCREEN),
            take_off_run=max(go_run, aeo_run),
            take_off_distance=max(go_distance, AEO_FACTOR * aeo_screen),
            accelerate_stop=max(oei, aeo),
            accelerate_go_oei=go_distance,
            accelerate_stop_oei=oei,
            accelerate_stop_aeo=aeo,
            accelerate_stop_reverse=self.accelerate_stop(v1, reverse=True),
            take_off_distance_aeo=AEO_FACTOR * aeo_screen,
            take_off_run_aeo=aeo_run,
            v1_set_by=set_by,
            v1_balanced=balanced,
            balanced_stop=nan if isnan(balanced) else self.longest_stop(balanced),
            balanced_go=nan if isnan(balanced) else self.accelerate_go(balanced),
            gradients=self.gradients(v1),
            brake_energy=_share(stop, "gear/brake-energy-peak-mj", "gear/brake-energy-limit-mj"),
            tyre_speed=_share(flown, "gear/tyre-speed-max-mps", "gear/tyre-speed-limit-mps"),
        )


def field_of(case: TakeOff) -> Field:
    """The balanced field of a take-off."""
    return FieldFlights(case).field()


def _gradient(flown: Flown) -> float:
    """Climb and acceleration as one gradient, over the last seconds."""
    last = flown.time >= flown.time[-1] - CLIMB_OVER
    time, speed, height = flown.time[last], flown.ground_speed[last], flown.height[last]
    climb = np.polyfit(time, height, 1)[0]
    gain = np.polyfit(time, speed, 1)[0]
    return float(climb / speed.mean() + gain / G0)


def _share(flown: Flown, quantity: str, limit: str) -> float:
    return flown.wear[quantity] / flown.wear[limit] if {quantity, limit} <= flown.wear.keys() else nan
