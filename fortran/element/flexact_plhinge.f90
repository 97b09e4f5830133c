! SPDX-License-Identifier: BSD-3-Clause
!> PLHINGE: the angle of q relative to p in the xy plane.
module flexact_plhinge
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t
   implicit none
   private
   public :: plhinge_deformation

contains

   !> e1: angle of q minus angle of p, of any number of turns [rad].
   pure subroutine plhinge_deformation(p, q, e, derivative)
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)

      e = 0.0_wp
      derivative = 0.0_wp
      e(1) = q%angle - p%angle
      derivative(1, 6) = -1.0_wp
      derivative(1, 12) = 1.0_wp
   end subroutine plhinge_deformation
end module flexact_plhinge
