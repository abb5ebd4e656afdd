"""`harness qualify` from the command line: a few tests of the guide, really flown."""

import json
from pathlib import Path

from conftest import Command


def test_a_few_tests_as_json_and_as_a_page(harness: Command, tmp_path: Path) -> None:
    result = harness("qualify", "--only", "V09", "V10a", "--json", "--out", "page", "--jobs", "2")
    rows = json.loads(result.stdout)
    assert [row["id"] for row in rows] == ["V09a", "V09b", "V10a"]
    assert {"id", "quantity", "result", "target", "tolerance", "unit", "inside", "calibrated"} <= rows[
        0
    ].keys()
    assert result.returncode == (0 if all(row["inside"] for row in rows) else 1)
    assert "3/3" not in result.stdout
    assert "V10a" in result.stderr
    assert (tmp_path / "page" / "qualification.html").read_text("utf-8").count("<svg") == 3


def test_bad_input_is_refused(harness: Command) -> None:
    for arguments in (["gtb"], ["--only", "V99"], ["--jobs", "0"], ["--jobs", "many"]):
        result = harness("qualify", *arguments)
        assert (result.returncode, result.stdout) == (2, "")
        assert result.stderr.startswith("harness: ")
