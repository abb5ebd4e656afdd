"""The flights of one take-off that CS 25.105 to 25.121 ask for, each flown once, and V1 by brackets on them."""

from collections.abc import Callable
from dataclasses import replace
from math import isnan, nan
from typing import NamedTuple

from scipy.optimize import brentq

from harness.errors import OverrunError
from harness.manual import FlightManual, read_manual
from harness.takeoff.case import NOTHING, Happening, TakeOff
from harness.takeoff.fleet import fly_all
from harness.takeoff.flight import CS25_SCREEN, Flown, fly_take_off
from harness.takeoff.speeds import ControlSpeeds, control_speeds, take_off_speeds
from harness.units import FT

RECOGNITION = 1.0  # s from the failure to the first action, AMC 25.107(a)(2)
AT_V1 = 2.0  # s at V1 that CS 25.109(a) adds to the stop
WET_SCREEN = 15 * FT  # CS 25.113(b)(2), with an engine failed on a wet runway
BALANCED = 0.5  # m: the brackets on V1 stop here
TOLERANCE = 0.02  # m/s, likewise
VR_TRIALS, REACHED = 5, 0.03  # m/s: V2 at 35 ft is met so well
STEP = 2.0  # m/s below VR: V1 of the trials for VR
STEEPER = (
    1.3  # the first step towards the balance goes so much further than the estimate, to have it in between
)
BRAKES = ("gear/brake-energy-peak-mj", "gear/brake-energy-limit-mj")
WORN = 0.002  # of the brakes' limit: the brackets on VMBE stop here

Asked = tuple[Happening, float]


class Runway(NamedTuple):
    """Distances available, m."""

    run: float
    distance: float
    stop: float


class Guess(NamedTuple):
    """Where VR and V1 are looked for first; the flights decide."""

    v2_less_vr: float
    v1_over_vr: float
    dry_v1_over_vr: float  # on a wet runway that of the dry one, else the same


class Decision(NamedTuple):
    """V1 (m/s CAS), what sets it, and the V1 that would balance the distances if nothing else mattered."""

    v1: float
    set_by: str  # balance, VR, VMCG or brake energy
    balanced: float


def _fly(asked: tuple[TakeOff, Happening, FlightManual, float]) -> Flown:
    case, happening, manual, height = asked
    return fly_take_off(case, happening, manual, height=height)


