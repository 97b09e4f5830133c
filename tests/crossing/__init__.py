# SPDX-License-Identifier: BSD-3-Clause
"""Mechanisms a little changed, through every verb and every form of output."""
