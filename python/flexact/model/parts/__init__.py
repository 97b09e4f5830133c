# SPDX-License-Identifier: BSD-3-Clause
"""What a model consists of to a designer: sheets, wires, bodies, hinges, bars."""
