# SPDX-License-Identifier: BSD-3-Clause
"""Variants: their parameters, their analysis and what is collected; uses results and the engine."""
