# SPDX-License-Identifier: BSD-3-Clause
"""What can be done about motions and self-stresses, as values; uses `result` and below."""
