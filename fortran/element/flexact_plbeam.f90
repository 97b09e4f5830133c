! SPDX-License-Identifier: BSD-3-Clause
!> PLBEAM: a slender beam in the xy plane. The signs of the bending
!> deformations differ from those of e5 and e6 of the spatial beam.
module flexact_plbeam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_chord, only: chord_t, make_chord, across_chord, add_length, add_projection
   use flexact_second_order, only: at_ends, spin_p, spin_q
   use flexact_vectors, only: planar_turn
   implicit none
   private
   public :: plbeam_deformation, plbeam_curvature

contains

   !> e1 elongation, e2 and e3 bending at p and q [m], with the chord e_l:
   !> e2 = -l0 e_l . eyp, e3 = l0 e_l . eyq,
   !> e1 = l - l0 + (2 e2**2 + e2 e3 + 2 e3**2)/(30 l0).
   pure subroutine plbeam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      type(chord_t) :: chord
      real(wp) :: eyp(3), eyq(3), g2, g3

      e = 0.0_wp
      derivative = 0.0_wp
      call make_chord(reference, p, q, chord)
      eyp = planar_turn(p%angle, reference%frame(:, 2))
      eyq = planar_turn(q%angle, reference%frame(:, 2))
      associate (el => chord%direction, l0 => reference%length)
         ! In units of l0.
         g2 = -dot_product(el, eyp)
         g3 = dot_product(el, eyq)
         ! As in space: angles below rounding are none.
         if (abs(g2) < epsilon(1.0_wp)) g2 = 0.0_wp
         if (abs(g3) < epsilon(1.0_wp)) g3 = 0.0_wp
         e(1) = chord%elongation + l0*(2*g2**2 + g2*g3 + 2*g3**2)/30
         e(2) = l0*g2
         e(3) = l0*g3

         derivative(2, 7:9) = -across_chord(chord, eyp)
         derivative(3, 7:9) = across_chord(chord, eyq)
         derivative(1, 7:9) = el
         derivative(2, 6) = l0*turning(el, eyp)
         derivative(3, 12) = -l0*turning(el, eyq)
      end associate
      derivative(:, 1:3) = -derivative(:, 7:9)
      derivative(1, :) = derivative(1, :) + ((4*g2 + g3)*derivative(2, :) + (g2 + 4*g3)*derivative(3, :))/30
   end subroutine plbeam_deformation

   !> sigma_1 d2e1 + sigma_2 d2e2 + sigma_3 d2e3: those of l, e2 and e3, and of e1 the
   !> products of the first derivatives of e2 and e3.
   pure function plbeam_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)
      type(chord_t) :: chord
      real(wp) :: e(6), derivative(6, 12), second(9, 9), b(2)

      call plbeam_deformation(reference, p, q, e, derivative)
      call make_chord(reference, p, q, chord)
      associate (eyp => planar_turn(p%angle, reference%frame(:, 2)), &
                 eyq => planar_turn(q%angle, reference%frame(:, 2)), l0 => reference%length)
         b = sigma(1)*[4*e(2) + e(3), e(2) + 4*e(3)]/l0/30 + sigma(2:3)
         second = 0.0_wp
         call add_length(reference, chord, sigma(1), second)
         call add_projection(reference, chord, eyp, spin_p, -b(1), second)
         call add_projection(reference, chord, eyq, spin_q, b(2), second)
         h = at_ends(second) + sigma(1)/(30*l0)* &
             matmul(transpose(derivative(2:3, :)), &
                    matmul(reshape([4.0_wp, 1.0_wp, 1.0_wp, 4.0_wp], [2, 2]), derivative(2:3, :)))
      end associate
   end function plbeam_curvature

   !> Minus the derivative of e_l . ey with respect to the angle of ey.
   pure real(wp) function turning(el, ey)
      real(wp), intent(in) :: el(3), ey(3)
      turning = el(1)*ey(2) - el(2)*ey(1)
   end function turning
end module flexact_plbeam
