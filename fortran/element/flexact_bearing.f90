! SPDX-License-Identifier: BSD-3-Clause
!> BEARING: how a body at q moves against a body at p, in the frame of an axis.
module flexact_bearing
   use flexact_hinge, only: hinge_deformation, hinge_curvature
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_rbeam, only: rbeam_deformation, rbeam_curvature
   implicit none
   private
   public :: bearing_deformation, bearing_curvature

contains

   !> e1 to e3: displacement of q along the axis and across it, in the frame that
   !> turns with p [m]; e4: rotation about the axis; e5 and e6: tilts of the
   !> axis of q against that of p [rad].
   pure subroutine bearing_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      real(wp) :: turn(6), turn_derivative(6, 12)

      call rbeam_deformation(reference, p, q, e, derivative)
      call hinge_deformation(reference, p, q, turn, turn_derivative)
      e(4:6) = turn(1:3)
      derivative(4:6, :) = turn_derivative(1:3, :)
   end subroutine bearing_deformation

   !> sigma_1 d2e1 to sigma_6 d2e6, summed.
   pure function bearing_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)

      h = rbeam_curvature(reference, p, q, sigma) &
          + hinge_curvature(reference, p, q, [sigma(4:6), 0.0_wp, 0.0_wp, 0.0_wp])
   end function bearing_curvature
end module flexact_bearing
