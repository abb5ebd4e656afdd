"""`python -m harness` is `harness`."""

import sys

try:
    from harness.cli import main
except KeyboardInterrupt:  # while it is still being read in
    sys.exit(130)

sys.exit(main())
