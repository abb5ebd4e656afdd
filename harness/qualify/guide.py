"""The test guide of an aircraft: `aircraft/NAME/qualification.csv`, one row a quantity held against a target."""

import csv
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from math import inf
from pathlib import Path

from harness.errors import InputError, InputErrors, did_you_mean
from harness.qualify.condition import Condition, read
from harness.units import UnitError

COLUMNS = (
    "id",
    "title",
    "manoeuvre",
    "condition",
    "quantity",
    "target",
    "unit",
    "tolerance",
    "tolerance_source",
    "source",
    "calibrated_on",
)
CALIBRATED = re.compile(r"(yes|no)\b[:;,]?\s*(.*)", re.DOTALL)
SIZE = r"\d+(?:\.\d+)?"
NUMBER = rf"[+-]?{SIZE}"


@dataclass(frozen=True)
class Row:
    """One objective test: what is flown, which quantity is judged, and its bounds in `unit`."""

    id: str
    title: str
    manoeuvre: str
    condition_text: str
    condition: Condition
    quantity: str
    target: float
    unit: str
    tolerance: str
    low: float
    high: float
    tolerance_source: str
    source: str
    calibrated: bool
    calibrated_on: str

    def inside(self, result: float) -> bool:
        """Whether a result is within the tolerance; what could not be measured is not."""
        return self.low <= result <= self.high


def bounds(target: float, tolerance: str) -> tuple[float, float]:
    """The lowest and highest result inside: `±3 %`, `±2`, `-10 +5 %`, `at least`, `at most`, `0.3 to 2.0`.

    Raises UnitError.
    """
    text = tolerance.strip()
    if text in ("at least", "at most"):
        return (target, inf) if text == "at least" else (-inf, target)
    found = re.fullmatch(rf"({NUMBER}) to ({NUMBER})", text)
    if found:
        return float(found[1]), float(found[2])
    found = re.fullmatch(rf"(?:±\s*({SIZE})|(-{SIZE})\s+(\+{SIZE}))\s*(%?)", text)
    if not found:
        raise UnitError(
            f'"{text}" is not a tolerance; '
            "write ±3 %, ±2 (in the unit of the row), -10 +5 %, at least, at most or 0.3 to 2.0"
        )
    below, above = (-float(found[1]), float(found[1])) if found[1] else (float(found[2]), float(found[3]))
    scale = abs(target) / 100 if found[4] else 1.0
    return target + below * scale, target + above * scale


def read_guide(path: Path, manoeuvres: Collection[str]) -> list[Row]:
    """The rows of a guide. Raises InputError (all faults at once) with file, line and remedy."""
    if not path.is_file():
        raise InputError(
            "the aircraft has no test guide.", file=path, remedy=f"it needs the columns {', '.join(COLUMNS)}"
        )
    rows: list[Row] = []
    faults: list[InputError] = []
    with path.open(encoding="utf-8", newline="") as file:
        reader = csv.DictReader(file)
        if tuple(reader.fieldnames or ()) != COLUMNS:
            raise InputError(
                "the columns are not those of a test guide.",
                file=path,
                line=1,
                remedy=f"they are {','.join(COLUMNS)}",
            )
        for fields in reader:
            try:
                row = _row(fields, manoeuvres)
            except UnitError as error:
                faults.append(InputError(str(error), file=path, line=reader.line_num))
                continue
            if any(row.id == other.id for other in rows):
                faults.append(
                    InputError(f'the id "{row.id}" stands there twice', file=path, line=reader.line_num)
                )
            rows.append(row)
    if faults:
        raise InputErrors(faults)
    return rows


def select(rows: Sequence[Row], only: Sequence[str]) -> list[Row]:
    """The rows wanted: `V10` takes V10, V10a, V10b. Raises InputError for a name no row has."""
    if not only:
        return list(rows)
    for name in only:
        if not any(_named(row, name) for row in rows):
            raise InputError(
                f'the test guide has no test "{name}".',
                file="--only",
                remedy=did_you_mean(name, {row.id for row in rows}),
            )
    return [row for row in rows if any(_named(row, name) for name in only)]


def _named(row: Row, name: str) -> bool:
    return row.id == name or re.fullmatch(re.escape(name) + "[a-z]", row.id) is not None


def _row(fields: dict[str, str], manoeuvres: Collection[str]) -> Row:
    missing = [name for name in COLUMNS if not (fields.get(name) or "").strip() and name != "condition"]
    if missing:
        raise UnitError(f"the row says nothing about {', '.join(missing)}")
    if fields["manoeuvre"] not in manoeuvres:
        raise UnitError(
            f'there is no manoeuvre "{fields["manoeuvre"]}"; {did_you_mean(fields["manoeuvre"], manoeuvres)}'
        )
    try:
        target = float(fields["target"])
    except ValueError:
        raise UnitError(f'the target "{fields["target"]}" is not a number') from None
    low, high = bounds(target, fields["tolerance"])
    calibrated = CALIBRATED.fullmatch(fields["calibrated_on"])
    if not calibrated or (calibrated[1] == "yes" and not calibrated[2]):
        raise UnitError('calibrated_on says "no", or "yes: " and which parameters were fitted to this target')
    return Row(
        id=fields["id"],
        title=fields["title"],
        manoeuvre=fields["manoeuvre"],
        condition_text=fields["condition"],
        condition=read(fields["condition"]),
        quantity=fields["quantity"],
        target=target,
        unit=fields["unit"],
        tolerance=fields["tolerance"],
        low=low,
        high=high,
        tolerance_source=fields["tolerance_source"],
        source=fields["source"],
        calibrated=calibrated[1] == "yes",
        calibrated_on=calibrated[2],
    )
