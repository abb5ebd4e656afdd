"""Does the simulation keep its books? Mass against fuel flow, energy against work, rotation against moments."""

from math import cos, radians, sin

import numpy as np
from scipy.integrate import trapezoid

from harness.plant.bench import LBF, Attitude, Bench, Record
from harness.plant.trim import release, trim
from harness.qualify.condition import Condition
from harness.qualify.outcome import Aircraft, Outcome, history
from harness.units import DEG, FT

EARTH_RATE = 7.292115e-5  # rad/s, WGS 84
EARTH_RADIUS = 6_371_000.0  # m; enters with the centrifugal acceleration only
SLUG_FT2 = LBF * FT  # kg m2
PARTS = ("aero", "prop", "external")
INERTIAS = tuple(f"inertia/i{axes}-slugs_ft2" for axes in ("xx", "yy", "zz", "xy", "xz", "yz"))


def mass(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Fuel gone from the tanks against the fuel flow integrated over every frame, with moving levers."""
    bench = aircraft.loaded(condition)
    trim(bench, condition.altitude, Attitude(condition.tas, alpha=radians(5.0)))
    release(bench)
    start, used = bench["fuel"], bench["fuel_used"]

    def levers(time: float) -> None:
        bench.levers(0.6 + 0.35 * sin(time / 4.0))

    bench.put("fcs/law", 0.0)
    for axis in ("pitch", "roll", "yaw"):
        bench.put(f"ap/{axis}-mode", 1.0)
    bench.put("ap/pitch-target-rad", bench["pitch"])
    record = bench.record(120.0, ("fuel", "fuel_used", "fuel_flow"), pilot=levers)
    record["closure"] = (start - record["fuel"]) - (record["fuel_used"] - used)
    burned = float(record["fuel_used"][-1] - used)
    return Outcome(
        {"closure": 1e6 * float(np.abs(record["closure"]).max()) / burned},
        [
            history(record, "fuel flow, kg/s", ("fuel_flow", 1.0)),
            history(record, "tanks less flow, mg", ("closure", 1e-6)),
        ],
        f"{burned:.1f} kg burned",
    )


def _lively(bench: Bench, condition: Condition, quantities: tuple[str, ...]) -> Record:
    """A climb with rolling and pitching, every frame recorded, fuel frozen."""
    trim(bench, condition.altitude, Attitude(condition.tas, alpha=radians(5.0)))
    bench.move(True)
    bench.put("fcs/law", 0.0)
    for axis in ("pitch", "roll", "yaw"):
        bench.put(f"ap/{axis}-mode", 1.0)
    level = bench["pitch"]
    bench.levers(1.0)

    def pilot(time: float) -> None:
        bench.put("ap/pitch-target-rad", level + radians(6.0) * sin(time / 5.0) ** 2)
        bench.put("ap/bank-target-rad", radians(25.0) * sin(time / 6.0))

    return bench.record(60.0, quantities, steps=1, pilot=pilot)


def energy(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Kinetic and potential energy against the work of air, propellers and jets, in the rotating frame of the Earth."""
    bench = aircraft.loaded(condition)
    forces = tuple(f"forces/fb{axis}-{part}-lbs" for part in PARTS for axis in "xyz")
    velocities = tuple(f"velocities/{axis}-fps" for axis in "uvw")
    record = _lively(
        bench,
        condition,
        (
            *forces,
            *velocities,
            "altitude",
            "vertical_speed",
            "accelerations/gravity-ft_sec2",
            "mass",
            "latitude",
        ),
    )
    velocity = np.column_stack([record[name] * FT for name in velocities])
    force = sum(
        np.column_stack([record[f"forces/fb{axis}-{part}-lbs"] * LBF for axis in "xyz"]) for part in PARTS
    )
    power = np.einsum("ij,ij->i", np.asarray(force), velocity)
    body = record["mass"][0]
    pull = (
        record["accelerations/gravity-ft_sec2"] * FT
        - EARTH_RATE**2 * EARTH_RADIUS * cos(float(record["latitude"][0])) ** 2
    )
    kinetic = 0.5 * body * np.einsum("ij,ij->i", velocity, velocity)
    gain = kinetic[-1] - kinetic[0] + body * float(trapezoid(pull * record["vertical_speed"], record["time"]))
    work = float(trapezoid(power, record["time"]))
    scale = float(trapezoid(np.abs(power), record["time"]))
    record["power"] = power
    return Outcome(
        {"closure": 1e4 * abs(gain - work) / scale},
        [
            history(record, "altitude, m", ("altitude", 1.0)),
            history(record, "power of all forces, MW", ("power", 1e6)),
        ],
        f"energy gained {gain / 1e6:.1f} MJ, work {work / 1e6:.1f} MJ",
    )


def rotation(aircraft: Aircraft, condition: Condition) -> Outcome:
    """Rates against the integral of Euler's equations with the moments on the aircraft."""
    bench = aircraft.loaded(condition)
    moments = tuple(f"moments/{axis}-total-lbsft" for axis in "lmn")
    rates = tuple(f"velocities/{axis}i-rad_sec" for axis in "pqr")
    record = _lively(bench, condition, (*moments, *rates, "roll_rate", "pitch_rate", "yaw_rate", *INERTIAS))
    xx, yy, zz, xy, xz, yz = (float(record[name][0]) * SLUG_FT2 for name in INERTIAS)
    inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])  # JSBSim gives the elements of the matrix
    moment = np.column_stack([record[name] * LBF * FT for name in moments])
    rate = np.column_stack([record[name] for name in rates])
    change = np.linalg.solve(inertia, (moment - np.cross(rate, rate @ inertia)).T).T
    worst = 0.0
    for i, name in enumerate(("roll_rate", "pitch_rate", "yaw_rate")):
        steps = np.diff(record["time"]) * (change[1:, i] + change[:-1, i]) / 2
        integral = rate[0, i] + np.concatenate(([0.0], np.cumsum(steps)))
        record[f"{name} from moments"] = integral
        worst = max(worst, float(np.abs(integral - rate[:, i]).max()) / DEG)
    return Outcome(
        {"closure": worst},
        [
            history(record, "roll rate, deg/s", ("roll_rate", DEG), ("roll_rate from moments", DEG)),
            history(record, "pitch rate, deg/s", ("pitch_rate", DEG), ("pitch_rate from moments", DEG)),
        ],
    )
