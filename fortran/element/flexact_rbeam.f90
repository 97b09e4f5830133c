! SPDX-License-Identifier: BSD-3-Clause
!> RBEAM, PINBODY and PLRBEAM: a point q that belongs to the rigid body of node p.
module flexact_rbeam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: cross, planar_turn
   implicit none
   private
   public :: rbeam_deformation, plrbeam_deformation

contains

   !> e1 to e3: position of q in the local frame that turns with p, minus the
   !> position that it has in the reference configuration [m].
   pure subroutine rbeam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      real(wp) :: frame(3, 3), offset(3)
      integer :: i

      e = 0.0_wp
      derivative = 0.0_wp
      offset = q%position - p%position
      frame = matmul(p%rotation, reference%frame)
      e(1:3) = matmul(offset - matmul(p%rotation, reference%offset), frame)
      do i = 1, 3
         derivative(i, 1:3) = -frame(:, i)
         derivative(i, 4:6) = cross(frame(:, i), offset)
         derivative(i, 7:9) = frame(:, i)
      end do
   end subroutine rbeam_deformation

   !> e1 and e2: the same in the xy plane, where p has turned by its angle.
   pure subroutine plrbeam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(out) :: e(6), derivative(6, 12)
      type(pose_t) :: turned
      integer :: i

      ! From rest: in the plane a node turns by its angle alone.
      turned%position = p%position
      do i = 1, 3
         turned%rotation(:, i) = planar_turn(p%angle, turned%rotation(:, i))
      end do
      call rbeam_deformation(reference, turned, q, e, derivative)
      e(3) = 0.0_wp
      derivative(3, :) = 0.0_wp
      derivative(:, 4:5) = 0.0_wp
   end subroutine plrbeam_deformation
end module flexact_rbeam
