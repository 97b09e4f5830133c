! SPDX-License-Identifier: BSD-3-Clause
!> Whether all singular values of a small dense matrix are above a bound, by one Cholesky
!> factorisation; theory.md (48).
module flexact_full_rank
   use flexact_kinds, only: wp
   use flexact_lapack, only: dpotrf, dsyrk
   implicit none
   private
   public :: make_dense_gram, is_above

   real(wp), parameter :: unit = 0.5_wp*epsilon(1.0_wp)
   !> Roundings beside those of the products: roots, divisions, what is subtracted, the bound.
   integer, parameter :: extra = 10

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

   !> That the factorisation of A'A - s I runs to its end shows that no singular value of A is
   !> below `least`, if s is the square of that and what rounding may make: the sums of k
   !> products of A'A and of the factor are off by at most k roundings times sums of magnitudes,
   !> together no more than (rows + columns) roundings times the sum of all squares of A
   !> (Higham, Accuracy and Stability of Numerical Algorithms, 2002, lemma 8.4 and theorem
   !> 10.3; Rump, BIT 46, 2006). gram: by make_dense_gram; terms: rows and columns of A together.
   subroutine is_above(gram, terms, least, above)
      real(wp), intent(in) :: gram(:, :), least
      integer, intent(in) :: terms
      logical, intent(out) :: above
      real(wp) :: factor(size(gram, 1), size(gram, 1)), shift
      integer :: info, i

      above = size(gram, 1) > 0
      if (.not. above) return
      factor = gram
      shift = (least**2 + (terms + extra)*unit*sum([(gram(i, i), i=1, size(gram, 1))]))*(1 + extra*unit)
      do i = 1, size(gram, 1)
         factor(i, i) = factor(i, i) - shift
      end do
      call dpotrf('L', size(gram, 1), factor, size(gram, 1), info)
      above = info == 0
   end subroutine is_above
end module flexact_full_rank
