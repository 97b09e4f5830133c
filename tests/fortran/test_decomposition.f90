! SPDX-License-Identifier: BSD-3-Clause
!> The decompositions: small, empty, rank-deficient, graded and extreme matrices.
program test_decomposition
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_kinds, only: wp
   use flexact_bidiagonal, only: bidiagonal_t, is_worth_steps, bidiagonalise, find_all_vectors, find_lowest_vectors
   use flexact_decomposition, only: method_svd, method_jacobi, is_feasible, decompose_by, singular_values_by
   use flexact_error, only: error_t, is_kind, error_convergence
   use flexact_orthonormal, only: orthonormalise
   use flexact_pivoted_qr, only: null_space
   use flexact_test_matrices, only: identity
   use flexact_testing, only: tally_t, set_random
   implicit none

   character(len=*), parameter :: name_of(2) = ['svd   ', 'jacobi']
   type(tally_t) :: tally
   integer :: m, n, rank, method

   call set_random()
   do m = 0, 5
      do n = 0, 5
         do rank = 0, min(m, n)
            do method = method_svd, method_jacobi
               call test_random(method, m, n, rank)
            end do
            call test_pivoted(m, n, rank)
         end do
      end do
   end do
   do method = method_svd, method_jacobi
      call test_random(method, 40, 30, 12)
      call test_random(method, 30, 40, 30)
      call test_known(method)
      call test_extreme(method)
      call test_not_finite(method)
   end do
   do n = 13, 60, 47
      call test_steps(n, 1.0e-4_wp, .true.)
      call test_steps(n, 1.0e-7_wp, .false.)
      call test_steps(n, 1.0_wp + 1.0_wp/n, .false.)
   end do
   call test_pivoted(40, 30, 12)
   call test_pivoted(30, 40, 29)
   call test_graded()
   call test_graded_deficient()
   call test_lauchli()
   call test_kahan()
   call test_pivoted_extreme()
   call test_orthonormalise()
   call tally%check(is_feasible(0, 0, .false.) .and. is_feasible(35, 35, .false.), 'small ones are feasible')
   call tally%check(.not. is_feasible(30000, 30000, .false.), 'beyond the integers of LAPACK')
   call tally%check(.not. is_feasible(2000000000, 5, .true.), 'beyond any memory')
   call tally%finish()

