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
   use flexact_equilibration, only: find_scale
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_lanes, only: lanes, symmetric_times, solve_lanes
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: symmetric_factor_t, factorise, solve, solve_refined, null_vectors
   public :: reduce, reduced_times, to_reduced, from_reduced

   type :: symmetric_factor_t
      integer :: n = 0
      !> Eigenvalues of the matrix that are negative, and those that are zero.
      integer :: negative = 0, zero = 0
      !> What columns are multiplied with before, in the order of elimination as all below.
      real(wp), allocatable :: unit(:)
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
      allocate (factor%unit(pattern%n), factor%pivot(pattern%n), factor%value(size(pattern%place)), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call find_scale(matrix, row, least)
      factor%unit = 1/row(pattern%order)
      allocate (factor%pinned(0))
      next = pattern%start(:pattern%n)
      row = 0.0_wp
      do k = 1, pattern%n
         call gather_row(pattern, matrix, factor%unit, k, row)
         call eliminate_row(pattern, k, next, row, factor)
         if (.not. abs(factor%pivot(k)) > suspicious) call pin_if_zero(pattern, k, next, factor)
      end do
      factor%negative = count(factor%pivot < 0)
      call take_pins_off(pattern, factor, error)
   end subroutine factorise

   !> Row k of the scaled lower triangle.
   pure subroutine gather_row(pattern, matrix, unit, k, row)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(in) :: unit(:)
      integer, intent(in) :: k
      real(wp), intent(inout) :: row(:)
      integer :: entry, j

      do entry = pattern%row_start(k), pattern%row_start(k + 1) - 1
         j = pattern%row_column(entry)
         row(j) = row(j) + matrix%value(pattern%row_entry(entry))*unit(j)*unit(k)
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
      real(wp) :: entry
      integer :: j, at, p

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
      factor%pivot(k) = row(k)
      row(k) = 0.0_wp
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
      real(wp) :: block(lanes, pattern%n)
      integer :: pins, i, k, first, last

      pins = size(factor%pinned)
      allocate (factor%response(pattern%n, pins), factor%slack(pins))
      if (pins == 0) return
      do first = 1, pins, lanes
         last = min(first + lanes - 1, pins)
         block = 0.0_wp
         do i = first, last
            block(i - first + 1, factor%pinned(i)) = 1.0_wp
         end do
         call solve_lanes(pattern, factor%value, factor%pivot, block)
         factor%response(:, first:last) = transpose(block(:last - first + 1, :))
      end do
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

   !> Solve A x = b for x (n, k) in place of b. Where A is singular, b must be orthogonal to
   !> its null vectors, and x is one of the solutions.
   pure subroutine solve(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(:, :)
      real(wp) :: block(lanes, pattern%n), part(lanes, size(factor%slack))
      integer :: first, last, i, k

      if (size(x, 2) == 1 .and. size(factor%slack) == factor%zero) then
         call solve_one(pattern, factor, x(:, 1))
         return
      end if
      block = 0.0_wp
      do first = 1, size(x, 2), lanes
         last = min(first + lanes - 1, size(x, 2))
         do k = 1, pattern%n
            do i = first, last
               block(i - first + 1, k) = x(pattern%order(k), i)*factor%unit(k)
            end do
         end do
         if (size(factor%slack) > factor%zero) part = matmul(block, factor%response)
         call solve_lanes(pattern, factor%value, factor%pivot, block)
         if (size(factor%slack) > factor%zero) call add_response(factor, part, block)
         do k = 1, pattern%n
            do i = first, last
               x(pattern%order(k), i) = block(i - first + 1, k)*factor%unit(k)
            end do
         end do
      end do
   end subroutine solve

   !> From the inverse of F to that of A.
   pure subroutine add_response(factor, part, x)
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: part(:, :), x(:, :)
      integer :: i

      do i = 1, size(factor%slack)
         if (abs(factor%slack(i)) > 0) then
            part(:, i) = part(:, i)/factor%slack(i)
         else
            part(:, i) = 0.0_wp
         end if
      end do
      x = x + matmul(part, transpose(factor%response))
   end subroutine add_response

   !> Solve F x = b in place for one right-hand side as given.
   pure subroutine solve_one(pattern, factor, given)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: given(:)
      real(wp) :: x(pattern%n)

      x = given(pattern%order)*factor%unit
      call solve_lower(pattern, factor, x)
      x = x/factor%pivot
      call solve_upper(pattern, factor, x)
      given(pattern%order) = x*factor%unit
   end subroutine solve_one

   !> Solve L x = b in place.
   pure subroutine solve_lower(pattern, factor, x)
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
   end subroutine solve_lower

   !> Solve L' x = b in place.
   pure subroutine solve_upper(pattern, factor, x)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(inout) :: x(:)
      real(wp) :: total
      integer :: j, p

      do j = pattern%n, 1, -1
         total = x(j)
         do p = pattern%start(j), pattern%start(j + 1) - 1
            total = total - factor%value(p)*x(pattern%place(p))
         end do
         x(j) = total
      end do
   end subroutine solve_upper

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

   !> Entries of B, of the pattern of a matrix A = R'R that is definite and has no pins, from which
   !> `reduced_times` makes products with inv(R') B inv(R), whose eigenvalues are those of inv(A) B.
   pure function reduce(pattern, factor, b) result(entries)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      type(sparse_t), intent(in) :: b
      real(wp) :: entries(size(pattern%row_entry))
      integer :: k

      do k = 1, pattern%n
         associate (first => pattern%row_start(k), last => pattern%row_start(k + 1) - 1)
            entries(first:last) = b%value(pattern%row_entry(first:last))*factor%unit(k) &
                                  *factor%unit(pattern%row_column(first:last))
         end associate
      end do
   end function reduce

   pure subroutine reduced_times(pattern, factor, entries, x, y)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(in) :: entries(:), x(:)
      real(wp), intent(out) :: y(:)
      real(wp) :: v(pattern%n), total, here
      integer :: j, k, p

      v = x/sqrt(factor%pivot)
      call solve_upper(pattern, factor, v)
      y = 0.0_wp
      do k = 1, pattern%n
         total = 0.0_wp
         here = v(k)
         do p = pattern%row_start(k), pattern%row_start(k + 1) - 1
            j = pattern%row_column(p)
            if (j == k) then
               total = total + entries(p)*here
            else
               total = total + entries(p)*v(j)
               y(j) = y(j) + entries(p)*here
            end if
         end do
         y(k) = total
      end do
      call solve_lower(pattern, factor, y)
      y = y/sqrt(factor%pivot)
   end subroutine reduced_times

   !> R x.
   pure function to_reduced(pattern, factor, x) result(y)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(in) :: x(:)
      real(wp) :: y(pattern%n)
      integer :: j, p

      y = x(pattern%order)/factor%unit
      do j = 1, pattern%n
         do p = pattern%start(j), pattern%start(j + 1) - 1
            y(j) = y(j) + factor%value(p)*y(pattern%place(p))
         end do
      end do
      y = y*sqrt(factor%pivot)
   end function to_reduced

   !> inv(R) x: the eigenvector of inv(A) B.
   pure function from_reduced(pattern, factor, x) result(y)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      real(wp), intent(in) :: x(:)
      real(wp) :: y(pattern%n), v(pattern%n)

      v = x/sqrt(factor%pivot)
      call solve_upper(pattern, factor, v)
      y(pattern%order) = v*factor%unit
   end function from_reduced

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
         vectors(pattern%order, found) = factor%response(:, k)*factor%unit
         vectors(:, found) = vectors(:, found)/norm2(vectors(:, found))
      end do
      call orthonormalise(vectors, error)
   end subroutine null_vectors
end module flexact_symmetric_factor
