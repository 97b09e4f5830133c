# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of tables; uses tables, crossings and pictures."""
