! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values of a small dense matrix of full rank with their vectors, and
!> the ends of its spectrum, in less time than a decomposition takes; theory.md (44).
!>
!> The eigenvectors of A'A give a space that is right to second order of their errors: in it
!> the values and the vectors are found from A itself, so that they are as exact as those of
!> a decomposition of A.
module flexact_lowest_pairs
   use flexact_decomposition, only: decompose, singular_values
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_full_rank, only: make_gram
   use flexact_lapack, only: dsytd2, dstein, dormtr
   use flexact_tridiagonal, only: some_eigenvalues
   implicit none
   private
   public :: lowest_pairs, find_ends

   !> Eigenvalues are wanted to this part of the largest, where their vectors and A follow.
   real(wp), parameter :: rough = 1.0e-9_wp
   !> Entries beside the diagonal that are this small split a tridiagonal matrix.
   real(wp), parameter :: splits = 1.0e-12_wp
   !> Eigenvalues of A'A below this part of the largest have lost too many digits.
   real(wp), parameter :: least_part = 1.0e-7_wp
   !> Columns whose cosine is below are orthogonal.
   real(wp), parameter :: orthogonal = 4*epsilon(1.0_wp)
   integer, parameter :: most_sweeps = 12

contains

   !> The smallest values, ascending, as many as there is room for and no more than there are
   !> (used), with left (rows, :) and right (columns, :) vectors of unit norm.
   !> gram: A'A or A A', by make_gram.
   subroutine lowest_pairs(a, gram, values, left, right, used, error)
      real(wp), intent(in), contiguous :: a(:, :), gram(:, :)
      real(wp), intent(out) :: values(:), left(:, :), right(:, :)
      integer, intent(out) :: used
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: basis(:, :)
      logical :: is_found

      used = min(size(values), size(a, 1), size(a, 2))
      if (used == 0) return
      allocate (basis(minval(shape(a)), used))
      call lowest_space(gram, basis, is_found)
      if (.not. is_found) then
         call decompose_whole(a, used, values, left, right, error)
      else if (size(a, 1) < size(a, 2)) then
         left(:, :used) = basis
         right(:, :used) = matmul(transpose(a), basis)
         call make_orthogonal(right(:, :used), left(:, :used), values(:used))
      else
         right(:, :used) = basis
         left(:, :used) = matmul(a, basis)
         call make_orthogonal(left(:, :used), right(:, :used), values(:used))
      end if
   end subroutine lowest_pairs

   !> Eigenvectors of the smallest eigenvalues of A'A or A A'.
   subroutine lowest_space(gram, basis, is_found)
      real(wp), intent(in) :: gram(:, :)
      real(wp), intent(inout), contiguous :: basis(:, :)
      logical, intent(out) :: is_found
      real(wp), dimension(size(basis, 1)) :: d, e, tau
      real(wp) :: reflections(size(basis, 1), size(basis, 1)), work(64*size(basis, 1)), w(size(basis, 2))
      integer :: block(size(basis, 1)), split(size(basis, 1)), iwork(size(basis, 1)), fail(size(basis, 2)), n, k, info

      n = size(basis, 1)
      k = size(basis, 2)
      reflections = gram
      call dsytd2('L', n, reflections, n, d, e, tau, info)
      is_found = all(abs(e(:n - 1)) > splits*(abs(d(:n - 1)) + abs(d(2:))))
      if (.not. is_found) return
      call some_eigenvalues(d, e(:n - 1), [(info, info=1, k)], rough, rough, w)
      block = 1
      split = n
      call dstein(n, d, e, k, w, block, split, basis, n, work, iwork, fail, info)
      is_found = info == 0
      if (is_found .and. n > 1) call dormtr('L', 'L', 'N', n, k, reflections, n, tau, basis, n, work, size(work), info)
   end subroutine lowest_space

   !> Turn the columns of `image` (the images of the columns of `source`) until they are
   !> orthogonal, by Jacobi rotations of both; they ascend, and their norms are the values.
   subroutine make_orthogonal(image, source, values)
      real(wp), intent(inout) :: image(:, :), source(:, :)
      real(wp), intent(out) :: values(:)
      integer :: i, j, sweep, first
      logical :: is_done

      do sweep = 1, most_sweeps
         is_done = .true.
         do j = 2, size(values)
            do i = 1, j - 1
               call rotate(image(:, i), image(:, j), source(:, i), source(:, j), is_done)
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

   pure subroutine rotate(x, y, u, v, is_done)
      real(wp), intent(inout) :: x(:), y(:), u(:), v(:)
      logical, intent(inout) :: is_done
      real(wp) :: xx, yy, xy, zeta, tangent, cosine, sine
      integer :: i

      xx = dot_product(x, x)
      yy = dot_product(y, y)
      xy = dot_product(x, y)
      if (.not. abs(xy) > orthogonal*sqrt(xx*yy)) return
      is_done = .false.
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

   !> The smallest and the largest singular value.
   subroutine find_ends(a, smallest, largest, error)
      real(wp), intent(in), contiguous :: a(:, :)
      real(wp), intent(out) :: smallest, largest
      type(error_t), allocatable, intent(out) :: error
      real(wp), dimension(minval(shape(a))) :: d, e, tau
      real(wp) :: gram(minval(shape(a)), minval(shape(a))), ends(2)
      real(wp), allocatable :: copy(:, :)
      integer :: n, info

      n = size(d)
      smallest = 0.0_wp
      largest = 0.0_wp
      if (n == 0) return
      call make_gram(a, gram)
      call dsytd2('L', n, gram, n, d, e, tau, info)
      call some_eigenvalues(d, e(:n - 1), [1, n], epsilon(1.0_wp), 0.0_wp, ends)
      if (.not. ends(1) > least_part*ends(2)) then
         allocate (copy, source=a)
         call singular_values(copy, d, error)
         ends = d([n, 1])**2
      end if
      smallest = sqrt(ends(1))
      largest = sqrt(ends(2))
   end subroutine find_ends
end module flexact_lowest_pairs
