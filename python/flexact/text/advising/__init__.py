# SPDX-License-Identifier: BSD-3-Clause
"""Advice that was tried, in words."""
