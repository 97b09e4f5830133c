! SPDX-License-Identifier: BSD-3-Clause
!> Rows and columns that can be eliminated without arithmetic: a row with one entry
!> takes its column with it, a column with one entry its row, and so on; theory.md (17).
module flexact_singletons
   use, intrinsic :: iso_fortran_env, only: int64
   implicit none
   private
   public :: take_singletons

   !> The rows of a matrix, or its columns.
   type :: side_t
      !> Entries start(i) to start(i + 1) - 1 of number i stand in those of the other side.
      integer, allocatable :: start(:), other(:)
      !> How many of them are left, and the sum of their numbers: of one, its number.
      integer, allocatable :: count(:)
      integer(int64), allocatable :: sum(:)
      logical, allocatable :: is_left(:)
   end type side_t

contains

   !> Entries start(i) to start(i + 1) - 1 of row i stand in these columns. pivots: so many
   !> pairs were taken; is_row_left, is_column_left: what they leave, without empty ones.
   pure subroutine take_singletons(start, column, columns, pivots, is_row_left, is_column_left)
      integer, intent(in) :: start(:), column(:), columns
      integer, intent(out) :: pivots
      logical, intent(out) :: is_row_left(:), is_column_left(:)
      type(side_t) :: by_row, by_column
      integer :: i, before

      by_row%start = start
      by_row%other = column
      call transpose_side(by_row, columns, by_column)
      call sum_up(by_row)
      call sum_up(by_column)
      pivots = 0
      do
         before = pivots
         do i = 1, size(by_row%count)
            if (by_row%is_left(i) .and. by_row%count(i) == 1) &
               call take(i, int(by_row%sum(i)), by_row, by_column, pivots)
         end do
         do i = 1, columns
            if (by_column%is_left(i) .and. by_column%count(i) == 1) &
               call take(int(by_column%sum(i)), i, by_row, by_column, pivots)
         end do
         if (pivots == before) exit
      end do
      is_row_left = by_row%is_left .and. by_row%count > 0
      is_column_left = by_column%is_left .and. by_column%count > 0
   end subroutine take_singletons

   pure subroutine transpose_side(by_row, columns, by_column)
      type(side_t), intent(in) :: by_row
      integer, intent(in) :: columns
      type(side_t), intent(out) :: by_column
      integer :: next(columns), i, entry

      next = 0
      do entry = 1, size(by_row%other)
         next(by_row%other(entry)) = next(by_row%other(entry)) + 1
      end do
      allocate (by_column%start(columns + 1), by_column%other(size(by_row%other)))
      by_column%start(1) = 1
      do i = 1, columns
         by_column%start(i + 1) = by_column%start(i) + next(i)
      end do
      next = by_column%start(:columns)
      do i = 1, size(by_row%start) - 1
         do entry = by_row%start(i), by_row%start(i + 1) - 1
            associate (at => next(by_row%other(entry)))
               by_column%other(at) = i
               at = at + 1
            end associate
         end do
      end do
   end subroutine transpose_side

   pure subroutine sum_up(side)
      type(side_t), intent(inout) :: side
      integer :: i, numbers

      numbers = size(side%start) - 1
      side%count = side%start(2:) - side%start(:numbers)
      side%sum = [(sum(int(side%other(side%start(i):side%start(i + 1) - 1), int64)), i=1, numbers)]
      allocate (side%is_left(numbers), source=.true.)
   end subroutine sum_up

   !> Leave out a row and a column, of which one has no other entry.
   pure subroutine take(row, column, by_row, by_column, pivots)
      integer, intent(in) :: row, column
      type(side_t), intent(inout) :: by_row, by_column
      integer, intent(inout) :: pivots

      pivots = pivots + 1
      call leave_out(row, by_row, by_column)
      call leave_out(column, by_column, by_row)
   end subroutine take

   !> Those that meet it lose an entry.
   pure subroutine leave_out(number, side, other)
      integer, intent(in) :: number
      type(side_t), intent(inout) :: side, other
      integer :: entry

      side%is_left(number) = .false.
      do entry = side%start(number), side%start(number + 1) - 1
         associate (met => side%other(entry))
            other%count(met) = other%count(met) - 1
            other%sum(met) = other%sum(met) - number
         end associate
      end do
   end subroutine leave_out
end module flexact_singletons
