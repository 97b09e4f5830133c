# SPDX-License-Identifier: BSD-3-Clause
"""The model: arrays, builder, configurations, its deck."""
