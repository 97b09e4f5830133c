!> Sorting.
module flexact_sort
   use flexact_kinds, only: wp
   implicit none
   private
   public :: sort_descending

contains

   !> Heap sort.
   pure subroutine sort_descending(values)
      real(wp), intent(inout) :: values(:)
      real(wp) :: moving
      integer :: i, last

      do i = size(values)/2, 1, -1
         call sift(values, i, size(values))
      end do
      do last = size(values), 2, -1
         moving = values(last)
         values(last) = values(1)
         values(1) = moving
         call sift(values, 1, last - 1)
      end do
   end subroutine sort_descending

   !> Move the value at `from` down a heap whose smallest value stands first.
   pure subroutine sift(values, from, last)
      real(wp), intent(inout) :: values(:)
      integer, intent(in) :: from, last
      real(wp) :: moving
      integer :: i, child

      moving = values(from)
      i = from
      do while (2*i <= last)
         child = 2*i
         if (child < last) then
            if (values(child + 1) < values(child)) child = child + 1
         end if
         if (values(child) >= moving) exit
         values(i) = values(child)
         i = child
      end do
      values(i) = moving
   end subroutine sift
end module flexact_sort