class FieldFlights:
    """The flights of one take-off. Distances are from brake release, m; speeds m/s CAS."""

    def __init__(
        self,
        case: TakeOff,
        manual: FlightManual | None = None,
        control: ControlSpeeds | None = None,
        workers: int = 1,
        guess: Guess | None = None,
    ) -> None:
        """`case` at 120 pilot steps a second, or V1 and VR are up to 0.1 m/s and the distances 3 m late.

        VR, if the case has none, is the least of CS 25.107(e): V2 is reached by 35 ft with an engine failed. `control`
        are the minimum control speeds of the day, if they are known already; `guess` comes from another mass.
        """
        self.manual = manual or read_manual(case.aircraft)
        self.speeds = take_off_speeds(
            case, self.manual, control or control_speeds(case, self.manual, workers)
        )
        self._workers = workers
        self._first_v1 = 1.0 if guess is None else guess.v1_over_vr
        self._flown: dict[Asked, Flown] = {}
        self._stop_with_all = False
        first = self.speeds.vr
        if case.vr is None and guess is not None:
            first = max(self.speeds.v2 - guess.v2_less_vr, self.speeds.vr_min)
        self._rotate_at(case, first)
        if case.vr is None:
            self._rotate_at(case, self._least_vr())
            if self.slowest_v1 > self.speeds.vr:  # VR is at least V1, CS 25.107(e)(1)(i)
                self._rotate_at(case, self.slowest_v1)

    def _rotate_at(self, case: TakeOff, vr: float) -> None:
        if self._flown and vr == self.speeds.vr:
            return
        self.speeds = self.speeds._replace(vr=vr)
        self.case = replace(case, vr=vr)
        self._flown.clear()
        self.fly((NOTHING, CS25_SCREEN))

    def _least_vr(self) -> float:
        """Trials with an engine failing shortly before VR; the speed at 35 ft grows as VR does."""
        vr, least = self.speeds.vr, self.speeds.vr_min
        happening = Happening(vef=self.vef(vr - STEP), v2=self.speeds.v2)
        for _ in range(VR_TRIALS):
            trial = _fly((replace(self.case, vr=vr), happening, self.manual, CS25_SCREEN))
            short = self.speeds.v2 - trial.speed_at(CS25_SCREEN)
            if abs(short) <= REACHED or (short < 0.0 and vr <= least):
                break
            vr = max(vr + short, least)
        return vr

    def fly(self, *asked: Asked) -> Flown:
        """The first of them; those not flown yet are flown together."""
        missing = [one for one in dict.fromkeys(asked) if one not in self._flown]
        cases = [(self.case, happening, self.manual, height) for happening, height in missing]
        self._flown.update(zip(missing, fly_all(_fly, cases, self._workers, self.case), strict=True))
        return self._flown[asked[0]]

    @property
    def all_engines(self) -> Flown:
        """The take-off without a failure."""
        return self.fly((NOTHING, CS25_SCREEN))

    def vef(self, v1: float) -> float:
        """The failure speed from which V1 is not reached before it is recognised, m/s CAS."""
        flown = self.all_engines
        index = flown.at_speed(v1)
        before = flown.at_time(flown.at(index, "time") - RECOGNITION)
        return flown.at(before, "cas")

    def going(self, v1: float) -> Asked:
        """The take-off continued after an engine failed at VEF."""
        return Happening(vef=self.vef(v1), v2=self.speeds.v2), CS25_SCREEN

    def stopping(self, v1: float, *, failure: bool, reverse: bool | None = None) -> Asked:
        """The take-off rejected at V1, with the engine failed at VEF or all of them running.

        Reverse thrust counts on a wet runway only, CS 25.109(f).
        """
        vef = self.vef(v1) if failure else None
        return Happening(vef=vef, v1=v1, reverse=self.wet if reverse is None else reverse), CS25_SCREEN

    def accelerate_go(self, v1: float) -> float:
        """Distance to 35 ft, on a wet runway 15 ft, with an engine failed at VEF, m."""
        flown = self.fly(self.going(v1))
        return flown.at(flown.at_height(self.screen), "along")

    def accelerate_stop(self, v1: float, *, failure: bool = True, reverse: bool | None = None) -> float:
        """Distance to the stop and 2 s at V1, m."""
        flown = self.fly(self.stopping(v1, failure=failure, reverse=reverse))
        decided = flown.when("phase", "RTO")
        return float(flown.along[-1]) + AT_V1 * flown.at(decided, "ground_speed")

    def longest_stop(self, v1: float) -> float:
        """Accelerate-stop distance, m: with the engine failed or with all of them, CS 25.109(a)."""
        return max(self.accelerate_stop(v1, failure=failure) for failure in (True, False))

    def brake_energy(self, v1: float) -> float:
        """What a stop from V1 leaves in the hardest worked brake, as a share of its limit. NaN without such brakes."""
        used, limit = BRAKES
        stops = [self.fly(self.stopping(v1, failure=failure)).wear for failure in (True, False)]
        return max((wear[used] / wear[limit] for wear in stops if used in wear), default=nan)

    @property
    def wet(self) -> bool:
        """Whether the rules of a wet runway apply."""
        return self.case.surface == "wet"

    @property
    def screen(self) -> float:
        """The screen height with an engine failed, m."""
        return WET_SCREEN if self.wet else CS25_SCREEN

    @property
    def slowest_v1(self) -> float:
        """VMCG and what is gained until a failure there is recognised: CS 25.107(a)(1), m/s CAS."""
        flown = self.all_engines
        index = flown.at_speed(self.speeds.vmcg)
        return flown.at(flown.at_time(flown.at(index, "time") + RECOGNITION), "cas")

    def decision_speed(self, runway: Runway | None = None) -> Decision:
        """V1 at which what is left of the stop and of the take-off distance is the same: without a runway, they are.

        VMCG, VR and what the brakes absorb (VMBE) bound it.
        """
        longer = 0.0 if runway is None else runway.stop - runway.distance
        try:
            balanced = self._balanced(longer)
        except OverrunError:  # so slow that the aircraft is not kept on the runway: far below VMCG
            balanced = nan
        slowest = min(self.slowest_v1, self.speeds.vr)
        if balanced >= slowest:
            chosen = Decision(balanced, "VR" if balanced == self.speeds.vr else "balance", balanced)
        else:
            chosen = Decision(slowest, "VMCG", balanced)
        if self.brake_energy(chosen.v1) > 1.0 and chosen.v1 > slowest:
            return chosen._replace(v1=self._brakes_bear(slowest, chosen.v1), set_by="brake energy")
        return chosen

    def _balanced(self, longer: float) -> float:
        """V1 of equal distances, the stop `longer` than the other, or VR if even there it takes less."""

        def stop(v1: float) -> float:
            if self._stop_with_all:
                self.fly(self.stopping(v1, failure=True), self.stopping(v1, failure=False), self.going(v1))
                return self.longest_stop(v1)
            self.fly(self.stopping(v1, failure=True), self.going(v1))
            return self.accelerate_stop(v1)

        def excess(v1: float) -> float:
            return stop(v1) - self.accelerate_go(v1) - longer

        v1 = self._root(excess)
        # Nearly always the stop with the engine failed is the longer one: the other is looked at only here.
        if not self._stop_with_all and self.longest_stop(v1) > stop(v1):
            self._stop_with_all = True
            v1 = self._root(excess)
        return v1

    def _slope(self, v1: float) -> float:
        """How the stop less the take-off distance grows with V1, s: estimate, more than a square."""
        return 3.0 * self.accelerate_stop(v1) / v1

    def _root(self, excess: Callable[[float], float]) -> float:
        """Where `excess`, which grows with V1, is nearest to nothing; VR if it is negative even there."""
        high = self.speeds.vr
        flown: dict[float, float] = {}

        def seen(v1: float) -> float:
            flown[v1] = excess(v1)
            return 0.0 if abs(flown[v1]) < BALANCED else flown[v1]

        v1, stretch = high * self._first_v1, STEEPER
        below = above = nan
        while (value := seen(v1)) != 0.0 and (isnan(below) or isnan(above)):
            below, above = (below, v1) if value > 0.0 else (v1, above)
            if below >= high:
                return high
            if isnan(below) or isnan(above):
                v1, stretch = min(v1 - stretch * value / self._slope(v1), high), 2.0 * stretch
        if value != 0.0:
            brentq(seen, below, above, xtol=TOLERANCE)
        # Between two steps of the pilot distances jump by up to a metre: the best of those flown.
        return min(flown, key=lambda one: abs(flown[one]))

    def _brakes_bear(self, slowest: float, fastest: float) -> float:
        """VMBE: the fastest V1 from which the brakes absorb the stop, or `slowest` if none does."""
        flown: dict[float, float] = {}

        def over(v1: float) -> float:
            self.fly(self.stopping(v1, failure=True), self.stopping(v1, failure=False))
            flown[v1] = self.brake_energy(v1) - 1.0
            return 0.0 if -WORN < flown[v1] <= 0.0 else flown[v1] + 0.5 * WORN

        if over(slowest) >= 0.0:
            return slowest
        brentq(over, slowest, fastest, xtol=TOLERANCE)
        return max((v1 for v1, share in flown.items() if share <= 0.0), default=slowest)
