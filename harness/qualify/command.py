"""`harness qualify`: which aircraft, which tests, where the page goes."""

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from harness import resources
from harness.command_line import OUTSIDE, add_json, print_json, say
from harness.errors import InputError, did_you_mean

if TYPE_CHECKING:
    from harness.command_line import Subparsers

GUIDE = "qualification.csv"


def add(commands: "Subparsers") -> None:
    """The arguments of `harness qualify`."""
    parser = commands.add_parser(
        "qualify",
        help="fly an aircraft's test guide and hold each result against its target",
        description="Fly the objective tests of aircraft/NAME/qualification.csv; exit code 1 if a result is outside.",
    )
    parser.add_argument(
        "aircraft", metavar="AIRCRAFT", nargs="?", default="gta", help="its name (default: %(default)s)"
    )
    parser.add_argument("--only", metavar="TEST", nargs="+", default=[], help="ids of tests, such as V10 V27")
    parser.add_argument("--out", metavar="DIR", help="folder for the HTML page (default: none is written)")
    parser.add_argument("--jobs", metavar="N", type=int, help="flights at once (default: one a processor)")
    add_json(parser)
    parser.set_defaults(run=run)


def run(chosen: argparse.Namespace) -> int:
    """`harness qualify`: the verdicts in the order of the guide; exit code 1 if one is outside."""
    name, known = chosen.aircraft, resources.aircraft()
    if chosen.jobs is not None and chosen.jobs < 1:
        raise InputError(f"{chosen.jobs} flights at once are none.", file="--jobs", remedy="give 1 or more")
    if name not in known:
        raise InputError(f'there is no aircraft "{name[:100]}".', remedy=did_you_mean(name, known))
    from harness.qualify.guide import read_guide, select
    from harness.qualify.judge import qualify
    from harness.qualify.manoeuvres import MANOEUVRES
    from harness.qualify.outcome import Aircraft
    from harness.qualify.report import table, write_page

    rows = select(read_guide(known[name].parent / GUIDE, MANOEUVRES), chosen.only)
    flown = qualify(
        Aircraft(resources.root(), name), rows, jobs=chosen.jobs, told=lambda text: say(f"harness: {text}")
    )
    order = {row.id: i for i, row in enumerate(rows)}
    verdicts = sorted(flown, key=lambda verdict: order[verdict.row.id])
    page = None
    if chosen.out is not None:
        page = write_page(verdicts, name, resources.fingerprint(name), Path(chosen.out))
    if chosen.json:
        print_json([verdict.as_data() for verdict in verdicts])
    else:
        print(table(verdicts))
        if page is not None:
            print(f"page: {page}")
    return 0 if all(verdict.inside for verdict in verdicts) else OUTSIDE
