# SPDX-License-Identifier: BSD-3-Clause
"""Sets of releases and of declarations that make a mechanism right, counted, tried and listed."""
