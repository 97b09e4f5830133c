! SPDX-License-Identifier: BSD-3-Clause
!> Connected components of a matrix: rows and columns that no entry joins have
!> nothing to do with each other and are decomposed one by one.
module flexact_components
   use flexact_kinds, only: wp
   use flexact_sparse, only: operator_t
   implicit none
   private
   public :: components_t, find_components, shape_of, largest_component, component_of_columns, breadth_first_order

   type :: components_t
      integer :: count = 0
      !> Rows of component i are row(row_start(i):row_start(i + 1) - 1), ascending;
      !> columns likewise. A component may have no rows or no columns.
      integer, allocatable :: row_start(:), row(:)
      integer, allocatable :: column_start(:), column(:)
   end type components_t

contains

   !> Rows and columns of component i.
   pure function shape_of(components, i)
      type(components_t), intent(in) :: components
      integer, intent(in) :: i
      integer :: shape_of(2)
      associate (row_start => components%row_start, column_start => components%column_start)
         shape_of = [row_start(i + 1) - row_start(i), column_start(i + 1) - column_start(i)]
      end associate
   end function shape_of

   !> The component of each column.
   pure function component_of_columns(components) result(component_of)
      type(components_t), intent(in) :: components
      integer :: component_of(size(components%column)), i

      do i = 1, components%count
         component_of(components%column(components%column_start(i):components%column_start(i + 1) - 1)) = i
      end do
   end function component_of_columns

   !> Rows and columns of the component that is largest in its shorter side.
   pure function largest_component(components) result(largest)
      type(components_t), intent(in) :: components
      integer :: largest(2), i

      largest = 0
      do i = 1, components%count
         if (minval(shape_of(components, i)) > minval(largest) .or. i == 1) largest = shape_of(components, i)
      end do
   end function largest_component

   !> Components in the order of their first columns, those without columns last.
   pure subroutine find_components(a, components)
      type(operator_t), intent(in) :: a
      type(components_t), intent(out) :: components
      integer, allocatable :: of_row(:), of_column(:), order(:)
      integer :: i, j

      allocate (of_row(a%by_column%rows), of_column(a%by_column%columns), source=0)
      allocate (order(a%by_column%columns))
      do j = 1, a%by_column%columns
         if (of_column(j) /= 0) cycle
         components%count = components%count + 1
         call spread_from(j, components%count, a, of_row, of_column, order)
      end do
      do i = 1, a%by_column%rows
         if (of_row(i) /= 0) cycle
         components%count = components%count + 1
         of_row(i) = components%count
      end do
      call gather(of_row, components%count, components%row_start, components%row)
      call gather(of_column, components%count, components%column_start, components%column)
   end subroutine find_components

   !> The columns of a connected matrix in the order in which a search spreads
   !> from one that is far out: columns that share a row come close together. most: of
   !> entries of the envelope; the order is not there where it would have more for certain.
   pure subroutine breadth_first_order(a, order, most, is_there)
      type(operator_t), intent(in) :: a
      integer, intent(out) :: order(:)
      real(wp), intent(in) :: most
      logical, intent(out) :: is_there
      integer :: of_row(a%by_column%rows), of_column(a%by_column%columns), first, round

      is_there = .true.
      if (size(order) == 0) return
      first = 1
      do round = 1, 2
         of_row = 0
         of_column = 0
         call spread_from(first, 1, a, of_row, of_column, order, merge(huge(most), most, round == 1), is_there)
         if (is_there) first = order(size(order))
      end do
   end subroutine breadth_first_order

   !> Give all that is joined with a column the number of a component. Its columns
   !> come first in the order, breadth first, unless the envelope has more entries than `most`:
   !> each column shares a row with the one that it is reached from.
   pure subroutine spread_from(first, number, a, of_row, of_column, order, most, is_there)
      integer, intent(in) :: first, number
      type(operator_t), intent(in) :: a
      integer, intent(inout) :: of_row(:), of_column(:), order(:)
      real(wp), intent(in), optional :: most
      logical, intent(out), optional :: is_there
      real(wp) :: entries
      integer :: head, tail, i, j, entry, other

      entries = 1.0_wp
      order(1) = first
      of_column(first) = number
      head = 0
      tail = 1
      do while (head < tail)
         head = head + 1
         if (present(most)) then
            is_there = entries <= most
            if (.not. is_there) return
         end if
         do entry = a%by_column%start(order(head)), a%by_column%start(order(head) + 1) - 1
            i = a%by_column%place(entry)
            if (of_row(i) /= 0) cycle
            of_row(i) = number
            do other = a%by_row%start(i), a%by_row%start(i + 1) - 1
               j = a%by_row%place(other)
               if (of_column(j) /= 0) cycle
               of_column(j) = number
               tail = tail + 1
               order(tail) = j
               entries = entries + (tail - head + 1)
            end do
         end do
      end do
   end subroutine spread_from

   !> Lists of what has each number, ascending.
   pure subroutine gather(number, numbers, start, list)
      integer, intent(in) :: number(:), numbers
      integer, allocatable, intent(out) :: start(:), list(:)
      integer :: next(numbers), i

      allocate (start(numbers + 1), source=0)
      allocate (list(size(number)))
      do i = 1, size(number)
         start(number(i) + 1) = start(number(i) + 1) + 1
      end do
      start(1) = 1
      do i = 1, numbers
         start(i + 1) = start(i + 1) + start(i)
      end do
      next = start(:numbers)
      do i = 1, size(number)
         list(next(number(i))) = i
         next(number(i)) = next(number(i)) + 1
      end do
   end subroutine gather
end module flexact_components
