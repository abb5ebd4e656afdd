"""The table of a study: one row a case, in the order of the design, the same bytes for the same results."""

import hashlib
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

from harness.errors import InputError
from harness.studies.cases import Case
from harness.studies.journal import Result
from harness.studies.model import Distribution, Study

if TYPE_CHECKING:
    import pyarrow as pa

TABLE = "results.parquet"
CSV = "results.csv"
GROUP = 4096  # rows of the file's groups: what is in memory at a time
Rows = Iterable[tuple[Case, Result]]


def write(path: Path, study: Study, rows: Callable[[], Rows]) -> Mapping[str, int]:
    """Write the table; returns how many rows have each status.

    `rows` gives the rows anew each time: once to see which outputs are words, once to write. Raises OSError.
    """
    import pyarrow as pa
    from pyarrow import parquet

    statuses: Counter[str] = Counter()
    words: set[int] = set()
    for _, result in rows():
        statuses[result.status] += 1
        words.update(place for place, value in enumerate(result.outputs) if isinstance(value, str))
    schema = _schema(study, words)
    with parquet.ParquetWriter(path, schema, compression="zstd") as writer:
        for group in _groups(rows()):
            columns = zip(*(_row(case, result, words) for case, result in group), strict=True)
            arrays = [
                pa.array(list(column), field.type) for column, field in zip(columns, schema, strict=True)
            ]
            writer.write_table(pa.Table.from_arrays(arrays, schema=schema))
    return statuses


def read(path: Path) -> "pa.Table":
    """Read a table back. Raises InputError when it is damaged."""
    import pyarrow as pa
    from pyarrow import parquet

    try:
        return parquet.ParquetFile(path).read()  # read_table loads a library for folders of files
    except (OSError, pa.ArrowException) as error:
        what = f"is damaged or cut short: {' '.join(str(error).split())[:200]}"
        remedy = "`harness study STUDY --resume` writes it anew from the journal beside it"
        raise InputError(what, file=path, remedy=remedy) from error


def write_csv(path: Path, table_path: Path) -> None:
    """Write the rows of a table as CSV: UTF-8, one header line, empty where a value is missing. Raises OSError."""
    from pyarrow import csv, parquet

    with parquet.ParquetFile(table_path) as table:
        options = csv.WriteOptions(quoting_style="needed")
        with csv.CSVWriter(path, table.schema_arrow, write_options=options) as writer:
            for batch in table.iter_batches(GROUP):
                writer.write_batch(batch)


def fingerprint(path: Path) -> str:
    """SHA-256 of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _schema(study: Study, words: set[int]) -> "pa.Schema":
    import pyarrow as pa

    def unit(text: str) -> dict[str, str]:
        return {"unit": text or "1"}

    fields = [
        pa.field("case", pa.int64(), nullable=False),
        pa.field("key", pa.string(), nullable=False),
        pa.field("seed", pa.int64(), nullable=False),
    ]
    for factor in study.factors:
        if not isinstance(factor.spread, Distribution) and isinstance(factor.spread[0].value, str):
            fields.append(pa.field(factor.column, pa.string()))
        else:
            fields.append(pa.field(factor.column, pa.float64(), metadata=unit(factor.unit)))
    fields.append(pa.field("status", pa.string(), nullable=False))
    fields.append(pa.field("reason", pa.string(), nullable=False))
    for place, output in enumerate(study.outputs):
        fields.append(pa.field(output.column, pa.string() if place in words else pa.float64()))
    return pa.schema(fields, metadata={"study": study.name, "description": study.description})


def _row(case: Case, result: Result, words: set[int]) -> list[Any]:
    outputs = [
        str(value) if place in words and value is not None else value
        for place, value in enumerate(result.outputs)
    ]
    values = [level and level.value for level in case.point]
    return [case.number, case.key, case.seed, *values, result.status, result.reason, *outputs]


def _groups(rows: Rows) -> Iterator[list[tuple[Case, Result]]]:
    iterator = iter(rows)
    while group := list(islice(iterator, GROUP)):
        yield group
