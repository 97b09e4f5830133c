! SPDX-License-Identifier: BSD-3-Clause
!> Where the entries of Z'A Z stand for sparse Z and symmetric sparse A, whose patterns stay the
!> same from one to the next.
!>
!> Columns of Z that stand side by side and have the same rows are a group. So Z'A Z consists of
!> full blocks, one for each two groups that an entry of A joins.
module flexact_projection_pattern
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   implicit none
   private
   public :: projection_t, prepare, rows_of

   !> basis: Z. matrix: lower triangle of Z'A Z; only its pattern counts.
   type :: projection_t
      type(sparse_t) :: basis, matrix
      type(symmetric_pattern_t) :: pattern
      integer :: groups = 0
      !> First column of each group; the groups of row i: group(of_row(i):of_row(i + 1) - 1).
      integer, allocatable :: first(:), of_row(:), group(:)
      !> The groups that each is joined with: itself, and then those behind it.
      integer, allocatable :: start(:), joined(:)
   end type projection_t

contains

   !> Take another basis Z; what is known of the patterns stays where they are the same.
   subroutine prepare(basis, a, projection)
      type(sparse_t), intent(in) :: basis, a
      type(projection_t), intent(inout) :: projection
      logical :: is_same

      is_same = allocated(projection%basis%start)
      if (is_same) is_same = projection%basis%columns == basis%columns .and. size(projection%basis%place) == size(basis%place)
      if (is_same) is_same = all(projection%basis%start == basis%start) .and. all(projection%basis%place == basis%place)
      projection%basis = basis
      if (is_same) return
      call find_groups(projection)
      call join_groups(a, projection)
      call fill_pattern(projection)
      projection%pattern = symmetric_pattern_t()
      call analyse_pattern(projection%matrix, projection%pattern)
   end subroutine prepare

   !> A column with other rows than the one before begins a group.
   pure subroutine find_groups(projection)
      type(projection_t), intent(inout) :: projection
      integer :: j, g, i
      integer, allocatable :: rows(:), next(:)
      logical :: is_new

      associate (z => projection%basis)
         projection%first = spread(0, 1, z%columns + 1)
         projection%groups = 0
         do j = 1, z%columns
            is_new = j == 1
            if (.not. is_new) is_new = z%start(j + 1) - z%start(j) /= z%start(j) - z%start(j - 1)
            if (.not. is_new) is_new = any(z%place(z%start(j):z%start(j + 1) - 1) /= z%place(z%start(j - 1):z%start(j) - 1))
            if (.not. is_new) cycle
            projection%groups = projection%groups + 1
            projection%first(projection%groups) = j
         end do
         projection%first = [projection%first(:projection%groups), z%columns + 1]
         allocate (next(z%rows + 1), source=0)
         do g = 1, projection%groups
            rows = rows_of(projection, g)
            next(rows + 1) = next(rows + 1) + 1
         end do
         next(1) = 1
         do i = 1, z%rows
            next(i + 1) = next(i) + next(i + 1)
         end do
         projection%of_row = next
         projection%group = spread(0, 1, next(z%rows + 1) - 1)
         do g = 1, projection%groups
            rows = rows_of(projection, g)
            projection%group(next(rows)) = g
            next(rows) = next(rows) + 1
         end do
      end associate
   end subroutine find_groups

   !> The rows of a group.
   pure function rows_of(projection, g) result(rows)
      type(projection_t), intent(in) :: projection
      integer, intent(in) :: g
      integer, allocatable :: rows(:)

      associate (j => projection%first(g), z => projection%basis)
         rows = z%place(z%start(j):z%start(j + 1) - 1)
      end associate
   end function rows_of

   pure subroutine join_groups(a, projection)
      type(sparse_t), intent(in) :: a
      type(projection_t), intent(inout) :: projection
      integer :: seen(projection%groups), g, h, i, k, q, found, round
      integer, allocatable :: rows(:)

      projection%start = spread(1, 1, projection%groups + 1)
      do round = 1, 2
         seen = 0
         found = 0
         do g = 1, projection%groups
            found = found + 1
            projection%start(g) = found
            if (round == 2) projection%joined(found) = g
            seen(g) = g
            rows = rows_of(projection, g)
            do i = 1, size(rows)
               do q = a%start(rows(i)), a%start(rows(i) + 1) - 1
                  do k = projection%of_row(a%place(q)), projection%of_row(a%place(q) + 1) - 1
                     h = projection%group(k)
                     if (h <= g) cycle
                     if (seen(h) == g) cycle
                     seen(h) = g
                     found = found + 1
                     if (round == 2) projection%joined(found) = h
                  end do
               end do
            end do
         end do
         projection%start(projection%groups + 1) = found + 1
         if (round == 1) projection%joined = spread(0, 1, found)
      end do
      do g = 1, projection%groups
         associate (joined => projection%joined(projection%start(g):projection%start(g + 1) - 1))
            joined = joined(ascending(real(joined, wp)))
         end associate
      end do
   end subroutine join_groups

   !> Column by column: the rest of its own group, and all columns of those joined.
   pure subroutine fill_pattern(projection)
      type(projection_t), intent(inout) :: projection
      integer :: g, j, p, k, found, entries

      associate (matrix => projection%matrix, first => projection%first)
         matrix%rows = projection%basis%columns
         matrix%columns = projection%basis%columns
         matrix%start = spread(1, 1, matrix%columns + 1)
         entries = 0
         do g = 1, projection%groups
            do p = projection%start(g), projection%start(g + 1) - 1
               entries = entries + (first(g + 1) - first(g))*(first(projection%joined(p) + 1) - first(projection%joined(p)))
            end do
         end do
         matrix%place = spread(0, 1, entries)
         found = 0
         do g = 1, projection%groups
            do j = first(g), first(g + 1) - 1
               matrix%start(j) = found + 1
               do p = projection%start(g), projection%start(g + 1) - 1
                  do k = max(j, first(projection%joined(p))), first(projection%joined(p) + 1) - 1
                     found = found + 1
                     matrix%place(found) = k
                  end do
               end do
            end do
         end do
         matrix%start(matrix%columns + 1) = found + 1
         matrix%place = matrix%place(:found)
         matrix%value = spread(1.0_wp, 1, found)
      end associate
   end subroutine fill_pattern
end module flexact_projection_pattern
