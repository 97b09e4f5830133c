"""``python -m flexact`` is the command ``flexact``."""

import sys

from flexact.cli import main

if __name__ == "__main__":
    sys.exit(main())
