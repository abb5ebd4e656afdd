"""`harness study` with the stub kind known: `python stub_study.py ARGS`. For tests that kill it."""

import sys

from harness import cli
from harness.studies.kinds import KINDS

KINDS["stub"] = "stub_kind"

if __name__ == "__main__":
    sys.exit(cli.main(["study", *sys.argv[1:]]))
