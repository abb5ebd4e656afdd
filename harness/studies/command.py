"""`harness study`: which study, on which processors, where its results go."""

import argparse
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from harness.command_line import INTERRUPTED, add_json, end_as_interrupted, print_json, say
from harness.errors import FlightError, InputError

if TYPE_CHECKING:
    from harness.command_line import Subparsers


def add(commands: "Subparsers") -> None:
    """The arguments of `harness study`."""
    parser = commands.add_parser(
        "study",
        help="fly a mission many times with factors varied",
        description="Run the cases of a study, or what is left of them, into one table.",
    )
    parser.add_argument("study", metavar="STUDY", help="a name from `harness list`, or a study file")
    parser.add_argument("--workers", metavar="N", type=int, help="processes (default: one for each core)")
    parser.add_argument("--resume", action="store_true", help="continue, and try again what failed")
    parser.add_argument(
        "--cluster", metavar="ADDRESS", help="run on a Dask cluster: its scheduler, such as tcp://host:8786"
    )
    parser.add_argument("--out", metavar="DIR", help="folder of the results (default: runs/study-STUDY)")
    parser.add_argument("--csv", action="store_true", help="write the table as results.csv too")
    parser.add_argument("--yes", action="store_true", help="do not ask, however many cases there are")
    add_json(parser)
    parser.set_defaults(run=run)


def run(chosen: argparse.Namespace) -> int:
    """`harness study`: exit code 3 if a case did not succeed."""
    from harness.studies.conduct import conduct, default_folder, open_study
    from harness.studies.console import StudyProgress, describe_study
    from harness.studies.journal import JOURNAL

    study = open_study(chosen.study)
    end_as_interrupted()
    folder = default_folder(study) if chosen.out is None else chosen.out
    try:
        with StudyProgress(study.name, sys.stderr) as progress:
            summary = conduct(
                study,
                folder,
                workers=chosen.workers,
                cluster=chosen.cluster,
                resume=chosen.resume,
                csv=chosen.csv,
                confirm=None if chosen.yes else _confirm,
                tell=say,
                progress=progress,
            )
    except KeyboardInterrupt:
        begun = Path(folder, JOURNAL).exists()
        kept = f"what was finished is in {folder}; continue with --resume" if begun else "nothing was begun"
        say(f"harness: interrupted\n    {kept}")
        return INTERRUPTED
    if chosen.json:
        print_json(summary)
    else:
        print(describe_study(summary))
    return 0 if summary["counts"].keys() <= {"ok"} else FlightError.exit_code


def _confirm(cases: int) -> None:
    """Ask whether so many cases are meant. Raises InputError when they are not, or when nobody can be asked."""
    remedy = "fewer levels, or --yes if they are meant"
    if not sys.stdin.isatty():
        raise InputError(f"the study has {cases:,} cases", remedy=remedy)
    say(f"The study has {cases:,} cases. Go on? [y/N]")
    if sys.stdin.readline().strip().lower() not in {"y", "yes"}:
        raise InputError(f"the {cases:,} cases were not begun", remedy=remedy)
