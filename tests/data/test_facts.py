"""Every figure the aircraft cites is in its table of facts."""

import csv
import re
from pathlib import Path

CITATION = re.compile(r"\[facts\s+([^\]]+)\]")
NOT_ROWS = {"NAME", "McCormick"}  # the pattern itself, and an author cited beside a row


def test_cited_facts_exist(repository: Path) -> None:
    with (repository / "aircraft" / "gta" / "facts.csv").open(encoding="utf-8", newline="") as file:
        known = {row["name"] for row in csv.DictReader(file)}
    files = [
        path for folder in ("aircraft", "engine", "systems") for path in (repository / folder).rglob("*.xml")
    ]
    cited = {
        name.strip()
        for path in files
        for names in CITATION.findall(path.read_text(encoding="utf-8"))
        for name in re.split(r",\s*", names)
    }
    missing = {name for name in cited - NOT_ROWS if name not in known and not _rows_of_a_group(name, known)}
    assert len(cited) > 30
    assert not missing


def _rows_of_a_group(name: str, known: set[str]) -> bool:
    """`radius_gyr_Rx/Ry/Rz` stands for three rows."""
    first, *others = name.split("/")
    stem = first[: -len(others[0])] if others else first
    return bool(others) and all(stem + other in known for other in others) and first in known
