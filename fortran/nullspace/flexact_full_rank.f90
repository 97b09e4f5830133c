! SPDX-License-Identifier: BSD-3-Clause
!> Whether all singular values of a small dense matrix are above a bound, by one Cholesky
!> factorisation; theory.md (48).
module flexact_full_rank
   use flexact_gram_lanes, only: shift_of
   use flexact_kinds, only: wp
   use flexact_lapack, only: dpotrf, dsyrk
   implicit none
   private
   public :: make_dense_gram, is_above

contains

   !> A'A, or A A' if that is smaller: its lower triangle.
   subroutine make_dense_gram(a, gram)
      real(wp), intent(in), contiguous :: a(:, :)
      real(wp), intent(inout), contiguous :: gram(:, :)

      associate (side => minval(shape(a)))
         if (side > 0) call dsyrk('L', merge('T', 'N', size(a, 2) == side), side, maxval(shape(a)), 1.0_wp, &
                                  a, size(a, 1), 0.0_wp, gram, side)
      end associate
   end subroutine make_dense_gram

   !> Whether no singular value of A is below `least`; gram: by make_dense_gram; terms: rows and columns
   !> of A together.
   subroutine is_above(gram, terms, least, above)
      real(wp), intent(in) :: gram(:, :), least
      integer, intent(in) :: terms
      logical, intent(out) :: above
      real(wp) :: factor(size(gram, 1), size(gram, 1)), shift
      integer :: info, i

      above = size(gram, 1) > 0
      if (.not. above) return
      factor = gram
      shift = shift_of(least, terms, sum([(gram(i, i), i=1, size(gram, 1))]))
      do i = 1, size(gram, 1)
         factor(i, i) = factor(i, i) - shift
      end do
      call dpotrf('L', size(gram, 1), factor, size(gram, 1), info)
      above = info == 0
   end subroutine is_above
end module flexact_full_rank
