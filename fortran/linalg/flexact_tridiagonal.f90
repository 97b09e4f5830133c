! SPDX-License-Identifier: BSD-3-Clause
!> A few eigenvalues of a small symmetric matrix, with their vectors, by its tridiagonal form.
!>
!> LAPACK does the same for one matrix. Of many small ones, in several threads, most of its
!> time goes into calls of BLAS, which take a lock each. What is found here is checked by its
!> residuals; where it is not good, is_found says so.
module flexact_tridiagonal
   use flexact_kinds, only: wp
   implicit none
   private
   public :: tridiagonal_t, tridiagonalise, find_ends, lowest_values, lowest_vectors, lanes

   !> So many eigenvalues and vectors at once take hardly longer than one: each division waits
   !> for the last.
   integer, parameter :: lanes = 6
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
      !> Diagonal of T (n), and beside it (n - 1).
      real(wp), allocatable :: d(:), e(:)
      real(wp), allocatable :: v(:, :), beta(:)
   end type tridiagonal_t

contains

   !> Of a symmetric matrix, its lower triangle.
   pure subroutine tridiagonalise(a, t)
      real(wp), intent(in) :: a(:, :)
      type(tridiagonal_t), intent(out) :: t
      real(wp) :: x, rest, norm, nothing
      integer :: k, n

      n = size(a, 1)
      t%n = n
      allocate (t%d(n), t%e(max(0, n - 1)))
      allocate (t%beta(n), source=0.0_wp)
      allocate (t%v, source=a)
      ! What is far below rounding is left out: its inverses may be too large for numbers.
      nothing = (negligible*maxval([(abs(a(k, k)), k=1, n)]))**2
      do k = 1, n - 1
         t%d(k) = t%v(k, k)
         x = t%v(k + 1, k)
         rest = product_of(t%v(k + 2:n, k), t%v(k + 2:n, k))
         if (.not. rest > nothing) then
            t%e(k) = x
            cycle
         end if
         norm = -sign(sqrt(x**2 + rest), x)
         t%e(k) = norm
         t%beta(k) = 1/(norm*(norm - x))
         t%v(k + 1, k) = x - norm
         call reflect(k, t%beta(k), t%v)
      end do
      if (n > 0) t%d(n) = t%v(n, n)
   end subroutine tridiagonalise

   !> (I - beta v v') A (I - beta v v') of the lower triangle of what is behind column k, v
   !> in that column.
   pure subroutine reflect(k, beta, a)
      integer, intent(in) :: k
      real(wp), intent(in) :: beta
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp) :: v(size(a, 1)), w(size(a, 1)), factor, part(4)
      integer :: i, j, n, whole

      n = size(a, 1)
      do i = k + 1, n
         v(i) = a(i, k)
         w(i) = 0.0_wp
      end do
      do j = k + 1, n
         factor = v(j)
         do i = j + 1, n
            w(i) = w(i) + a(i, j)*factor
         end do
         ! As in product_of, of which every call would take as long as the sum.
         part = 0.0_wp
         whole = n - mod(n - j + 1, 4)
         do i = j, whole, 4
            part = part + a(i:i + 3, j)*v(i:i + 3)
         end do
         factor = (part(1) + part(2)) + (part(3) + part(4))
         do i = whole + 1, n
            factor = factor + a(i, j)*v(i)
         end do
         w(j) = w(j) + factor
      end do
      factor = 0.5_wp*beta**2*product_of(w(k + 1:n), v(k + 1:n))
      do i = k + 1, n
         w(i) = beta*w(i) - factor*v(i)
      end do
      do j = k + 1, n
         do i = j, n
            a(i, j) = a(i, j) - v(i)*w(j) - w(i)*v(j)
         end do
      end do
   end subroutine reflect

   !> The inner product, in four sums that do not wait for each other.
   pure real(wp) function product_of(x, y) result(total)
      real(wp), intent(in), contiguous :: x(:), y(:)
      real(wp) :: part(4)
      integer :: i, whole

      part = 0.0_wp
      whole = size(x) - mod(size(x), 4)
      do i = 1, whole, 4
         part = part + x(i:i + 3)*y(i:i + 3)
      end do
      total = (part(1) + part(2)) + (part(3) + part(4))
      do i = whole + 1, size(x)
         total = total + x(i)*y(i)
      end do
   end function product_of

   !> The smallest and the largest eigenvalue, as exact as A is known to working precision. The
   !> matrix is positive semidefinite.
   pure subroutine find_ends(t, ends)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(out) :: ends(2)
      call multisect(t, [1, t%n], 2*epsilon(1.0_wp), ends)
   end subroutine find_ends

   !> The smallest eigenvalues, ascending, at most `lanes`, to this part of the largest.
   pure subroutine lowest_values(t, absolute, value)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: absolute
      real(wp), intent(out) :: value(:)
      integer :: k
      call multisect(t, [(k, k=1, size(value))], absolute, value)
   end subroutine lowest_values

   !> The eigenvalues with these numbers, counted upwards from 1, by multisection: Sturm
   !> sequences at several places at once (Lo, Philippe and Sameh, SIAM J. Sci. Stat. Comput. 8,
   !> 1987).
   pure subroutine multisect(t, number, absolute, value)
      type(tridiagonal_t), intent(in) :: t
      integer, intent(in) :: number(:)
      real(wp), intent(in) :: absolute
      real(wp), intent(out) :: value(:)
      real(wp), dimension(size(number)) :: lower, upper
      real(wp) :: x(lanes), squares(t%n), top
      real(wp) :: share(lanes)
      integer :: below(lanes), owner(lanes), i
      logical :: is_narrower

      squares = [0.0_wp, max(tiny(top), t%e**2)]
      top = bound_of(t)
      lower = -epsilon(1.0_wp)*top
      upper = min(top, [(bound_by_diagonal(t%d, number(i)), i=1, size(number))])
      ! Each number has its places evenly in its interval.
      owner = [(mod(i - 1, size(number)) + 1, i=1, lanes)]
      share = [(real((i - 1)/size(number) + 1, wp)/((lanes - owner(i))/size(number) + 2), i=1, lanes)]
      is_narrower = .true.
      do while (is_narrower .and. any(upper - lower > absolute*top))
         x = lower(owner) + (upper(owner) - lower(owner))*share
         call count_below(t%d, squares, x, below)
         call narrow(number, x, below, lower, upper, is_narrower)
      end do
      value = max(0.0_wp, lower/2 + upper/2)
   end subroutine multisect

   !> No eigenvalue is above (Gershgorin).
   pure real(wp) function bound_of(t) result(bound)
      type(tridiagonal_t), intent(in) :: t
      bound = maxval(abs(t%d) + [abs(t%e), 0.0_wp] + [0.0_wp, abs(t%e)])*(1 + 8*epsilon(1.0_wp))
   end function bound_of

   !> Every other entry of the diagonal is a principal submatrix, whose eigenvalues in order are
   !> no less than those of the whole (Cauchy).
   pure real(wp) function bound_by_diagonal(d, number) result(bound)
      real(wp), intent(in) :: d(:)
      integer, intent(in) :: number
      real(wp) :: smallest(lanes)
      integer :: i, k

      bound = huge(bound)
      if (number > min(lanes, (size(d) + 1)/2)) return
      smallest = huge(bound)
      do i = 1, size(d), 2
         k = number
         if (.not. d(i) < smallest(k)) cycle
         do while (k > 1)
            if (.not. d(i) < smallest(k - 1)) exit
            smallest(k) = smallest(k - 1)
            k = k - 1
         end do
         smallest(k) = d(i)
      end do
      bound = smallest(number)*(1 + 8*epsilon(bound)) + tiny(bound)
   end function bound_by_diagonal

   !> How many eigenvalues are below each place: so many pivots are negative. A pivot of zero
   !> makes the next one minus infinity, and that counts in its place.
   pure subroutine count_below(d, squares, x, below)
      real(wp), intent(in) :: d(:), squares(:), x(lanes)
      integer, intent(out) :: below(lanes)
      real(wp) :: pivot(lanes), counted(lanes)
      integer :: i

      pivot = 1.0_wp
      counted = 0.0_wp
      do i = 1, size(d)
         pivot = (d(i) - x) - squares(i)/pivot
         counted = counted + merge(1.0_wp, 0.0_wp, pivot < 0)
      end do
      below = nint(counted)
   end subroutine count_below

   !> Take in what the counts say: each place is in the interval of one number.
   pure subroutine narrow(number, x, below, lower, upper, is_narrower)
      integer, intent(in) :: number(:), below(:)
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: lower(:), upper(:)
      logical, intent(out) :: is_narrower
      integer :: i, k

      is_narrower = .false.
      k = 0
      do i = 1, size(x)
         k = k + 1
         if (k > size(number)) k = 1
         is_narrower = is_narrower .or. (x(i) > lower(k) .and. x(i) < upper(k))
         lower(k) = merge(max(lower(k), x(i)), lower(k), below(i) < number(k))
         upper(k) = merge(upper(k), min(upper(k), x(i)), below(i) < number(k))
      end do
   end subroutine narrow

   !> An orthonormal basis (n, k), k <= lanes, of the space of eigenvectors of A for eigenvalues
   !> that are roughly known, by inverse iteration on T.
   pure subroutine lowest_vectors(t, value, basis, is_found)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: value(:)
      real(wp), intent(out) :: basis(:, :)
      logical, intent(out) :: is_found
      real(wp) :: z(lanes, t%n), shift(lanes), start(lanes), apart
      integer :: step, k, i

      ! Lanes without a value of their own repeat the last one.
      shift = value([(min(k, size(value)), k=1, lanes)])
      ! Anything without symmetry serves to begin with.
      start = [(k/(lanes + 0.7_wp), k=1, lanes)]
      do i = 1, t%n
         start = 9.7_wp*start + 0.3_wp
         start = start - int(start)
         z(:, i) = start - 0.4_wp
      end do
      is_found = .false.
      do step = 1, most_steps
         call iterate(t, shift, z)
         is_found = step > 1
         if (is_found) is_found = largest_residual(t, z) <= good*bound_of(t)
         if (is_found) exit
      end do
      call make_orthonormal(size(value), z, apart)
      if (apart < well_apart) is_found = .false.
      ! Vectors of equal values are kept apart, and are good if their space is.
      do step = 1, merge(0, most_steps, is_found)
         call iterate(t, shift, z)
         call make_orthonormal(size(value), z, apart)
         is_found = apart >= well_apart
         if (is_found) is_found = residual(t, z(:size(value), :)) <= good*bound_of(t)
         if (is_found) exit
      end do
      if (.not. is_found) return
      call turn_back(t, z)
      basis = transpose(z(:size(value), :))
   end subroutine lowest_vectors

   !> Solve with T less a shift for each lane, to unit vectors. Without pivoting; the residual tells.
   pure subroutine iterate(t, shift, z)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: shift(lanes)
      real(wp), intent(inout) :: z(lanes, t%n)
      real(wp) :: inverse(lanes, t%n), pivot(lanes), squares(lanes), least
      integer :: i

      least = epsilon(1.0_wp)*bound_of(t) + tiny(least)
      do i = 1, t%n
         pivot = t%d(i) - shift
         if (i > 1) then
            pivot = pivot - t%e(i - 1)**2*inverse(:, i - 1)
            z(:, i) = z(:, i) - t%e(i - 1)*inverse(:, i - 1)*z(:, i - 1)
         end if
         inverse(:, i) = 1/merge(sign(least, pivot), pivot, abs(pivot) < least)
      end do
      z(:, t%n) = z(:, t%n)*inverse(:, t%n)
      squares = z(:, t%n)**2
      do i = t%n - 1, 1, -1
         z(:, i) = (z(:, i) - t%e(i)*z(:, i + 1))*inverse(:, i)
         squares = squares + z(:, i)**2
      end do
      squares = 1/sqrt(max(squares, tiny(least)))
      do i = 1, t%n
         z(:, i) = squares*z(:, i)
      end do
   end subroutine iterate

   !> Of the unit vectors in the lanes the largest |T z - (z' T z) z|.
   pure real(wp) function largest_residual(t, z) result(largest)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: z(lanes, t%n)
      real(wp) :: image(lanes, t%n), quotient(lanes), left(lanes)
      integer :: i

      quotient = 0.0_wp
      do i = 1, t%n
         image(:, i) = t%d(i)*z(:, i)
         if (i > 1) image(:, i) = image(:, i) + t%e(i - 1)*z(:, i - 1)
         if (i < t%n) image(:, i) = image(:, i) + t%e(i)*z(:, i + 1)
         quotient = quotient + image(:, i)*z(:, i)
      end do
      left = 0.0_wp
      do i = 1, t%n
         left = max(left, abs(image(:, i) - quotient*z(:, i)))
      end do
      largest = maxval(left)
   end function largest_residual

   !> The first k lanes, unit vectors, orthonormal, each to those before it; the others are left.
   !> apart: the least that was left of one.
   pure subroutine make_orthonormal(k, z, apart)
      integer, intent(in) :: k
      real(wp), intent(inout) :: z(:, :)
      real(wp), intent(out) :: apart
      real(wp) :: x(size(z, 2), k), norm
      integer :: i, j, round

      apart = 1.0_wp
      x = transpose(z(:k, :))
      do i = 1, k
         ! Twice is enough, also for vectors that are nearly parallel.
         do round = 1, 2
            do j = 1, i - 1
               x(:, i) = x(:, i) - product_of(x(:, j), x(:, i))*x(:, j)
            end do
            norm = sqrt(product_of(x(:, i), x(:, i)))
            apart = min(apart, norm)
            x(:, i) = x(:, i)/max(tiny(norm), norm)
         end do
      end do
      z(:k, :) = transpose(x)
   end subroutine make_orthonormal

   !> The largest part of T z outside of the space of the columns of z'.
   pure real(wp) function residual(t, z)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(in) :: z(:, :)
      real(wp) :: image(t%n, size(z, 1)), x(t%n, size(z, 1))
      integer :: i, j

      x = transpose(z)
      residual = 0.0_wp
      do i = 1, size(z, 1)
         image(:, i) = t%d*x(:, i)
         image(2:, i) = image(2:, i) + t%e*x(:t%n - 1, i)
         image(:t%n - 1, i) = image(:t%n - 1, i) + t%e*x(2:, i)
         do j = 1, size(z, 1)
            image(:, i) = image(:, i) - product_of(x(:, j), image(:, i))*x(:, j)
         end do
         residual = max(residual, maxval(abs(image(:, i))))
      end do
   end function residual

   !> Vectors of A from those of T, in place.
   pure subroutine turn_back(t, z)
      type(tridiagonal_t), intent(in) :: t
      real(wp), intent(inout) :: z(lanes, t%n)
      real(wp) :: along(lanes)
      integer :: k, i

      do k = t%n - 1, 1, -1
         if (.not. abs(t%beta(k)) > 0) cycle
         along = 0.0_wp
         do i = k + 1, t%n
            along = along + t%v(i, k)*z(:, i)
         end do
         along = t%beta(k)*along
         do i = k + 1, t%n
            z(:, i) = z(:, i) - t%v(i, k)*along
         end do
      end do
   end subroutine turn_back
end module flexact_tridiagonal
