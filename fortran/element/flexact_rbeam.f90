!> RBEAM and PINBODY: a point q that belongs to the rigid body of node p.
module flexact_rbeam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: cross
   implicit none
   private
   public :: rbeam_deformation

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
end module flexact_rbeam
