# SPDX-License-Identifier: BSD-3-Clause
"""Stored answers, what differs from them, and findings as services want them."""
