# SPDX-License-Identifier: BSD-3-Clause
"""What everything may use: errors, frozen values, memory, signals."""
