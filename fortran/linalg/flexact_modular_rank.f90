! SPDX-License-Identifier: BSD-3-Clause
!> The rank of a sparse matrix modulo a prime: what needs no arithmetic first, then
!> elimination by the shortest row and its rarest column (Markowitz, Management
!> Science 3, 1957), and the rest, once it has filled in, by FLINT; theory.md (17).
module flexact_modular_rank
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_flint, only: flint_inverse, flint_rank, flint_times
   use flexact_kinds, only: wp
   use flexact_singletons, only: take_singletons
   implicit none
   private
   public :: modular_rank, limits_t, too_much_work

   integer, parameter :: too_much_work = -1
   !> Up to this size, and from this density on, a matrix is dense.
   integer, parameter :: small = 64
   real(wp), parameter :: filled = 0.2_wp
   !> So often it is asked how full the matrix is.
   integer, parameter :: now_and_then = 32
   !> Multiplications that FLINT does in the time of one here.
   real(wp), parameter :: faster = 8.0_wp

   !> Multiplications that may be spent, and entries of a dense matrix that may be held.
   type :: limits_t
      real(wp) :: work = huge(1.0_wp), entries = huge(1.0_wp)
   end type limits_t

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

   !> Entries start(i) to start(i + 1) - 1 of row i stand in these columns. Beyond
   !> the limits the rank is too_much_work.
   pure integer function modular_rank(start, column, entry, columns, modulus, limits) result(rank)
      integer, intent(in) :: start(:), column(:), columns
      integer(int64), intent(in) :: entry(:), modulus
      type(limits_t), intent(in) :: limits
      type(matrix_t) :: matrix
      logical :: is_row_left(size(start) - 1), is_column_left(columns)
      integer :: pivots, rest

      call take_singletons(start, column, columns, rank, is_row_left, is_column_left)
      if (.not. any(is_row_left)) return
      if (max(count(is_row_left), count(is_column_left)) <= small) then
         rank = rank + rank_of_small(start, column, entry, modulus, is_row_left, is_column_left)
         return
      end if
      call make_matrix(start, column, entry, modulus, is_row_left, is_column_left, matrix)
      pivots = 0
      do while (.not. is_dense(matrix, pivots))
         if (matrix%work > limits%work) then
            rank = too_much_work
            return
         end if
         call eliminate_one(matrix)
         pivots = pivots + 1
      end do
      rest = rank_of_dense(matrix, limits)
      rank = merge(rank + pivots + rest, too_much_work, rest /= too_much_work)
   end function modular_rank

   !> The rank of what the singletons have left, as a whole.
   pure integer function rank_of_small(start, column, entry, modulus, is_row_left, is_column_left) result(rank)
      integer, intent(in) :: start(:), column(:)
      integer(int64), intent(in) :: entry(:), modulus
      logical, intent(in) :: is_row_left(:), is_column_left(:)
      integer(int64) :: dense(count(is_column_left), count(is_row_left))
      integer :: number(size(is_column_left)), i, j, k, at

      number = unpack([(j, j=1, size(dense, 1))], is_column_left, 0)
      dense = 0
      k = 0
      do i = 1, size(is_row_left)
         if (.not. is_row_left(i)) cycle
         k = k + 1
         do at = start(i), start(i + 1) - 1
            if (is_column_left(column(at))) dense(number(column(at)), k) = entry(at)
         end do
      end do
      rank = flint_rank(size(dense, 2), size(dense, 1), dense, modulus)
   end function rank_of_small

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

   !> Whether the rest is best dealt with as a whole, or nothing is left.
   pure logical function is_dense(matrix, pivots)
      type(matrix_t), intent(in) :: matrix
      integer, intent(in) :: pivots

      is_dense = matrix%rows_left == 0 .or. max(matrix%rows_left, matrix%columns_left) <= small
      if (mod(pivots, now_and_then) == 0) is_dense = is_dense .or. &
                                                     matrix%entries > filled*matrix%rows_left*real(matrix%columns_left, wp)
   end function is_dense

   !> Take the shortest row and its rarest column, and that column out of the others.
   pure subroutine eliminate_one(matrix)
      type(matrix_t), intent(inout) :: matrix
      integer :: pivot, j, at, k
      integer(int64) :: scale

      do while (matrix%first(matrix%lowest) == 0)
         matrix%lowest = matrix%lowest + 1
      end do
      pivot = matrix%first(matrix%lowest)
      call unlink(matrix, pivot)
      associate (row => matrix%row(pivot))
         at = minloc(matrix%in_column(row%column(:row%count)), 1)
         j = row%column(at)
         scale = flint_inverse(row%value(at), matrix%modulus)
         matrix%is_left(pivot) = .false.
         matrix%rows_left = matrix%rows_left - 1
         matrix%columns_left = matrix%columns_left - 1
         matrix%in_column(row%column(:row%count)) = matrix%in_column(row%column(:row%count)) - 1
         matrix%entries = matrix%entries - row%count
      end associate
      do k = 1, matrix%column(j)%count
         associate (i => matrix%column(j)%row(k))
            if (matrix%is_left(i)) call subtract(matrix, i, pivot, j, scale)
         end associate
      end do
      matrix%in_column(j) = -1
   end subroutine eliminate_one

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
            factor = modulus - flint_times(row%value(matrix%place(j)), scale, modulus)
            call make_room(row, row%count + matrix%row(pivot)%count)
            do k = 1, matrix%row(pivot)%count
               call add_entry(matrix, i, matrix%row(pivot)%column(k), &
                              flint_times(factor, matrix%row(pivot)%value(k), modulus))
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

   !> The rank of what is left.
   pure integer function rank_of_dense(matrix, limits) result(rank)
      type(matrix_t), intent(in) :: matrix
      type(limits_t), intent(in) :: limits
      integer(int64), allocatable :: dense(:, :)
      integer :: number(size(matrix%in_column)), i, j, k, rows, columns, info

      rows = matrix%rows_left
      columns = count(matrix%in_column > 0)
      rank = 0
      if (rows == 0) return
      rank = too_much_work
      if (real(rows, wp)*columns > limits%entries) return
      if (real(rows, wp)*columns*min(rows, columns)/faster > limits%work - matrix%work) return
      allocate (dense(columns, rows), source=0_int64, stat=info)
      if (info /= 0) return
      number = unpack([(j, j=1, columns)], matrix%in_column > 0, 0)
      k = 0
      do i = 1, size(matrix%row)
         if (.not. matrix%is_left(i)) cycle
         k = k + 1
         associate (row => matrix%row(i))
            dense(number(row%column(:row%count)), k) = row%value(:row%count)
         end associate
      end do
      rank = flint_rank(rows, columns, dense, matrix%modulus)
   end function rank_of_dense
end module flexact_modular_rank
