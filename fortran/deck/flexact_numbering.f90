! SPDX-License-Identifier: BSD-3-Clause
!> From the free numbers of a deck to indices without gaps, in ascending order.
module flexact_numbering
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: numbering_t, make_numbering

   type :: numbering_t
      !> The numbers that occur, ascending, each once.
      integer, allocatable :: number(:)
      !> The index of each number up to the largest, where that table stays small.
      integer, allocatable, private :: direct(:)
   contains
      procedure :: find
   end type numbering_t

contains

   !> The numbering of the positive numbers among those given.
   pure function make_numbering(numbers) result(numbering)
      integer, intent(in) :: numbers(:)
      type(numbering_t) :: numbering
      integer :: i, count, largest

      largest = 0
      if (size(numbers) > 0) largest = max(0, maxval(numbers))
      if (largest/8 <= size(numbers) + 128) then
         allocate (numbering%direct(largest), source=0)
         do i = 1, size(numbers)
            if (numbers(i) > 0) numbering%direct(numbers(i)) = 1
         end do
         allocate (numbering%number(sum(numbering%direct)))
         count = 0
         do i = 1, largest
            if (numbering%direct(i) == 0) cycle
            count = count + 1
            numbering%number(count) = i
            numbering%direct(i) = count
         end do
      else
         call sort_unique(pack(numbers, numbers > 0), numbering%number)
      end if
   end function make_numbering

   !> The index of a number, 0 where it does not occur.
   pure integer function find(self, number) result(index)
      class(numbering_t), intent(in) :: self
      integer, intent(in) :: number
      integer :: low, high, middle

      index = 0
      if (allocated(self%direct)) then
         if (number >= 1 .and. number <= size(self%direct)) index = self%direct(number)
         return
      end if
      low = 1
      high = size(self%number)
      do while (low <= high)
         middle = low + (high - low)/2
         if (self%number(middle) == number) then
            index = middle
            return
         else if (self%number(middle) < number) then
            low = middle + 1
         else
            high = middle - 1
         end if
      end do
   end function find

   pure subroutine sort_unique(numbers, unique)
      integer, intent(in) :: numbers(:)
      integer, allocatable, intent(out) :: unique(:)
      integer :: order(size(numbers)), i, count

      order = numbers(ascending(real(numbers, wp)))
      count = 0
      do i = 1, size(order)
         if (count > 0) then
            if (order(i) == order(count)) cycle
         end if
         count = count + 1
         order(count) = order(i)
      end do
      allocate (unique(count), source=order(:count))
   end subroutine sort_unique
end module flexact_numbering
