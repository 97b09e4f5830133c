! SPDX-License-Identifier: BSD-3-Clause
!> A sparse matrix modulo a prime whose rows change: which row is shortest, and which
!> column rarest, is at hand at any time.
module flexact_modular_rows
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_modular, only: modular_product
   use flexact_kinds, only: wp
   implicit none
   private
   public :: matrix_t, make_matrix, unlink, subtract

   type :: row_t
      integer :: count = 0
      integer, allocatable :: column(:)
      integer(int64), allocatable :: value(:)
   end type row_t

   !> Rows that have, or once had, an entry in a column.
   type :: list_t
      integer :: count = 0
      integer, allocatable :: row(:)
   end type list_t

   type :: matrix_t
      integer(int64) :: modulus = 0
      type(row_t), allocatable :: row(:)
      type(list_t), allocatable :: column(:)
      !> Entries of each column; negative where it is eliminated.
      integer, allocatable :: in_column(:)
      logical, allocatable :: is_left(:)
      !> Rows of equal count are linked; the first of each count, and the neighbours.
      integer, allocatable :: first(:), after(:), before(:)
      integer :: rows_left = 0, columns_left = 0, lowest = 1
      real(wp) :: entries = 0.0_wp, work = 0.0_wp
      !> Where an entry stands in the row that is worked on; 0 where there is none.
      integer, allocatable :: place(:)
   end type matrix_t

contains

   !> What is left of a matrix, its columns numbered anew.
   pure subroutine make_matrix(start, column, entry, modulus, is_row_left, is_column_left, matrix)
      integer, intent(in) :: start(:), column(:)
      integer(int64), intent(in) :: entry(:), modulus
      logical, intent(in) :: is_row_left(:), is_column_left(:)
      type(matrix_t), intent(out) :: matrix
      integer :: number(size(is_column_left)), i, j, k

      matrix%modulus = modulus
      matrix%rows_left = count(is_row_left)
      matrix%columns_left = count(is_column_left)
      number = unpack([(j, j=1, matrix%columns_left)], is_column_left, 0)
      allocate (matrix%row(matrix%rows_left), matrix%column(matrix%columns_left))
      allocate (matrix%in_column(matrix%columns_left), matrix%place(matrix%columns_left), source=0)
      allocate (matrix%is_left(matrix%rows_left), source=.true.)
      allocate (matrix%after(matrix%rows_left), matrix%before(matrix%rows_left), &
                matrix%first(matrix%columns_left + 1), source=0)
      k = 0
      do i = 1, size(is_row_left)
         if (.not. is_row_left(i)) cycle
         k = k + 1
         associate (there => number(column(start(i):start(i + 1) - 1)), row => matrix%row(k))
            row%column = pack(there, there > 0)
            row%value = pack(entry(start(i):start(i + 1) - 1), there > 0)
            row%count = size(row%column)
            do j = 1, row%count
               call add_to_column(matrix, row%column(j), k)
            end do
         end associate
         call link(matrix, k)
      end do
   end subroutine make_matrix

   pure subroutine add_to_column(matrix, j, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: j, i
      integer, allocatable :: longer(:)

      matrix%in_column(j) = matrix%in_column(j) + 1
      matrix%entries = matrix%entries + 1
      associate (list => matrix%column(j))
         if (.not. allocated(list%row)) allocate (list%row(8))
         if (list%count == size(list%row)) then
            allocate (longer(2*list%count))
            longer(:list%count) = list%row
            call move_alloc(longer, list%row)
         end if
         list%count = list%count + 1
         list%row(list%count) = i
      end associate
   end subroutine add_to_column

   !> Put a row with the others of its count; one without entries is left out.
   pure subroutine link(matrix, i)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i

      associate (count => matrix%row(i)%count)
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
            matrix%first(matrix%row(i)%count) = after
         end if
         if (after > 0) matrix%before(after) = before
      end associate
   end subroutine unlink

   !> Take the multiple of the pivot row from row i that makes its entry in column j zero.
   pure subroutine subtract(matrix, i, pivot, j, scale)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i, pivot, j
      integer(int64), intent(in) :: scale
      integer(int64) :: factor
      integer :: k

      associate (row => matrix%row(i), modulus => matrix%modulus)
         do k = 1, row%count
            matrix%place(row%column(k)) = k
         end do
         if (matrix%place(j) > 0) then
            call unlink(matrix, i)
            factor = modulus - modular_product(row%value(matrix%place(j)), scale, modulus)
            call make_room(row, row%count + matrix%row(pivot)%count)
            do k = 1, matrix%row(pivot)%count
               call add_entry(matrix, i, matrix%row(pivot)%column(k), &
                              modular_product(factor, matrix%row(pivot)%value(k), modulus))
            end do
            matrix%work = matrix%work + matrix%row(pivot)%count + row%count
            matrix%place(row%column(:row%count)) = 0
            call drop_zeros(matrix, row)
            call link(matrix, i)
         else
            matrix%place(row%column(:row%count)) = 0
         end if
      end associate
   end subroutine subtract

   pure subroutine make_room(row, most)
      type(row_t), intent(inout) :: row
      integer, intent(in) :: most
      integer, allocatable :: column(:)
      integer(int64), allocatable :: value(:)

      if (size(row%column) >= most) return
      allocate (column(2*most), value(2*most))
      column(:row%count) = row%column(:row%count)
      value(:row%count) = row%value(:row%count)
      call move_alloc(column, row%column)
      call move_alloc(value, row%value)
   end subroutine make_room

   pure subroutine add_entry(matrix, i, j, value)
      type(matrix_t), intent(inout) :: matrix
      integer, intent(in) :: i, j
      integer(int64), intent(in) :: value

      associate (row => matrix%row(i), at => matrix%place(j))
         if (at == 0) then
            row%count = row%count + 1
            at = row%count
            row%column(at) = j
            row%value(at) = value
            call add_to_column(matrix, j, i)
         else
            row%value(at) = row%value(at) - (matrix%modulus - value)
            if (row%value(at) < 0) row%value(at) = row%value(at) + matrix%modulus
         end if
      end associate
   end subroutine add_entry

   pure subroutine drop_zeros(matrix, row)
      type(matrix_t), intent(inout) :: matrix
      type(row_t), intent(inout) :: row
      integer :: k, kept

      kept = 0
      do k = 1, row%count
         if (row%value(k) == 0) then
            matrix%in_column(row%column(k)) = matrix%in_column(row%column(k)) - 1
            matrix%entries = matrix%entries - 1
         else
            kept = kept + 1
            row%column(kept) = row%column(k)
            row%value(kept) = row%value(k)
         end if
      end do
      row%count = kept
   end subroutine drop_zeros
end module flexact_modular_rows
