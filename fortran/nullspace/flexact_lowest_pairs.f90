! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values of a small dense matrix of full rank with their vectors, and
!> the ends of its spectrum, in less time than a decomposition takes; theory.md (49) and (50).
!>
!> The eigenvectors of A'A give a space that is right to second order of their errors: in it
!> the values and the vectors are found from A itself, so that they are as exact as those of
!> a decomposition of A.
module flexact_lowest_pairs
   use flexact_decomposition, only: decompose, singular_values
   use flexact_error, only: error_t
   use flexact_kinds, only: wp, lanes
   use flexact_tridiagonal, only: tridiagonal_t, tridiagonalise, ends_of => find_ends, lowest_values, lowest_vectors
   implicit none
   private
   public :: lowest_spaces, lowest_pairs, find_ends, have_lost_digits, decompose_ends

   !> Eigenvalues are wanted to this part of the largest, where their vectors and A follow.
   real(wp), parameter :: rough = 1.0e-7_wp
   !> Eigenvalues of A'A below this part of the largest have lost too many digits.
   real(wp), parameter :: least_part = 1.0e-7_wp
   !> Squares from here to its inverse can be multiplied with each other.
   real(wp), parameter :: least_square = 1.0e-100_wp
   !> Columns whose cosine is below are orthogonal.
   real(wp), parameter :: orthogonal = 1.0e-13_wp
   integer, parameter :: most_sweeps = 12

contains

   !> Eigenvectors (lanes, n, vectors) of the smallest eigenvalues of some A'A or A A' (lanes, n, n), side by
   !> side; their lower triangles are destroyed. is_found: of each whether they are good.
   subroutine lowest_spaces(gram, basis, is_found)
      real(wp), allocatable, intent(inout) :: gram(:, :, :)
      real(wp), intent(out) :: basis(:, :, :)
      logical, intent(out) :: is_found(lanes)
      type(tridiagonal_t) :: t
      real(wp) :: value(lanes, size(basis, 3))

      call tridiagonalise(gram, t)
      call lowest_values(t, rough, value)
      call lowest_vectors(t, value, basis, is_found)
   end subroutine lowest_spaces

   !> The smallest values, ascending, as many as the basis has vectors, with left (rows, :) and right
   !> (columns, :) vectors of unit norm.
   !> basis: by `lowest_spaces`, which has found one, or all of A is decomposed.
   subroutine lowest_pairs(a, basis, is_found, values, left, right, error)
      real(wp), intent(in), contiguous :: a(:, :)
      real(wp), intent(in) :: basis(:, :)
      logical, intent(in) :: is_found
      real(wp), intent(out) :: values(:), left(:, :), right(:, :)
      type(error_t), allocatable, intent(out) :: error

      if (.not. is_found) then
         call decompose_whole(a, size(values), values, left, right, error)
      else if (size(a, 1) < size(a, 2)) then
         left = basis
         right = matmul(transpose(a), basis)
         call make_orthogonal(right, left, values)
      else
         right = basis
         left = matmul(a, basis)
         call make_orthogonal(left, right, values)
      end if
   end subroutine lowest_pairs

   !> Turn the columns of `image` (the images of the columns of `source`) until they are
   !> orthogonal, by Jacobi rotations of both; they ascend, and their norms are the values.
   subroutine make_orthogonal(image, source, values)
      real(wp), intent(inout) :: image(:, :), source(:, :)
      real(wp), intent(out) :: values(:)
      real(wp) :: products(size(values), size(values))
      integer :: i, j, sweep, first
      logical :: is_done

      do sweep = 1, most_sweeps
         products = matmul(transpose(image), image)
         is_done = .true.
         do j = 2, size(values)
            do i = 1, j - 1
               if (.not. abs(products(i, j)) > orthogonal*sqrt(products(i, i)*products(j, j))) cycle
               is_done = .false.
               call rotate(image(:, i), image(:, j), source(:, i), source(:, j))
            end do
         end do
         if (is_done) exit
      end do
      values = norm2(image, 1)
      do i = 1, size(values)
         first = i - 1 + minloc(values(i:), 1)
         values([i, first]) = values([first, i])
         image(:, [i, first]) = image(:, [first, i])
         source(:, [i, first]) = source(:, [first, i])
         if (values(i) > 0) image(:, i) = image(:, i)/values(i)
      end do
   end subroutine make_orthogonal

   pure subroutine rotate(x, y, u, v)
      real(wp), intent(inout) :: x(:), y(:), u(:), v(:)
      real(wp) :: xx, yy, xy, zeta, tangent, cosine, sine
      integer :: i

      xx = dot_product(x, x)
      yy = dot_product(y, y)
      xy = dot_product(x, y)
      if (.not. abs(xy) > 0) return
      zeta = (yy - xx)/(2*xy)
      tangent = sign(1/(abs(zeta) + hypot(1.0_wp, zeta)), zeta)
      cosine = 1/hypot(1.0_wp, tangent)
      sine = cosine*tangent
      do i = 1, size(x)
         xx = x(i)
         x(i) = cosine*xx - sine*y(i)
         y(i) = sine*xx + cosine*y(i)
      end do
      do i = 1, size(u)
         xx = u(i)
         u(i) = cosine*xx - sine*v(i)
         v(i) = sine*xx + cosine*v(i)
      end do
   end subroutine rotate

   !> From a complete decomposition.
   subroutine decompose_whole(a, used, values, left, right, error)
      real(wp), intent(in), contiguous :: a(:, :)
      integer, intent(in) :: used
      real(wp), intent(inout) :: values(:), left(:, :), right(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: copy(size(a, 1), size(a, 2)), every(minval(shape(a))), u(size(a, 1), size(a, 1)), vt(size(a, 2), size(a, 2))
      integer :: k

      copy = a
      call decompose(copy, every, u, vt, error)
      if (allocated(error)) return
      do k = 1, used
         associate (last => size(every) - k + 1)
            values(k) = every(last)
            left(:, k) = u(:, last)
            right(:, k) = vt(last, :)
         end associate
      end do
   end subroutine decompose_whole

   !> The squares (lanes, 2) of the smallest and the largest singular values of some A, from A'A or A A'
   !> (lanes, n, n), side by side; their lower triangles are destroyed.
   subroutine find_ends(gram, squares)
      real(wp), allocatable, intent(inout) :: gram(:, :, :)
      real(wp), intent(out) :: squares(lanes, 2)
      type(tridiagonal_t) :: t

      call tridiagonalise(gram, t)
      call ends_of(t, squares)
   end subroutine find_ends

   !> Whether the roots of these squares are not those of a decomposition.
   pure logical function have_lost_digits(squares)
      real(wp), intent(in) :: squares(2)
      have_lost_digits = .not. (squares(1) > max(least_square, least_part*squares(2)) .and. squares(2) < 1/least_square)
   end function have_lost_digits

   !> The smallest and the largest singular value by a decomposition.
   subroutine decompose_ends(a, smallest, largest, error)
      real(wp), intent(in) :: a(:, :)
      real(wp), intent(out) :: smallest, largest
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: copy(size(a, 1), size(a, 2)), values(minval(shape(a)))

      copy = a
      call singular_values(copy, values, error)
      smallest = values(size(values))
      largest = values(1)
   end subroutine decompose_ends
end module flexact_lowest_pairs
