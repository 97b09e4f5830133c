! SPDX-License-Identifier: BSD-3-Clause
!> A few eigenvalues of small symmetric matrices, with their vectors, by their tridiagonal forms:
!> of several matrices side by side in lanes, as (lanes, ...).
!>
!> LAPACK does the same for one matrix. Of many small ones, in several threads, most of its
!> time goes into calls of BLAS, which take a lock each, and into divisions that wait for the last.
!> What is found here is checked by its residuals; where it is not good, is_found says so.
module flexact_tridiagonal
   use flexact_kinds, only: wp, lanes
   implicit none
   private
   public :: tridiagonal_t, tridiagonalise, find_ends, lowest_values, lowest_vectors

   !> From so near, as a part of the largest, Newton's method takes a few rounds to an end.
   real(wp), parameter :: near_enough = 1.0e-3_wp
   integer, parameter :: most_rounds = 12
   !> Steps of inverse iteration, and what is left by good vectors, relative to the matrix.
   integer, parameter :: most_steps = 6
   real(wp), parameter :: good = 1.0e-13_wp
   !> Unit vectors of which so much is left beside the others are told apart.
   real(wp), parameter :: well_apart = 0.1_wp
   !> Entries of less than this part of the matrix are none.
   real(wp), parameter :: negligible = 1.0e-20_wp

   !> Q' A Q = T. Q is the product of reflections I - beta v v', v from below the diagonal on.
   type :: tridiagonal_t
      integer :: n = 0
      !> Diagonal of T (lanes, n), and beside it (lanes, n), the last zero.
      real(wp), allocatable :: d(:, :), e(:, :)
      real(wp), allocatable :: v(:, :, :), beta(:, :)
      !> No eigenvalue is above, (lanes).
      real(wp) :: bound(lanes) = 0.0_wp
   end type tridiagonal_t

