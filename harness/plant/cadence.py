"""An aircraft's files for another frame rate, with its control laws, engines and systems at their own rates.

JSBSim counts the rate of a channel (`execrate`) in frames: a law that runs 30 times a second at 120 frames a second
runs 15 times at 60, and flies differently, by more than the integration does.
"""

import re
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory

from harness.errors import OutputError

WRITTEN_FOR = 120
"""Frames a second at which the channels of systems/ and aircraft/ have the rates that their comments name."""
QUICK = 6
"""Channels that run in every so many frames or more often, control laws and engines, run in every other frame with
WRITTEN_FOR frames a second and more: a distance is 2 m shorter or longer as VR comes just before or just after the
attitude law's turn, a stop 4 m as reverse thrust is called for before or after an engine's. Not in every frame: in the
first one harness.plant.preset needs the engines to rest."""
_EXECRATE = re.compile(r'execrate="(\d+)"')


@contextmanager
def own_rates(root: Path, aircraft: str, rate: int) -> Iterator[Path]:
    """A root, as long as this lasts, whose channels of `aircraft` have their own rates at `rate` frames a second.

    Raises OutputError when there is no room for it among the temporary files.
    """
    with TemporaryDirectory(prefix="harness-aircraft-", ignore_cleanup_errors=True) as folder:
        copy = Path(folder)
        try:
            for part in ("engine", "systems", f"aircraft/{aircraft}"):
                shutil.copytree(root / part, copy / part)
            for file in (*copy.glob("systems/*.xml"), *copy.glob("aircraft/*/*.xml")):
                text = file.read_text("utf-8")
                file.write_text(_EXECRATE.sub(partial(_scaled, rate), text), "utf-8")
        except OSError as error:
            raise OutputError(f"the aircraft cannot be copied: {error}", path=folder) from error
        yield copy


def _scaled(rate: int, found: re.Match[str]) -> str:
    written = int(found[1])
    frames = 2 if written <= QUICK and rate >= WRITTEN_FOR else max(round(written * rate / WRITTEN_FOR), 1)
    return f'execrate="{frames}"'
