"""`harness takeoff`: take-offs over mass, as the paper's Fig. 14."""

import argparse
import csv
import json
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from harness.command_line import add_json, print_json
from harness.takeoff import card_command, charts_command, options
from harness.units import KT

if TYPE_CHECKING:
    from harness.command_line import Subparsers
    from harness.takeoff.case import TakeOff
    from harness.takeoff.flight import Flown

PAPER_MASSES = "89t:124t:7t"
COLUMNS = (
    ("mass", "t", "mass_kg", 1e-3, 1),
    ("VR", "m/s", "vr_mps", 1.0, 1),
    ("VLOF", "m/s", "vlof_mps", 1.0, 1),
    ("lift-off", "m", "liftoff_distance_m", 1.0, 0),
    ("35 ft", "m", "distance_35ft_m", 1.0, 0),
    ("35 m", "m", "distance_35m_m", 1.0, 0),
    ("35 m", "s", "time_35m_s", 1.0, 1),
    ("V 35 m", "m/s", "v_35m_mps", 1.0, 1),
    ("1.15 x 35 ft", "m", "takeoff_distance_aeo_m", 1.0, 0),
)


def add(commands: "Subparsers") -> None:
    """The arguments of `harness takeoff` and of its topics."""
    parser = commands.add_parser(
        "takeoff",
        help="take-off distances over mass",
        description="Fly take-offs from standstill to the screen height, one for each mass.",
    )
    parser.add_argument(
        "--mass",
        metavar="FROM:TO:STEP",
        default=PAPER_MASSES,
        help="take-off masses, also 89t,100t (default: %(default)s)",
    )
    parser.add_argument(
        "--vr",
        metavar="SPEED",
        default="62.5m/s",
        help="rotation speed, CAS (default: %(default)s), or scheduled: by the stall speed",
    )
    options.add_conditions(parser, fine=False)
    parser.add_argument("--out", metavar="DIR", help="folder for a new folder with table and picture")
    add_json(parser)
    parser.set_defaults(run=run)
    topics = parser.add_subparsers(dest="topic", metavar="TOPIC", title="more")
    card_command.add(topics)
    charts_command.add(topics)


def run(chosen: argparse.Namespace) -> int:
    """`harness takeoff`: fly, print, keep."""
    masses = options.read("--mass", options.masses, chosen.mass)
    fields = options.conditions(chosen)
    workers = options.workers(chosen.workers)
    from harness.takeoff.case import TakeOff

    cases = [TakeOff(mass, **fields) for mass in masses]
    beside: list[Flown] = []
    folder = None
    if chosen.out is None:
        flown = _fly(cases, workers)
    else:
        flown, beside, folder = _keep(cases, workers, chosen.out)
    from harness.takeoff.rows import row

    rows = [row(one) for one in flown]
    if chosen.json:
        print_json(rows)
    else:
        print(table(rows, [row(one) for one in beside], folder))
    return 0


def _fly(
    cases: Sequence["TakeOff"], workers: int, meanwhile: Sequence[Callable[[], object]] = ()
) -> list["Flown"]:
    from harness.takeoff.case import check_all
    from harness.takeoff.fleet import fly_all
    from harness.takeoff.flight import fly_take_off

    check_all(cases)
    return fly_all(fly_take_off, cases, workers, cases[0], meanwhile)


def _keep(cases: list["TakeOff"], workers: int, out: str) -> tuple[list["Flown"], list["Flown"], Path]:
    from harness.log import RunFolder
    from harness.takeoff.fig14 import beside, draw, load_pictures
    from harness.takeoff.rows import row

    with RunFolder(out, "takeoff") as folder:
        more = beside(cases)
        flown = _fly([*cases, *more], workers, [load_pictures])
        flown, other = flown[: len(cases)], flown[len(cases) :]
        rows = [row(one) for one in flown]
        (folder.path / "takeoff.json").write_text(json.dumps(rows, indent=2) + "\n", "utf-8")
        with (folder.path / "takeoff.csv").open("w", encoding="utf-8", newline="") as file:
            writer = csv.DictWriter(file, rows[0])
            writer.writeheader()
            writer.writerows(rows)
        draw(flown, other, folder.path / "takeoff.png")
        return flown, other, folder.keep()


def table(rows: Sequence[dict[str, Any]], beside: Sequence[dict[str, Any]], folder: Path | None) -> str:
    """The rows as text."""
    widths = [max(len(title), 6) for title, *_ in COLUMNS]
    lines = [
        "  ".join(f"{column[0]:>{width}}" for column, width in zip(COLUMNS, widths, strict=True)),
        "  ".join(f"{column[1]:>{width}}" for column, width in zip(COLUMNS, widths, strict=True)),
        *(_line(one, widths) for one in rows),
    ]
    lines.append(
        "Distances from brake release, heights of the main wheels; 35 m is the paper's screen, 35 ft that of CS-25."
    )
    lines.append("The last column is the take-off distance of CS 25.113 with all engines.")
    if beside:
        lines.append(f"Beside them, rotating at {beside[0]['vr_mps'] / KT:.0f} kt:")
        lines += [_line(one, widths) for one in beside]
    if folder is not None:
        lines.append(f"kept in {folder}")
    return "\n".join(lines)


def _line(one: dict[str, Any], widths: Sequence[int]) -> str:
    return "  ".join(
        f"{one[key] * factor:>{width}.{digits}f}"
        for (_, _, key, factor, digits), width in zip(COLUMNS, widths, strict=True)
    )
