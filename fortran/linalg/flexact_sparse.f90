! SPDX-License-Identifier: BSD-3-Clause
!> Sparse matrices, compressed column by column, and products with them.
module flexact_sparse
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_ptr
   use flexact_blas, only: blas_threads
   use flexact_kinds, only: wp
   use flexact_threads, only: on_pieces
   implicit none
   private
   public :: sparse_t, operator_t, operator_of, compress, transposed, times, times_transposed, submatrix, norm_bound

   type :: sparse_t
      integer :: rows = 0
      integer :: columns = 0
      !> Entries start(j) to start(j + 1) - 1 are those of column j.
      integer, allocatable :: start(:)
      !> Row of each entry, ascending within a column, and its value.
      integer, allocatable :: place(:)
      real(wp), allocatable :: value(:)
   end type sparse_t

   !> A matrix by columns and by rows, so that products with it and with its
   !> transpose both gather, and rows of a column and columns of a row are at hand.
   type :: operator_t
      type(sparse_t) :: by_column
      type(sparse_t) :: by_row
   end type operator_t

   !> y = A' x, to be made some rows of y at a time.
   type :: product_t
      type(sparse_t), pointer :: matrix => null()
      real(wp), pointer, contiguous :: x(:, :) => null(), y(:, :) => null()
   end type product_t

contains

   pure function operator_of(matrix) result(operator)
      type(sparse_t), intent(in) :: matrix
      type(operator_t) :: operator

      operator%by_column = matrix
      call transposed(matrix, operator%by_row)
   end function operator_of

   !> From a list of entries, no place of which occurs twice; those with a row or
   !> column of 0 are left out. Rows ascend within a column if they ascend in
   !> the list.
   pure subroutine compress(rows, columns, row, column, value, matrix)
      integer, intent(in) :: rows, columns, row(:), column(:)
      real(wp), intent(in) :: value(:)
      type(sparse_t), intent(out) :: matrix
      integer :: entry, j, next(columns)

      matrix%rows = rows
      matrix%columns = columns
      allocate (matrix%start(columns + 1), source=0)
      do entry = 1, size(row)
         if (row(entry) > 0 .and. column(entry) > 0) &
            matrix%start(column(entry) + 1) = matrix%start(column(entry) + 1) + 1
      end do
      matrix%start(1) = 1
      do j = 1, columns
         matrix%start(j + 1) = matrix%start(j + 1) + matrix%start(j)
      end do
      allocate (matrix%place(matrix%start(columns + 1) - 1), matrix%value(matrix%start(columns + 1) - 1))
      next = matrix%start(:columns)
      do entry = 1, size(row)
         j = column(entry)
         if (row(entry) == 0 .or. j == 0) cycle
         matrix%place(next(j)) = row(entry)
         matrix%value(next(j)) = value(entry)
         next(j) = next(j) + 1
      end do
   end subroutine compress

   !> The transpose of a matrix.
   pure subroutine transposed(matrix, transpose)
      type(sparse_t), intent(in) :: matrix
      type(sparse_t), intent(out) :: transpose
      integer, allocatable :: column(:)
      integer :: j

      allocate (column(size(matrix%place)))
      do j = 1, matrix%columns
         column(matrix%start(j):matrix%start(j + 1) - 1) = j
      end do
      call compress(matrix%columns, matrix%rows, column, matrix%place, matrix%value, transpose)
   end subroutine transposed

   !> y = A' x for a matrix A, x (rows, k), y (columns, k).
   subroutine times_transposed(matrix, x, y)
      type(sparse_t), intent(in), target :: matrix
      real(wp), intent(in), target, contiguous :: x(:, :)
      real(wp), intent(out), target, contiguous :: y(:, :)
      type(product_t), target :: product

      product%matrix => matrix
      product%x => x
      product%y => y
      call on_pieces(matrix%columns, blas_threads(), multiply_piece, c_loc(product))
   end subroutine times_transposed

   recursive subroutine multiply_piece(part, first, last, data)
      integer, intent(in) :: part, first, last
      type(c_ptr), intent(in) :: data
      type(product_t), pointer :: product

      call c_f_pointer(data, product)
      call multiply_some(product%matrix, product%x, first, last, product%y)
   end subroutine multiply_piece

   pure recursive subroutine multiply_some(matrix, x, first, last, y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in), contiguous :: x(:, :)
      integer, intent(in) :: first, last
      real(wp), intent(inout), contiguous :: y(:, :)
      real(wp) :: total
      integer :: j, k, entry

      do k = 1, size(x, 2)
         do j = first, last
            total = 0.0_wp
            do entry = matrix%start(j), matrix%start(j + 1) - 1
               total = total + matrix%value(entry)*x(matrix%place(entry), k)
            end do
            y(j, k) = total
         end do
      end do
   end subroutine multiply_some

   !> y = A x for a matrix A, x (columns, k), y (rows, k).
   pure subroutine times(matrix, x, y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      integer :: j, k, entry

      y = 0.0_wp
      do k = 1, size(x, 2)
         do j = 1, matrix%columns
            do entry = matrix%start(j), matrix%start(j + 1) - 1
               y(matrix%place(entry), k) = y(matrix%place(entry), k) + matrix%value(entry)*x(j, k)
            end do
         end do
      end do
   end subroutine times

   !> What stands in some rows and columns; new_row gives the row in the submatrix
   !> of each row, and all entries of the columns must be in it.
   pure subroutine submatrix(matrix, rows, columns, new_row, sub)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: rows, columns(:), new_row(:)
      type(sparse_t), intent(out) :: sub
      integer :: j, entry, used

      sub%rows = rows
      sub%columns = size(columns)
      allocate (sub%start(sub%columns + 1))
      sub%start(1) = 1
      do j = 1, sub%columns
         sub%start(j + 1) = sub%start(j) + matrix%start(columns(j) + 1) - matrix%start(columns(j))
      end do
      allocate (sub%place(sub%start(sub%columns + 1) - 1), sub%value(sub%start(sub%columns + 1) - 1))
      used = 0
      do j = 1, sub%columns
         do entry = matrix%start(columns(j)), matrix%start(columns(j) + 1) - 1
            used = used + 1
            sub%place(used) = new_row(matrix%place(entry))
            sub%value(used) = matrix%value(entry)
         end do
      end do
   end subroutine submatrix

   !> An upper bound of the 2-norm: the root of the largest sum of magnitudes of a
   !> row times that of a column.
   pure real(wp) function norm_bound(matrix) result(bound)
      type(sparse_t), intent(in) :: matrix
      real(wp) :: in_row(matrix%rows), widest
      integer :: j, entry

      in_row = 0.0_wp
      widest = 0.0_wp
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            in_row(matrix%place(entry)) = in_row(matrix%place(entry)) + abs(matrix%value(entry))
         end do
         widest = max(widest, sum(abs(matrix%value(matrix%start(j):matrix%start(j + 1) - 1))))
      end do
      bound = 0.0_wp
      if (widest > 0) bound = sqrt(widest)*sqrt(maxval(in_row))
   end function norm_bound
end module flexact_sparse
