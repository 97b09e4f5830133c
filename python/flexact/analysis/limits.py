# SPDX-License-Identifier: BSD-3-Clause
"""The table of limits: what counts as zero, as the same, or as in doubt, and so what is said.

Without another unit each is a number [1], a part of what its reason names. docs/theory.md has
those that decide a verdict, with what set them.
"""

# Rounding -------------------------------------------------------------------

#: What is below this part of a motion, a self-stress or a unit vector is rounding: the least that
#: is ever used, as the decomposition leaves some 1e-12; theory.md (42).
ROUNDING = 1.0e-9
#: More than this of a null vector is not taken for rounding, however close the decision was.
LARGEST_ROUNDING = 1.0e-3
#: Of the size of the model: places that differ by less are one, and coordinates below it zero.
SAME_PLACE = 1.0e-9
#: A component of a direction below this says nothing of its sense: six digits are typed of many.
NO_SENSE = 1.0e-6
#: A direction is along x, y or z where its other components are below this, likewise.
ALONG = 1.0e-6
#: Cosines as near as this to 0, 1 or -1 are that: frames are computed to some 1e-15.
EXACT_COSINE = 1.0e-12
#: Stress resultants below this part of the largest are none, before they are added up at nodes.
NO_RESULTANT = 1.0e-12
#: Resultants of a part below this part of its largest are not told: sums of several that cancel.
TOLD = 1.0e2 * ROUNDING
#: Wrenches are multiples of one another where no more than this part of the largest is left.
SAME_WRENCH = 1.0e3 * ROUNDING
#: Of a body's loads and twists, of unit length, what is below this is none.
HELD = 1.0e-6
#: Components of a mode below this part of its largest are left out of the JSON.
LEFT_OUT = 1.0e-14
#: Below this leverage a row does not reach into a null space, far above what rounding makes of it.
NO_LEVERAGE = 1.0e-7
#: Independent velocities that depend on each other to within this cannot be told apart.
DEPENDENT_VELOCITIES = 1.0e-12
#: A degree of freedom moves if its velocity can be one to within this, the others being zero.
NOT_ONE = 1.0e-6
#: Modes of unit length depend on each other where a singular value of theirs is up to this.
DEPENDENT_MODES = 1.0e-10
#: Cosine of the angle up to which a mode is the same after a change: 25 degrees, so that small
#: changes of the geometry keep it.
SAME_DIRECTION = 0.9

# Certainty of the rank ------------------------------------------------------

#: Values up to this multiple of the noise are looked at.
NEAR = 100.0
#: Of those, the ones up to this multiple of what storing the geometry makes of them are in doubt:
#: a geometry that was itself computed has lost some bits more, and does not say so.
CLEARLY = 30.0
#: Powers of ten. Where motions and self-stresses of sound mechanisms both fade it is by 4 at most;
#: where a tiny value counts as zero, by 10 and more.
FADED = 7.0
#: Values up to this multiple of what half a unit of the last digits makes are in doubt: digits
#: may have been cut off, zeros at the end leave no trace, and the change is of first order.
CUT_OFF = 2.0
#: A unit of a third digit moves a singular value by less than this; see `rank_evidence`.
REACH_OF_DIGITS = 0.1
#: What of a lift by the last bits is the storing of a number far from the origin: one unit of 4.
STORED = 0.25
#: How many roundings each entry of D(c) has gone through.
ROUNDINGS = 8.0
#: Neighbouring components of a vector that fades are no further apart, in powers of ten.
LONGEST_STEP = 4.5
#: Components this many powers of ten below the largest may be rounding.
LAST_POWER = 13.0

# Margin ---------------------------------------------------------------------

#: A change by less than this part of the scale of the whole matrix is none: no geometry has it.
NO_CHANGE = 1.0e-9
#: Margins below this angle [rad], or this part of the characteristic length, are small: what is
#: larger is another design, and the margin is of first order.
SMALL_MARGIN = 0.1
#: A margin below this is smaller than parts are usually made to [m]; of a model without stiffness,
#: which may be in any unit, below this part of the characteristic length, or this angle [rad].
USUAL_ACCURACY, USUAL_PART = 2.0e-5, 2.0e-4
#: A smallest non-zero singular value below this part of the largest is worth a warning.
CLOSE_DECISION = 1.0e-5

# Away from the reference, and motions that go on ----------------------------

#: Scaled singular values up to here are zero away from the reference, where the rounding of
#: positions is magnified, and the residual of an equilibrium is in its places.
ZERO_ELSEWHERE = 1.0e-10
#: Scaled singular values up to here are zero at the reference where no rank is given.
ZERO_AT_REFERENCE = 1.0e-9
#: Held deformations up to this part of the size are zero.
TRUE = 1.0e-12
#: Singular values of the derivatives of second-order forms above this are not zero.
CLEAR_SLOPE = 1.0e-6
#: A motion is rigid where this part of it is not, as told motions are found by elimination.
RIGID = 1.0e-7
#: Beside the largest entry of the second-order forms a value from the first on is not zero, and up
#: to the second it is; what lies between decides nothing. Told motions are found by elimination.
STRAINED, UNSTRAINED = 1.0e-6, 1.0e-7

# Compliance -----------------------------------------------------------------

#: Below this part of the largest, with rotations times a length, a compliance is none.
NO_COMPLIANCE = 1.0e-13
#: A point rests in a motion without stiffness that moves others by one and it by less.
POINT_RESTS = 1.0e-8
#: A node that moves by less, where the farthest moves by one, is not named as what moves.
NODE_RESTS = 1.0e-6
