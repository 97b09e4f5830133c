! SPDX-License-Identifier: BSD-3-Clause
!> Sorting, for all that is sorted here: by keys, as a permutation.
module flexact_sorting
   use flexact_kinds, only: wp
   implicit none
   private
   public :: ascending

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
end module flexact_sorting
