! SPDX-License-Identifier: BSD-3-Clause
!> What an element routine sees: where its two ends are, and its own reference.
module flexact_pose
   use flexact_kinds, only: wp
   implicit none
   private
   public :: pose_t, reference_t

   !> One end of an element in some configuration. The rotation takes a vector
   !> of the reference configuration to where the node has turned it; it is
   !> the identity in the reference configuration. The angle is that of a
   !> planar node, relative to its reference value.
   type :: pose_t
      real(wp) :: position(3) = 0.0_wp
      real(wp) :: rotation(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, &
                                            0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
      real(wp) :: angle = 0.0_wp
   end type pose_t

   !> The element in the reference configuration: the vector from p to q, its
   !> length l0, and the local axes ex, ey, ez as columns. A zero length is
   !> ordinary for an element without extent (a hinge).
   type :: reference_t
      real(wp) :: offset(3) = 0.0_wp
      real(wp) :: length = 0.0_wp
      real(wp) :: frame(3, 3) = 0.0_wp
      !> Constant of the torsion-elongation coupling in eq. (3) of the paper,
      !> polar second moment of area over area [m^2].
      real(wp) :: c_t = 0.0_wp
   end type reference_t
end module flexact_pose
