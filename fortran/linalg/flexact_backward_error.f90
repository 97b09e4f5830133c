! SPDX-License-Identifier: BSD-3-Clause
!> By how much, in the 2-norm, the product L L' of a Cholesky factorisation that ran to
!> its end may differ from A'A and what was added to its diagonal.
!>
!> Whatever the order of the operations, a sum of k products is off by at most g(k), k
!> roundings, times the sum of their magnitudes (Higham, Accuracy and Stability of
!> Numerical Algorithms, 2002, lemma 8.4, theorem 10.3). So are the entries of A'A, where
!> k counts the rows that two columns share, and those of L L', where k counts
!> the columns in which two rows of L both have entries: at most min(k_i, k_j), the
!> numbers of entries of rows i and j; zeros cost no rounding. As g of the
!> minimum is at most the root of g(k_i) g(k_j), the error has a norm of at most that of
!> W |L| |L'| W, W = diag(root of g(k_i)). Of this matrix, which is not negative, the
!> norm is at most the largest quotient of the entries of its product with x and those of
!> x, for any positive x (Collatz, Math. Z. 48, 1942); theory.md (32) and (33), with what
!> they leave out.
module flexact_backward_error
   use flexact_kinds, only: wp
   use flexact_sparse, only: operator_t
   implicit none
   private
   public :: error_of_gram, unit, extra, rounds

   real(wp), parameter :: unit = 0.5_wp*epsilon(1.0_wp)
   !> Roundings of an entry beside those of its products: a division as a product
   !> with the inverse, a root, what was added, and one for the bound itself.
   integer, parameter :: extra = 4
   !> Products with x: the first is with a guess, which is w, for rows with many entries meet
   !> others such; the second is nearly as good as many.
   integer, parameter :: rounds = 2

contains

   !> Of k roundings, relative to the sum of magnitudes.
   pure elemental real(wp) function growth(k)
      integer, intent(in) :: k
      growth = k*unit/(1 - k*unit)
   end function growth

   !> For A'A with ones or less added to its diagonal. largest: entry of that. enough: no
   !> better bound than this is sought.
   pure real(wp) function error_of_gram(a, largest, enough) result(bound)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: largest, enough
      real(wp) :: w(a%by_column%columns), x(a%by_column%columns), z(a%by_column%columns), y(a%by_column%rows)
      real(wp) :: total
      integer :: j, round, entry

      w = growth(a%by_column%start(2:) - a%by_column%start(:a%by_column%columns) + extra)
      x = w
      bound = huge(bound)
      do round = 1, rounds
         y = 0.0_wp
         do j = 1, size(x)
            do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
               y(a%by_column%place(entry)) = y(a%by_column%place(entry)) + abs(a%by_column%value(entry))*x(j)
            end do
         end do
         do j = 1, size(x)
            total = 0.0_wp
            do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
               total = total + abs(a%by_column%value(entry))*y(a%by_column%place(entry))
            end do
            z(j) = w(j)*total
         end do
         bound = min(bound, maxval(z/x))
         if (bound <= enough) exit
         x = z + max(tiny(1.0_wp), epsilon(1.0_wp)*maxval(z))
      end do
      bound = bound + growth(extra)*(1 + largest)
   end function error_of_gram
end module flexact_backward_error
