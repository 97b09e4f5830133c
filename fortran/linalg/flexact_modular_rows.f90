! SPDX-License-Identifier: BSD-3-Clause
!> A sparse matrix modulo a prime whose rows change: which row is shortest, and which
!> column rarest, is at hand at any time. Rows are known up to factors.
module flexact_modular_rows
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_modular, only: modular_multiples
   use flexact_kinds, only: wp
   implicit none
   private
   public :: matrix_t, make_matrix, unlink, subtract

   type :: matrix_t
      integer(int64) :: modulus = 0
      !> The entries of row i are `count(i)` from `start(i)` on, where there is room for `room(i)`.
      integer, allocatable :: start(:), count(:), room(:), column(:)
      integer(int64), allocatable :: value(:)
      !> So many places are given away.
      integer :: used = 0
      !> Rows that have, or once had, an entry in a column, linked: the first and the last
      !> place of a column, and the row and the place after each.
      integer, allocatable :: head(:), tail(:), met(:), next(:)
      integer :: meetings = 0
      !> Entries of each column; negative where it is eliminated.
      integer, allocatable :: in_column(:)
      logical, allocatable :: is_left(:)
      !> Rows of equal count are linked; the first of each count, and the neighbours.
      integer, allocatable :: first(:), after(:), before(:)
      integer :: rows_left = 0, columns_left = 0, lowest = 1
      real(wp) :: entries = 0.0_wp, work = 0.0_wp
      !> Where an entry stands in the row that is worked on; 0 where there is none.
      integer, allocatable :: place(:)
      !> Multiples of the entries of a row.
      integer(int64), allocatable :: multiple(:)
   end type matrix_t

