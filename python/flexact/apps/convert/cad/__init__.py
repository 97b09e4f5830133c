# SPDX-License-Identifier: BSD-3-Clause
"""From CAD: the solids of a STEP file as flexures and bodies, and the model of them."""
