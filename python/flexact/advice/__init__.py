# SPDX-License-Identifier: BSD-3-Clause
"""What is wrong and why, and steps that mend it, in words and as JSON."""
