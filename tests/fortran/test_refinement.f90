! SPDX-License-Identifier: BSD-3-Clause
!> Small singular values of matrices that no grading makes well-conditioned.
!> Pascal's matrix is symmetric and positive definite, and its inverse is similar
!> to it: singular values come in pairs of product one, and the left vectors are
!> the right ones.
program test_refinement
   use flexact_kinds, only: wp
   use flexact_error, only: error_t
   use flexact_jacobi, only: decompose_by_jacobi, values_by_jacobi
   use flexact_refinement, only: is_refinable, exact_product
   use flexact_testing, only: tally_t
   implicit none

   type(tally_t) :: tally
   integer :: n

   do n = 2, 12
      call test_pascal(n)
      call test_repeated(n)
   end do
   call test_not_square()
   call test_far_below()
   call test_too_large()
   call test_exact_product()
   call tally%check(is_refinable(12, 12), 'the compiler has quadruple precision')
   call tally%finish()

contains

   !> All entries are integers, the largest of 12 x 12 is 705432.
   function pascal(n) result(a)
      integer, intent(in) :: n
      real(wp) :: a(n, n)
      integer :: i, j

      a = 1.0_wp
      do j = 2, n
         do i = 2, n
            a(i, j) = a(i - 1, j) + a(i, j - 1)
         end do
      end do
   end function pascal

   subroutine check_orthogonal(a, name)
      real(wp), intent(in) :: a(:, :)
      character(len=*), intent(in) :: name
      real(wp) :: product(size(a, 2), size(a, 2))
      integer :: i

      product = matmul(transpose(a), a)
      do i = 1, size(a, 2)
         product(i, i) = product(i, i) - 1
      end do
      call tally%check(all(abs(product) <= 1.0e-14_wp), name)
   end subroutine check_orthogonal

   !> U diag(s) V' is A, and U and V are orthogonal.
   subroutine check_factors(a, s, u, vt, name)
      real(wp), intent(in) :: a(:, :), s(:), u(:, :), vt(:, :)
      character(len=*), intent(in) :: name
      integer :: k

      k = size(s)
      call check_orthogonal(u, 'U, '//name)
      call check_orthogonal(vt, 'V, '//name)
      call tally%check(all(s(2:) <= s(:k - 1)), 'descending, '//name)
      call tally%check(all(abs(matmul(u(:, :k)*spread(s, 1, size(u, 1)), vt(:k, :)) - a) <= 1.0e-14_wp*s(1)), &
                       'product of the factors, '//name)
   end subroutine check_factors

   !> As it stands and near the ends of the range; for n = 12 the smallest value is
   !> 3e-13 of the largest.
   subroutine test_pascal(n)
      integer, intent(in) :: n
      real(wp) :: a(n, n), s(n), alone(n), u(n, n), vt(n, n)
      type(error_t), allocatable :: error
      integer :: power

      do power = -990, 990, 990
         a = scale(pascal(n), power)
         call decompose_by_jacobi(a, s, u, vt, error)
         call tally%check(.not. allocated(error), 'status, Pascal')
         s = scale(s, -power)
         call tally%near(s*s(n:1:-1), spread(1.0_wp, 1, n), 1.0e-14_wp, 'Pascal')
         call check_factors(pascal(n), s, u, vt, 'Pascal')
         call tally%near(u(:, n), vt(n, :), 1.0e-14_wp, 'its vectors')
         a = scale(pascal(n), power)
         call values_by_jacobi(a, alone, error)
         call tally%near(scale(alone, -power)/s, spread(1.0_wp, 1, n), 1.0e-14_wp, 'Pascal without vectors')
      end do
   end subroutine test_pascal

   !> [P P; P P; 0 0], in either orientation, has twice the values of P and as
   !> many zeros.
   subroutine test_repeated(n)
      integer, intent(in) :: n
      real(wp) :: a(2*n + 3, 2*n), copy(2*n + 3, 2*n), across(2*n, 2*n + 3), s(2*n)
      real(wp) :: u(2*n + 3, 2*n + 3), vt(2*n, 2*n), left(2*n, 2*n), right(2*n + 3, 2*n + 3)
      type(error_t), allocatable :: error

      a = 0.0_wp
      a(:n, :n) = pascal(n)
      a(n + 1:2*n, :n) = pascal(n)
      a(:, n + 1:) = a(:, :n)
      copy = a
      call decompose_by_jacobi(copy, s, u, vt, error)
      call tally%check(.not. allocated(error), 'status, repeated')
      call tally%near(s(:n)*s(n:1:-1), spread(4.0_wp, 1, n), 1.0e-13_wp, 'repeated')
      call tally%check(all(s(n + 1:) >= 0 .and. s(n + 1:) <= 1.0e-15_wp*s(1)), 'zeros')
      call check_factors(a, s, u, vt, 'repeated')
      call tally%check(all(abs(matmul(transpose(u(:, n + 1:)), a)) <= 1.0e-14_wp*s(1)), 'left null vectors')
      call tally%near(sqrt(2.0_wp)*u(:n, n), sqrt(2.0_wp)*vt(n, n + 1:), 1.0e-14_wp, 'vectors of the smallest value')
      across = transpose(a)
      call decompose_by_jacobi(across, s, left, right, error)
      call tally%near(s(:n)*s(n:1:-1), spread(4.0_wp, 1, n), 1.0e-13_wp, 'repeated, transposed')
      call check_factors(transpose(a), s, left, right, 'repeated, transposed')
   end subroutine test_repeated

   !> Rows 3 P and 4 P together have five times the values of P.
   subroutine test_not_square()
      real(wp) :: a(24, 12), s(12)
      type(error_t), allocatable :: error

      a(:12, :) = 3*pascal(12)
      a(13:, :) = 4*pascal(12)
      call values_by_jacobi(a, s, error)
      call tally%check(.not. allocated(error), 'status, not square')
      call tally%near(s*s(12:1:-1), spread(25.0_wp, 1, 12), 25.0e-14_wp, 'not square')
   end subroutine test_not_square

   !> The smallest value of [1 1; 1 1 + d] for d = 2**(-52) is d/2 but for 1 in d.
   subroutine test_far_below()
      real(wp), parameter :: d = epsilon(1.0_wp)
      real(wp) :: a(2, 2), s(2)
      type(error_t), allocatable :: error

      a = reshape([1.0_wp, 1.0_wp, 1.0_wp, 1.0_wp + d], [2, 2])
      call values_by_jacobi(a, s, error)
      call tally%near(s/[2.0_wp, d/2], [1.0_wp, 1.0_wp], 1.0e-15_wp, 'far below')
   end subroutine test_far_below

   !> What is too large or zero is as right as the rotations make it.
   subroutine test_too_large()
      real(wp) :: zero(2, 2), s(2)
      type(error_t), allocatable :: error

      call tally%check(.not. is_refinable(3000, 3000), 'too large')
      call tally%check(.not. is_refinable(2000000000, 2000000000), 'far too large')
      zero = 0.0_wp
      call values_by_jacobi(zero, s, error)
      call tally%check(.not. allocated(error), 'zero')
      call tally%near(s, [0.0_wp, 0.0_wp], 0.0_wp, 'its values')
   end subroutine test_too_large

   !> 1 + e - 1 is e, however small.
   subroutine test_exact_product()
      real(wp), parameter :: e = scale(1.0_wp, -100)
      real(wp) :: product(1, 1)

      call exact_product(reshape([1.0_wp, 1.0_wp, 1.0_wp], [1, 3]), reshape([1.0_wp, e, -1.0_wp], [3, 1]), product)
      call tally%near(product(:, 1)/e, [1.0_wp], 0.0_wp, 'no digit is lost')
   end subroutine test_exact_product
end program test_refinement
