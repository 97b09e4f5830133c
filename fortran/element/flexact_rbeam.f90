! SPDX-License-Identifier: BSD-3-Clause
!> RBEAM, PINBODY and PLRBEAM: a point q that belongs to the rigid body of node p.
module flexact_rbeam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: skew, turned_once, at_ends, apart, spin_p
   use flexact_vectors, only: cross, planar_turn
   implicit none
   private
   public :: rbeam_deformation, rbeam_curvature, plrbeam_deformation, plrbeam_curvature

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

   !> sigma_1 d2e1 + sigma_2 d2e2 + sigma_3 d2e3: each is a vector that turns with p
   !> times the vector from p to q.
   pure function rbeam_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)
      real(wp) :: force(3), second(9, 9)

      force = matmul(matmul(p%rotation, reference%frame), sigma(1:3))
      second = 0.0_wp
      second(apart:apart + 2, spin_p:spin_p + 2) = -skew(force)
      second(spin_p:spin_p + 2, apart:apart + 2) = skew(force)
      second(spin_p:spin_p + 2, spin_p:spin_p + 2) = turned_once(force, q%position - p%position)
      h = at_ends(second)
   end function rbeam_curvature

   !> e1 and e2: the same in the xy plane, where p has turned by its angle.
   pure subroutine plrbeam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(out) :: e(6), derivative(6, 12)

      call rbeam_deformation(reference, turned(p), q, e, derivative)
      e(3) = 0.0_wp
      derivative(3, :) = 0.0_wp
      derivative(:, 4:5) = 0.0_wp
   end subroutine plrbeam_deformation

   !> sigma_1 d2e1 + sigma_2 d2e2.
   pure function plrbeam_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)

      h = rbeam_curvature(reference, turned(p), q, [sigma(1:2), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
   end function plrbeam_curvature

   !> From rest: in the plane a node turns by its angle alone.
   pure type(pose_t) function turned(pose)
      type(pose_t), intent(in) :: pose
      integer :: i

      turned%position = pose%position
      do i = 1, 3
         turned%rotation(:, i) = planar_turn(pose%angle, turned%rotation(:, i))
      end do
   end function turned
end module flexact_rbeam
