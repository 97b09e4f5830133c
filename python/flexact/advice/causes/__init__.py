# SPDX-License-Identifier: BSD-3-Clause
"""Why there are motions and self-stresses: the count, or this geometry; and how to mend it."""
