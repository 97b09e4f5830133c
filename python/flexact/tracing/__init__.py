# SPDX-License-Identifier: BSD-3-Clause
"""The path of a motion, both ways, with its dead points."""
