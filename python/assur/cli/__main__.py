"""``python -m assur.cli``."""

import sys

from assur.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
