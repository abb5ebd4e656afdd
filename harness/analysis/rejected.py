"""What a rejected take-off came to: speeds, distances, deceleration."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from harness.analysis.metrics import roll_deviation
from harness.log import Event, Run
from harness.navigation.database import Runway

WINDOW = 0.5  # s, over which the deceleration is taken


class RejectedTakeOff(NamedTuple):
    """The numbers of a rejected take-off, SI.

    `decision` is when the pilot decides to stop, `brake_onset` when he brakes. Distances are along the ground track.
    """

    decision_s: float
    decision_cas_mps: float
    brake_onset_s: float
    brake_onset_cas_mps: float
    stop_s: float
    accelerate_distance_m: float
    braking_distance_m: float
    accelerate_stop_distance_m: float
    peak_deceleration_mps2: float
    centreline_deviation_m: float


def rejected_take_off(run: Run, runway: Runway) -> RejectedTakeOff:
    """The numbers of a flight that ended with a rejected take-off on `runway`."""
    release = run.summary["brake_release_s"]
    decision, stop = (_entered(run.events, phase) for phase in ("RTO", "END"))
    onset = next(
        (event.time for event in run.events if event.phase == "RTO" and "set=brakes" in event.detail), stop
    )
    speed = np.hypot(run.history["velocity_north"], run.history["velocity_east"])
    moments = np.arange(decision, stop, WINDOW)
    released, decided, braked, stopped = (
        run.at("distance", time) for time in (release, decision, onset, stop)
    )
    return RejectedTakeOff(
        decision_s=decision,
        decision_cas_mps=run.at("cas", decision),
        brake_onset_s=onset,
        brake_onset_cas_mps=run.at("cas", onset),
        stop_s=stop,
        accelerate_distance_m=decided - released,
        braking_distance_m=stopped - braked,
        accelerate_stop_distance_m=stopped - released,
        peak_deceleration_mps2=float(
            np.max(-np.diff(np.interp(moments, run.history["time"], speed)), initial=0.0) / WINDOW
        ),
        centreline_deviation_m=max(roll_deviation(run, runway, phase) for phase in ("T/O", "RTO")),
    )


def _entered(events: Sequence[Event], phase: str) -> float:
    return next(event.time for event in events if event.kind == "phase" and event.name == phase)
