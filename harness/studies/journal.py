"""The crash-safe record of a study: one SQLite row a case, on the disk before the next is begun.

Only the process that runs the study opens it, and locks it. Write-ahead log with full synchronisation: a row that was
committed survives the death of the process and of the machine.
"""

import errno
import json
import os
import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, NamedTuple, Self

from harness.errors import InputError, OutputError

JOURNAL = "journal.sqlite"
FORMAT = 1

_TABLES = """
CREATE TABLE meta (name TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE results (
    key TEXT PRIMARY KEY, status TEXT NOT NULL, reason TEXT NOT NULL, outputs TEXT NOT NULL,
    detail TEXT NOT NULL, wall_s REAL NOT NULL, cpu_s REAL NOT NULL, session INTEGER NOT NULL
) WITHOUT ROWID;
"""


class Result(NamedTuple):
    """What became of a case.

    `status` is ok, failed (the flight could not be completed, or was refused), error (a bug of ours), crashed (its
    process died) or timeout; `outputs` are in the order of the study's. `detail` is for whoever looks for the cause.
    Times are of the computer, in seconds.
    """

    key: str
    status: str
    reason: str
    outputs: list[float | str | None]
    detail: str = ""
    wall_s: float = 0.0
    cpu_s: float = 0.0


class Journal:
    """The journal in the results folder of a study. Used as a context."""

    def __init__(self, folder: Path) -> None:
        """Open the journal, or make it, with the folder.

        Raises OutputError when the folder cannot be written or holds something else, InputError when the journal is
        damaged or in use.
        """
        self.path = folder / JOURNAL
        self.new = not self.path.exists()
        with _disk(self.path):
            if self.new:
                folder.mkdir(parents=True, exist_ok=True)
                if any(folder.iterdir()):
                    raise OutputError(
                        "is not empty, and holds no study.",
                        path=folder,
                        remedy="choose another folder: --out DIR.",
                    )
            elif self.path.stat().st_size == 0:
                raise _damaged(self.path, "it is empty")
            self._database = sqlite3.connect(self.path, timeout=0, isolation_level=None)
            try:
                self._prepare()
            except BaseException:
                self._database.close()
                raise
        self.session = int(self.meta.get("session", "0")) + 1
        self.empty = self._database.execute("SELECT 1 FROM results LIMIT 1").fetchone() is None

    def _prepare(self) -> None:
        run = self._database.execute
        run("PRAGMA locking_mode = EXCLUSIVE")
        run("PRAGMA journal_mode = WAL")
        run("PRAGMA synchronous = FULL")
        run("BEGIN IMMEDIATE")  # takes the lock, which the end of this process gives back whatever happens
        if self.new:
            for statement in filter(str.strip, _TABLES.split(";")):
                run(statement)
            run("INSERT INTO meta VALUES ('format', ?)", (str(FORMAT),))
        run("COMMIT")
        fault = "" if self.new else run("PRAGMA quick_check(1)").fetchone()[0]
        if fault not in {"", "ok"}:
            raise _damaged(self.path, fault)
        self.meta: dict[str, str] = dict(run("SELECT name, value FROM meta"))
        if self.meta.get("format") != str(FORMAT):
            raise InputError(
                "was written by another version of harness",
                file=self.path,
                remedy="choose another folder: --out DIR",
            )

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *exception: object) -> None:
        with suppress(sqlite3.Error):
            self._database.close()

    def note(self, facts: Mapping[str, str]) -> None:
        """Keep facts about the study as a whole. Raises OutputError."""
        with self._transaction():
            self._database.executemany("INSERT OR REPLACE INTO meta VALUES (?, ?)", facts.items())
        self.meta |= facts

    def add(self, results: Iterable[Result]) -> None:
        """Keep results; one of the same key replaces the earlier one. Raises OutputError: none of them is kept then."""
        rows = [(*r[:3], json.dumps(r.outputs), *r[4:], self.session) for r in results]
        with self._transaction():
            self._database.executemany("INSERT OR REPLACE INTO results VALUES (?, ?, ?, ?, ?, ?, ?, ?)", rows)

    def settled(self, key: str) -> bool:
        """Whether the case needs no run: it succeeded, or was tried since this journal was opened."""
        with _disk(self.path):
            row = self._database.execute(
                "SELECT status = 'ok' OR session = ? FROM results WHERE key = ?", (self.session, key)
            ).fetchone()
        return row is not None and bool(row[0])

    def status(self, key: str) -> str | None:
        """The status of a case; None when it has no result."""
        with _disk(self.path):
            row = self._database.execute("SELECT status FROM results WHERE key = ?", (key,)).fetchone()
        return None if row is None else str(row[0])

    def result(self, key: str) -> Result:
        """The result of a case. Raises KeyError when it has none."""
        query = "SELECT status, reason, outputs, detail, wall_s, cpu_s FROM results WHERE key = ?"
        with _disk(self.path):
            row = self._database.execute(query, (key,)).fetchone()
        if row is None:
            raise KeyError(key)
        status, reason, outputs, detail, wall_s, cpu_s = row
        return Result(key, status, reason, json.loads(outputs), detail, wall_s, cpu_s)

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        with _disk(self.path):
            self._database.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._database.execute("COMMIT")
            except BaseException:
                with suppress(sqlite3.Error):
                    self._database.execute("ROLLBACK")
                raise


def write_whole(path: Path, write: Any) -> None:  # noqa: ANN401  whatever takes a path and writes a file there
    """Write a file so that it appears whole, or not at all. Raises OutputError."""
    partial = path.with_name(f".{path.name}.partial")
    with _disk(path):
        try:
            write(partial)
            with partial.open("rb+") as file:
                os.fsync(file.fileno())
            partial.replace(path)
        finally:
            partial.unlink(missing_ok=True)


@contextmanager
def _disk(path: Path) -> Iterator[None]:
    """Turns the refusals of the system and of SQLite into messages."""
    try:
        yield
    except sqlite3.OperationalError as error:
        if "locked" in str(error):
            raise InputError(
                "is in use: another `harness study` runs in this folder",
                file=path.parent,
                remedy="wait for its end, or choose another folder: --out DIR",
            ) from error
        raise _full(path, str(error)) from error
    except sqlite3.DatabaseError as error:
        raise _damaged(path, str(error)) from error
    except OSError as error:
        if error.errno in {errno.EEXIST, errno.ENOTDIR}:
            reason = "it is a file, not a folder"
            raise OutputError(
                f"cannot be written: {reason}.", path=path.parent, remedy="choose --out DIR."
            ) from error
        raise _full(path, error.strerror or str(error)) from error


def _full(path: Path, reason: str) -> OutputError:
    return OutputError(
        f"cannot be written: {reason}.",
        path=path,
        remedy="nothing that was finished is lost: make room, then continue with --resume.",
    )


def _damaged(path: Path, reason: str) -> InputError:
    return InputError(
        f"is damaged or cut short: {reason}",
        file=path,
        remedy="put back a copy, or begin anew in another folder: --out DIR; nothing here was changed",
    )
