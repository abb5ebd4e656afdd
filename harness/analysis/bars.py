"""How good a flight must be: each quantity of a flight held against its bar. From the log alone.

Source of the bars: issue 2, "How good it must be"; what it asks for in words only has its number here.
"""

from collections.abc import Iterator, Sequence
from math import isnan, nan
from typing import NamedTuple

import numpy as np

from harness.analysis.level import Hold
from harness.analysis.metrics import Envelope, FlownLeg, Measures, measure
from harness.log import Run
from harness.manual import FlightManual
from harness.mission.model import Mission
from harness.navigation.database import Runway
from harness.units import DEG, FT, KT, MIN, NM

PAPER_TIME = 78.0  # min to WP12. Source: AIAA 2010-7777, Results A
PAPER_TOLERANCE = 0.03
PAPER_MISSIONS = {"cologne-munich": True, "cologne-munich-tas": False}
"""The missions that fly Table 1, and whether their time is judged or only told."""
TURNS = 2.0  # reversals a minute: a correction and its end; a limit cycle has more
LEVER_SWING = 0.01
LEVEL_SWING = 10.0  # ft
CAS_SWING = 0.5  # kt
LOAD_FACTOR_SWING = 0.05
STAND_REACHED = 5.0  # m
STOPPED = 0.1  # m/s
LATCHED = "latched by the aircraft 60 times a second"
CROSSWIND = 15 * KT  # the strongest wind for which there is a bar on the runway


class Bar(NamedTuple):
    """A quantity, what was measured and between which bounds it must be; with no bound it is told only."""

    quantity: str
    measured: float
    unit: str
    low: float | None = None
    high: float | None = None
    remark: str = ""

    @property
    def inside(self) -> bool | None:
        """Whether the bar is met, None without one. What could not be measured does not meet it."""
        if self.low is None and self.high is None:
            return None
        if isnan(self.measured):
            return False
        return (self.low is None or self.measured >= self.low) and (
            self.high is None or self.measured <= self.high
        )


def judge(run: Run, mission: Mission, manual: FlightManual, departure: Runway, arrival: Runway) -> list[Bar]:
    """Hold a flight against its bars."""
    found = measure(run, mission, manual, departure, arrival)
    completed = bool(run.summary["completed"])
    closure = run.summary["mass_closure_kg"]
    return [
        Bar("flight completed", float(completed), "", 1.0, None, run.summary["reason"]),
        *_time(run, mission),
        *(_leg(flown) for flown in found.legs),
        *_level(found),
        *_runway(found, mission),
        *_landing(found, mission),
        *_never(run, manual, found.envelope),
        Bar("mass closure", nan if closure is None else closure, "kg", -0.1, 0.1),
    ]


def _time(run: Run, mission: Mission) -> Iterator[Bar]:
    if mission.name not in PAPER_MISSIONS:
        return
    release = run.summary["brake_release_s"]
    times = {passage.name: passage.time for passage in run.passages}
    minutes = (times.get("WP12", nan) - (nan if release is None else release)) / MIN
    bar = Bar("WP12 after brake release", minutes, "min", remark="speeds as TAS")
    if PAPER_MISSIONS[mission.name]:
        low, high = PAPER_TIME * (1 - PAPER_TOLERANCE), PAPER_TIME * (1 + PAPER_TOLERANCE)
        bar = bar._replace(low=low, high=high, remark="speeds as CAS")
    yield bar


def _leg(flown: FlownLeg) -> Bar:
    """A leg against its bar. What was not passed has NaN, and a direct leg a bar that only NaN fails."""
    leg, name = flown.leg, flown.leg.name
    at = "not passed" if flown.passage is None else f"at {flown.passage.time:.0f} s"
    if leg.mode == "homing":
        return Bar(f"{name} homing: closest", flown.closest / NM, "NM", None, 0.3, at)
    if leg.mode == "tracking":
        turn = f", {leg.turn}: closest {flown.closest / NM:.2f} NM"
        return Bar(f"{name} tracking: off the course", flown.cross_track / NM, "NM", None, 0.3, at + turn)
    return Bar(f"{name} direct: off the line", flown.cross_track / NM, "NM", *_told(flown.cross_track), at)


def _told(value: float) -> tuple[float | None, float | None]:
    """No bar, but for what was not flown: that is outside any."""
    return (0.0, None) if isnan(value) else (None, None)


