! SPDX-License-Identifier: BSD-3-Clause
!> Products with sparse symmetric matrices, and solutions with their factors, for several
!> vectors at a time: they stand side by side (lanes, n), so that each entry is read once.
module flexact_symmetric_lanes
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: lanes, symmetric_times, solve_lanes

   !> Vectors that are taken at a time.
   integer, parameter :: lanes = 8

contains

   !> y = A x for a symmetric matrix given by its lower triangle or whole: entries above the
   !> diagonal are not read.
   pure subroutine symmetric_times(matrix, x, y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      real(wp) :: from(lanes, matrix%columns), to(lanes, matrix%columns)
      integer :: first, last, i

      do first = 1, size(x, 2), lanes
         last = min(first + lanes - 1, size(x, 2))
         from(last - first + 2:, :) = 0.0_wp
         do i = first, last
            from(i - first + 1, :) = x(:, i)
         end do
         call multiply_lanes(matrix, from, to)
         do i = first, last
            y(:, i) = to(i - first + 1, :)
         end do
      end do
   end subroutine symmetric_times

   pure subroutine multiply_lanes(matrix, x, y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in) :: x(lanes, matrix%columns)
      real(wp), intent(out) :: y(lanes, matrix%columns)
      real(wp) :: total(lanes), here(lanes)
      integer :: i, j, entry

      y = 0.0_wp
      do j = 1, matrix%columns
         here = x(:, j)
         total = y(:, j)
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i > j) then
               total = total + matrix%value(entry)*x(:, i)
               y(:, i) = y(:, i) + matrix%value(entry)*here
            else if (i == j) then
               total = total + matrix%value(entry)*here
            end if
         end do
         y(:, j) = total
      end do
   end subroutine multiply_lanes

   !> Solve L D L' x = b in place, in the order of elimination.
   pure subroutine solve_lanes(pattern, value, pivot, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      real(wp), intent(in) :: value(:), pivot(:)
      real(wp), intent(inout) :: x(lanes, pattern%n)
      real(wp) :: total(lanes)
      integer :: j, p

      do j = 1, pattern%n
         total = x(:, j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            x(:, pattern%place(p)) = x(:, pattern%place(p)) - value(p)*total
         end do
      end do
      do j = pattern%n, 1, -1
         total = x(:, j)/pivot(j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            total = total - value(p)*x(:, pattern%place(p))
         end do
         x(:, j) = total
      end do
   end subroutine solve_lanes
end module flexact_symmetric_lanes
