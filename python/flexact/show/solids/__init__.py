# SPDX-License-Identifier: BSD-3-Clause
"""A model as solids, for CAD and for printing."""
