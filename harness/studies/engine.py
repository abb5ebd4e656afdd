"""Runs what is left of a study, here or on a cluster, and writes its table when all is there."""

import os
import queue
from collections import Counter
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from harness.errors import InputError
from harness.studies import table
from harness.studies.cases import Case, Cases, identity
from harness.studies.design import count
from harness.studies.guard import Answer, Guards
from harness.studies.journal import JOURNAL, Journal, Result, write_whole
from harness.studies.model import Study

MANY = 10_000  # cases: more are asked about before they are begun
MOST_WORKERS = 16  # for each core
AHEAD = 2  # cases handed out for each worker, so that none waits for the journal
TICK = 1.0  # s between two looks at what else may have happened
STORED = ("definition", "aircraft", "aircraft_files", "code")
CHANGEABLE = {"code": "the harness or one of its libraries", "aircraft_files": "the aircraft's files"}
"""What results are flown anew for when it changes."""

Progress = Callable[[int, int, int], None]
"""Called with the numbers of cases done, of all, and of those that did not succeed."""


class Outcome(NamedTuple):
    """What a study came to. Times of the computer in seconds; `cases_run` are those that ran this time."""

    table_path: Path
    counts: Mapping[str, int]
    cases_run: int
    cpu_s: float

    @property
    def failures(self) -> int:
        """How many cases did not succeed."""
        return sum(number for status, number in self.counts.items() if status != "ok")


class Engine(Protocol):
    """Where cases are run."""

    def room(self) -> int:
        """How many cases may be handed out at a time. Raises InputError when no result will ever come."""

    def submit(self, request: Mapping[str, Any], done: Callable[[Any], None]) -> None:
        """Hand out a case; `done` is called with its future, in whatever thread."""

    def answer(self, future: Any) -> Answer:  # noqa: ANN401  of the engine's own type
        """What a future has brought. Raises InputError when cases cannot be run at all."""

    def close(self) -> None:
        """End what runs, whatever it does."""


