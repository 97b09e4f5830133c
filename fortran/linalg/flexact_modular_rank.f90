! SPDX-License-Identifier: BSD-3-Clause
!> The rank of a sparse matrix modulo a prime: what needs no arithmetic first, then
!> elimination by the shortest row and its rarest column (Markowitz, Management
!> Science 3, 1957), and the rest, once it has filled in, as a dense matrix; theory.md (17).
module flexact_modular_rank
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_modular, only: dense_modular_rank
   use flexact_kinds, only: wp
   use flexact_modular_rows, only: matrix_t, make_matrix, unlink, subtract
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
   !> Multiplications of a dense matrix in the time of one here.
   real(wp), parameter :: faster = 8.0_wp

   !> Multiplications that may be spent, and entries of a dense matrix that may be held.
   type :: limits_t
      real(wp) :: work = huge(1.0_wp), entries = huge(1.0_wp)
   end type limits_t

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
      rank = dense_modular_rank(size(dense, 2), size(dense, 1), dense, modulus)
   end function rank_of_small

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
      integer :: pivot, j, k, at, entry

      do while (matrix%first(matrix%lowest) == 0)
         matrix%lowest = matrix%lowest + 1
      end do
      pivot = matrix%first(matrix%lowest)
      call unlink(matrix, pivot)
      at = matrix%start(pivot)
      do k = matrix%start(pivot), matrix%start(pivot) + matrix%count(pivot) - 1
         if (matrix%in_column(matrix%column(k)) < matrix%in_column(matrix%column(at))) at = k
      end do
      do k = matrix%start(pivot), matrix%start(pivot) + matrix%count(pivot) - 1
         matrix%in_column(matrix%column(k)) = matrix%in_column(matrix%column(k)) - 1
      end do
      matrix%is_left(pivot) = .false.
      matrix%rows_left = matrix%rows_left - 1
      matrix%columns_left = matrix%columns_left - 1
      matrix%entries = matrix%entries - matrix%count(pivot)
      j = matrix%column(at)
      entry = matrix%head(j)
      do while (entry > 0)
         if (matrix%is_left(matrix%met(entry))) call subtract(matrix, matrix%met(entry), pivot, at)
         entry = matrix%next(entry)
      end do
      matrix%in_column(j) = -1
   end subroutine eliminate_one

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
      do i = 1, size(matrix%start)
         if (.not. matrix%is_left(i)) cycle
         k = k + 1
         associate (first => matrix%start(i), last => matrix%start(i) + matrix%count(i) - 1)
            dense(number(matrix%column(first:last)), k) = matrix%value(first:last)
         end associate
      end do
      rank = dense_modular_rank(rows, columns, dense, matrix%modulus)
   end function rank_of_dense
end module flexact_modular_rank
