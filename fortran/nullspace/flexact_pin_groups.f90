! SPDX-License-Identifier: BSD-3-Clause
!> Columns that depend on others of their group, as those of one node (or element)
!> that it can move (or stress) by itself: the first to be pinned.
module flexact_pin_groups
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: pin_groups

contains

   !> Mark columns that depend on others of their group.
   pure subroutine pin_groups(by_column, group, least, is_pinned)
      type(sparse_t), intent(in) :: by_column
      integer, intent(in) :: group(:)
      real(wp), intent(in) :: least
      logical, intent(out) :: is_pinned(:)
      integer :: first, last

      is_pinned = .false.
      first = 1
      do while (first <= size(group))
         last = first
         do while (last < size(group))
            if (group(last + 1) /= group(first)) exit
            last = last + 1
         end do
         call pin_group(by_column, first, last, least, is_pinned)
         first = last + 1
      end do
   end subroutine pin_groups

   !> The pivots of the block of A'A of columns first to last, of which there are
   !> few, decide.
   pure subroutine pin_group(by_column, first, last, least, is_pinned)
      type(sparse_t), intent(in) :: by_column
      integer, intent(in) :: first, last
      real(wp), intent(in) :: least
      logical, intent(inout) :: is_pinned(:)
      real(wp) :: l(last - first + 1, last - first + 1), pivot
      integer :: i, j

      do i = 1, size(l, 1)
         do j = 1, i - 1
            l(i, j) = (product_of(by_column, first + i - 1, first + j - 1) - dot_product(l(i, :j - 1), l(j, :j - 1)))/l(j, j)
         end do
         pivot = product_of(by_column, first + i - 1, first + i - 1) - sum(l(i, :i - 1)**2)
         if (pivot < least) then
            is_pinned(first + i - 1) = .true.
            pivot = pivot + 1.0_wp
         end if
         l(i, i) = sqrt(pivot)
      end do
   end subroutine pin_group

   !> The product of two columns.
   pure real(wp) function product_of(matrix, j, k) result(total)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: j, k
      integer :: a, b

      total = 0.0_wp
      a = matrix%start(j)
      b = matrix%start(k)
      do while (a < matrix%start(j + 1) .and. b < matrix%start(k + 1))
         if (matrix%place(a) == matrix%place(b)) total = total + matrix%value(a)*matrix%value(b)
         if (matrix%place(a) <= matrix%place(b)) then
            a = a + 1
            if (matrix%place(a - 1) == matrix%place(b)) b = b + 1
         else
            b = b + 1
         end if
      end do
   end function product_of
end module flexact_pin_groups
