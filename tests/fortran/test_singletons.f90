! SPDX-License-Identifier: BSD-3-Clause
!> Rows and columns that are eliminated without arithmetic, and what they leave.
program test_singletons
   use flexact_error, only: error_t
   use flexact_jacobi, only: values_by_jacobi
   use flexact_kinds, only: wp
   use flexact_singletons, only: take_singletons
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   integer :: n

   call set_random()
   call nothing_is_left_of_a_triangle()
   call a_cycle_is_left()
   call a_tail_is_taken_from_a_cycle()
   call empty_rows_and_columns()
   call a_taken_column_empties_rows()
   do n = 2, 30
      call the_rank_is_kept(n)
   end do
   call tally%finish()

contains

   !> Each row ends on the diagonal, the longest first.
   subroutine nothing_is_left_of_a_triangle()
      integer, parameter :: start(*) = [1, 4, 6, 7], column(*) = [1, 2, 3, 1, 2, 1]
      logical :: rows(3), columns(3)
      integer :: pivots

      call take_singletons(start, column, 3, pivots, rows, columns)
      call tally%check(pivots == 3 .and. .not. any(rows) .and. .not. any(columns), 'a triangle')
   end subroutine nothing_is_left_of_a_triangle

   !> Two entries in every row and column.
   subroutine a_cycle_is_left()
      integer, parameter :: start(*) = [1, 3, 5, 7], column(*) = [1, 2, 2, 3, 3, 1]
      logical :: rows(3), columns(3)
      integer :: pivots

      call take_singletons(start, column, 3, pivots, rows, columns)
      call tally%check(pivots == 0 .and. all(rows) .and. all(columns), 'a cycle')
   end subroutine a_cycle_is_left

   !> Columns 1 and 2 in rows 2 and 3; row 1 joins columns 2 and 3, row 4 columns 3 and 4.
   subroutine a_tail_is_taken_from_a_cycle()
      integer, parameter :: start(*) = [1, 3, 5, 7, 9], column(*) = [2, 3, 1, 2, 1, 2, 3, 4]
      logical :: rows(4), columns(4)
      integer :: pivots

      call take_singletons(start, column, 4, pivots, rows, columns)
      call tally%check(pivots == 2, 'two pairs of the tail')
      call tally%check(all(rows .eqv. [.false., .true., .true., .false.]), 'rows of the cycle')
      call tally%check(all(columns .eqv. [.true., .true., .false., .false.]), 'columns of the cycle')
   end subroutine a_tail_is_taken_from_a_cycle

   subroutine empty_rows_and_columns()
      integer, parameter :: start(*) = [1, 1, 2, 2], column(*) = [3]
      integer :: none(0), pivots
      logical :: rows(3), columns(4), no_rows(0)

      call take_singletons(start, column, 4, pivots, rows, columns)
      call tally%check(pivots == 1 .and. .not. any(rows) .and. .not. any(columns), 'one entry')
      call take_singletons([1], none, 4, pivots, no_rows, columns)
      call tally%check(pivots == 0 .and. .not. any(columns), 'no rows')
   end subroutine empty_rows_and_columns

   !> Three rows with the same one entry have rank one.
   subroutine a_taken_column_empties_rows()
      logical :: rows(3), columns(1)
      integer :: pivots

      call take_singletons([1, 2, 3, 4], [1, 1, 1], 1, pivots, rows, columns)
      call tally%check(pivots == 1 .and. .not. any(rows) .and. .not. any(columns), 'rows that are parallel')
   end subroutine a_taken_column_empties_rows

   !> The pairs and the rank of what is left are the rank; entries are ones and twos, so
   !> that some of these matrices are singular.
   subroutine the_rank_is_kept(n)
      integer, intent(in) :: n
      real(wp) :: chance(n, n), value(n, n), matrix(n, n)
      integer :: start(n + 1), column(n*n), pivots, i, j, entries
      logical :: rows(n), columns(n)

      call random_number(chance)
      call random_number(value)
      matrix = merge(1.0_wp + anint(value), 0.0_wp, chance < 2.0_wp/n)
      entries = 0
      do i = 1, n
         start(i) = entries + 1
         do j = 1, n
            if (.not. matrix(i, j) > 0) cycle
            entries = entries + 1
            column(entries) = j
         end do
      end do
      start(n + 1) = entries + 1
      call take_singletons(start, column(:entries), n, pivots, rows, columns)
      call tally%check(rank(matrix) == pivots + rank(matrix, rows, columns), 'the rank of random entries')
      call tally%check(.not. any(count(matrix > 0 .and. spread(columns, 1, n), 2) == 1 .and. rows), 'no row is single')
      call tally%check(.not. any(count(matrix > 0 .and. spread(rows, 2, n), 1) == 1 .and. columns), 'no column is single')
   end subroutine the_rank_is_kept

   integer function rank(matrix, rows, columns)
      real(wp), intent(in) :: matrix(:, :)
      logical, intent(in), optional :: rows(:), columns(:)
      real(wp) :: copy(size(matrix, 1), size(matrix, 2)), values(size(matrix, 1))
      type(error_t), allocatable :: error

      copy = matrix
      if (present(rows)) copy = merge(copy, 0.0_wp, spread(rows, 2, size(copy, 2)))
      if (present(columns)) copy = merge(copy, 0.0_wp, spread(columns, 1, size(copy, 1)))
      values = 0.0_wp
      call values_by_jacobi(copy, values, error)
      call tally%check(.not. allocated(error), 'status')
      rank = count(values > 1.0e-9_wp)
   end function rank
end program test_singletons