contains

   subroutine check_orthogonal(a, name)
      real(wp), intent(in) :: a(:, :)
      character(len=*), intent(in) :: name
      call tally%near(reshape(matmul(transpose(a), a), [size(a, 2)**2]), &
                      reshape(identity(size(a, 2)), [size(a, 2)**2]), 1.0e-14_wp, name)
   end subroutine check_orthogonal

   subroutine check_zero(a, tolerance, name)
      real(wp), intent(in) :: a(:, :), tolerance
      character(len=*), intent(in) :: name
      call tally%check(all(abs(a) <= tolerance), name)
   end subroutine check_zero

   !> A random matrix of a rank, with a zero row and column where the rank
   !> leaves one.
   function random_of_rank(m, n, rank) result(a)
      integer, intent(in) :: m, n, rank
      real(wp) :: a(m, n), left(m, rank), right(rank, n)

      call random_number(left)
      call random_number(right)
      if (m > rank) left(m/2 + 1, :) = 0.0_wp
      if (n > rank) right(:, n/2 + 1) = 0.0_wp
      a = matmul(left - 0.5_wp, right - 0.5_wp)
      if (m > rank) a(m/2 + 1, :) = 0.0_wp
      if (n > rank) a(:, n/2 + 1) = 0.0_wp
   end function random_of_rank

   !> U diag(s) V' is A again, U and V are orthogonal, the values descend, are
   !> zero beyond the rank, and are the same without the vectors.
   subroutine test_random(method, m, n, rank)
      integer, intent(in) :: method, m, n, rank
      real(wp) :: a(m, n), copy(m, n), s(min(m, n)), alone(min(m, n)), u(m, m), vt(n, n)
      type(error_t), allocatable :: error
      integer :: k

      a = random_of_rank(m, n, rank)
      k = min(m, n)
      copy = a
      call decompose_by(method, copy, s, u, vt, error)
      call tally%check(.not. allocated(error), 'status, '//name_of(method))
      call check_zero(matmul(u(:, :k)*spread(s, 1, m), vt(:k, :)) - a, 1.0e-13_wp, &
                      'product of the factors, '//name_of(method))
      call check_orthogonal(u, 'U, '//name_of(method))
      call check_orthogonal(vt, 'V, '//name_of(method))
      call tally%check(all(s(2:) <= s(:k - 1)), 'descending, '//name_of(method))
      call tally%check(all(s(rank + 1:) >= 0 .and. s(rank + 1:) <= 1.0e-14_wp), 'zeros, '//name_of(method))
      copy = a
      call singular_values_by(method, copy, alone, error)
      call tally%check(.not. allocated(error), 'status without vectors, '//name_of(method))
      call tally%near(alone, s, 1.0e-13_wp, 'values without vectors, '//name_of(method))
   end subroutine test_random

   !> In steps: the same values, all vectors the same, and those of the smallest values up to
   !> signs. The smallest is `least`; what is too near to zero, or to the next, has none.
   subroutine test_steps(n, least, is_apart)
      integer, intent(in) :: n
      real(wp), intent(in) :: least
      logical, intent(in) :: is_apart
      real(wp), dimension(n, n) :: a, copy, u, vt, left, right
      real(wp) :: s(n), values(n)
      type(bidiagonal_t) :: form
      type(error_t), allocatable :: error
      logical :: is_found
      integer :: k

      a = random_of_rank(n, n, n)
      copy = a
      call decompose_by(method_svd, copy, s, u, vt, error)
      s = [(2.0_wp - real(k, wp)/n, k=1, n - 1), least]
      a = matmul(u*spread(s, 1, n), vt)
      copy = a
      call decompose_by(method_svd, copy, s, u, vt, error)
      call tally%check(is_worth_steps(a), 'worth steps')
      call bidiagonalise(a, form, values, error)
      call tally%check(.not. allocated(error), 'status of steps')
      call tally%near(values, s, 1.0e-13_wp, 'values in steps')
      call find_lowest_vectors(form, values, left, right, is_found)
      call tally%check(is_found .eqv. is_apart, 'whether vectors are clear')
      if (is_found) then
         call check_zero(left(:, :n - 6), 0.0_wp, 'no other left vectors')
         do k = n - 5, n
            call tally%near(matmul(a, right(k, :)), s(k)*left(:, k), 1.0e-13_wp, 'a pair')
            call tally%near([abs(dot_product(u(:, k), left(:, k))), abs(dot_product(vt(k, :), right(k, :)))], &
                            [1.0_wp, 1.0_wp], 1.0e-11_wp, 'a pair of vectors')
         end do
      end if
      call find_all_vectors(form, left, right, error)
      call check_zero(left - u, 1.0e-15_wp, 'all left vectors')
      call check_zero(right - vt, 1.0e-15_wp, 'all right vectors')
   end subroutine test_steps

   !> [3 0; 4 5] has the singular values 3 sqrt(5) and sqrt(5).
   subroutine test_known(method)
      integer, intent(in) :: method
      real(wp) :: a(2, 2), s(2), u(2, 2), vt(2, 2)
      type(error_t), allocatable :: error

      a = reshape([3.0_wp, 4.0_wp, 0.0_wp, 5.0_wp], [2, 2])
      call decompose_by(method, a, s, u, vt, error)
      call tally%near(s, [3*sqrt(5.0_wp), sqrt(5.0_wp)], 1.0e-14_wp, 'known values')
      call tally%near(abs(u(:, 1)), [sqrt(0.1_wp), 3*sqrt(0.1_wp)], 1.0e-15_wp, 'known left vector')
      call tally%near(abs(vt(1, :)), [sqrt(0.5_wp), sqrt(0.5_wp)], 1.0e-15_wp, 'known right vector')
   end subroutine test_known

   !> The same near the ends of the range of the numbers.
   subroutine test_extreme(method)
      integer, intent(in) :: method
      real(wp) :: a(2, 3), s(2), u(2, 2), vt(3, 3)
      type(error_t), allocatable :: error
      integer :: i

      do i = -1000, 1000, 2000
         a = scale(reshape([3.0_wp, 4.0_wp, 0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp], [2, 3]), i)
         call decompose_by(method, a, s, u, vt, error)
         call tally%near(scale(s, -i), [3*sqrt(5.0_wp), sqrt(5.0_wp)], 1.0e-14_wp, 'extreme values')
         call check_orthogonal(u, 'U of extreme values')
         call tally%near(abs(vt(3, :)), [0.0_wp, 0.0_wp, 1.0_wp], 1.0e-15_wp, 'null vector of extreme values')
      end do
   end subroutine test_extreme

   subroutine test_not_finite(method)
      integer, intent(in) :: method
      real(wp) :: a(2, 2), s(2)
      type(error_t), allocatable :: error

      a = ieee_value(1.0_wp, ieee_quiet_nan)
      call singular_values_by(method, a, s, error)
      call tally%check(is_kind(error, error_convergence), 'not a number gives a status')
   end subroutine test_not_finite

   !> diag(d1) B diag(d2) with a condition of B of 3 and powers of two in d1 and
   !> d2, in either orientation; the values were computed with 60 digits.
   subroutine test_graded()
      real(wp), parameter :: b(5, 4) = reshape([4.0_wp, 1.0_wp, 2.0_wp, 1.0_wp, 1.0_wp, 1.0_wp, 3.0_wp, -1.0_wp, &
                                                1.0_wp, 0.0_wp, -2.0_wp, 1.0_wp, 5.0_wp, -1.0_wp, 2.0_wp, 1.0_wp, &
                                                -1.0_wp, 1.0_wp, 2.0_wp, -1.0_wp], [5, 4])
      integer, parameter :: d1(5) = [13, 0, 20, 7, 10], d2(4) = [0, 20, 7, 13]
      real(wp), parameter :: expected(4) = [1.0000616312434484_wp, 1.2246816161965793e-4_wp, &
                                            1.8795166093703342e-7_wp, 1.7294567086772202e-9_wp]
      real(wp) :: a(5, 4), across(4, 5), s(4), u(5, 5), vt(4, 4)
      type(error_t), allocatable :: error

      a = scale(b, -spread(d1, 2, 4) - spread(d2, 1, 5))
      across = transpose(a)
      call decompose_by(method_jacobi, a, s, u, vt, error)
      call tally%near(s/expected, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-14_wp, 'graded')
      call decompose_by(method_jacobi, across, s, vt, u, error)
      call tally%near(s/expected, [1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp], 1.0e-14_wp, 'graded, transposed')
   end subroutine test_graded

   !> diag(1, 1/g, g) [1 2 3; 4 5 6; 7 8 9] has the null vectors [1 -2 1] and,
   !> on the left, [1 -2g 1/g]; what rounding leaves of the zero is as small as
   !> the smallest row.
   subroutine test_graded_deficient()
      real(wp), parameter :: second(0:2) = [1.0561383974864504_wp, 1.0551786871786737_wp, 1.0551786871689885_wp]
      real(wp) :: a(3, 3), s(3), u(3, 3), vt(3, 3), g, left(3)
      type(error_t), allocatable :: error
      integer :: i

      do i = 0, 2
         g = 10.0_wp**(4*i + 1)
         a = reshape([1.0_wp, 4.0_wp, 7.0_wp, 2.0_wp, 5.0_wp, 8.0_wp, 3.0_wp, 6.0_wp, 9.0_wp], [3, 3])
         a(2, :) = a(2, :)/g
         a(3, :) = a(3, :)*g
         call decompose_by(method_jacobi, a, s, u, vt, error)
         call tally%near([s(2)/second(i)], [1.0_wp], 1.0e-14_wp, 'graded of rank 2')
         call tally%check(s(3) <= 1.0e-14_wp/g, 'its zero')
         call tally%near(vt(3, :)/vt(3, 1), [1.0_wp, -2.0_wp, 1.0_wp], 1.0e-14_wp, 'its null vector')
         left = u(:, 3)/u(2, 3)
         call tally%near(left*[-2*g, 1.0_wp, -2*g**2], [1.0_wp, 1.0_wp, 1.0_wp], 1.0e-13_wp, 'its left null vector')
      end do
   end subroutine test_graded_deficient

   function lauchli(n, mu) result(a)
      integer, intent(in) :: n
      real(wp), intent(in) :: mu
      real(wp) :: a(n + 1, n)

      a(1, :) = 1.0_wp
      a(2:, :) = mu*identity(n)
   end function lauchli

   !> A row of ones above mu I has the values sqrt(n + mu**2) and, n - 1 times,
   !> mu.
   subroutine test_lauchli()
      integer, parameter :: n = 5
      real(wp), parameter :: mu = 1.0e-9_wp
      real(wp) :: a(n + 1, n), across(n, n + 1), s(n), u(n + 1, n + 1), vt(n, n), expected(n)
      real(wp), allocatable :: stress(:, :)
      type(error_t), allocatable :: error

      expected = mu
      expected(1) = sqrt(n + mu**2)
      a = lauchli(n, mu)
      call decompose_by(method_jacobi, a, s, u, vt, error)
      call tally%near(s/expected, spread(1.0_wp, 1, n), 1.0e-14_wp, 'Lauchli')
      across = transpose(lauchli(n, mu))
      call null_space(across, 1.0e-12_wp, stress, error)
      call tally%check(size(stress, 2) == 1, 'Lauchli, pivoted')
      call tally%near(stress(2:, 1)/stress(1, 1)*mu, spread(-1.0_wp, 1, n), 1.0e-14_wp, 'its null vector')
   end subroutine test_lauchli

   !> Kahan's matrix; a slight grading keeps its columns in their order.
   function kahan(n, theta) result(a)
      integer, intent(in) :: n
      real(wp), intent(in) :: theta
      real(wp) :: a(n, n)
      integer :: i, j

      a = 0.0_wp
      do j = 1, n
         do i = 1, j
            a(i, j) = sin(theta)**(i - 1)*merge(1.0_wp, -cos(theta), i == j)*(1 - scale(real(j, wp), -17))
         end do
      end do
   end function kahan

   !> Pivoting does not see how small the smallest value of Kahan's matrix is,
   !> which was computed with 60 digits.
   subroutine test_kahan()
      integer, parameter :: n = 90
      real(wp), parameter :: theta = 1.2_wp, smallest_value = 3.9605751346931777e-15_wp
      real(wp) :: s(n), a(n, n)
      real(wp), allocatable :: basis(:, :)
      type(error_t), allocatable :: error

      a = kahan(n, theta)
      call singular_values_by(method_jacobi, a, s, error)
      call tally%near([s(n)/smallest_value], [1.0_wp], 1.0e-9_wp, 'Kahan')
      a = kahan(n, theta)
      call null_space(a, 1.0e-12_wp, basis, error)
      call tally%check(size(basis, 2) == 0, 'Kahan is not seen by pivoting')
   end subroutine test_kahan

   !> The basis is orthonormal, and A takes it to zero.
   subroutine test_pivoted(m, n, rank)
      integer, intent(in) :: m, n, rank
      real(wp) :: a(m, n), copy(m, n)
      real(wp), allocatable :: motions(:, :)
      type(error_t), allocatable :: error

      a = random_of_rank(m, n, rank)
      copy = a
      call null_space(copy, 1.0e-13_wp, motions, error)
      call tally%check(.not. allocated(error), 'status, pivoted')
      call tally%check(all(shape(motions) == [n, n - rank]), 'as many motions, pivoted')
      call check_orthogonal(motions, 'motions, pivoted')
      call check_zero(matmul(a, motions), 1.0e-14_wp, 'motions are free')
   end subroutine test_pivoted

   !> Near the ends of the range the null vector of [3 0 0; 4 5 0] stays, and is no
   !> more where nothing counts as zero.
   subroutine test_pivoted_extreme()
      real(wp) :: a(2, 3)
      real(wp), allocatable :: motion(:, :)
      type(error_t), allocatable :: error
      integer :: i

      do i = -1000, 1000, 2000
         a = scale(reshape([3.0_wp, 4.0_wp, 0.0_wp, 5.0_wp, 0.0_wp, 0.0_wp], [2, 3]), i)
         call null_space(a, scale(1.0_wp, i), motion, error)
         call tally%check(size(motion, 2) == 1, 'one motion of extreme values')
         call tally%near(abs(motion(:, 1)), [0.0_wp, 0.0_wp, 1.0_wp], 1.0e-15_wp, 'which is this')
      end do
      a = ieee_value(1.0_wp, ieee_quiet_nan)
      call null_space(a, 0.0_wp, motion, error)
      call tally%check(is_kind(error, error_convergence), 'not a number gives an error, pivoted')
   end subroutine test_pivoted_extreme

   subroutine test_orthonormalise()
      real(wp) :: a(6, 3), b(6, 3), one(3, 1), none(4, 0)
      type(error_t), allocatable :: error

      call random_number(a)
      b = a
      call orthonormalise(b, error)
      call tally%check(.not. allocated(error), 'status of a basis')
      call check_orthogonal(b, 'basis')
      call tally%near(reshape(matmul(b, matmul(transpose(b), a)), [18]), reshape(a, [18]), 1.0e-14_wp, 'its span')
      one(:, 1) = [2.0_wp, 1.0_wp, 2.0_wp]
      call orthonormalise(one, error)
      call tally%near(one(:, 1), [2.0_wp, 1.0_wp, 2.0_wp]/3, epsilon(1.0_wp), 'one column')
      call orthonormalise(none, error)
      call tally%check(.not. allocated(error), 'no column')
   end subroutine test_orthonormalise
end program test_decomposition
