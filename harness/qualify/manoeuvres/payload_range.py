"""Payload and range: climb, cruise at the best altitude for the mass, descent, integrated from trimmed points.

Quasi-steady, not flown frame by frame: every point of the integration is the six-degrees-of-freedom aircraft, trimmed.
Still air, ISA; fuel for taxiing and an alternate is what the reserve stands for.
"""

from collections.abc import Callable
from dataclasses import replace
from math import cos, radians, sin

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from harness.analysis.panel import Curve, Panel
from harness.errors import FlightError
from harness.plant.bench import Attitude, Bench
from harness.plant.trim import trim
from harness.qualify.condition import Condition
from harness.qualify.manoeuvres.climb import climbing
from harness.qualify.outcome import Aircraft, Outcome
from harness.units import FLIGHT_LEVEL, FT, KM, KT, LB, TONNE, Speed

MASSES = (80e3, 95e3, 110e3, 125e3, 141e3)  # kg
LEVELS = tuple(level * FLIGHT_LEVEL for level in (230, 260, 290, 310, 330, 350, 370))
LOWEST = 1500 * FT
CLIMB = Speed("CAS", 220 * KT)
FULL = 48_879.0  # kg, normal filling: aircraft/gta/facts.csv fuel_usable_normal_fill
PAYLOADS = (37, 30, 20, 0)  # t
MARGIN = 0.97  # of the lever: a cruise leaves something to climb with
STEP = 250.0  # kg of fuel


def payload_range(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Still-air range with each payload: take-off mass and reserve of the condition, cruise at its Mach number."""
    bench = aircraft.loaded(condition)
    empty = bench.get("inertia/empty-weight-lbs") * LB
    flow, top = _cruise_table(aircraft, condition)
    ranges: dict[str, float] = {}
    profiles = []
    for payload in PAYLOADS:
        zero_fuel = empty + payload * TONNE
        fuel = min(FULL, condition.mass - zero_fuel)
        mass, distance, last = zero_fuel + fuel, 0.0, zero_fuel + condition.reserve
        altitude = top(mass)
        burned, far = _to_level(aircraft, condition, mass, altitude)
        down_burned, down_far = _from_level(aircraft, condition, last, top(last))
        mass, distance = mass - burned, far
        profile = [(0.0, 0.0), (distance / KM, altitude / FT / 1000)]
        while mass - down_burned > last:
            burn = min(STEP, mass - down_burned - last)
            middle = mass - burn / 2
            altitude = top(middle)
            distance += condition.tas_at(altitude) * burn / flow(middle, altitude)
            mass -= burn
            profile.append((distance / KM, altitude / FT / 1000))
        profile.append(((distance + down_far) / KM, 0.0))
        ranges[f"range with {payload} t"] = (distance + down_far) / KM
        profiles.append(Curve(f"{payload} t", [x for x, _ in profile], [y for _, y in profile]))
    return Outcome(
        ranges,
        [
            Panel("range, km", "altitude, 1000 ft", profiles),
            Panel("range, km", "payload, t", [Curve("measured", list(ranges.values()), PAYLOADS, "o")]),
        ],
        "quasi-steady integration of trimmed points; fuel for taxi and alternate is the reserve",
    )


def _cruise_table(
    aircraft: Aircraft, condition: Condition
) -> tuple[Callable[[float, float], float], Callable[[float], float]]:
    """Fuel flow over mass and altitude, kg/s, and the altitude of the best range at a mass."""
    flows = np.full((len(MASSES), len(LEVELS)), np.nan)
    for i, mass in enumerate(MASSES):
        bench = aircraft.loaded(condition)
        bench.load(mass)
        for j, altitude in enumerate(LEVELS):
            try:
                found = trim(
                    bench,
                    altitude,
                    Attitude(condition.tas_at(altitude), alpha=radians(3.0)),
                    controls={"throttle": 0.7},
                )
            except FlightError:
                break
            if found.controls["throttle"] > MARGIN:
                break
            flows[i, j] = bench["fuel_flow"]
    speeds = np.array([condition.tas_at(altitude) for altitude in LEVELS])
    best = [LEVELS[int(np.nanargmax(speeds / row))] for row in flows]
    filled = np.where(np.isnan(flows), np.nanmax(flows, axis=1, keepdims=True), flows)
    surface = RegularGridInterpolator((MASSES, LEVELS), filled)

    def flow(mass: float, altitude: float) -> float:
        return float(surface((mass, altitude)))

    def top(mass: float) -> float:
        return float(np.interp(mass, MASSES, best))

    return flow, top


def _to_level(aircraft: Aircraft, condition: Condition, mass: float, altitude: float) -> tuple[float, float]:
    """Fuel (kg) and distance (m) of the climb."""
    bench = aircraft.loaded(condition)
    bench.load(mass)
    steps = np.linspace(LOWEST, altitude, 7)
    climb = replace(condition, speed=CLIMB, lever=1.0)
    return _integrated([_rates(bench, climb, float(height)) for height in steps], steps)


def _from_level(
    aircraft: Aircraft, condition: Condition, mass: float, altitude: float
) -> tuple[float, float]:
    """Fuel (kg) and distance (m) of the descent with idling engines."""
    bench = aircraft.loaded(condition)
    bench.load(mass)
    steps = np.linspace(altitude, LOWEST, 4)
    idle = replace(condition, speed=CLIMB, lever=0.0)
    return _integrated([_rates(bench, idle, float(height)) for height in steps], steps)


def _rates(bench: Bench, condition: Condition, altitude: float) -> tuple[float, float, float]:
    """Rate of climb and ground speed, m/s, and fuel flow, kg/s."""
    now = climbing(bench, condition, altitude).attitude
    return now.tas * sin(now.path), now.tas * cos(now.path), bench["fuel_flow"]


def _integrated(rates: list[tuple[float, float, float]], heights: NDArray[np.float64]) -> tuple[float, float]:
    climb, speed, flow = (np.array(column) for column in zip(*rates, strict=True))
    seconds_a_metre = 1.0 / climb
    return float(np.trapezoid(flow * seconds_a_metre, heights)), float(
        np.trapezoid(speed * seconds_a_metre, heights)
    )
