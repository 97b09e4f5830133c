# SPDX-License-Identifier: BSD-3-Clause
"""From a file or a text to a model; uses `model` and below."""
