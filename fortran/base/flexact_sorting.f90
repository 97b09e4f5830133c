! SPDX-License-Identifier: BSD-3-Clause
!> Sorting, for all that is sorted here: by keys, as a permutation; and sets that are joined.
module flexact_sorting
   use flexact_kinds, only: wp
   implicit none
   private
   public :: ascending, by_number, root_of, join

contains

   !> The order in which keys ascend, that of equal ones kept (merge sort):
   !> keys(ascending(keys)) is sorted.
   pure function ascending(keys) result(order)
      real(wp), intent(in) :: keys(:)
      integer :: order(size(keys)), former(size(keys)), width, first, i, j, k

      order = [(i, i=1, size(keys))]
      width = 1
      do while (width < size(keys))
         former = order
         do first = 1, size(keys), 2*width
            i = first
            j = first + width
            associate (middle => min(j, size(keys) + 1), last => min(j + width, size(keys) + 1))
               do k = first, last - 1
                  if (takes_left(i, middle, j, last)) then
                     order(k) = former(i)
                     i = i + 1
                  else
                     order(k) = former(j)
                     j = j + 1
                  end if
               end do
            end associate
         end do
         width = 2*width
      end do
   contains
      pure logical function takes_left(i, middle, j, last)
         integer, intent(in) :: i, middle, j, last

         takes_left = j >= last
         if (i < middle .and. j < last) takes_left = keys(former(i)) <= keys(former(j))
      end function takes_left
   end function ascending

   !> The same for whole numbers from 0 to a largest one, and without comparing them
   !> (counting sort).
   pure function by_number(keys, largest) result(order)
      integer, intent(in) :: keys(:), largest
      integer :: order(size(keys)), start(0:largest + 1), i

      start = 0
      do i = 1, size(keys)
         start(keys(i) + 1) = start(keys(i) + 1) + 1
      end do
      do i = 1, largest
         start(i) = start(i) + start(i - 1)
      end do
      do i = 1, size(keys)
         start(keys(i)) = start(keys(i)) + 1
         order(start(keys(i))) = i
      end do
   end function by_number

   !> The member that stands for the set that i belongs to, parent(i) = i of a set of one.
   pure subroutine root_of(parent, i, root)
      integer, intent(inout) :: parent(:)
      integer, intent(in) :: i
      integer, intent(out) :: root

      root = i
      do while (parent(root) /= root)
         parent(root) = parent(parent(root))
         root = parent(root)
      end do
   end subroutine root_of

   !> Join the sets of i and j; the smaller root stands for both.
   pure subroutine join(parent, i, j)
      integer, intent(inout) :: parent(:)
      integer, intent(in) :: i, j
      integer :: a, b

      call root_of(parent, i, a)
      call root_of(parent, j, b)
      parent(max(a, b)) = min(a, b)
   end subroutine join
end module flexact_sorting