class Local:
    """Runs cases in processes of this computer."""

    def __init__(self, workers: int) -> None:
        self._guards = Guards()
        self._threads = ThreadPoolExecutor(workers)
        self._room = AHEAD * workers

    def room(self) -> int:
        """How many cases may be handed out at a time."""
        return self._room

    def submit(self, request: Mapping[str, Any], done: Callable[[Any], None]) -> None:
        """Hand out a case; `done` is called with its future."""
        self._threads.submit(self._guards.run, request).add_done_callback(done)

    def answer(self, future: "Future[Answer]") -> Answer:
        """What a future has brought. Raises WorkerError."""
        return future.result()

    def close(self) -> None:
        """End the workers, whatever they do."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._guards.close()
        self._threads.shutdown()


def run_study(
    study: Study,
    folder: Path,
    *,
    workers: int | None = None,
    cluster: str | None = None,
    resume: bool = False,
    confirm: Callable[[int], None] | None = None,
    tell: Callable[[str], None] | None = None,
    progress: Progress | None = None,
) -> Outcome:
    """Run a study, or with `resume` what is left of it, into its results folder.

    `confirm` is called with the number of cases when they are many, and raises to stop; `tell` with a line that says
    what is kept of an earlier run. Raises InputError, OutputError; whatever happens, results that were journalled stay.
    """
    _check_workers(workers, cluster)
    cases = None
    if not (folder / JOURNAL).exists():
        cases = _ready(study, confirm)  # before anything is written
    with Journal(folder) as journal:
        _own(journal, study, folder, resume=resume)
        if finished := _finished(journal, study, folder):
            return finished
        cases = cases or _ready(study, confirm if journal.empty else None)
        facts = dict(zip(STORED, identity(study, cases.aircraft), strict=True))
        if tell and not journal.empty:
            tell(_kept(cases, journal, facts))
        journal.note({"study": study.name, "session": str(journal.session), "table": "", **facts})
        return _Run(study, cases, journal, progress).finish(folder, workers, cluster)


def _check_workers(workers: int | None, cluster: str | None) -> None:
    """Raise InputError for a number of workers that cannot be meant."""
    if workers is None:
        return
    most = MOST_WORKERS * cores()
    if cluster is not None:
        what, remedy = "a cluster has its own workers", "choose either --workers or --cluster"
    elif workers < 1:
        what, remedy = "there is at least one worker", "e.g. --workers 2"
    elif workers > most:
        what = f"more than {most} workers are too many for {cores()} cores: each takes some 70 MB"
        remedy = f"--workers {cores()}, or nothing, which is the same, is the fastest"
    else:
        return
    raise InputError(what, file=f"--workers {workers}", remedy=remedy)


def _ready(study: Study, confirm: Callable[[int], None] | None) -> Cases:
    if confirm and (number := count(study)) > MANY:
        confirm(number)
    return Cases(study)


class _Run:
    """One run of a study."""

    def __init__(self, study: Study, cases: Cases, journal: Journal, progress: Progress | None) -> None:
        self.study = study
        self.cases = cases
        self.journal = journal
        self.progress = progress or _unseen
        self.results: queue.SimpleQueue[tuple[Case, Any]] = queue.SimpleQueue()
        self.done = self.failed = self.ran = self.waiting = 0
        self.cpu_s = 0.0

    def finish(self, folder: Path, workers: int | None, cluster: str | None) -> Outcome:
        """Run what is left, then write the table."""
        left = self._left()
        first = next(left, None)
        if first is not None:
            engine = _engine(workers, cluster)
            try:
                self._submit(engine, first)
                for case in left:
                    self._submit(engine, case)
                while self.waiting:
                    self._take(engine)
            finally:
                engine.close()
        path = folder / table.TABLE
        counts: dict[str, int] = {}
        write_whole(path, lambda partial: counts.update(table.write(partial, self.study, self._rows)))
        complete = counts.keys() == {"ok"}
        self.journal.note(
            {"table": table.fingerprint(path) if complete else "", "count": str(self.cases.count)}
        )
        return Outcome(path, counts, self.ran, self.cpu_s)

    def _left(self) -> Iterator[Case]:
        """The cases that are not settled; those that are, are counted."""
        for case in self.cases:
            if self.journal.session > 1 and self.journal.settled(case.key):
                self.done += 1
            else:
                yield case

    def _rows(self) -> Iterator[tuple[Case, Result]]:
        return ((case, self.journal.result(case.key)) for case in self.cases)

    def _submit(self, engine: Engine, case: Case) -> None:
        while self.waiting >= engine.room():
            self._take(engine)
        engine.submit(self.cases.request(case), lambda future: self.results.put((case, future)))
        self.waiting += 1

    def _take(self, engine: Engine) -> None:
        """Wait a moment for results, and keep all there are."""
        try:
            found = [self.results.get(timeout=TICK)]
        except queue.Empty:
            engine.room()  # raises when there is nothing to wait for any more
            self.progress(self.done, self.cases.count, self.failed)
            return
        while not self.results.empty():
            found.append(self.results.get())
        kept, stopped = [], None
        for case, future in found:
            self.waiting -= 1
            try:
                kept.append(self._result(case, engine.answer(future)))
            except InputError as error:
                stopped = error
        self.journal.add(kept)
        self.done += len(kept)
        self.ran += len(kept)
        self.failed += sum(result.status != "ok" for result in kept)
        self.cpu_s += sum(result.cpu_s for result in kept)
        self.progress(self.done, self.cases.count, self.failed)
        if stopped:
            raise stopped

    def _result(self, case: Case, answer: Answer) -> Result:
        nothing: list[float | str | None] = [None] * len(self.study.outputs)
        return Result(
            case.key,
            answer["status"],
            answer["reason"],
            answer["outputs"] or nothing,
            answer["detail"],
            answer["wall_s"],
            answer["cpu_s"],
        )


def _unseen(done: int, total: int, failed: int) -> None:
    """Progress that nobody looks at."""


def _own(journal: Journal, study: Study, folder: Path, *, resume: bool) -> None:
    """Refuse the results of another study, and those of this one unless asked to resume."""
    if journal.empty:
        return
    known = journal.meta["study"]
    if known != study.name:
        raise InputError(
            f'holds the results of the study "{known}", not of "{study.name}"',
            file=folder,
            remedy="choose another folder: --out DIR",
        )
    if not resume:
        raise InputError(
            f'holds results of the study "{known}" already',
            file=folder,
            remedy="continue it with --resume, or choose another folder: --out DIR",
        )
    if journal.meta["definition"] != identity(study, journal.meta["aircraft"]).definition:
        raise InputError(
            f'holds results of the study "{known}" as it was before its file or its mission was changed',
            file=folder,
            remedy="undo the change, or choose another folder: --out DIR",
        )


def _kept(cases: Cases, journal: Journal, facts: Mapping[str, str]) -> str:
    """How many rows of an earlier run are kept, how many cases are flown, and why."""
    statuses = Counter(journal.status(case.key) for case in cases)
    kept, new = statuses.pop("ok", 0), statuses.pop(None, 0)
    changed = " and ".join(what for name, what in CHANGEABLE.items() if journal.meta[name] != facts[name])
    reasons = {
        f"not flown since {changed} changed" if changed else "not flown yet": new,
        "that did not succeed before": statuses.total(),
    }
    told = ", ".join(f"{number:,} {reason}" for reason, number in reasons.items() if number)
    return f"{cases.study.name}: {kept:,} of {cases.count:,} rows are kept; to fly: {told or 'nothing'}"


def _finished(journal: Journal, study: Study, folder: Path) -> Outcome | None:
    """The outcome, if the study has been finished with this code, every case succeeded and the table is there."""
    path = folder / table.TABLE
    if not journal.meta.get("table") or not path.is_file():
        return None
    same = tuple(journal.meta[name] for name in STORED) == identity(study, journal.meta["aircraft"])
    if not same or table.fingerprint(path) != journal.meta["table"]:
        return None
    return Outcome(path, {"ok": int(journal.meta["count"])}, 0, 0.0)


def _engine(workers: int | None, cluster: str | None) -> Engine:
    if cluster is None:
        return Local(workers or cores())
    from harness.studies.cluster import Cluster

    return Cluster(cluster)


def cores() -> int:
    """The cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
