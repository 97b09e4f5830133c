! SPDX-License-Identifier: BSD-3-Clause
!> What makes small singular values exact: the product A V in quadruple
!> precision, for the computed right vectors V of A. Rounding it back costs each
!> column no more than its own last digits, and its columns are nearly
!> orthogonal, however much they differ in length: of such a matrix Jacobi
!> rotations give every value to its own last digits (Demmel and Veselic, SIAM
!> J. Matrix Anal. Appl. 13, 1992, pp. 1204-1245). As V is orthogonal to
!> working precision, these are the values of A.
module flexact_refinement
   use flexact_kinds, only: wp, qp
   implicit none
   private
   public :: is_refinable, exact_product

   !> m n**2, up to which a second decomposition and the products, which are fewer by
   !> the zeros of A, take less than a second: square matrices may be 250 x 250. It
   !> counts operations, so that results do not depend on the machine.
   real(wp), parameter :: largest = 1.6e7_wp

contains

   !> Whether an m x n matrix, m >= n, is small enough, and numbers are at hand that
   !> have more digits.
   pure logical function is_refinable(m, n)
      integer, intent(in) :: m, n

      is_refinable = precision(1.0_qp) > precision(1.0_wp) .and. real(m, wp)*n*n <= largest
   end function is_refinable

   !> A B (m, k) for A (m, n), B (n, k), each entry right to its last digit.
   pure subroutine exact_product(a, b, product)
      real(wp), intent(in) :: a(:, :), b(:, :)
      real(wp), intent(out) :: product(:, :)
      real(qp) :: total(size(a, 1))
      integer :: start(size(a, 2) + 1), entry, i, j, k
      integer, allocatable :: row(:)

      start(1) = 1
      do j = 1, size(a, 2)
         start(j + 1) = start(j) + count(abs(a(:, j)) > 0)
      end do
      row = pack(spread([(i, i=1, size(a, 1))], 2, size(a, 2)), abs(a) > 0)
      do k = 1, size(b, 2)
         total = 0.0_qp
         do j = 1, size(a, 2)
            do entry = start(j), start(j + 1) - 1
               i = row(entry)
               total(i) = total(i) + real(a(i, j), qp)*b(j, k)
            end do
         end do
         product(:, k) = real(total, wp)
      end do
   end subroutine exact_product
end module flexact_refinement
