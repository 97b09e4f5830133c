! SPDX-License-Identifier: BSD-3-Clause
!> The elimination tree of a symmetric matrix: which column each one changes first.
module flexact_elimination_tree
   implicit none
   private
   public :: elimination_tree, postorder, find_first

contains

   !> The first row below the diagonal of each column of L, 0 where there is none
   !> (Liu, SIAM J. Matrix Anal. Appl. 11, 1990, pp. 134-172).
   !> Row k of the lower triangle of the matrix has entries row_start(k) to row_start(k + 1) - 1.
   !> ancestor (n) is room for the work.
   pure subroutine elimination_tree(row_start, row_column, parent, ancestor)
      integer, intent(in) :: row_start(:), row_column(:)
      integer, intent(out) :: parent(:), ancestor(:)
      integer :: k, entry, i, next

      parent = 0
      ancestor = 0
      do k = 1, size(parent)
         do entry = row_start(k), row_start(k + 1) - 1
            i = row_column(entry)
            do while (i < k)
               next = ancestor(i)
               ancestor(i) = k
               if (next == 0) parent(i) = k
               if (next == 0) exit
               i = next
            end do
         end do
      end do
   end subroutine elimination_tree

   !> An order in which all descendants stand right before each node of a tree. child (0:n) and
   !> sibling (n) are room for the work.
   pure subroutine postorder(parent, order, child, sibling)
      integer, intent(in) :: parent(:)
      integer, intent(out) :: order(:), child(0:), sibling(:)
      integer :: node, found, next

      child = 0
      do node = size(parent), 1, -1
         sibling(node) = child(parent(node))
         child(parent(node)) = node
      end do
      found = 0
      node = child(0)
      do while (node /= 0)
         if (child(node) /= 0) then
            next = child(node)
            child(node) = 0
         else
            found = found + 1
            order(found) = node
            next = sibling(node)
            if (next == 0) next = parent(node)
         end if
         node = next
      end do
   end subroutine postorder

   !> The first descendant of each node of a tree in postorder.
   pure subroutine find_first(parent, first)
      integer, intent(in) :: parent(:)
      integer, intent(out) :: first(:)
      integer :: k

      do k = 1, size(parent)
         first(k) = k
      end do
      do k = 1, size(parent)
         if (parent(k) /= 0) first(parent(k)) = min(first(parent(k)), first(k))
      end do
   end subroutine find_first
end module flexact_elimination_tree
