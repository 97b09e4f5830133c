# SPDX-License-Identifier: BSD-3-Clause
"""Many mechanisms: sweeps, tolerances, batches, their tables."""
