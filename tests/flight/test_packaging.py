"""A wheel carries everything it needs."""

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest


@pytest.mark.slow
def test_a_wheel_finds_its_own_missions_and_aircraft(repository: Path, tmp_path: Path) -> None:
    build = [sys.executable, "-m", "hatchling", "build", "-t", "wheel", "-d", str(tmp_path)]
    subprocess.run(build, cwd=repository, check=True, capture_output=True)
    (wheel,) = tmp_path.glob("*.whl")
    site = tmp_path / "site"
    with zipfile.ZipFile(wheel) as archive:
        archive.extractall(site)

    def harness(*arguments: str) -> str:
        return subprocess.run(
            [sys.executable, "-P", "-m", "harness", *arguments],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(site)},
            check=True,
            capture_output=True,
            text=True,
        ).stdout

    found = json.loads(harness("list", "--json"))
    assert "cologne-munich" in found["missions"]
    paths = [Path(entry["file"]) for entries in found.values() for entry in entries.values()]
    assert all(path.is_relative_to(site) and path.is_file() for path in paths)
    assert json.loads(harness("check", "cologne-munich", "--json"))["ok"]
    for folder in ("aircraft", "engine", "systems", "scripts"):
        ours = {file.name for file in (repository / folder).rglob("*.xml")}
        assert ours == {file.name for file in (site / "harness" / "data" / folder).rglob("*.xml")}
