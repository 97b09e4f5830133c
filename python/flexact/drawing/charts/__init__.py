# SPDX-License-Identifier: BSD-3-Clause
"""Curves and bars as values, with scales and units: what charts of pictures and pages show."""
