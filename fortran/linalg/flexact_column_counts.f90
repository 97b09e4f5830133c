! SPDX-License-Identifier: BSD-3-Clause
!> How many entries each column of the Cholesky factor of a symmetric matrix has, without the
!> factor (Gilbert, Ng and Peyton, SIAM J. Matrix Anal. Appl. 15, 1994, pp. 1075-1091): row i
!> of L is the part of the elimination tree that the entries of row i of the matrix span; a
!> leaf of it adds one entry to each column on its way up, and where two ways meet one is
!> counted twice.
module flexact_column_counts
   use flexact_elimination_tree, only: find_first
   implicit none
   private
   public :: column_counts

   !> For each row: the last leaf of its subtree, the largest first descendant of a leaf so far,
   !> and where a column belongs to among those that are done.
   type :: rows_t
      integer, allocatable :: last_leaf(:), largest_first(:), ancestor(:)
   end type rows_t

contains

   !> Entries of each column of L, the diagonal with them. parent: the elimination tree in
   !> postorder. Column j of the matrix has rows row(start(j)) to row(start(j + 1) - 1), j with them.
   !> info: not 0 where memory does not suffice.
   pure subroutine column_counts(parent, start, row, count, info)
      integer, intent(in) :: parent(:), start(:), row(:)
      integer, intent(out) :: count(:), info
      type(rows_t) :: rows
      integer, allocatable :: first(:)
      integer :: j, entry, meeting
      logical :: is_leaf

      allocate (first(size(parent)), rows%ancestor(size(parent)), stat=info)
      if (info == 0) allocate (rows%last_leaf(size(parent)), rows%largest_first(size(parent)), source=0, stat=info)
      if (info /= 0) return
      call find_first(parent, first)
      do j = 1, size(parent)
         rows%ancestor(j) = j
         count(j) = merge(1, 0, first(j) == j)
      end do
      do j = 1, size(parent)
         if (parent(j) /= 0) count(parent(j)) = count(parent(j)) - 1
         do entry = start(j), start(j + 1) - 1
            call meet(rows, row(entry), j, first(j), is_leaf, meeting)
            if (is_leaf) count(j) = count(j) + 1
            if (meeting /= 0) count(meeting) = count(meeting) - 1
         end do
         if (parent(j) /= 0) rows%ancestor(j) = parent(j)
      end do
      do j = 1, size(parent)
         if (parent(j) /= 0) count(parent(j)) = count(parent(j)) + count(j)
      end do
   end subroutine column_counts

   !> Whether column j is a leaf of the subtree of row i, and the column at which its way up
   !> meets that of the leaf before it, 0 where there is none.
   pure subroutine meet(rows, i, j, first, is_leaf, meeting)
      type(rows_t), intent(inout) :: rows
      integer, intent(in) :: i, j, first
      logical, intent(out) :: is_leaf
      integer, intent(out) :: meeting
      integer :: last, at, next

      meeting = 0
      is_leaf = i > j .and. first > rows%largest_first(i)
      if (.not. is_leaf) return
      rows%largest_first(i) = first
      last = rows%last_leaf(i)
      rows%last_leaf(i) = j
      if (last == 0) return
      meeting = last
      do while (rows%ancestor(meeting) /= meeting)
         meeting = rows%ancestor(meeting)
      end do
      at = last
      do while (at /= meeting)
         next = rows%ancestor(at)
         rows%ancestor(at) = meeting
         at = next
      end do
   end subroutine meet
end module flexact_column_counts
