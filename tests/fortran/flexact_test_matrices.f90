! SPDX-License-Identifier: BSD-3-Clause
!> Matrices of known singular values for the unit tests.
module flexact_test_matrices
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t, compress
   implicit none
   private
   public :: identity, sparse_of, dense_of, random_orthogonal, banded, grid, path

contains

   pure function identity(n) result(a)
      integer, intent(in) :: n
      real(wp) :: a(n, n)
      integer :: i

      a = 0.0_wp
      do i = 1, n
         a(i, i) = 1.0_wp
      end do
   end function identity

   !> The entries of a matrix that are not zero.
   pure function sparse_of(dense) result(matrix)
      real(wp), intent(in) :: dense(:, :)
      type(sparse_t) :: matrix
      integer :: row(size(dense)), column(size(dense)), i, j, entry

      entry = 0
      do i = 1, size(dense, 1)
         do j = 1, size(dense, 2)
            entry = entry + 1
            row(entry) = merge(i, 0, abs(dense(i, j)) > 0)
            column(entry) = j
         end do
      end do
      call compress(size(dense, 1), size(dense, 2), row, column, [transpose(dense)], matrix)
   end function sparse_of

   pure function dense_of(matrix) result(dense)
      type(sparse_t), intent(in) :: matrix
      real(wp) :: dense(matrix%rows, matrix%columns)
      integer :: j, entry

      dense = 0.0_wp
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            dense(matrix%place(entry), j) = dense(matrix%place(entry), j) + matrix%value(entry)
         end do
      end do
   end function dense_of

   !> A product of reflections.
   function random_orthogonal(n) result(q)
      integer, intent(in) :: n
      real(wp) :: q(n, n), v(n)
      integer :: k

      q = identity(n)
      do k = 1, n
         call random_number(v)
         v = v - 0.5_wp
         q = q - 2/dot_product(v, v)*matmul(reshape(v, [n, 1]), matmul(reshape(v, [1, n]), q))
      end do
   end function random_orthogonal

   !> A connected matrix (size(values), size(values)) with these singular values.
   !> Left and right singular vectors are the columns of one orthogonal matrix each
   !> that has up to four entries a column: turns of the entries (2, 3), (4, 5), ..
   !> after turns of (1, 2), (3, 4), ..
   subroutine banded(values, matrix, left, right)
      real(wp), intent(in) :: values(:)
      type(sparse_t), intent(out) :: matrix
      real(wp), allocatable, intent(out) :: left(:, :), right(:, :)

      call turns(size(values), 0.7_wp, left)
      call turns(size(values), 1.1_wp, right)
      matrix = sparse_of(product_of(left, values, right))
   end subroutine banded

   subroutine turns(n, angle, q)
      integer, intent(in) :: n
      real(wp), intent(in) :: angle
      real(wp), allocatable, intent(out) :: q(:, :)
      real(wp) :: old(n)
      integer :: first, i

      allocate (q(n, n), source=identity(n))
      do first = 1, 2
         do i = first, n - 1, 2
            old = q(i, :)
            q(i, :) = cos(angle)*old - sin(angle)*q(i + 1, :)
            q(i + 1, :) = sin(angle)*old + cos(angle)*q(i + 1, :)
         end do
      end do
   end subroutine turns

   !> Left diag(values) right' of banded factors.
   function product_of(left, values, right) result(a)
      real(wp), intent(in) :: left(:, :), values(:), right(:, :)
      real(wp), allocatable :: a(:, :)
      integer :: k, from, to

      allocate (a(size(left, 1), size(right, 1)), source=0.0_wp)
      do k = 1, size(values)
         from = max(1, k - 3)
         to = min(size(values), k + 3)
         a(from:to, from:to) = a(from:to, from:to) + values(k)*matmul(left(from:to, [k]), transpose(right(from:to, [k])))
      end do
   end function product_of

   !> Differences along a path of n places between two fixed ends, (n + 1, n): its
   !> singular values are 2 sin(k pi/(2 (n + 1))). As a ring, (n, n), they are
   !> 2 sin(k pi/n), k from 0.
   function path(n, is_ring) result(matrix)
      integer, intent(in) :: n
      logical, intent(in) :: is_ring
      type(sparse_t) :: matrix
      integer :: before(n + 1), after(n + 1), i, rows

      rows = merge(n, n + 1, is_ring)
      before = [(i - 1, i=1, n + 1)]
      after = [(i, i=1, n), 0]
      if (is_ring) before(1) = n
      matrix = differences(n, before(:rows), after(:rows))
   end function path

   !> The same along all lines of a square of n x n places, (columns n**2): squares
   !> of singular values are sums of two of those of the path (or ring).
   function grid(n, is_ring) result(matrix)
      integer, intent(in) :: n
      logical, intent(in) :: is_ring
      type(sparse_t) :: matrix
      integer :: before(2*n*(n + 1)), after(2*n*(n + 1)), i, j, rows

      rows = 0
      do j = 1, n
         do i = merge(1, 0, is_ring), n
            before(rows + 1:rows + 2) = [place(i, j), place(j, i)]
            after(rows + 1:rows + 2) = [place(i + 1, j), place(j, i + 1)]
            rows = rows + 2
         end do
      end do
      matrix = differences(n**2, before(:rows), after(:rows))
   contains
      integer function place(i, j)
         integer, intent(in) :: i, j
         integer :: p(2)

         p = [i, j]
         if (is_ring) p = modulo(p - 1, n) + 1
         place = 0
         if (all(p >= 1 .and. p <= n)) place = p(1) + n*(p(2) - 1)
      end function place
   end function grid

   !> One row for each pair of places: the second less the first; 0 is fixed.
   function differences(n, before, after) result(matrix)
      integer, intent(in) :: n, before(:), after(:)
      type(sparse_t) :: matrix
      integer :: i

      call compress(size(before), n, [([i, i], i=1, size(before))], [([before(i), after(i)], i=1, size(before))], &
                    [([-1.0_wp, 1.0_wp], i=1, size(before))], matrix)
   end function differences
end module flexact_test_matrices
