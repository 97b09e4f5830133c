!> The decomposition on small and empty matrices.
program test_decomposition
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_kinds, only: wp
   use flexact_decomposition, only: is_feasible, decompose, singular_values, orthonormalise, &
                                    status_fine, status_no_convergence
   use flexact_testing, only: tally_t, set_random
   implicit none

   type(tally_t) :: tally
   integer :: m, n

   call set_random()
   do m = 0, 5
      do n = 0, 5
         call test_random(m, n)
         call test_zero(m, n)
      end do
   end do
   call test_known()
   call test_not_finite()
   call test_orthonormalise()
   call tally%check(is_feasible(0, 0) .and. is_feasible(35, 35), 'small ones are feasible')
   call tally%check(.not. is_feasible(30000, 30000), 'beyond the integers of LAPACK')
   call tally%check(.not. is_feasible(2000000000, 5), 'beyond any memory')
   call tally%finish()

contains

   function identity(n) result(a)
      integer, intent(in) :: n
      real(wp) :: a(n, n)
      integer :: i

      a = 0.0_wp
      do i = 1, n
         a(i, i) = 1.0_wp
      end do
   end function identity

   subroutine check_orthogonal(a, name)
      real(wp), intent(in) :: a(:, :)
      character(len=*), intent(in) :: name
      call tally%near(reshape(matmul(transpose(a), a), [size(a, 2)**2]), &
                      reshape(identity(size(a, 2)), [size(a, 2)**2]), 1.0e-14_wp, name)
   end subroutine check_orthogonal

   !> U diag(s) V' is A again, U and V are orthogonal, the values descend and
   !> are the same without the vectors.
   subroutine test_random(m, n)
      integer, intent(in) :: m, n
      real(wp) :: a(m, n), copy(m, n), s(min(m, n)), alone(min(m, n)), u(m, m), vt(n, n), product(m, n)
      integer :: status, k

      call random_number(a)
      k = min(m, n)
      copy = a
      call decompose(copy, s, u, vt, status)
      call tally%check(status == status_fine, 'status')
      product = matmul(u(:, :k)*spread(s, 1, m), vt(:k, :))
      call tally%near(reshape(product, [m*n]), reshape(a, [m*n]), 1.0e-13_wp, 'product of the factors')
      call check_orthogonal(u, 'U')
      call check_orthogonal(vt, 'V')
      call tally%check(all(s(2:) <= s(:k - 1)), 'descending')
      copy = a
      call singular_values(copy, alone, status)
      call tally%check(status == status_fine, 'status without vectors')
      call tally%near(alone, s, 1.0e-13_wp, 'values without vectors')
   end subroutine test_random

   subroutine test_zero(m, n)
      integer, intent(in) :: m, n
      real(wp) :: a(m, n), s(min(m, n)), u(m, m), vt(n, n)
      integer :: status

      a = 0.0_wp
      call decompose(a, s, u, vt, status)
      call tally%check(status == status_fine, 'status of zero')
      call tally%near(s, 0*s, 0.0_wp, 'values of zero')
      call check_orthogonal(u, 'U of zero')
      call check_orthogonal(vt, 'V of zero')
   end subroutine test_zero

   !> [3 0; 4 5] has the singular values 3 sqrt(5) and sqrt(5).
   subroutine test_known()
      real(wp) :: a(2, 2), s(2), u(2, 2), vt(2, 2)
      integer :: status

      a = reshape([3.0_wp, 4.0_wp, 0.0_wp, 5.0_wp], [2, 2])
      call decompose(a, s, u, vt, status)
      call tally%near(s, [3*sqrt(5.0_wp), sqrt(5.0_wp)], 1.0e-14_wp, 'known values')
      call tally%near(abs(u(:, 1)), [sqrt(0.1_wp), 3*sqrt(0.1_wp)], 1.0e-15_wp, 'known left vector')
      call tally%near(abs(vt(1, :)), [sqrt(0.5_wp), sqrt(0.5_wp)], 1.0e-15_wp, 'known right vector')
   end subroutine test_known

   subroutine test_not_finite()
      real(wp) :: a(2, 2), s(2)
      integer :: status

      a = ieee_value(1.0_wp, ieee_quiet_nan)
      call singular_values(a, s, status)
      call tally%check(status == status_no_convergence, 'not a number gives a status')
   end subroutine test_not_finite

   subroutine test_orthonormalise()
      real(wp) :: a(6, 3), b(6, 3), one(3, 1), none(4, 0)
      integer :: status

      call random_number(a)
      b = a
      call orthonormalise(b, status)
      call tally%check(status == status_fine, 'status of a basis')
      call check_orthogonal(b, 'basis')
      call tally%near(reshape(matmul(b, matmul(transpose(b), a)), [18]), reshape(a, [18]), 1.0e-14_wp, 'its span')
      one(:, 1) = [2.0_wp, 1.0_wp, 2.0_wp]
      call orthonormalise(one, status)
      call tally%near(one(:, 1), [2.0_wp, 1.0_wp, 2.0_wp]/3, epsilon(1.0_wp), 'one column')
      call orthonormalise(none, status)
      call tally%check(status == status_fine, 'no column')
   end subroutine test_orthonormalise
end program test_decomposition
