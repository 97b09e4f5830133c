! SPDX-License-Identifier: BSD-3-Clause
!> TRUSS and PLTRUSS: a bar between two points, eq. (2). In the plane z = 0
!> the same formula holds, so both share it.
module flexact_truss
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_chord, only: chord_t, make_chord, add_length
   use flexact_second_order, only: at_ends
   implicit none
   private
   public :: truss_deformation, truss_curvature

contains

   !> e1 = l - l0 [m].
   pure subroutine truss_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      type(chord_t) :: chord

      e = 0.0_wp
      derivative = 0.0_wp
      call make_chord(reference, p, q, chord)
      e(1) = chord%elongation
      derivative(1, 1:3) = -chord%direction
      derivative(1, 7:9) = chord%direction
   end subroutine truss_deformation

   !> sigma_1 times the second derivative of e1.
   pure function truss_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)
      type(chord_t) :: chord
      real(wp) :: second(9, 9)

      call make_chord(reference, p, q, chord)
      second = 0.0_wp
      call add_length(reference, chord, sigma(1), second)
      h = at_ends(second)
   end function truss_curvature
end module flexact_truss
