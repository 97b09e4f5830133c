# SPDX-License-Identifier: BSD-3-Clause
"""The frozen result of an analysis, and what follows from it; uses `model` and below."""
