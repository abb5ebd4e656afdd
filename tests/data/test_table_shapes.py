"""Each table of the aircraft has the shape declared for it in aircraft/gta/table-shapes.csv, and every table has one.

JSBSim interpolates linearly, so a table is continuous where its arguments rise; `smooth` refuses the wild entry.
Tables of the four engines are written alike (tested elsewhere) and declared once, as NAME[*].
"""

import csv
import itertools
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

Column = list[float]
TINY = 1e-9
WILD = 0.15  # of the range of a column, off the line between the neighbours


def non_decreasing(c: Column) -> bool:
    return all(a <= b for a, b in itertools.pairwise(c))


def increasing(c: Column) -> bool:
    return all(a < b for a, b in itertools.pairwise(c))


def mirrored(c: Column) -> Column:
    return [-x for x in c]


def one_maximum(c: Column) -> bool:
    top = c.index(max(c))
    return non_decreasing(c[: top + 1]) and non_decreasing(mirrored(c[top:]))


def smooth(arguments: Column, column: Column) -> bool:
    """No row is far from the line between its neighbours."""
    rows = list(zip(arguments, column, strict=True))
    span = max(column) - min(column)
    return all(
        abs(y - y0 - (y1 - y0) * (x - x0) / (x1 - x0)) <= WILD * span
        for (x0, y0), (x, y), (x1, y1) in zip(rows, rows[1:], rows[2:], strict=False)
    )


SHAPES: dict[str, Callable[[Column], bool]] = {
    "increasing": increasing,
    "decreasing": lambda c: increasing(mirrored(c)),
    "non-decreasing": non_decreasing,
    "non-increasing": lambda c: non_decreasing(mirrored(c)),
    "one maximum": one_maximum,
    "one minimum": lambda c: one_maximum(mirrored(c)),
    "positive": lambda c: min(c) > 0,
    "negative": lambda c: max(c) < 0,
    "non-negative": lambda c: min(c) >= 0,
    "odd": lambda c: all(abs(a + b) < TINY for a, b in zip(c, reversed(c), strict=True)),
    "even": lambda c: all(abs(a - b) < TINY for a, b in zip(c, reversed(c), strict=True)),
}


def holds(shape: str, arguments: Column, column: Column) -> bool:
    words = shape.split()
    if words[0] == "bounded":
        return float(words[1]) <= min(column) and max(column) <= float(words[2])
    if shape == "smooth":
        return smooth(arguments, column)
    symmetric = all(abs(a + b) < TINY for a, b in zip(arguments, reversed(arguments), strict=True))
    return SHAPES[shape](column) and (symmetric or shape not in ("odd", "even"))


def tables(path: Path) -> Iterator[tuple[str, list[Column]]]:
    """Name and rows of the tables of a file; of the engines' only the first."""
    counts: dict[str, int] = {}

    def walk(element: ET.Element, name: str) -> Iterator[tuple[str, ET.Element]]:
        if element.tag in ("function", "fcs_function", "switch", "table"):
            name = element.get("name") or name
        if element.tag == "table":
            yield name, element
        for child in element:
            yield from walk(child, name)

    for name, table in walk(ET.parse(path).getroot(), "?"):
        text = table.findtext("tableData")
        index = re.search(r"\[(\d+)\]", name)
        if text is None or (index and index[1] != "0"):
            continue
        counts[name] = counts.get(name, 0) + 1
        rows = [[float(word) for word in line.split()] for line in text.split("\n") if line.strip()]
        yield f"{name.replace('[0]', '[*]')}#{counts[name]}", rows


@pytest.fixture(scope="module")
def found(repository: Path) -> dict[tuple[str, str], list[Column]]:
    files = [*(repository / "aircraft/gta").glob("*.xml"), *(repository / "systems").glob("*.xml")]
    files += (repository / "engine").glob("*.xml")
    return {
        (path.relative_to(repository).as_posix(), name): rows
        for path in sorted(files)
        for name, rows in tables(path)
    }


@pytest.fixture(scope="module")
def declared(repository: Path) -> dict[tuple[str, str], str]:
    with (repository / "aircraft/gta/table-shapes.csv").open(encoding="utf-8", newline="") as file:
        return {(row["file"], row["table"]): row["shape"] for row in csv.DictReader(file) if row["why"]}


def test_every_table_declares_its_shape(
    found: dict[tuple[str, str], list[Column]], declared: dict[tuple[str, str], str]
) -> None:
    assert found.keys() == declared.keys(), "add the table to aircraft/gta/table-shapes.csv"


def test_every_table_has_the_shape_it_declares(
    found: dict[tuple[str, str], list[Column]], declared: dict[tuple[str, str], str]
) -> None:
    wrong = []
    for key in found.keys() & declared.keys():
        rows = found[key]
        body = rows[1:] if len(rows) > 1 and len(rows[0]) == len(rows[1]) - 1 else rows
        arguments, *columns = ([row[i] for row in body] for i in range(len(body[0])))
        assert increasing(arguments), key
        wrong += [
            f"{key[0]} {key[1]}: not {shape} in column {i}"
            for shape in (word.strip() for word in declared[key].split(";"))
            for i, column in enumerate(columns, 1)
            if not holds(shape, arguments, column)
        ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(
    ("shape", "column", "expected"),
    [
        ("increasing", [1, 2, 2], False),
        ("non-decreasing", [1, 2, 2], True),
        ("one maximum", [0, 2, 1], True),
        ("one maximum", [0, 2, 1, 3], False),
        ("odd", [-1, 0, 1], True),
        ("odd", [-1, 0.1, 1], False),
        ("bounded 0 2", [0, 1, 3], False),
        ("smooth", [0, 1, 2, 9, 4], False),
    ],
)
def test_the_shapes_themselves(shape: str, column: Column, expected: bool) -> None:
    arguments = [float(i) - (len(column) - 1) / 2 for i in range(len(column))]
    assert holds(shape, arguments, [float(x) for x in column]) == expected
