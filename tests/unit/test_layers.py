"""The house: imports go downwards, and one library is one file deep."""

import ast
from pathlib import Path

import pytest
from importlinter.cli import EXIT_STATUS_SUCCESS, lint_imports

ROOMS = {
    "distributed": "harness/studies/cluster.py",
    "jsbsim": "harness/plant",
    "lxml": ("harness/xml_source.py", "harness/mission/"),
    "matplotlib": "harness/analysis/plots",
    "pyarrow": ("harness/log/", "harness/studies/", "harness/__init__.py"),
    "pyproj": "harness/world/earth.py",
    "rich": "harness/studies/console.py",
    "transitions": "harness/pilot/machine.py",
}
"""The only places that import each library."""


def imported(path: Path) -> set[str]:
    tree = ast.parse(path.read_text("utf-8"))
    names = {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    names |= {node.module or "" for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    return {name.partition(".")[0] for name in names}


def test_imports_go_downwards(repository: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(repository)
    assert lint_imports() == EXIT_STATUS_SUCCESS


@pytest.mark.parametrize("library", ROOMS)
def test_a_library_is_imported_in_one_place_only(repository: Path, library: str) -> None:
    users = [
        file.relative_to(repository).as_posix()
        for file in (repository / "harness").rglob("*.py")
        if library in imported(file)
    ]
    assert all(user.startswith(ROOMS[library]) for user in users), users


def test_modules_stay_short(repository: Path) -> None:
    lengths = {
        file: len(file.read_text("utf-8").splitlines()) for file in (repository / "harness").rglob("*.py")
    }
    assert {file.name: lines for file, lines in lengths.items() if lines > 500} == {}
