! SPDX-License-Identifier: BSD-3-Clause
!> Singular values far below the rounding of a decomposition, of matrices that are made
!> with more than 30 digits from values and vectors that are known.
program test_refined_zeros
   use flexact_decomposition, only: decompose_by, method_jacobi, method_svd
   use flexact_error, only: error_t
   use flexact_kinds, only: wp, qp
   use flexact_refined_zeros, only: many_digits_t, refined_zeros_t, refine_zeros, least_told
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   real(qp), parameter :: known(6) = [1.0_qp, 0.5_qp, 1.0e-3_qp, 1.0e-20_qp, 1.0e-25_qp, 0.0_qp]
   !> Of them the first are told from zero.
   integer, parameter :: rank = 3

   call set_random()
   if (precision(1.0_qp) > precision(1.0_wp)) then
      call check_known(method_jacobi, 6, 6)
      call check_known(method_svd, 6, 6)
      call check_known(method_svd, 9, 6)
      call check_known(method_svd, 6, 9)
      call check_full_rank()
   else
      call tally%check(.true., 'skipped: the compiler has no quadruple precision')
   end if
   call tally%finish()

contains

   !> An orthogonal matrix with more than 30 digits: two reflections.
   function orthogonal(n) result(q)
      integer, intent(in) :: n
      real(qp) :: q(n, n), v(n)
      real(wp) :: chance(n)
      integer :: i, k

      q = 0.0_qp
      do i = 1, n
         q(i, i) = 1.0_qp
      end do
      do k = 1, 2
         call random_number(chance)
         v = chance - 0.5_wp
         q = q - matmul(q, spread(v, 2, n)*spread(v, 1, n))*(2/dot_product(v, v))
      end do
   end function orthogonal

   pure type(many_digits_t) function by_rows(a)
      real(qp), intent(in) :: a(:, :)
      integer :: i, j

      by_rows%columns = size(a, 2)
      allocate (by_rows%start(size(a, 1) + 1), source=[(1 + (i - 1)*size(a, 2), i=1, size(a, 1) + 1)])
      allocate (by_rows%place(size(a)), source=[((j, j=1, size(a, 2)), i=1, size(a, 1))])
      allocate (by_rows%value(size(a)), source=reshape(transpose(a), [size(a)]))
   end function by_rows

   !> U diag(known) V' of m rows and n columns.
   subroutine check_known(method, m, n)
      integer, intent(in) :: method, m, n
      real(qp) :: q(m, m), r(n, n), a(m, n)
      real(wp) :: rounded(m, n), values(min(m, n)), u(m, m), vt(n, n)
      type(refined_zeros_t) :: zeros
      type(error_t), allocatable :: error
      integer :: k

      q = orthogonal(m)
      r = orthogonal(n)
      a = matmul(q(:, :6)*spread(known, 1, m), transpose(r(:, :6)))
      rounded = real(a, wp)
      call decompose_by(method, rounded, values, u, vt, error)
      call tally%check(.not. allocated(error) .and. all(values(rank + 1:) < 1.0e-14_wp), 'the decomposition')
      call refine_zeros(by_rows(a), u, values, vt, rank, zeros, error)
      call tally%check(.not. allocated(error) .and. size(zeros%value) == 3, 'three of them')
      call tally%near(zeros%value(:2)/[1.0e-20_wp, 1.0e-25_wp], [1.0_wp, 1.0_wp], 1.0e-6_wp, 'tiny values')
      call tally%check(zeros%value(3) <= least_told, 'a true zero')
      do k = 1, 2
         call tally%near([abs(dot_product(zeros%left(:, k), real(q(:, rank + k), wp))), &
                          abs(dot_product(zeros%right(:, k), real(r(:, rank + k), wp)))], &
                         [1.0_wp, 1.0_wp], 1.0e-9_wp, 'their vectors')
      end do
      call tally%check(all(shape(zeros%left) == [m, m - rank]) .and. all(shape(zeros%right) == [n, n - rank]), &
                       'vectors of no value')
   end subroutine check_known

   !> Without anything small there is nothing to refine.
   subroutine check_full_rank()
      real(qp) :: a(4, 4)
      real(wp) :: rounded(4, 4), values(4), u(4, 4), vt(4, 4)
      type(refined_zeros_t) :: zeros
      type(error_t), allocatable :: error

      a = orthogonal(4)
      rounded = real(a, wp)
      call decompose_by(method_svd, rounded, values, u, vt, error)
      call refine_zeros(by_rows(a), u, values, vt, 4, zeros, error)
      call tally%check(.not. allocated(error) .and. size(zeros%value) == 0, 'none is small')
   end subroutine check_full_rank
end program test_refined_zeros
