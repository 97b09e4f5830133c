# SPDX-License-Identifier: BSD-3-Clause
"""Many mechanisms: sweeps, tolerances, batches and their tables; uses results, models and the engine."""
