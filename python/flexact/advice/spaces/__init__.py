# SPDX-License-Identifier: BSD-3-Clause
"""Freedom and constraint spaces of a body, and wires to add."""
