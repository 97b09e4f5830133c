! SPDX-License-Identifier: BSD-3-Clause
!> The straight line from p to q, which trusses and beams measure.
module flexact_chord
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: length_of, unit
   implicit none
   private
   public :: chord_t, make_chord, across_chord

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
end module flexact_chord
