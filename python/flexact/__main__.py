# SPDX-License-Identifier: BSD-3-Clause
"""``python -m flexact`` is the command ``flexact``."""

import sys

from .apps.cli.main import main

if __name__ == "__main__":
    sys.exit(main())
