# SPDX-License-Identifier: BSD-3-Clause
"""The version of Flexact, as in meson.build."""

VERSION = "0.1.0"
