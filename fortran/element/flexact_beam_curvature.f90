! SPDX-License-Identifier: BSD-3-Clause
!> Second derivatives of the deformations of a BEAM, eqs. (3) and (4) in full.
module flexact_beam_curvature
   use flexact_beam, only: linear_deformation, coupling
   use flexact_chord, only: chord_t, make_chord, add_length, add_projection
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: turned_once, turned_apart, at_ends, spin_p, spin_q
   implicit none
   private
   public :: beam_curvature

contains

   !> sigma_1 d2e1 to sigma_6 d2e6, summed: e is quadratic in the deformations b of
   !> eq. (4), so that with the derivatives B of b and T of e by b it is
   !> sum of (sigma T)_k d2b_k + B' (sum of sigma_k d2e_k/db2) B.
   pure function beam_curvature(reference, p, q, sigma) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp) :: h(12, 12)
      real(wp) :: g(6), derivative(6, 12)

      call linear_deformation(reference, p, q, g, derivative)
      h = linear_curvature(reference, p, q, matmul(sigma, coupling(reference, g))) &
          + matmul(transpose(derivative), matmul(quadratic(reference, sigma), derivative))
   end function beam_curvature

   !> Second derivatives of eq. (4), times factors and summed.
   pure function linear_curvature(reference, p, q, factor) result(h)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: factor(6)
      real(wp) :: h(12, 12)
      type(chord_t) :: chord
      real(wp) :: frame_p(3, 3), frame_q(3, 3), second(9, 9)

      call make_chord(reference, p, q, chord)
      frame_p = matmul(p%rotation, reference%frame)
      frame_q = matmul(q%rotation, reference%frame)
      second = 0.0_wp
      associate (eyp => frame_p(:, 2), ezp => frame_p(:, 3), eyq => frame_q(:, 2), ezq => frame_q(:, 3))
         call add_length(reference, chord, factor(1), second)
         call add_twist(eyp, ezp, eyq, ezq, 0.5_wp*reference%length*factor(2), second)
         call add_projection(reference, chord, factor(5)*eyp - factor(3)*ezp, spin_p, 1.0_wp, second)
         call add_projection(reference, chord, factor(4)*ezq - factor(6)*eyq, spin_q, 1.0_wp, second)
      end associate
      h = at_ends(second)
   end function linear_curvature

   !> Add the second derivative of zp.yq - yp.zq, times a factor.
   pure subroutine add_twist(eyp, ezp, eyq, ezq, factor, second)
      real(wp), intent(in) :: eyp(3), ezp(3), eyq(3), ezq(3), factor
      real(wp), intent(inout) :: second(9, 9)
      real(wp) :: own(3, 3), mixed(3, 3)
      integer, parameter :: p(3) = [spin_p, spin_p + 1, spin_p + 2], q(3) = [spin_q, spin_q + 1, spin_q + 2]

      own = factor*(turned_once(ezp, eyq) - turned_once(eyp, ezq))
      mixed = factor*(turned_apart(ezp, eyq) - turned_apart(eyp, ezq))
      second(p, p) = second(p, p) + own
      second(q, q) = second(q, q) + own
      second(p, q) = second(p, q) + mixed
      second(q, p) = second(q, p) + transpose(mixed)
   end subroutine add_twist

   !> The sum of sigma_k times the second derivative of e_k, eq. (3), with respect to
   !> the deformations of eq. (4).
   pure function quadratic(reference, sigma) result(second)
      type(reference_t), intent(in) :: reference
      real(wp), intent(in) :: sigma(6)
      real(wp) :: second(6, 6)

      second = 0.0_wp
      second(2, 2) = 30*sigma(1)*(reference%c_t/reference%length)/reference%length
      second(3, 3:4) = sigma(1)*[4, 1]
      second(4, 4) = 4*sigma(1)
      second(5, 5:6) = sigma(1)*[4, 1]
      second(6, 6) = 4*sigma(1)
      second(2, 3:4) = 5*(sigma(6) - sigma(5))
      second(2, 5:6) = 5*(sigma(3) - sigma(4))
      second(3, 6) = -30*sigma(2)
      second(4, 5) = 30*sigma(2)
      second = second/(30*reference%length)
      second(3:, 2) = second(2, 3:)
      second(4:, 3) = second(3, 4:)
      second(5:, 4) = second(4, 5:)
      second(6, 5) = second(5, 6)
   end function quadratic
end module flexact_beam_curvature
