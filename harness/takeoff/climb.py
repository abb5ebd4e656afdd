"""Climb gradients with an engine failed: CS 25.121(a) and (b)."""

from typing import NamedTuple

import numpy as np

from harness.takeoff.case import Happening
from harness.takeoff.field_flights import Asked, FieldFlights
from harness.takeoff.flight import Flown
from harness.units import G0

# CS 25.121(a)(3), (b)(3): four engines
FIRST_SEGMENT, SECOND_SEGMENT = 0.005, 0.03
CLIMB_HEIGHT = 120.0  # m: 400 ft, where the second segment ends; three spans up the ground is not felt
CLIMB_OVER = 4.0  # s before it, over which the gradient is taken


class Gradients(NamedTuple):
    """Climb gradients with an engine failed, per unit, and the speed each was flown at, m/s CAS."""

    first: float
    first_cas: float
    second: float
    second_cas: float


def climbs(flights: FieldFlights, v1: float) -> tuple[Asked, Asked]:
    """First segment, gear down at VLOF, and second, gear up at V2, both after a failure at VEF."""
    go = flights.fly(flights.going(v1))
    vef, vlof = flights.vef(v1), go.at(go.liftoff, "cas")
    return (
        (Happening(vef=vef, v2=vlof, gear_up=False), CLIMB_HEIGHT),
        (Happening(vef=vef, v2=flights.speeds.v2), CLIMB_HEIGHT),
    )


def gradients(flights: FieldFlights, v1: float) -> Gradients:
    """What the excess power would climb at constant speed, both segments."""
    first, second = (flights.fly(one) for one in climbs(flights, v1))
    return Gradients(gradient(first), float(first.cas[-1]), gradient(second), float(second.cas[-1]))


def gradient(flown: Flown) -> float:
    """Climb and acceleration over the last seconds as one gradient: to the air, whatever the wind over the ground."""
    last = flown.time >= flown.time[-1] - CLIMB_OVER
    time, height = flown.time[last], flown.height[last]
    speed = flown.ground_speed[last] + flown.case.headwind
    climb = np.polyfit(time, height, 1)[0]
    gain = np.polyfit(time, speed, 1)[0]
    return float(climb / speed.mean() + gain / G0)
