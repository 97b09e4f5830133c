!> PLRBEAM: a point q that belongs to the rigid body of node p, in the xy plane.
module flexact_plrbeam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: planar_turn
   implicit none
   private
   public :: plrbeam_deformation

contains

   !> e1 and e2: position of q in the local frame that turns with p, minus the
   !> position that it has in the reference configuration [m].
   pure subroutine plrbeam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      real(wp) :: offset(3), moved(3), axis(3)
      integer :: i

      e = 0.0_wp
      derivative = 0.0_wp
      offset = q%position - p%position
      moved = offset - planar_turn(p%angle, reference%offset)
      do i = 1, 2
         axis = planar_turn(p%angle, reference%frame(:, i))
         e(i) = dot_product(axis, moved)
         derivative(i, 1:3) = -axis
         derivative(i, 6) = axis(1)*offset(2) - axis(2)*offset(1)
         derivative(i, 7:9) = axis
      end do
   end subroutine plrbeam_deformation
end module flexact_plrbeam
