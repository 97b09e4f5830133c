# SPDX-License-Identifier: BSD-3-Clause
"""Models in other formats: tables as of SPACAR Light, line meshes."""
