! SPDX-License-Identifier: BSD-3-Clause
!> What a sparse factorisation L D L' of a symmetric matrix needs to know of its pattern:
!> an order of elimination, the elimination tree and the pattern of L. It is found once for
!> all matrices of the same pattern.
module flexact_symmetric_pattern
   use flexact_elimination_tree, only: elimination_tree, find_first
   use flexact_minimum_degree, only: minimum_degree_order
   use flexact_sparse, only: sparse_t
   use flexact_kinds, only: wp
   implicit none
   private
   public :: symmetric_pattern_t, analyse_pattern

   type :: symmetric_pattern_t
      integer :: n = 0
      !> The column that is eliminated k-th, and when each column is.
      integer, allocatable :: order(:), place_of(:)
      !> In the order of elimination from here on. The first of those whose elimination changes
      !> column k: all of them stand from there on to k.
      integer, allocatable :: first(:)
      !> Row k of the lower triangle: columns up to k, and the entry of the matrix that each is.
      integer, allocatable :: row_start(:), row_column(:), row_entry(:)
      !> Column j of L below the diagonal: its rows, ascending.
      integer, allocatable :: start(:), place(:)
      !> Row k of L left of the diagonal: its columns, ascending, and where each stands by columns.
      integer, allocatable :: left_start(:), left_column(:), left_entry(:)
   end type symmetric_pattern_t

contains

   !> Of a symmetric matrix given by its lower triangle or whole: entries above the diagonal
   !> are not read.
   pure subroutine analyse_pattern(matrix, pattern)
      type(sparse_t), intent(in) :: matrix
      type(symmetric_pattern_t), intent(out) :: pattern
      integer :: parent(matrix%columns), room(matrix%columns)

      pattern%n = matrix%columns
      allocate (pattern%order(pattern%n), pattern%place_of(pattern%n))
      call minimum_degree_order(both_triangles(matrix), pattern%order)
      call take_order(matrix, pattern)
      call elimination_tree(pattern%row_start, pattern%row_column, parent, room)
      call find_columns(parent, pattern)
      allocate (pattern%first(pattern%n))
      call find_first(parent, pattern%first)
   end subroutine analyse_pattern

   !> The pattern of both triangles with the whole diagonal; rows ascend within a column if
   !> they do in the matrix.
   pure function both_triangles(matrix) result(full)
      type(sparse_t), intent(in) :: matrix
      type(sparse_t) :: full
      integer :: next(matrix%columns), i, j, entry

      next = 1
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i > j) next([i, j]) = next([i, j]) + 1
         end do
      end do
      full%rows = matrix%columns
      full%columns = matrix%columns
      full%start = starts_of(next)
      next = full%start(:matrix%columns)
      allocate (full%place(full%start(matrix%columns + 1) - 1))
      do j = 1, matrix%columns
         full%place(next(j)) = j
         next(j) = next(j) + 1
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i <= j) cycle
            full%place(next(j)) = i
            full%place(next(i)) = j
            next([i, j]) = next([i, j]) + 1
         end do
      end do
      allocate (full%value(size(full%place)), source=1.0_wp)
   end function both_triangles

   !> The rows of the lower triangle in the order of elimination.
   pure subroutine take_order(matrix, pattern)
      type(sparse_t), intent(in) :: matrix
      type(symmetric_pattern_t), intent(inout) :: pattern
      integer :: next(pattern%n + 1), i, j, k, entry

      pattern%place_of(pattern%order) = [(k, k=1, pattern%n)]
      next = 0
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i < j) cycle
            k = max(pattern%place_of(i), pattern%place_of(j))
            next(k + 1) = next(k + 1) + 1
         end do
      end do
      next(1) = 1
      do k = 1, pattern%n
         next(k + 1) = next(k) + next(k + 1)
      end do
      pattern%row_start = next
      allocate (pattern%row_column(next(pattern%n + 1) - 1), pattern%row_entry(next(pattern%n + 1) - 1))
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i < j) cycle
            k = max(pattern%place_of(i), pattern%place_of(j))
            pattern%row_column(next(k)) = min(pattern%place_of(i), pattern%place_of(j))
            pattern%row_entry(next(k)) = entry
            next(k) = next(k) + 1
         end do
      end do
   end subroutine take_order

   !> The pattern of L by columns: row k reaches from the entries of the matrix up the
   !> tree to k.
   pure subroutine find_columns(parent, pattern)
      integer, intent(in) :: parent(:)
      type(symmetric_pattern_t), intent(inout) :: pattern
      integer :: mark(pattern%n), next(pattern%n), k

      mark = 0
      next = 0
      do k = 1, pattern%n
         call reach_row(parent, pattern, k, mark, next)
      end do
      pattern%start = starts_of(next)
      allocate (pattern%place(pattern%start(pattern%n + 1) - 1))
      next = pattern%start(:pattern%n)
      mark = 0
      do k = 1, pattern%n
         call reach_row(parent, pattern, k, mark, next, pattern%place)
      end do
      call find_rows(pattern)
   end subroutine find_columns

   !> The same by rows.
   pure subroutine find_rows(pattern)
      type(symmetric_pattern_t), intent(inout) :: pattern
      integer :: next(pattern%n), j, entry

      next = 0
      do entry = 1, size(pattern%place)
         next(pattern%place(entry)) = next(pattern%place(entry)) + 1
      end do
      pattern%left_start = starts_of(next)
      next = pattern%left_start(:pattern%n)
      allocate (pattern%left_column(size(pattern%place)), pattern%left_entry(size(pattern%place)))
      do j = 1, pattern%n
         do entry = pattern%start(j), pattern%start(j + 1) - 1
            associate (at => next(pattern%place(entry)))
               pattern%left_column(at) = j
               pattern%left_entry(at) = entry
               at = at + 1
            end associate
         end do
      end do
   end subroutine find_rows

   !> Where lists of these lengths start, one after the other.
   pure function starts_of(length) result(start)
      integer, intent(in) :: length(:)
      integer :: start(size(length) + 1), i

      start(1) = 1
      do i = 1, size(length)
         start(i + 1) = start(i) + length(i)
      end do
   end function starts_of

   !> Count row k in each column that it reaches, and write it there.
   pure subroutine reach_row(parent, pattern, k, mark, next, place)
      integer, intent(in) :: parent(:), k
      type(symmetric_pattern_t), intent(in) :: pattern
      integer, intent(inout) :: mark(:), next(:)
      integer, intent(inout), optional :: place(:)
      integer :: entry, j

      mark(k) = k
      do entry = pattern%row_start(k), pattern%row_start(k + 1) - 1
         j = pattern%row_column(entry)
         do while (mark(j) /= k)
            mark(j) = k
            if (present(place)) place(next(j)) = k
            next(j) = next(j) + 1
            j = parent(j)
         end do
      end do
   end subroutine reach_row
end module flexact_symmetric_pattern
