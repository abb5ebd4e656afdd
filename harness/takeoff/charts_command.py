"""`harness takeoff sensitivities` and `harness takeoff carpet`."""

import argparse
from typing import TYPE_CHECKING

from harness.command_line import add_json, print_json
from harness.errors import InputError
from harness.takeoff import options
from harness.units import parse

if TYPE_CHECKING:
    from harness.command_line import Subparsers


def add(topics: "Subparsers") -> None:
    """The arguments of both."""
    derivatives = topics.add_parser(
        "sensitivities", help="derivatives of the distance to 35 ft, with a check of their steps"
    )
    derivatives.add_argument("--mass", metavar="110t", required=True, help="take-off mass")
    carpet = topics.add_parser("carpet", help="distances over mass, temperature and elevation")
    carpet.add_argument(
        "--mass", metavar="FROM:TO:STEP", default="90t:140t:10t", help="(default: %(default)s)"
    )
    carpet.add_argument(
        "--warmths", metavar="LIST", default="0K,15K,30K", help="deviations from ISA (default: %(default)s)"
    )
    carpet.add_argument(
        "--elevations", metavar="LIST", default="0m,1000m,2000m", help="(default: %(default)s)"
    )
    for parser, run in ((derivatives, run_sensitivities), (carpet, run_carpet)):
        parser.add_argument(
            "--vr",
            metavar="SPEED",
            default="scheduled",
            help="rotation speed, CAS (default: by the stall speed)",
        )
        options.add_conditions(parser, fine=parser is derivatives)
        add_json(parser)
        parser.set_defaults(run=run)


def run_sensitivities(chosen: argparse.Namespace) -> int:
    """`harness takeoff sensitivities`."""
    mass = options.read("--mass", parse, chosen.mass, "mass")
    fields = options.conditions(chosen)
    workers = options.workers(chosen.workers)
    from harness.takeoff.case import TakeOff, check_all, fine
    from harness.takeoff.charts import early_rotation, sensitivities

    case = fine(TakeOff(mass, **fields))
    check_all([case])
    found, early = sensitivities(case, workers), early_rotation(case, workers)
    if chosen.json:
        print_json({"sensitivities": [one._asdict() for one in found], "early_rotation": early})
        return 0
    print(
        f"distance to 35 ft, all engines, {mass / 1e3:.1f} t: for the change people speak of; "
        "per unit, at the whole step and at half of it"
    )
    for one in found:
        told = f"step {one.step:g}" + ("" if one.smooth else ", NOT SMOOTH")
        print(
            f"  {one.name:13}{one.usual_change:>15}{one.usual_share:>+8.1%}"
            f"{one.derivative:>12.5g} m per {one.unit:5}{one.at_half_step:>12.5g}   {told}"
        )
    print(
        f"  VR early by {early['vr_mps'] - early['early_vr_mps']:.1f} m/s: {early['longer']:+.1%} of the distance; "
        f"AMC 25.107(e)(4) wants at most +1 %: {'met' if early['met'] else 'NOT MET'}"
    )
    return 0


def run_carpet(chosen: argparse.Namespace) -> int:
    """`harness takeoff carpet`."""
    masses = options.read("--mass", options.masses, chosen.mass)
    warmths = options.read("--warmths", options.several, chosen.warmths, "temperature-difference")
    elevations = options.read("--elevations", options.several, chosen.elevations, "length")
    fields = options.conditions(chosen)
    workers = options.workers(chosen.workers)
    from harness.takeoff.case import TakeOff, check_all
    from harness.takeoff.charts import carpet
    from harness.takeoff.fleet import fly_all
    from harness.takeoff.rows import case_row

    cases = carpet(TakeOff(masses[0], **fields), masses, warmths, elevations)
    if len(cases) > options.MOST_CASES:
        raise InputError(
            f"{len(cases)} take-offs are asked for",
            file="--mass",
            remedy="fewer here; harness study for more",
        )
    check_all(cases)
    rows = fly_all(case_row, cases, workers, cases[0])
    if chosen.json:
        print_json(rows)
        return 0
    print("distance to 35 ft, all engines, m" + "".join(f"{mass / 1e3:>9.1f} t" for mass in masses))
    for i in range(0, len(rows), len(masses)):
        line = rows[i : i + len(masses)]
        head = f"  {line[0]['elevation_m']:.0f} m, ISA {line[0]['isa_deviation_K']:+.0f} K"
        print(f"{head:33}" + "".join(f"{row['distance_35ft_m']:>11.0f}" for row in line))
    return 0