def _level(found: Measures) -> Iterator[Bar]:
    level = found.level
    yield _worst("level once captured", level.levels, FT, "ft", 50.0)
    yield _worst("CAS in level flight once captured", level.speeds, KT, "kt", 2.0)
    for bar in (
        Bar("lever reversals of 2 % in level flight", level.lever_reversals, "1/min", None, TURNS),
        Bar("lever swing, steady level flight", level.lever_swing, "", None, LEVER_SWING),
        Bar("level swing, steady level flight", level.level_swing / FT, "ft", None, LEVEL_SWING),
        Bar("CAS swing, steady level flight", level.cas_swing / KT, "kt", None, CAS_SWING),
        Bar("load-factor swing, steady climb and descent", found.climb_swing, "", None, LOAD_FACTOR_SWING),
    ):
        if not isnan(bar.measured):  # a short mission has no stretch long enough to tell
            yield bar


def _worst(quantity: str, holds: Sequence[Hold], unit: float, name: str, bar: float) -> Bar:
    """The worst of the stretches at one target; one that was never captured is the worst of all."""
    if not holds:
        return Bar(quantity, nan, name, None, bar, "no level flight")
    worst = max(holds, key=lambda hold: np.nan_to_num(hold.deviation.largest, nan=np.inf))
    latest = max(hold.deviation.captured - hold.begin for hold in holds)
    remark = f"{worst.begin:.0f} to {worst.end:.0f} s; the worst of {len(holds)}, captured in {latest:.0f} s or less"
    if isnan(worst.deviation.captured):
        remark = f"not captured {worst.begin:.0f} to {worst.end:.0f} s"
    return Bar(quantity, worst.deviation.largest / unit, name, None, bar, remark)


def _runway(found: Measures, mission: Mission) -> Iterator[Bar]:
    wind = mission.environment.wind_speed
    bar = 3.0 if wind == 0.0 else 6.0 if wind <= CROSSWIND * (1 + 1e-6) else None
    air = "still air" if wind == 0.0 else f"{wind / KT:.0f} kt of wind"
    yield Bar("take-off roll: off the centre line", found.takeoff_roll, "m", None, bar, air)
    yield Bar("landing roll: off the centre line", found.landing_roll, "m", None, bar, air)


def _landing(found: Measures, mission: Mission) -> Iterator[Bar]:
    yield Bar("glide slope, 1,000 ft to the flare", found.glide_slope_dots, "dots", None, 0.5)
    yield Bar("localizer, 1,000 ft to the flare", found.localizer_dots, "dots")
    yield Bar("touchdown past the threshold", found.touchdown.distance, "m", 200.0, 700.0)
    yield Bar("sink at touchdown", found.touchdown.sink, "m/s", None, 1.2)
    yield Bar("runway left after the landing roll", found.stopping_margin, "m", 0.0)
    if mission.arrival.stand is not None:
        heading = f"heading {found.parked.heading_error / DEG:+.1f} deg off"
        yield Bar("from the stand", found.parked.distance, "m", None, STAND_REACHED, heading)
    yield Bar("speed at the end", found.parked.speed, "m/s", None, STOPPED)


def _never(run: Run, manual: FlightManual, never: Envelope) -> Iterator[Bar]:
    limits, seen = manual.limits, _rates(run)
    yield Bar("stall warning in the air", float(never.stall_warning), "", None, 0.0, LATCHED)
    yield Bar("CAS over the 1-g stall speed", never.stall_ratio, "", remark=seen)
    yield Bar("below VMO", never.vmo_margin / KT, "kt", 0.0, None, seen)
    yield Bar("below MMO", never.mmo_margin, "Mach", 0.0, None, seen)
    yield Bar("below the flap speed", never.flap_speed_margin / KT, "kt", 0.0)
    yield Bar("below the gear speed", never.gear_speed_margin / KT, "kt", 0.0)
    yield Bar("bank", never.bank / DEG, "deg", None, limits["maximum-bank"] / DEG, LATCHED)
    yield Bar("least load factor", never.load_factor_low, "", limits["minimum-load-factor"], None, LATCHED)
    yield Bar(
        "greatest load factor", never.load_factor_high, "", None, limits["maximum-load-factor"], LATCHED
    )


def _rates(run: Run) -> str:
    """How often the log looks while in the air."""
    time = run.history["time"][run.history["main_on_ground"] == 0]
    if len(time) < 2:
        return "never in the air"
    steps = np.diff(time)
    return f"looked at every {np.min(steps[steps > 0]):.2f} s at the runway to {np.median(steps):.2f} s aloft"
