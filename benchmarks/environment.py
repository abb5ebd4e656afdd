"""Imported before anything that is installed: a benchmark started by another Python goes on in the project's own."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))
if sys.prefix == sys.base_prefix:  # not in an environment
    import run

    if problem := run.set_up():
        sys.exit(run.fail(*problem))
    os.execv(run.PYTHON, [str(run.PYTHON), *sys.orig_argv[1:]])
