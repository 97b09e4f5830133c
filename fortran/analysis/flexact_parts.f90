!> The connected parts of D(c): rows and columns that no entry joins have
!> nothing to do with each other and are decomposed one by one.
module flexact_parts
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: parts_t, find_parts, shape_of, largest_part

   type :: parts_t
      integer :: count = 0
      !> Rows of part i are row(row_start(i):row_start(i + 1) - 1), ascending;
      !> columns likewise. A part may have no rows or no columns.
      integer, allocatable :: row_start(:), row(:)
      integer, allocatable :: column_start(:), column(:)
   end type parts_t

contains

   !> Rows and columns of part i.
   pure function shape_of(parts, i)
      type(parts_t), intent(in) :: parts
      integer, intent(in) :: i
      integer :: shape_of(2)
      shape_of = [parts%row_start(i + 1) - parts%row_start(i), parts%column_start(i + 1) - parts%column_start(i)]
   end function shape_of

   !> Rows and columns of the part that is largest in its shorter side.
   pure function largest_part(parts) result(largest)
      type(parts_t), intent(in) :: parts
      integer :: largest(2), i

      largest = 0
      do i = 1, parts%count
         if (minval(shape_of(parts, i)) > minval(largest) .or. i == 1) largest = shape_of(parts, i)
      end do
   end function largest_part

   !> Parts in the order of their first columns, those without columns last.
   pure subroutine find_parts(by_column, by_row, parts)
      type(sparse_t), intent(in) :: by_column, by_row
      type(parts_t), intent(out) :: parts
      integer, allocatable :: of_row(:), of_column(:), queue(:)
      integer :: i, j

      allocate (of_row(by_column%rows), of_column(by_column%columns), source=0)
      allocate (queue(by_column%columns))
      do j = 1, by_column%columns
         if (of_column(j) /= 0) cycle
         parts%count = parts%count + 1
         call spread_from(j, parts%count, by_column, by_row, of_row, of_column, queue)
      end do
      do i = 1, by_column%rows
         if (of_row(i) /= 0) cycle
         parts%count = parts%count + 1
         of_row(i) = parts%count
      end do
      call gather(of_row, parts%count, parts%row_start, parts%row)
      call gather(of_column, parts%count, parts%column_start, parts%column)
   end subroutine find_parts

   !> Give all that is joined with a column the number of a part.
   pure subroutine spread_from(first, number, by_column, by_row, of_row, of_column, queue)
      integer, intent(in) :: first, number
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(inout) :: of_row(:), of_column(:), queue(:)
      integer :: head, tail, i, j, a, b

      queue(1) = first
      of_column(first) = number
      head = 0
      tail = 1
      do while (head < tail)
         head = head + 1
         do a = by_column%start(queue(head)), by_column%start(queue(head) + 1) - 1
            i = by_column%place(a)
            if (of_row(i) /= 0) cycle
            of_row(i) = number
            do b = by_row%start(i), by_row%start(i + 1) - 1
               j = by_row%place(b)
               if (of_column(j) /= 0) cycle
               of_column(j) = number
               tail = tail + 1
               queue(tail) = j
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
end module flexact_parts
