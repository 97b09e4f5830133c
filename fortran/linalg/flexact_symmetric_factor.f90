! SPDX-License-Identifier: BSD-3-Clause
!> Sparse factorisation L D L' of a symmetric matrix, which may be indefinite or singular.
!>
!> The matrix is scaled to a unit diagonal. Pivots are taken in the order of the pattern,
!> whatever their signs. One that rounding alone may have left is pinned: 1 is added to it.
!> Whether it is one is asked of the vector v of the elimination so far, v'Av = pivot and
!> v = 1 there: its Rayleigh quotient pivot/v'v is at the level of rounding then. Afterwards
!> the pins E of F = A + E E' are taken off again by S = I - E' inv(F) E: null vectors of S
!> give those of A, and what else it has gives the inverse of A. So zero pivots of a regular
!> matrix do no harm.
module flexact_symmetric_factor
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: symmetric_factor_t, factorise, solve, solve_refined, null_vectors, symmetric_times

   type :: symmetric_factor_t
      integer :: n = 0
      !> Eigenvalues of the matrix that are negative, and those that are zero.
      integer :: negative = 0, zero = 0
      !> The scale of each column, in the order as given; the rest in that of elimination.
      real(wp), allocatable :: scale(:)
      !> L by columns as in the pattern, and D.
      real(wp), allocatable :: value(:), pivot(:)
      !> Columns that were pinned, and inv(F) times them, turned by the eigenvectors of S.
      integer, allocatable :: pinned(:)
      real(wp), allocatable :: response(:, :)
      !> Eigenvalues of S; those of null vectors, which come first, are 0.
      real(wp), allocatable :: slack(:)
   end type symmetric_factor_t

   !> Rayleigh quotients of the scaled matrix up to this are zero.
   real(wp), parameter :: rounding = 2.0e-14_wp
   !> Larger pivots are not suspected.
   real(wp), parameter :: suspicious = 1.0e-4_wp
   !> Right-hand sides that are taken at a time.
   integer, parameter :: lanes = 4

