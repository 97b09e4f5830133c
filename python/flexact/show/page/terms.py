# SPDX-License-Identifier: BSD-3-Clause
"""The words of the field, each in a sentence: what pages tell where one points at a word."""

from __future__ import annotations

#: In small letters, singular; the table "In pages" of docs/glossary.md is made of them.
TERMS: dict[str, str] = {
    "exactly constrained": "Every motion is either declared or stopped, and each only once.",
    "under-constrained": "Some motion is neither declared nor stopped.",
    "over-constrained": "Some motion is stopped more than once: misalignment causes stress.",
    "self-stress": "A stress in balance with itself: it can exist without any load.",
    "motion": "A movement that nothing stops and nobody declared, at its very beginning.",
    "degree of freedom": "A motion that the designer declared as wanted.",
    "margin": "Smallest misalignment of one node or element that changes the verdict, "
    "to first order.",
    "d(c)": "The matrix that says how fast fixed and independent deformations (its rows) change "
    "with dependent coordinates (its columns); its rank decides the verdict.",
    "rank": "How many singular values of D(c) count as non-zero: so many rows are independent.",
    "rank doubtful": "A rule finds a reason to doubt the rank; the alternative is named.",
    "numerically certain": "Not proven, but no rule finds a reason to doubt the rank.",
    "proven": "Computed in exact arithmetic, for the decimals as typed or the numbers as stored.",
    "certainty": "How sure the rank is: proven, numerically certain, or doubtful.",
    "condition number": "Largest over smallest singular value: how much small errors may grow.",
    "singular value": "A measure of how far D(c) is from losing rank; zero means that it has.",
    "coordinate": "A component of a node: a position along x, y or z, or a rotation about it.",
    "deformation": "How an element can change its shape: it lengthens, twists or bends.",
    "fixed": "Held at zero: a coordinate by a support, a deformation by its stiffness.",
    "dependent": "Not chosen: it follows from what is fixed and what is independent.",
    "independent": "Declared: a degree of freedom, or a prescribed motion.",
    "released": "Of a deformation: free to happen, because the flexure is compliant in it.",
    "elongation": "A member becomes longer or shorter along its axis.",
    "twist": "Torsion: one end of a member turns about its axis against the other.",
    "in-plane bending": "Bending of a sheet within its own plane, in which it is stiff.",
    "out-of-plane bending": "Bending of a sheet across its plane, in which it is compliant.",
    "normal force": "The force along a member; positive is tension.",
    "twist moment": "The moment about the axis of a member.",
    "in-plane moment": "The moment that bends a sheet within its own plane.",
    "out-of-plane moment": "The moment that bends a sheet across its plane.",
    "bending moment": "The moment that bends a member.",
    "infinitesimal": "Of a motion: it only begins, and soon strains what is held.",
    "on its path": "Followed as far as drawn, without straining anything that is held.",
    "clamp": "A support that holds all translations and rotations of a point.",
    "fold": "The line in which two sheets meet at an angle.",
    "freedom space": "All motions (twists) that a body has at one moment when nothing is declared.",
    "constraint space": "All forces and moments (wrenches) that hold a body: they do no work "
    "on its freedom.",
    "misalignment": "How far a point is moved or turned from where it was designed.",
    "tolerance": "Of a clamp: how far it may be off; of the decision: what counts as zero.",
    "stroke": "How far a drive is moved.",
    "multiplier": "By how much the stresses of a state grow until it buckles.",
    "parasitic frequency": "A natural frequency that does not belong to a declared motion.",
}
