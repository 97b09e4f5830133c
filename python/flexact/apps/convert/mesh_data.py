# SPDX-License-Identifier: BSD-3-Clause
"""What stands in the data of a mesh: three numbers each, which any format can hold.

0 or 1 for x, y, z of a point; for the deformations 1, 2, 3 and 4, 5, 6 of a line.
"""

from __future__ import annotations

#: What a line can be.
KINDS = ("beam", "truss", "plbeam", "pltruss")
#: Of points, with the fields of tables that they stand for, but for the axis.
POINT_DATA = {
    "fixed": "fix_",
    "fixed_rotation": "fix_r",
    "independent": "displ_",
    "independent_rotation": "rot_",
}
#: Of lines: the deformations that are released, or independent.
RELEASED = {"released": (1, 2, 3), "released_bending": (4, 5, 6)}
INDEPENDENT = {"independent_deformation": (1, 2, 3), "independent_bending": (4, 5, 6)}
#: Of lines: the vector along local y; 1 where it is a truss.
VECTOR, TRUSS = "orien", "truss"
