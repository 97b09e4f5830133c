# SPDX-License-Identifier: BSD-3-Clause
"""What advice says in words: causes, extents, spaces, and ways to mend; uses the rest of `text`."""
