# SPDX-License-Identifier: BSD-3-Clause
"""A result as a mesh, for ParaView and its like.

Every element that has two ends is a row of lines along its axis, eight where it can bend and one
where not; an element without extent (a hinge) is a vertex where its orientation nodes stand. The
elements that are drawn have a surface of quads besides: sheets, rods, solids; cylinders for
hinges; flat strips and discs in the plane. What the deck does not draw (DONOTDRAW) has its line or
vertex, with all its numbers, but no surface. With more than 5,000 elements there are no surfaces.
Points are not shared between elements, nor between an axis and its surface, so that parts which
a motion moves apart come apart in the picture. Lengths are in m.

Point data
    ``displacement``, ``rotation``: of the motion that is shown, times what makes the largest
    displacement a tenth of the mechanism's size, so that Warp By Vector with a factor of 1 shows
    it. The motion is the one asked for, else the first motion, else that of the first declared
    degree of freedom that can move (not looked for with more than 5,000 elements); zeros without
    any. First order: along a bending member cubic, at a surface that of the axis plus the
    rotation times the arm [m, rad].
    ``node``: number of the position node at the point; 0 between nodes, at surfaces, and where
    none is known.
    ``motion_k``, ``motion_k_rotation``: displacement and rotation in motion k as the analysis
    gives it, at the nodes to the last bit, between them likewise. The far end of a rigid link
    turns with its near end, a hinge with the first of its two orientation nodes, a truss with
    its axis.
    ``selfstress_k_normal_force`` [N], ``_twist_moment``, ``_in_plane_moment`` and
    ``_out_of_plane_moment`` [N m] of self-stress k at that station of the member: the stress
    resultants of the analysis at its ends, linear between, with the signs of
    ``flexact.analysis.part_stresses``, which depend on geometry alone. Equal values at both ends
    are a constant moment. A rigid link has the components of its force at its far end: the normal
    force along itself, and the moments that the others make on the way. Hinges have sizes.
Cell data
    ``element``: number of the element; ``kind``: its code, see ``flexact.core.elements``; ``form``:
    what it is to the eye, see ``flexact.show.drawing.Form``, 0 for hinges; ``name``: its name, in
    .vtp files alone. meshio does not read a .vtu file that has text, so that names are field data.
    Supports and declared degrees of freedom are quads with an ``element`` and a ``kind`` of 0 and
    the ``form`` that `flexact.show.mesh.content` says; they go with their nodes, without stress.
Field data, in .vtu and .vtp files
    Verdict, counts, margins, units and names of elements; see `flexact.show.mesh.content`.

Of very many motions or self-stresses only the first are there; see `Meshes.most_modes`.
"""

from .content import Mesh, Meshes, mesh_of, to_meshio

__all__ = ["Mesh", "Meshes", "mesh_of", "to_meshio"]
