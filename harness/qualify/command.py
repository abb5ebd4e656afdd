"""`harness qualify`: which aircraft, which tests, where the page goes."""

from collections.abc import Callable, Sequence
from pathlib import Path

from harness import resources
from harness.errors import InputError, did_you_mean
from harness.qualify.guide import read_guide, select
from harness.qualify.judge import Verdict, qualify
from harness.qualify.manoeuvres import MANOEUVRES
from harness.qualify.outcome import Aircraft
from harness.qualify.report import write_page

GUIDE = "qualification.csv"


def run(
    name: str,
    only: Sequence[str] = (),
    *,
    out: str | Path | None = None,
    jobs: int | None = None,
    told: Callable[[str], None] = print,
) -> tuple[list[Verdict], Path | None]:
    """Qualify an aircraft: verdicts in the order of its guide, and the page if a folder for it is given.

    Raises InputError for an aircraft, a test or a guide that is not there or not right, OutputError for the page.
    """
    known = resources.aircraft()
    if name not in known:
        raise InputError(f'there is no aircraft "{name[:100]}".', remedy=did_you_mean(name, known))
    rows = select(read_guide(known[name].parent / GUIDE, MANOEUVRES), only)
    found = list(qualify(Aircraft(resources.root(), name), rows, jobs=jobs, told=told))
    order = {row.id: i for i, row in enumerate(rows)}
    found.sort(key=lambda verdict: order[verdict.row.id])
    page = None if out is None else write_page(found, name, resources.fingerprint(name), Path(out))
    return found, page
