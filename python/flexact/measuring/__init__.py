# SPDX-License-Identifier: BSD-3-Clause
"""How fast this machine analyses mechanisms of growing size; uses `result` and below."""
