# SPDX-License-Identifier: BSD-3-Clause
"""Put the libraries that a wheel needs into it, on Windows. Not yet run there.

Usage: repair_on_windows.py WHEEL FOLDER. delvewheel must be told where OpenBLAS lies, whose folder
only Python knows; the libraries of GCC are found beside the compiler.
"""

import shutil
import subprocess
import sys
from pathlib import Path

import scipy_openblas32

wheel, folder = sys.argv[1:]
compiler = shutil.which("gfortran")
if compiler is None:
    sys.exit("gfortran is not on the path")
places = f"{scipy_openblas32.get_lib_dir()};{Path(compiler).parent}"
words = ["-m", "delvewheel", "repair", "--add-path", places, "-w", folder, wheel]
sys.exit(subprocess.run([sys.executable, *words]).returncode)
