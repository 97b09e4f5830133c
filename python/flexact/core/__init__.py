# SPDX-License-Identifier: BSD-3-Clause
"""The one door to the extension: calls, arrays, element table."""
