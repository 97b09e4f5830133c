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
      integer :: starts(size(group) + 1), groups, most, i
      real(wp), allocatable :: block(:), column(:)

      groups = 0
      do i = 1, size(group)
         if (i > 1) then
            if (group(i) == group(i - 1)) cycle
         end if
         groups = groups + 1
         starts(groups) = i
      end do
      starts(groups + 1) = size(group) + 1
      most = max(0, maxval([(starts(i + 1) - starts(i), i=1, groups)]))
      allocate (block(most**2), column(most))
      do i = 1, groups
         call pin_group(by_column, starts(i), starts(i + 1) - 1, least, block, column, is_pinned(starts(i):starts(i + 1) - 1))
      end do
   end subroutine pin_groups

   !> The block of A'A of columns first to last, of which there are few, is eliminated,
   !> the largest pivot first: what is not pinned holds the others by as much as can be.
   pure subroutine pin_group(by_column, first, last, least, block, column, is_left)
      type(sparse_t), intent(in) :: by_column
      integer, intent(in) :: first, last
      real(wp), intent(in) :: least
      real(wp), intent(inout) :: block(first:last, first:last), column(first:last)
      logical, intent(out) :: is_left(first:last)
      integer :: i, j, step

      do j = first, last
         do i = j, last
            block(i, j) = product_of(by_column, i, j)
            block(j, i) = block(i, j)
         end do
      end do
      is_left = .true.
      do step = first, last
         j = 0
         do i = first, last
            if (.not. is_left(i)) cycle
            if (j == 0) j = i
            if (block(i, i) > block(j, j)) j = i
         end do
         if (block(j, j) < least) exit
         is_left(j) = .false.
         column = block(:, j)
         do i = first, last
            block(:, i) = block(:, i) - column*(column(i)/column(j))
         end do
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