contains

   !> Least (columns): diagonal entries are scaled as if at least as large. Give what a
   !> coordinate's terms sum up to in magnitude where they may cancel: what is left of them
   !> is nothing then up to 2e-14 of it.
   pure subroutine factorise(pattern, matrix, factor, error, least)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(sparse_t), intent(in) :: matrix
      type(symmetric_factor_t), intent(out) :: factor
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: least(:)
      integer :: next(pattern%n), info, k
      real(wp) :: row(pattern%n)

      factor%n = pattern%n
      allocate (factor%scale(pattern%n), factor%pivot(pattern%n), factor%value(size(pattern%place)), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call find_scale(matrix, factor%scale, least)
      allocate (factor%pinned(0))
      next = pattern%start(:pattern%n)
      row = 0.0_wp
      do k = 1, pattern%n
         call gather_row(pattern, matrix, factor%scale, k, row)
         call eliminate_row(pattern, k, next, row, factor)
         if (.not. abs(factor%pivot(k)) > suspicious) call pin_if_zero(pattern, k, next, factor)
      end do
      factor%negative = count(factor%pivot < 0)
      call take_pins_off(pattern, factor, error)
   end subroutine factorise

   !> The root of the diagonal; where entries beside it stay above 1, more.
   pure subroutine find_scale(matrix, scale, least)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(out) :: scale(:)
      real(wp), intent(in), optional :: least(:)
      real(wp) :: largest(size(scale)), unscaled(size(scale))
      integer :: i, j, entry, round

      scale = 0.0_wp
      largest = 0.0_wp
      if (present(least)) scale = least
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i == j) scale(j) = max(scale(j), abs(matrix%value(entry)))
         end do
      end do
      scale = sqrt(scale)
      do round = 1, 2
         unscaled = merge(scale, 1.0_wp, scale > 0)
         largest = 0.0_wp
         do j = 1, matrix%columns
            do entry = matrix%start(j), matrix%start(j + 1) - 1
               i = matrix%place(entry)
               if (i <= j) cycle
               largest(i) = max(largest(i), abs(matrix%value(entry)/unscaled(j)))
               largest(j) = max(largest(j), abs(matrix%value(entry)/unscaled(i)))
            end do
         end do
         scale = max(scale, largest)
      end do
      where (.not. scale > 0) scale = 1.0_wp
   end subroutine find_scale

   !> Row k of the scaled lower triangle.
   pure subroutine gather_row(pattern, matrix, scale, k, row)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in) :: scale(:)
      integer, intent(in) :: k
      real(wp), intent(inout) :: row(:)
      integer :: entry, j

      do entry = pattern%row_start(k), pattern%row_start(k + 1) - 1
         j = pattern%row_column(entry)
         row(j) = row(j) + matrix%value(pattern%row_entry(entry))/(scale(pattern%order(j))*scale(pattern%order(k)))
      end do
   end subroutine gather_row

   !> Row k of L and its pivot; the row is zero again afterwards. Next is the entry of each
   !> column that the next row fills.
   pure subroutine eliminate_row(pattern, k, next, row, factor)
      type(symmetric_pattern_t), intent(in) :: pattern
      integer, intent(in) :: k
      integer, intent(inout) :: next(:)
      real(wp), intent(inout) :: row(:)
      type(symmetric_factor_t), intent(inout) :: factor
      real(wp) :: entry, pivot
      integer :: j, at, p, i

      do at = pattern%left_start(k), pattern%left_start(k + 1) - 1
         j = pattern%left_column(at)
         entry = row(j)
         row(j) = 0.0_wp
         do p = pattern%start(j), next(j) - 1
            row(pattern%place(p)) = row(pattern%place(p)) - factor%value(p)*entry
         end do
         factor%value(next(j)) = entry/factor%pivot(j)
         row(k) = row(k) - factor%value(next(j))*entry
         next(j) = next(j) + 1
      end do
      i = k
      pivot = row(i)
      row(i) = 0.0_wp
      factor%pivot(k) = pivot
   end subroutine eliminate_row

   !> Add 1 to a pivot that is zero but for rounding: see above.
   pure subroutine pin_if_zero(pattern, k, next, factor)
      type(symmetric_pattern_t), intent(in) :: pattern
      integer, intent(in) :: k, next(:)
      type(symmetric_factor_t), intent(inout) :: factor
      real(wp) :: vector(pattern%first(k):k), total, length
      integer :: j, p

      vector(k) = 1.0_wp
      length = 1.0_wp
      do j = k - 1, pattern%first(k), -1
         total = 0.0_wp
         do p = pattern%start(j), next(j) - 1
            total = total - factor%value(p)*vector(pattern%place(p))
         end do
         vector(j) = total
         length = length + total**2
      end do
      if (abs(factor%pivot(k)) > rounding*length) return
      factor%pivot(k) = factor%pivot(k) + 1.0_wp
      factor%pinned = [factor%pinned, k]
   end subroutine pin_if_zero

   !> Find S, its eigenvalues and which of them are of null vectors; count those that are
   !> negative.
   pure subroutine take_pins_off(pattern, factor, error)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(inout) :: factor
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: turn(:, :), unturned(:, :)
      integer :: pins, i, k

      pins = size(factor%pinned)
      allocate (factor%response(pattern%n, pins), factor%slack(pins))
      if (pins == 0) return
      factor%response = 0.0_wp
      do i = 1, pins
         factor%response(factor%pinned(i), i) = 1.0_wp
      end do
      call solve_pinned(pattern, factor, factor%response)
      turn = -factor%response(factor%pinned, :)
      do i = 1, pins
         turn(i, i) = turn(i, i) + 1.0_wp
      end do
      call symmetric_eigenpairs(turn, factor%slack, error)
      if (allocated(error)) return
      unturned = factor%response
      factor%response = matmul(unturned, turn)
      do k = 1, pins
         if (abs(factor%slack(k)) <= rounding*max(1.0_wp, sum(factor%response(:, k)**2))) factor%slack(k) = 0.0_wp
      end do
      factor%zero = count(.not. abs(factor%slack) > 0)
      factor%negative = factor%negative + count(factor%slack < 0)
   end subroutine take_pins_off

   !> Solve F x = b in place, scaled and in the order of elimination.
   pure subroutine solve_pinned(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(:, :)
      real(wp) :: block(lanes, pattern%n)
      integer :: first, last

      do first = 1, size(x, 2), lanes
         last = min(first + lanes - 1, size(x, 2))
         if (last == first) then
            call solve_one(pattern, factor, x(:, first))
         else
            block(last - first + 2:, :) = 0.0_wp
            block(:last - first + 1, :) = transpose(x(:, first:last))
            call solve_lanes(pattern, factor, block)
            x(:, first:last) = transpose(block(:last - first + 1, :))
         end if
      end do
   end subroutine solve_pinned

   pure subroutine solve_lanes(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(lanes, pattern%n)
      real(wp) :: total(lanes)
      integer :: j, p

      do j = 1, pattern%n
         total = x(:, j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            x(:, pattern%place(p)) = x(:, pattern%place(p)) - factor%value(p)*total
         end do
      end do
      do j = pattern%n, 1, -1
         total = x(:, j)/factor%pivot(j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            total = total - factor%value(p)*x(:, pattern%place(p))
         end do
         x(:, j) = total
      end do
   end subroutine solve_lanes

   pure subroutine solve_one(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(:)
      real(wp) :: total
      integer :: j, p

      do j = 1, pattern%n
         total = x(j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            x(pattern%place(p)) = x(pattern%place(p)) - factor%value(p)*total
         end do
      end do
      do j = pattern%n, 1, -1
         total = x(j)/factor%pivot(j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            total = total - factor%value(p)*x(pattern%place(p))
         end do
         x(j) = total
      end do
   end subroutine solve_one

   !> Solve A x = b for x (n, k) in place of b. Where A is singular, b must be orthogonal to
   !> its null vectors, and x is one of the solutions.
   pure subroutine solve(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(:, :)
      real(wp) :: scaled(pattern%n, size(x, 2)), part(size(factor%slack), size(x, 2))
      integer :: i, k

      do k = 1, size(x, 2)
         scaled(:, k) = x(pattern%order, k)/factor%scale(pattern%order)
      end do
      if (size(factor%slack) > factor%zero) then
         part = matmul(transpose(factor%response), scaled)
         do i = 1, size(factor%slack)
            part(i, :) = merge(part(i, :)/merge(factor%slack(i), 1.0_wp, abs(factor%slack(i)) > 0), 0.0_wp, &
                               abs(factor%slack(i)) > 0)
         end do
      end if
      call solve_pinned(pattern, factor, scaled)
      if (size(factor%slack) > factor%zero) scaled = scaled + matmul(factor%response, part)
      do k = 1, size(x, 2)
         x(pattern%order, k) = scaled(:, k)/factor%scale(pattern%order)
      end do
   end subroutine solve

   !> The same with this many rounds of refinement by the residual of the matrix.
   pure subroutine solve_refined(pattern, factor, matrix, x, rounds)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(inout), contiguous :: x(:, :)
      integer, intent(in) :: rounds
      real(wp) :: b(size(x, 1), size(x, 2)), rest(size(x, 1), size(x, 2))
      integer :: round

      b = x
      call solve(pattern, factor, x)
      do round = 1, rounds
         call symmetric_times(matrix, x, rest)
         rest = b - rest
         call solve(pattern, factor, rest)
         x = x + rest
      end do
   end subroutine solve_refined

   !> Orthonormal vectors (n, zero) that the matrix sends to zero.
   pure subroutine null_vectors(pattern, factor, vectors, error)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), allocatable, intent(out) :: vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      integer :: k, found

      allocate (vectors(pattern%n, factor%zero))
      found = 0
      do k = 1, size(factor%slack)
         if (abs(factor%slack(k)) > 0) cycle
         found = found + 1
         vectors(pattern%order, found) = factor%response(:, k)/factor%scale(pattern%order)
         vectors(:, found) = vectors(:, found)/norm2(vectors(:, found))
      end do
      call orthonormalise(vectors, error)
   end subroutine null_vectors

   !> y = A x for a symmetric matrix given by its lower triangle or whole: entries above the
   !> diagonal are not read.
   pure subroutine symmetric_times(matrix, x, y)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      real(wp) :: total
      integer :: i, j, k, entry

      y = 0.0_wp
      do k = 1, size(x, 2)
         do j = 1, matrix%columns
            total = 0.0_wp
            do entry = matrix%start(j), matrix%start(j + 1) - 1
               i = matrix%place(entry)
               if (i < j) cycle
               if (i == j) then
                  total = total + matrix%value(entry)*x(j, k)
               else
                  y(i, k) = y(i, k) + matrix%value(entry)*x(j, k)
                  total = total + matrix%value(entry)*x(i, k)
               end if
            end do
            y(j, k) = y(j, k) + total
         end do
      end do
   end subroutine symmetric_times
end module flexact_symmetric_factor
