# SPDX-License-Identifier: BSD-3-Clause
"""Programs that use the library: command, editor server, watched page, conversion, checks."""
