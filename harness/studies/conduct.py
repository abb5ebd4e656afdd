"""A study from its name to its results folder: what `harness study` and `harness.study` share."""

import json
import tempfile
from collections import Counter
from collections.abc import Callable
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from harness import __version__, resources
from harness.errors import OutputError
from harness.studies import table
from harness.studies.engine import Outcome, Progress, run_study
from harness.studies.journal import write_whole
from harness.studies.model import Study
from harness.studies.reader import read_study

if TYPE_CHECKING:
    import pyarrow as pa

SUMMARY = "summary.json"
OUT = "runs"
MOST_REASONS = 10


def open_study(study: str | PathLike[str]) -> Study:
    """The study of that name, or in that file. Raises InputError."""
    return read_study(resources.find_study(study))


def default_folder(study: Study) -> Path:
    """Where the results of a study go when nothing is said."""
    return Path(OUT) / f"study-{study.name}"


def conduct(
    study: Study,
    out: str | PathLike[str],
    *,
    workers: int | None = None,
    cluster: str | None = None,
    resume: bool = False,
    csv: bool = False,
    confirm: Callable[[int], None] | None = None,
    tell: Callable[[str], None] | None = None,
    progress: Progress | None = None,
) -> dict[str, Any]:
    """Run a study into its results folder; returns its summary, which is kept there as well.

    With `csv`, or where there is one already, the table is written as CSV too.
    Raises what `harness.studies.engine.run_study` raises.
    """
    if not fspath(out):
        raise OutputError("the output folder has no name.", remedy="choose a folder: --out DIR.")
    folder = Path(out)
    outcome = run_study(
        study,
        folder,
        workers=workers,
        cluster=cluster,
        resume=resume,
        confirm=confirm,
        tell=tell,
        progress=progress,
    )
    if csv or (folder / table.CSV).exists():
        write_whole(folder / table.CSV, lambda path: table.write_csv(path, outcome.table_path))
    kept = folder / SUMMARY
    if not outcome.cases_run and kept.is_file():
        try:
            summary: dict[str, Any] = json.loads(kept.read_text("utf-8"))
        except ValueError:
            pass
        else:
            return summary
    summary = _summary(study, outcome)
    text = json.dumps(summary, indent=2, ensure_ascii=False, allow_nan=False) + "\n"
    write_whole(kept, lambda path: path.write_text(text, "utf-8"))
    return summary


def run(
    study: str | PathLike[str],
    *,
    out: str | PathLike[str] | None,
    workers: int | None,
    cluster: str | None,
    resume: bool,
    progress: Progress | None,
) -> "pa.Table":
    """Run a study and return its table: see `harness.study`."""
    opened = open_study(study)
    with tempfile.TemporaryDirectory() as passing:
        folder = Path(passing) / "results" if out is None else Path(out)
        conduct(opened, folder, workers=workers, cluster=cluster, resume=resume, progress=progress)
        return table.read(folder / table.TABLE)


def _summary(study: Study, outcome: Outcome) -> dict[str, Any]:
    from harness.studies.report import conclude

    results = table.read(outcome.table_path)
    rows = zip(results["status"].to_pylist(), results["reason"].to_pylist(), strict=True)
    reasons = Counter(f"{status}: {reason}" for status, reason in rows if status != "ok")
    return {
        "study": study.name,
        "mission": study.mission_path.name,
        "design": study.design._asdict(),
        "cases": results.num_rows,
        "counts": dict(sorted(outcome.counts.items())),
        "reasons": dict(reasons.most_common(MOST_REASONS)),
        **conclude(study, results),
        "harness_version": __version__,
        "cases_run": outcome.cases_run,
        "cpu_s_per_case": outcome.cpu_s / outcome.cases_run if outcome.cases_run else None,
        "table": str(outcome.table_path),
    }
