# SPDX-License-Identifier: BSD-3-Clause
"""The page in a browser, at once and whenever a file is saved."""
