# SPDX-License-Identifier: BSD-3-Clause
"""Singular variants between the rows of a table; uses tables and results."""
