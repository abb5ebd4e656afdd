"""The same mission flown again, here or in another process, is the same to the byte."""

import pytest
from conftest import Command

import harness as package

RECORDS = ("history.parquet", "events.csv", "waypoints.csv")


def record(folder):
    return {name: (folder / name).read_bytes() for name in RECORDS}


def here(mission, out):
    folder = package.fly(mission, out=out).folder
    assert folder is not None
    return record(folder)


def elsewhere(harness, mission, out):
    result = harness("fly", mission, "--out", str(out))
    assert result.returncode == 0, result.stderr
    return record(out / f"{mission}-001")


def test_the_circuit_is_the_same_twice_and_in_another_process(harness: Command, tmp_path):
    first = here("circuit", tmp_path / "first")
    assert here("circuit", tmp_path / "second") == first
    assert elsewhere(harness, "circuit", tmp_path / "third") == first


@pytest.mark.slow
def test_the_main_mission_is_the_same_twice_and_in_another_process(harness: Command, tmp_path):
    first = here("cologne-munich", tmp_path / "first")
    assert here("cologne-munich", tmp_path / "second") == first
    assert elsewhere(harness, "cologne-munich", tmp_path / "third") == first
