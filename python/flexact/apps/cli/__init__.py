# SPDX-License-Identifier: BSD-3-Clause
"""The command ``flexact``, a module a verb, loaded by name."""
