"""Channels have the rates that their comments name, whatever the frame rate."""

import re

import pytest

from harness.errors import OutputError
from harness.plant import cadence
from harness.plant.cadence import own_rates
from harness.resources import root

CHANNELS = re.compile(r'<channel name="([^"]+)"[^>]*execrate="(\d+)"')


def execrates(folder):
    files = [*folder.glob("systems/*.xml"), *folder.glob("aircraft/gta/*.xml")]
    return {
        (file.name, name): int(frames)
        for file in files
        for name, frames in CHANNELS.findall(file.read_text("utf-8"))
    }


@pytest.mark.parametrize(
    ("rate", "expected"),
    [
        (30, {2: 1, 4: 1, 6: 2, 12: 3, 24: 6}),
        (60, {2: 1, 4: 2, 6: 3, 12: 6, 24: 12}),
        (120, {2: 2, 4: 2, 6: 2, 12: 12, 24: 24}),
        (480, {2: 2, 4: 2, 6: 2, 12: 48, 24: 96}),
    ],
)
def test_every_channel_keeps_its_rate_or_is_quick(rate, expected):
    written = execrates(root())
    assert {2, 4, 6, 12, 24} <= set(written.values())
    with own_rates(root(), "gta", rate) as copy:
        found = execrates(copy)
    assert found.keys() == written.keys()
    for channel, frames in written.items():
        assert found[channel] == expected.get(frames, found[channel]), channel
    assert not copy.exists()


def test_without_room_it_says_so(monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(cadence.shutil, "copytree", full)
    with pytest.raises(OutputError, match="No space left"), own_rates(root(), "gta", 30):
        pass