contains

   !> Of symmetric matrices (lanes, n, n), their lower triangles, which are taken over.
   pure subroutine tridiagonalise(a, t)
      real(wp), allocatable, intent(inout) :: a(:, :, :)
      type(tridiagonal_t), intent(out) :: t
      real(wp), dimension(lanes) :: nothing
      integer :: k

      t%n = size(a, 2)
      call move_alloc(a, t%v)
      allocate (t%d(lanes, t%n), t%e(lanes, t%n), t%beta(lanes, t%n), source=0.0_wp)
      ! What is far below rounding is left out: its inverses may be too large for numbers.
      nothing = 0.0_wp
      do k = 1, t%n
         nothing = max(nothing, abs(t%v(:, k, k)))
      end do
      nothing = (negligible*nothing)**2
      call reduce(t%n, nothing, t%v, t%d, t%e, t%beta)
      call find_bound(t)
   end subroutine tridiagonalise

   pure subroutine reduce(n, nothing, v, d, e, beta)
      integer, intent(in) :: n
      real(wp), intent(in) :: nothing(lanes)
      real(wp), intent(inout) :: v(lanes, n, n)
      real(wp), intent(inout) :: d(lanes, n), e(lanes, n), beta(lanes, n)
      real(wp), dimension(lanes) :: x, rest, norm
      integer :: i, k

      do k = 1, n - 1
         d(:, k) = v(:, k, k)
         x = v(:, k + 1, k)
         rest = 0.0_wp
         do i = k + 2, n
            rest = rest + v(:, i, k)**2
         end do
         norm = -sign(sqrt(x**2 + rest), x)
         where (rest > nothing)
            e(:, k) = norm
            beta(:, k) = 1/(norm*(norm - x))
            v(:, k + 1, k) = x - norm
         elsewhere
            e(:, k) = x
         end where
         call reflect(n, k, beta(:, k), v)
      end do
      if (n > 0) d(:, n) = v(:, n, n)
   end subroutine reduce

   !> (I - beta v v') A (I - beta v v') of the lower triangle of what is behind column k, v
   !> in that column.
   pure subroutine reflect(n, k, beta, a)
      integer, intent(in) :: n, k
      real(wp), intent(in) :: beta(lanes)
      real(wp), intent(inout) :: a(lanes, n, n)
      real(wp) :: w(lanes, n)
      real(wp), dimension(lanes) :: factor, total
      integer :: i, j

      w(:, k + 1:) = 0.0_wp
      do j = k + 1, n
         factor = a(:, j, k)
         total = a(:, j, j)*factor
         do i = j + 1, n
            w(:, i) = w(:, i) + a(:, i, j)*factor
            total = total + a(:, i, j)*a(:, i, k)
         end do
         w(:, j) = w(:, j) + total
      end do
      factor = 0.0_wp
      do i = k + 1, n
         factor = factor + w(:, i)*a(:, i, k)
      end do
      factor = 0.5_wp*beta**2*factor
      do i = k + 1, n
         w(:, i) = beta*w(:, i) - factor*a(:, i, k)
      end do
      do j = k + 1, n
         factor = a(:, j, k)
         total = w(:, j)
         do i = j, n
            a(:, i, j) = a(:, i, j) - a(:, i, k)*total - w(:, i)*factor
         end do
      end do
   end subroutine reflect

   !> After Gershgorin.
   pure subroutine find_bound(t)
      type(tridiagonal_t), intent(inout) :: t
      real(wp) :: before(lanes)
      integer :: i

      before = 0.0_wp
      do i = 1, t%n
         t%bound = max(t%bound, abs(t%d(:, i)) + abs(t%e(:, i)) + before)
         before = abs(t%e(:, i))
      end do
      t%bound = t%bound*(1 + 8*epsilon(1.0_wp))
   end subroutine find_bound

   !> The smallest and the largest eigenvalue, as exact as A is known to working precision. The
   !> matrices are positive semidefinite. From outside Newton's method for the determinant goes to the
   !> first root and not beyond; where that is a multiple one it takes too long.
   pure subroutine find_ends(t, ends)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(out) :: ends(lanes, 2)
      real(wp) :: lower(lanes, 2), upper(lanes, 2), step(lanes, 2)
      integer :: round

      call begin(t, lower, upper)
      call multisect(t, t%n, [1, t%n], near_enough, lower, upper)
      ends(:, 1) = lower(:, 1)
      ends(:, 2) = upper(:, 2)
      do round = 1, most_rounds
         call find_steps(t%n, 2, t%d, t%e, ends, step)
         ends = ends + step
         if (all(abs(step) <= 2*epsilon(1.0_wp)*spread(t%bound, 2, 2))) exit
      end do
      if (round > most_rounds) then
         call multisect(t, t%n, [1, t%n], 2*epsilon(1.0_wp), lower, upper)
         ends = lower/2 + upper/2
      end if
      ends = max(0.0_wp, ends)
   end subroutine find_ends

   !> Newton's steps -f/f' of f(x) = det(T - x): the logarithm of f is the sum of those of the pivots.
   pure subroutine find_steps(n, places, d, e, x, step)
      integer, intent(in) :: n, places
      real(wp), intent(in) :: d(lanes, n), e(lanes, n), x(lanes, places)
      real(wp), intent(out) :: step(lanes, places)
      real(wp), dimension(lanes) :: inverse, part, slope, total
      integer :: i, k

      do k = 1, places
         inverse = 1/((d(:, 1) - x(:, k)))
         slope = -1.0_wp
         total = -inverse
         do i = 2, n
            part = e(:, i - 1)**2*inverse
            slope = part*inverse*slope - 1
            inverse = 1/((d(:, i) - x(:, k)) - part)
            total = total + slope*inverse
         end do
         step(:, k) = -1/total
      end do
   end subroutine find_steps

   !> The smallest eigenvalues, ascending, to this part of the largest.
   pure subroutine lowest_values(t, absolute, value)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: absolute
      real(wp), intent(out) :: value(:, :)
      real(wp), dimension(lanes, size(value, 2)) :: lower, upper
      integer :: k

      call begin(t, lower, upper)
      call multisect(t, t%n, [(k, k=1, size(value, 2))], absolute, lower, upper)
      value = max(0.0_wp, lower/2 + upper/2)
   end subroutine lowest_values

   !> All eigenvalues are within.
   pure subroutine begin(t, lower, upper)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(out) :: lower(:, :), upper(:, :)

      lower = spread(-epsilon(1.0_wp)*t%bound, 2, size(lower, 2))
      upper = spread(t%bound, 2, size(upper, 2))
   end subroutine begin

   !> Intervals in which the eigenvalues with these numbers are, counted upwards from 1, are narrowed to
   !> this part of the largest, by Sturm sequences at several places at once (Lo, Philippe and Sameh,
   !> SIAM J. Sci. Stat. Comput. 8, 1987).
   pure subroutine multisect(t, n, number, absolute, lower, upper)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n, number(:)
      real(wp), intent(in) :: absolute
      real(wp), dimension(lanes, size(number)), intent(inout) :: lower, upper
      real(wp), dimension(lanes, size(number)) :: x, below
      real(wp) :: squares(lanes, n)
      integer :: k
      logical :: is_narrower

      squares(:, 2:) = max(tiny(1.0_wp), t%e(:, :n - 1)**2)
      squares(:, 1) = 0.0_wp
      is_narrower = .true.
      do while (is_narrower)
         x = 0.5_wp*lower + 0.5_wp*upper
         call count_below(n, size(number), t%d, squares, x, below)
         is_narrower = .false.
         do k = 1, size(number)
            is_narrower = is_narrower .or. any(x(:, k) > lower(:, k) .and. x(:, k) < upper(:, k) .and. &
                                               upper(:, k) - lower(:, k) > 2*absolute*t%bound)
            lower(:, k) = merge(x(:, k), lower(:, k), below(:, k) < number(k))
            upper(:, k) = merge(upper(:, k), x(:, k), below(:, k) < number(k))
         end do
      end do
   end subroutine multisect

   !> How many eigenvalues are below each place: so many pivots are negative. A pivot of zero
   !> makes the next one minus infinity, and that counts in its place.
   pure subroutine count_below(n, places, d, squares, x, below)
      integer, intent(in) :: n, places
      real(wp), intent(in) :: d(lanes, n), squares(lanes, n), x(lanes, places)
      real(wp), intent(out) :: below(lanes, places)
      real(wp), dimension(lanes) :: pivot, counted
      integer :: i, k

      do k = 1, places
         pivot = 1.0_wp
         counted = 0.0_wp
         do i = 1, n
            pivot = (d(:, i) - x(:, k)) - squares(:, i)/pivot
            counted = counted + (0.5_wp - sign(0.5_wp, pivot))
         end do
         below(:, k) = counted
      end do
   end subroutine count_below

   !> Orthonormal bases (lanes, n, k) of the spaces of eigenvectors of A for eigenvalues (lanes, k)
   !> that are roughly known, by inverse iteration on T.
   pure subroutine lowest_vectors(t, value, basis, is_found)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: value(:, :)
      real(wp), intent(out) :: basis(:, :, :)
      logical, intent(out) :: is_found(lanes)
      real(wp) :: z(lanes, t%n, size(value, 2)), start, apart(lanes)
      integer :: step, k, i

      ! Anything without symmetry serves to begin with.
      do k = 1, size(value, 2)
         start = k/(size(value, 2) + 0.7_wp)
         do i = 1, t%n
            start = 9.7_wp*start + 0.3_wp
            start = start - int(start)
            z(:, i, k) = start - 0.4_wp
         end do
      end do
      is_found = .false.
      do step = 1, most_steps
         call iterate(t, t%n, size(value, 2), value, z)
         if (step == 1) cycle
         is_found = largest_residual(t, t%n, size(value, 2), z) <= good*t%bound
         if (all(is_found)) exit
      end do
      call make_orthonormal(t%n, size(value, 2), z, apart)
      is_found = is_found .and. apart >= well_apart
      basis = z
      ! Vectors of equal values are kept apart, and are good if their space is.
      do step = 1, merge(0, most_steps, all(is_found))
         call iterate(t, t%n, size(value, 2), value, z)
         call make_orthonormal(t%n, size(value, 2), z, apart)
         associate (is_new => .not. is_found .and. apart >= well_apart .and. &
                    residual(t, t%n, size(value, 2), z) <= good*t%bound)
            do k = 1, lanes
               if (is_new(k)) basis(k, :, :) = z(k, :, :)
            end do
            is_found = is_found .or. is_new
         end associate
         if (all(is_found)) exit
      end do
      call turn_back(t, t%n, size(value, 2), basis)
   end subroutine lowest_vectors

   !> Solve with T less a shift for each vector, to unit vectors. Without pivoting; the residual
   !> tells.
   pure subroutine iterate(t, n, vectors, shift, z)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n, vectors
      real(wp), intent(in) :: shift(lanes, vectors)
      real(wp), intent(inout) :: z(lanes, n, vectors)
      real(wp) :: inverse(lanes, n)
      real(wp), dimension(lanes) :: pivot, squares, least
      integer :: i, k

      least = epsilon(1.0_wp)*t%bound + tiny(1.0_wp)
      do k = 1, vectors
         do i = 1, n
            pivot = t%d(:, i) - shift(:, k)
            if (i > 1) then
               squares = t%e(:, i - 1)*inverse(:, i - 1)
               pivot = pivot - t%e(:, i - 1)*squares
               z(:, i, k) = z(:, i, k) - squares*z(:, i - 1, k)
            end if
            inverse(:, i) = 1/sign(max(abs(pivot), least), pivot)
         end do
         z(:, n, k) = z(:, n, k)*inverse(:, n)
         squares = z(:, n, k)**2
         do i = n - 1, 1, -1
            z(:, i, k) = (z(:, i, k) - t%e(:, i)*z(:, i + 1, k))*inverse(:, i)
            squares = squares + z(:, i, k)**2
         end do
         squares = 1/sqrt(max(squares, tiny(1.0_wp)))
         do i = 1, n
            z(:, i, k) = squares*z(:, i, k)
         end do
      end do
   end subroutine iterate

   !> Of unit vectors the largest |T z - (z' T z) z| in each lane.
   pure function largest_residual(t, n, vectors, z) result(largest)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n, vectors
      real(wp), intent(in) :: z(lanes, n, vectors)
      real(wp) :: largest(lanes)
      real(wp) :: image(lanes, n), quotient(lanes)
      integer :: i, k

      largest = 0.0_wp
      do k = 1, vectors
         call multiply(t, n, z(:, :, k), image)
         quotient = inner(n, z(:, :, k), image)
         do i = 1, n
            largest = max(largest, abs(image(:, i) - quotient*z(:, i, k)))
         end do
      end do
   end function largest_residual

   pure subroutine multiply(t, n, z, image)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n
      real(wp), intent(in) :: z(lanes, n)
      real(wp), intent(out) :: image(lanes, n)
      integer :: i

      do i = 1, n
         image(:, i) = t%d(:, i)*z(:, i)
         if (i > 1) image(:, i) = image(:, i) + t%e(:, i - 1)*z(:, i - 1)
         if (i < n) image(:, i) = image(:, i) + t%e(:, i)*z(:, i + 1)
      end do
   end subroutine multiply

   pure function inner(n, x, y) result(product)
      integer, intent(in) :: n
      real(wp), intent(in) :: x(lanes, n), y(lanes, n)
      real(wp) :: product(lanes)
      integer :: i

      product = 0.0_wp
      do i = 1, n
         product = product + x(:, i)*y(:, i)
      end do
   end function inner

   !> Unit vectors orthonormal, each to those before it. apart: the least that was left of one.
   pure subroutine make_orthonormal(n, vectors, z, apart)
      integer, intent(in) :: n, vectors
      real(wp), intent(inout) :: z(lanes, n, vectors)
      real(wp), intent(out) :: apart(lanes)
      real(wp) :: part(lanes)
      integer :: i, j, k, round

      apart = 1.0_wp
      do k = 1, vectors
         ! Twice is enough, also for vectors that are nearly parallel.
         do round = 1, 2
            do j = 1, k - 1
               part = inner(n, z(:, :, j), z(:, :, k))
               do i = 1, n
                  z(:, i, k) = z(:, i, k) - part*z(:, i, j)
               end do
            end do
            part = sqrt(inner(n, z(:, :, k), z(:, :, k)))
            apart = min(apart, part)
            part = 1/max(tiny(1.0_wp), part)
            do i = 1, n
               z(:, i, k) = part*z(:, i, k)
            end do
         end do
      end do
   end subroutine make_orthonormal

   !> The largest part of T z outside of the space of the vectors, in each lane.
   pure function residual(t, n, vectors, z) result(largest)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n, vectors
      real(wp), intent(in) :: z(lanes, n, vectors)
      real(wp) :: largest(lanes)
      real(wp) :: image(lanes, n), part(lanes)
      integer :: i, j, k

      largest = 0.0_wp
      do k = 1, vectors
         call multiply(t, n, z(:, :, k), image)
         do j = 1, vectors
            part = inner(n, z(:, :, j), image)
            do i = 1, n
               image(:, i) = image(:, i) - part*z(:, i, j)
            end do
         end do
         do i = 1, n
            largest = max(largest, abs(image(:, i)))
         end do
      end do
   end function residual

   !> Vectors of A from those of T, in place.
   pure subroutine turn_back(t, n, vectors, z)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: n, vectors
      real(wp), intent(inout) :: z(lanes, n, vectors)
      real(wp) :: along(lanes)
      integer :: i, j, k

      do k = n - 1, 1, -1
         do j = 1, vectors
            along = 0.0_wp
            do i = k + 1, n
               along = along + t%v(:, i, k)*z(:, i, j)
            end do
            along = t%beta(:, k)*along
            do i = k + 1, n
               z(:, i, j) = z(:, i, j) - t%v(:, i, k)*along
            end do
         end do
      end do
   end subroutine turn_back
end module flexact_tridiagonal
