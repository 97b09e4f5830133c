# SPDX-License-Identifier: BSD-3-Clause
"""What over-constraint costs, and what each release gains."""
