# SPDX-License-Identifier: BSD-3-Clause
"""The frozen result of an analysis, what follows from it, and its words and JSON."""
