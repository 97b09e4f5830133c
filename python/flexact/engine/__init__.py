# SPDX-License-Identifier: BSD-3-Clause
"""Work on many items by threads, processes or a cluster; uses base alone, knows no mechanics."""
