# SPDX-License-Identifier: BSD-3-Clause
"""From a wanted freedom to flexures that are exactly constrained."""
