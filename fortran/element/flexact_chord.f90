! SPDX-License-Identifier: BSD-3-Clause
!> The straight line from p to q, which trusses and beams measure.
module flexact_chord
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: skew, turned_once, apart
   use flexact_vectors, only: identity, length_of, unit
   implicit none
   private
   public :: chord_t, make_chord, across_chord, add_length, add_projection

   !> Where p and q have come to coincide there is no direction: it and the
   !> ratio are zero.
   type :: chord_t
      !> The unit vector e_l of eq. (4).
      real(wp) :: direction(3)
      !> l - l0.
      real(wp) :: elongation
      !> l0/l.
      real(wp) :: ratio
   end type chord_t

contains

   !> The chord in a configuration. The elongation comes from the difference of
   !> the squares, so that it is exactly zero in the reference configuration
   !> and small ones keep their digits.
   pure subroutine make_chord(reference, p, q, chord)
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      type(chord_t), intent(out) :: chord
      real(wp) :: offset(3), length

      offset = q%position - p%position
      length = length_of(offset)
      chord%direction = unit(offset)
      chord%elongation = 0.0_wp
      chord%ratio = 0.0_wp
      if (length + reference%length > 0.0_wp) &
         chord%elongation = dot_product(offset - reference%offset, &
                                        (offset + reference%offset)/(length + reference%length))
      if (length > 0.0_wp) chord%ratio = reference%length/length
   end subroutine make_chord

   !> l0 times the derivative of e_l . a with respect to the position of q,
   !> for a vector a that stays as it is: (l0/l) (a - (e_l . a) e_l).
   pure function across_chord(chord, a) result(derivative)
      type(chord_t), intent(in) :: chord
      real(wp), intent(in) :: a(3)
      real(wp) :: derivative(3)
      derivative = chord%ratio*(a - dot_product(chord%direction, a)*chord%direction)
   end function across_chord

   !> Add the second derivative of the length, times a factor.
   pure subroutine add_length(reference, chord, factor, second)
      type(reference_t), intent(in) :: reference
      type(chord_t), intent(in) :: chord
      real(wp), intent(in) :: factor
      real(wp), intent(inout) :: second(9, 9)

      associate (here => second(apart:apart + 2, apart:apart + 2), n => chord%direction)
         here = here + factor*(chord%ratio/reference%length)*(identity - outer(n, n))
      end associate
   end subroutine add_length

   !> Add the second derivative of l0 e_l . a, times a factor, for a vector a that
   !> turns with the spin at this place.
   pure subroutine add_projection(reference, chord, a, spin, factor, second)
      type(reference_t), intent(in) :: reference
      type(chord_t), intent(in) :: chord
      real(wp), intent(in) :: a(3), factor
      integer, intent(in) :: spin
      real(wp), intent(inout) :: second(9, 9)
      real(wp) :: n(3), along, mixed(3, 3)
      integer :: x(3), w(3)

      n = chord%direction
      along = dot_product(n, a)
      x = [apart, apart + 1, apart + 2]
      w = [spin, spin + 1, spin + 2]
      second(x, x) = second(x, x) + factor*chord%ratio*(chord%ratio/reference%length) &
                     *(along*(3*outer(n, n) - identity) - outer(a, n) - outer(n, a))
      mixed = -factor*chord%ratio*matmul(identity - outer(n, n), skew(a))
      second(x, w) = second(x, w) + mixed
      second(w, x) = second(w, x) + transpose(mixed)
      second(w, w) = second(w, w) + factor*reference%length*turned_once(a, n)
   end subroutine add_projection

   pure function outer(a, b) result(matrix)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: matrix(3, 3)
      integer :: i

      do i = 1, 3
         matrix(:, i) = a*b(i)
      end do
   end function outer
end module flexact_chord