contains

   !> What is left of a matrix, its columns numbered anew.
   pure subroutine make_matrix(start, column, entry, modulus, is_row_left, is_column_left, matrix)
      integer, intent(in) :: start(:), column(:)
      integer(int64), intent(in) :: entry(:), modulus
      logical, intent(in) :: is_row_left(:), is_column_left(:)
      type(matrix_t), intent(out) :: matrix
      integer :: number(size(is_column_left)), i, j, k, at

      matrix%modulus = modulus
      matrix%rows_left = count(is_row_left)
      matrix%columns_left = count(is_column_left)
      number = unpack([(j, j=1, matrix%columns_left)], is_column_left, 0)
      associate (rows => matrix%rows_left, columns => matrix%columns_left)
         allocate (matrix%start(rows), matrix%count(rows), matrix%room(rows), matrix%after(rows), matrix%before(rows), &
                   matrix%column(2*size(column)), matrix%value(2*size(column)), matrix%met(2*size(column)), &
                   matrix%next(2*size(column)), matrix%tail(columns), matrix%multiple(columns))
         allocate (matrix%in_column(columns), matrix%place(columns), matrix%head(columns), matrix%first(columns + 1), source=0)
         allocate (matrix%is_left(rows), source=.true.)
      end associate
      k = 0
      do i = 1, size(is_row_left)
         if (.not. is_row_left(i)) cycle
         k = k + 1
         matrix%start(k) = matrix%used + 1
         do at = start(i), start(i + 1) - 1
            j = number(column(at))
            if (j == 0) cycle
            matrix%used = matrix%used + 1
            matrix%column(matrix%used) = j
            matrix%value(matrix%used) = entry(at)
            call add_to_column(matrix, j, k)
         end do
         matrix%count(k) = matrix%used + 1 - matrix%start(k)
         matrix%room(k) = matrix%count(k)
         call link(matrix, k)
      end do
   end subroutine make_matrix

   pure subroutine add_to_column(matrix, j, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: j, i

      matrix%in_column(j) = matrix%in_column(j) + 1
      matrix%entries = matrix%entries + 1
      if (matrix%meetings == size(matrix%met)) then
         call lengthen(matrix%met, 2*matrix%meetings)
         call lengthen(matrix%next, 2*matrix%meetings)
      end if
      matrix%meetings = matrix%meetings + 1
      matrix%met(matrix%meetings) = i
      matrix%next(matrix%meetings) = 0
      if (matrix%head(j) == 0) then
         matrix%head(j) = matrix%meetings
      else
         matrix%next(matrix%tail(j)) = matrix%meetings
      end if
      matrix%tail(j) = matrix%meetings
   end subroutine add_to_column

   pure subroutine lengthen(list, most)
      integer, allocatable, intent(inout) :: list(:)
      integer, intent(in) :: most
      integer, allocatable :: longer(:)

      allocate (longer(most))
      longer(:size(list)) = list
      call move_alloc(longer, list)
   end subroutine lengthen

   !> Put a row with the others of its count; one without entries is left out.
   pure subroutine link(matrix, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i

      associate (count => matrix%count(i))
         if (count == 0) then
            matrix%is_left(i) = .false.
            matrix%rows_left = matrix%rows_left - 1
            return
         end if
         matrix%before(i) = 0
         matrix%after(i) = matrix%first(count)
         if (matrix%after(i) > 0) matrix%before(matrix%after(i)) = i
         matrix%first(count) = i
         matrix%lowest = min(matrix%lowest, count)
      end associate
   end subroutine link

   pure subroutine unlink(matrix, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i

      associate (before => matrix%before(i), after => matrix%after(i))
         if (before > 0) then
            matrix%after(before) = after
         else
            matrix%first(matrix%count(i)) = after
         end if
         if (after > 0) matrix%before(after) = before
      end associate
   end subroutine unlink

   !> Make the entry of row i in a column zero, if it has one there, by the pivot row, whose
   !> entry there stands at `pivot_place`: of each row a multiple is taken, so that nothing
   !> is divided.
   pure subroutine subtract(matrix, i, pivot, pivot_place)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i, pivot, pivot_place
      integer :: at, k, first, new

      first = matrix%start(i)
      at = findloc(matrix%column(first:first + matrix%count(i) - 1), matrix%column(pivot_place), 1)
      if (at == 0) return
      call unlink(matrix, i)
      new = matrix%count(pivot)
      do k = 1, new
         matrix%multiple(k) = matrix%value(matrix%start(pivot) + k - 1)
      end do
      call modular_multiples(new, matrix%multiple, matrix%value(first + at - 1), matrix%modulus)
      call modular_multiples(matrix%count(i), matrix%value(first:), matrix%value(pivot_place), matrix%modulus)
      call make_room(matrix, i, matrix%count(i) + new)
      first = matrix%start(i)
      do k = first, first + matrix%count(i) - 1
         matrix%place(matrix%column(k)) = k
      end do
      do k = 1, new
         call take_entry(matrix, i, matrix%column(matrix%start(pivot) + k - 1), matrix%multiple(k))
      end do
      matrix%work = matrix%work + new + matrix%count(i)
      call drop_zeros(matrix, i)
      call link(matrix, i)
   end subroutine subtract

   !> Move a row to where there is room for so many entries.
   pure subroutine make_room(matrix, i, most)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i, most
      integer(int64), allocatable :: value(:)
      integer :: last

      if (matrix%room(i) >= most) return
      if (matrix%used + 2*most > size(matrix%value)) then
         allocate (value(2*(matrix%used + most)))
         value(:matrix%used) = matrix%value(:matrix%used)
         call move_alloc(value, matrix%value)
         call lengthen(matrix%column, size(matrix%value))
      end if
      last = matrix%start(i) + matrix%count(i) - 1
      matrix%column(matrix%used + 1:matrix%used + matrix%count(i)) = matrix%column(matrix%start(i):last)
      matrix%value(matrix%used + 1:matrix%used + matrix%count(i)) = matrix%value(matrix%start(i):last)
      matrix%start(i) = matrix%used + 1
      matrix%room(i) = 2*most
      matrix%used = matrix%used + 2*most
   end subroutine make_room

   !> Take a value from the entry of row i in column j.
   pure subroutine take_entry(matrix, i, j, value)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i, j
      integer(int64), intent(in) :: value

      associate (at => matrix%place(j))
         if (at == 0) then
            at = matrix%start(i) + matrix%count(i)
            matrix%count(i) = matrix%count(i) + 1
            matrix%column(at) = j
            matrix%value(at) = matrix%modulus - value
            call add_to_column(matrix, j, i)
         else
            matrix%value(at) = matrix%value(at) - value
            ! The modulus is added where that is negative: its sign is as good as random.
            matrix%value(at) = matrix%value(at) + iand(shifta(matrix%value(at), 63), matrix%modulus)
         end if
      end associate
   end subroutine take_entry

   !> Of a row whose entries have places, which are given up.
   pure subroutine drop_zeros(matrix, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i
      integer :: k, kept

      kept = matrix%start(i) - 1
      do k = matrix%start(i), kept + matrix%count(i)
         associate (j => matrix%column(k))
            matrix%place(j) = 0
            if (matrix%value(k) == 0) then
               matrix%in_column(j) = matrix%in_column(j) - 1
               matrix%entries = matrix%entries - 1
            else
               kept = kept + 1
               matrix%column(kept) = matrix%column(k)
               matrix%value(kept) = matrix%value(k)
            end if
         end associate
      end do
      matrix%count(i) = kept + 1 - matrix%start(i)
   end subroutine drop_zeros
end module flexact_modular_rows
