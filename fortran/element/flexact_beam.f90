! SPDX-License-Identifier: BSD-3-Clause
!> BEAM: a slender beam in space, eqs. (3) and (4), valid for large
!> displacements and rotations of the element as a whole.
module flexact_beam
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_chord, only: chord_t, make_chord, across_chord
   use flexact_vectors, only: cross
   implicit none
   private
   public :: beam_deformation, linear_deformation, coupling

contains

   !> e1 elongation, e2 torsion, e3 and e4 bending in the local xz plane at p
   !> and q, e5 and e6 bending in the local xy plane at p and q [m]; e2 to e6
   !> are l0 times an angle.
   pure subroutine beam_deformation(reference, p, q, e, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> Deformations (6) and their derivatives (6, 12) with respect to the
      !> position of p, rotation of p, position of q, rotation of q.
      real(wp), intent(out) :: e(6), derivative(6, 12)
      real(wp) :: linear(6), linear_derivative(6, 12)

      call linear_deformation(reference, p, q, linear, linear_derivative)
      e = coupled_deformation(reference, linear)
      if (any(abs(linear(2:)) > 0)) then
         derivative = matmul(coupling(reference, linear), linear_derivative)
      else
         derivative = linear_derivative
      end if
   end subroutine beam_deformation

   !> Eq. (4), each in units of l0 but for the first, and the derivatives of
   !> the deformations themselves.
   pure subroutine linear_deformation(reference, p, q, g, derivative)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(out) :: g(6), derivative(6, 12)
      type(chord_t) :: chord
      real(wp) :: frame_p(3, 3), frame_q(3, 3)

      call make_chord(reference, p, q, chord)
      frame_p = matmul(p%rotation, reference%frame)
      frame_q = matmul(q%rotation, reference%frame)
      derivative = 0.0_wp
      associate (el => chord%direction, l0 => reference%length, &
                 eyp => frame_p(:, 2), ezp => frame_p(:, 3), eyq => frame_q(:, 2), ezq => frame_q(:, 3))
         g(1) = chord%elongation
         g(2) = 0.5_wp*(dot_product(ezp, eyq) - dot_product(eyp, ezq))
         g(3) = -dot_product(el, ezp)
         g(4) = dot_product(el, ezq)
         g(5) = dot_product(el, eyp)
         g(6) = -dot_product(el, eyq)

         ! Angles below rounding are none: their products would fill zeros of D(c).
         where (abs(g(2:)) < epsilon(1.0_wp)) g(2:) = 0.0_wp

         derivative(1, 7:9) = el
         derivative(2, 10:12) = 0.5_wp*l0*(cross(eyq, ezp) - cross(ezq, eyp))
         derivative(2, 4:6) = -derivative(2, 10:12)
         derivative(3, 7:9) = -across_chord(chord, ezp)
         derivative(3, 4:6) = -l0*cross(ezp, el)
         derivative(4, 7:9) = across_chord(chord, ezq)
         derivative(4, 10:12) = l0*cross(ezq, el)
         derivative(5, 7:9) = across_chord(chord, eyp)
         derivative(5, 4:6) = l0*cross(eyp, el)
         derivative(6, 7:9) = -across_chord(chord, eyq)
         derivative(6, 10:12) = -l0*cross(eyq, el)
      end associate
      derivative(:, 1:3) = -derivative(:, 7:9)
   end subroutine linear_deformation

   !> Eq. (3).
   pure function coupled_deformation(reference, g) result(e)
      type(reference_t), intent(in) :: reference
      real(wp), intent(in) :: g(6)
      real(wp) :: e(6)

      associate (l0 => reference%length, c_t => reference%c_t)
         e(1) = g(1) + l0*(2*g(3)**2 + g(3)*g(4) + 2*g(4)**2 + 2*g(5)**2 + g(5)*g(6) + 2*g(6)**2)/30 &
                + c_t*g(2)**2/(2*l0)
         e(2) = l0*(g(2) - g(3)*g(6) + g(4)*g(5))
         e(3) = l0*(g(3) + g(2)*(g(5) + g(6))/6)
         e(4) = l0*(g(4) - g(2)*(g(5) + g(6))/6)
         e(5) = l0*(g(5) - g(2)*(g(3) + g(4))/6)
         e(6) = l0*(g(6) + g(2)*(g(3) + g(4))/6)
      end associate
   end function coupled_deformation

   !> The derivatives of eq. (3) with respect to the deformations of eq. (4);
   !> the identity where the beam is straight.
   pure function coupling(reference, g) result(t)
      type(reference_t), intent(in) :: reference
      real(wp), intent(in) :: g(6)
      real(wp) :: t(6, 6)

      t(1, :) = [1.0_wp, reference%c_t*g(2)/reference%length/reference%length, &
                 (4*g(3) + g(4))/30, (g(3) + 4*g(4))/30, (4*g(5) + g(6))/30, (g(5) + 4*g(6))/30]
      t(2, :) = [0.0_wp, 1.0_wp, -g(6), g(5), g(4), -g(3)]
      t(3, :) = [0.0_wp, (g(5) + g(6))/6, 1.0_wp, 0.0_wp, g(2)/6, g(2)/6]
      t(4, :) = [0.0_wp, -(g(5) + g(6))/6, 0.0_wp, 1.0_wp, -g(2)/6, -g(2)/6]
      t(5, :) = [0.0_wp, -(g(3) + g(4))/6, -g(2)/6, -g(2)/6, 1.0_wp, 0.0_wp]
      t(6, :) = [0.0_wp, (g(3) + g(4))/6, g(2)/6, g(2)/6, 0.0_wp, 1.0_wp]
   end function coupling
end module flexact_beam
