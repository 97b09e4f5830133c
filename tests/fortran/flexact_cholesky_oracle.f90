! SPDX-License-Identifier: BSD-3-Clause
!> What the Cholesky factor of a symmetric matrix must be, found densely and column by column,
!> and what it is, read off its panels.
module flexact_cholesky_oracle
   use flexact_backward_error, only: unit, extra, rounds
   use flexact_cholesky, only: cholesky_t, analyse
   use flexact_error, only: error_t, is_kind, error_not_definite
   use flexact_kinds, only: wp, qp
   use flexact_multifrontal, only: factorise
   use flexact_progress, only: progress_t
   implicit none
   private
   public :: lower_t, lower_of, analyse_for, factorise_by, entries_of, fill_of, permuted, failing, failing_t, &
             largest_residual, nested_grid, bound_of_full

   !> A lower triangle column by column, the diagonal first; indices count from 0.
   type :: lower_t
      integer :: n = 0
      integer, allocatable :: start(:), place(:)
      real(wp), allocatable :: value(:)
   end type lower_t

   !> In the order of elimination: columns whose pivots are not positive though those they
   !> depend on are, and columns that depend on such.
   type :: failing_t
      logical, allocatable :: fails(:), is_lost(:)
   end type failing_t

contains

   !> The entries of the lower triangle that are there, zeros as well; below the diagonal
   !> from the last row of every second column to the first.
   pure function lower_of(dense, is_there) result(matrix)
      real(wp), intent(in) :: dense(:, :)
      logical, intent(in) :: is_there(:, :)
      type(lower_t) :: matrix
      integer :: n, i, j, k, entry

      n = size(dense, 1)
      matrix%n = n
      allocate (matrix%start(n + 1), source=0)
      allocate (matrix%place(n*(n + 1)/2), source=0)
      allocate (matrix%value(n*(n + 1)/2), source=0.0_wp)
      entry = 0
      do j = 1, n
         do k = j, n
            i = merge(n + j + 1 - k, k, k > j .and. modulo(j, 2) == 0)
            if (.not. (is_there(i, j) .or. i == j)) cycle
            entry = entry + 1
            matrix%place(entry) = i - 1
            matrix%value(entry) = dense(i, j)
         end do
         matrix%start(j + 1) = entry
      end do
      matrix%place = matrix%place(:entry)
      matrix%value = matrix%value(:entry)
   end function lower_of

   !> For so many threads, however small it is.
   subroutine analyse_for(threads, a, order, factor, error)
      integer, intent(in) :: threads, order(:)
      type(lower_t), intent(in) :: a
      type(cholesky_t), intent(out) :: factor
      type(error_t), allocatable, intent(out) :: error

      call analyse(a%start, a%place, order, threads, factor, error)
      factor%threads = threads
   end subroutine analyse_for

   !> By so many threads, no more than it was analysed for. That it is not definite is told by
   !> `failed`, and is an error as well; an error that remains is another.
   subroutine factorise_by(threads, factor, value, failed, error)
      integer, intent(in) :: threads
      type(cholesky_t), intent(inout) :: factor
      real(wp), intent(in), contiguous :: value(:)
      integer, intent(out) :: failed
      type(error_t), allocatable, intent(out) :: error

      factor%threads = threads
      call factorise(factor, value, progress_t(), failed, error)
      if (is_kind(error, error_not_definite) .and. failed > 0) deallocate (error)
   end subroutine factorise_by

   !> The factor in full, and the column of the matrix that stands at each place of it (from 1).
   pure subroutine entries_of(factor, l, order)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(out) :: l(:, :)
      integer, intent(out) :: order(:)
      integer :: s, i, j, k, rows

      l = 0.0_wp
      associate (p => factor%pattern)
         order = p%order(:factor%n)
         do s = 1, p%supernodes
            rows = int(p%rows_from(s + 1) - p%rows_from(s))
            do k = 1, p%first(s + 1) - p%first(s)
               j = p%first(s) + k - 1
               do i = k, rows
                  l(p%row(p%rows_from(s) + i - 1), j) = factor%value(p%panel(s) + i - 1 + (k - 1)*rows)
               end do
            end do
         end do
      end associate
   end subroutine entries_of

   !> A symmetric matrix in an order (from 1), from its lower triangle.
   pure function permuted(dense, order) result(made)
      real(wp), intent(in) :: dense(:, :)
      integer, intent(in) :: order(:)
      real(wp) :: made(size(order), size(order))
      integer :: i, j

      do j = 1, size(order)
         do i = 1, size(order)
            made(i, j) = dense(max(order(i), order(j)), min(order(i), order(j)))
         end do
      end do
   end function permuted

   !> Where elimination of a pattern, in its order, brings forth entries of the lower triangle.
   pure function fill_of(is_there) result(fill)
      logical, intent(in) :: is_there(:, :)
      logical :: fill(size(is_there, 1), size(is_there, 1))
      integer :: j, k

      fill = is_there
      do j = 1, size(fill, 1)
         fill(:j - 1, j) = .false.
         fill(j, j) = .true.
      end do
      do j = 1, size(fill, 1)
         do k = j + 1, size(fill, 1)
            if (fill(k, j)) fill(k:, k) = fill(k:, k) .or. fill(k:, j)
         end do
      end do
   end function fill_of

   !> Where dense elimination fails, of a matrix in its order with this much more on its diagonal,
   !> relative to that. The others are eliminated even so.
   pure function failing(dense, fill, more) result(found)
      real(wp), intent(in) :: dense(:, :), more
      logical, intent(in) :: fill(:, :)
      type(failing_t) :: found
      real(wp) :: a(size(dense, 1), size(dense, 1))
      integer :: j, k

      allocate (found%fails(size(dense, 1)), found%is_lost(size(dense, 1)), source=.false.)
      a = dense
      do j = 1, size(dense, 1)
         a(j, j) = a(j, j) + more*abs(a(j, j))
      end do
      do j = 1, size(dense, 1)
         found%fails(j) = .not. found%is_lost(j) .and. .not. (a(j, j) > 0 .and. a(j, j) <= huge(more))
         if (found%fails(j) .or. found%is_lost(j)) then
            found%is_lost(j + 1:) = found%is_lost(j + 1:) .or. fill(j + 1:, j)
            cycle
         end if
         a(j:, j) = a(j:, j)/sqrt(a(j, j))
         do k = j + 1, size(dense, 1)
            if (fill(k, j)) a(k:, k) = a(k:, k) - a(k:, j)*a(k, j)
         end do
      end do
   end function failing

   !> The largest entry of L L' less the matrix, computed with many digits, over the same entry of
   !> |L| |L'| times as many roundings as it can have, and over nothing where it must be zero.
   pure real(wp) function largest_residual(l, dense) result(largest)
      real(wp), intent(in) :: l(:, :), dense(:, :)
      real(qp) :: turned(size(l, 1), size(l, 1)), product, magnitude
      integer :: i, j, terms(size(l, 1))

      largest = 0.0_wp
      turned = transpose(l)
      terms = count(abs(l) > 0, 2)
      do j = 1, size(l, 1)
         do i = j, size(l, 1)
            product = dot_product(turned(:j, i), turned(:j, j))
            magnitude = dot_product(abs(turned(:j, i)), abs(turned(:j, j)))
            product = abs(product - dense(i, j))
            if (product <= 0) cycle
            magnitude = magnitude*(min(terms(i), terms(j)) + 4)*0.5_wp*epsilon(1.0_wp)
            largest = max(largest, real(product/max(magnitude, tiny(1.0_qp)), wp))
         end do
      end do
   end function largest_residual

   !> The bound of flexact_backward_error for a factor without zeros.
   pure real(wp) function bound_of_full(l) result(bound)
      real(wp), intent(in) :: l(:, :)
      real(wp) :: w(size(l, 1)), x(size(l, 1)), z(size(l, 1))
      integer :: i, round

      w = [((i + extra)*unit/(1 - (i + extra)*unit), i=1, size(w))]
      x = w
      bound = huge(bound)
      do round = 1, rounds
         z = w*matmul(abs(l), matmul(transpose(abs(l)), x))
         bound = min(bound, maxval(z/x))
         x = z
      end do
   end function bound_of_full

   !> Nested dissection of a square of n x n places, from 0: halves by a line of places, which
   !> comes last.
   function nested_grid(n) result(order)
      integer, intent(in) :: n
      integer :: order(n*n), done

      done = 0
      call dissect(1, n, 1, n)
   contains
      recursive subroutine dissect(left, right, low, high)
         integer, intent(in) :: left, right, low, high
         integer :: i, j, middle

         if (left > right .or. low > high) return
         if (right - left >= high - low .and. right > left + 1) then
            middle = (left + right)/2
            call dissect(left, middle - 1, low, high)
            call dissect(middle + 1, right, low, high)
            call dissect(middle, middle, low, high)
         else if (high > low + 1) then
            middle = (low + high)/2
            call dissect(left, right, low, middle - 1)
            call dissect(left, right, middle + 1, high)
            call dissect(left, right, middle, middle)
         else
            do j = low, high
               do i = left, right
                  done = done + 1
                  order(done) = i - 1 + n*(j - 1)
               end do
            end do
         end if
      end subroutine dissect
   end function nested_grid
end module flexact_cholesky_oracle
