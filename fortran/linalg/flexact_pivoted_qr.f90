! SPDX-License-Identifier: BSD-3-Clause
!> Null spaces of small matrices by QR factorisation with column pivoting, which
!> is quicker than singular values. It may miss a zero (Kahan's matrix): who
!> takes a vector from here looks at its image.
module flexact_pivoted_qr
   use flexact_dense, only: fits_integer, allocate_work, bring_to_one
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqp3, dtzrzf, dormrz
   implicit none
   private
   public :: null_space

contains

   !> An orthonormal basis of the vectors that A (m, n) takes to zero; pivots up to
   !> `least` count as zero. A is destroyed.
   pure subroutine null_space(a, least, basis, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(in) :: least
      real(wp), allocatable, intent(out) :: basis(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: work(:)
      real(wp) :: tau(minval(shape(a))), length(1)
      integer :: pivot(size(a, 2)), m, n, rank, power, info, i

      m = size(a, 1)
      n = size(a, 2)
      pivot = [(i, i=1, n)]
      rank = 0
      call bring_to_one(a, power, error)
      if (allocated(error)) return
      if (m > 0 .and. n > 0) then
         pivot = 0
         info = 1
         if (fits_integer(m, n)) call dgeqp3(m, n, a, m, pivot, tau, length, -1, info)
         if (info == 0) call allocate_work(work, length(1), info)
         if (info /= 0) then
            call fail(error_memory, error)
            return
         end if
         call dgeqp3(m, n, a, m, pivot, tau, work, size(work), info)
         rank = count_pivots(a, scale(least, -power))
      end if
      allocate (basis(n, n - rank), source=0.0_wp)
      do i = 1, n - rank
         basis(rank + i, i) = 1.0_wp
      end do
      if (rank > 0 .and. rank < n) call rotate(a, rank, basis, error)
      basis(pivot, :) = basis
   end subroutine null_space

   !> How many pivots stand before the last one that counts; they descend but for
   !> rounding.
   pure integer function count_pivots(a, least) result(rank)
      real(wp), intent(in) :: a(:, :), least

      do rank = minval(shape(a)), 1, -1
         if (abs(a(rank, rank)) > least) return
      end do
   end function count_pivots

   !> Z' times a basis, where the first rows of R are T Z, T a triangle.
   pure subroutine rotate(a, rank, basis, error)
      real(wp), intent(in) :: a(:, :)
      integer, intent(in) :: rank
      real(wp), intent(inout), contiguous :: basis(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: rows(rank, size(a, 2)), tau(rank), length(2)
      real(wp), allocatable :: work(:)
      integer :: n, k, j, info

      n = size(a, 2)
      k = size(basis, 2)
      rows = 0.0_wp
      do j = 1, n
         rows(:min(j, rank), j) = a(:min(j, rank), j)
      end do
      call dtzrzf(rank, n, rows, rank, tau, length(1:), -1, info)
      call dormrz('L', 'T', n, k, rank, n - rank, rows, rank, tau, basis, n, length(2:), -1, info)
      call allocate_work(work, maxval(length), info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dtzrzf(rank, n, rows, rank, tau, work, size(work), info)
      call dormrz('L', 'T', n, k, rank, n - rank, rows, rank, tau, basis, n, work, size(work), info)
   end subroutine rotate
end module flexact_pivoted_qr
