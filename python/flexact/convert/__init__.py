# SPDX-License-Identifier: BSD-3-Clause
"""Models from and to other formats: tables, meshes of lines; uses models."""
