! SPDX-License-Identifier: BSD-3-Clause
!> Singular value decomposition by preconditioned Jacobi rotations (Drmac and
!> Veselic, SIAM J. Matrix Anal. Appl. 29, 2008, pp. 1322-1362). Rows and
!> columns may be graded: the small singular values of diag(d1) B diag(d2) are
!> as exact relative to themselves as the condition of B permits, where other
!> methods are exact relative to the largest one. Where B is ill-conditioned too,
!> they are refined (see `flexact_refinement`); theory.md (39).
module flexact_jacobi
   use flexact_dense, only: fits_integer, bring_to_one, set_identity, transpose_in_place
   use flexact_error, only: error_t, fail, error_convergence, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgejsv
   use flexact_refinement, only: is_refinable, exact_product
   implicit none
   private
   public :: decompose_by_jacobi, values_by_jacobi

   !> Values above the first part of the largest one are right to nearly all their
   !> digits at once. Those below the second stay as they are: V is orthogonal to
   !> 1e-16, the square of which is what a refined value errs by.
   real(wp), parameter :: small = 0.1_wp, least = 1.0e-17_wp

contains

   !> A = U diag(values) V', with all columns of U (m, m) and all rows of V'
   !> (n, n); values (min(m, n)) descend. A (m, n) is destroyed. U may be (m, n)
   !> for m > n.
   pure subroutine decompose_by_jacobi(a, values, u, vt, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: tall(:, :)

      if (any(shape(a) == 0)) then
         call set_identity(u)
         call set_identity(vt)
      else if (size(a, 1) >= size(a, 2)) then
         call decompose_tall(merge('U', 'F', size(u, 2) < size(u, 1)), a, values, u, vt, error)
      else
         call transpose_to(a, tall, error)
         if (.not. allocated(error)) call decompose_tall('F', tall, values, vt, u, error)
      end if
      if (.not. allocated(error)) call transpose_in_place(vt)
   end subroutine decompose_by_jacobi

   !> The singular values (min(m, n)) of A (m, n), descending. A is destroyed.
   pure subroutine values_by_jacobi(a, values, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: tall(:, :), v(:, :)
      real(wp) :: unused(1, 1)

      if (any(shape(a) == 0)) return
      ! The refinement needs the right vectors.
      allocate (v(minval(shape(a)), minval(shape(a))))
      if (size(a, 1) >= size(a, 2)) then
         call decompose_tall('N', a, values, unused, v, error)
      else
         call transpose_to(a, tall, error)
         if (.not. allocated(error)) call decompose_tall('N', tall, values, unused, v, error)
      end if
   end subroutine values_by_jacobi

   !> A = U diag(values) V' for m >= n, with V (n, n), not its transpose.
   pure subroutine decompose_tall(job_u, a, values, u, v, error)
      character, intent(in) :: job_u
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), v(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: copy(:, :)
      character :: job_v

      if (is_refinable(size(a, 1), size(a, 2))) allocate (copy, source=a)
      job_v = 'V'
      if (job_u == 'N' .and. .not. allocated(copy)) job_v = 'N'
      call run_dgejsv(job_u, job_v, a, values, u, v, error)
      if (allocated(error) .or. .not. allocated(copy)) return
      if (values(size(values)) < small*values(1)) call refine(job_u, copy, values, u, v)
   end subroutine decompose_tall

   !> Improve values, U and V of A (m, n), which is destroyed; what cannot be
   !> improved stays as it is.
   pure subroutine refine(job_u, a, values, u, v)
      character, intent(in) :: job_u
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(inout), contiguous :: values(:), u(:, :), v(:, :)
      real(wp), allocatable :: product(:, :), better(:), left(:, :), right(:, :)
      type(error_t), allocatable :: error
      integer :: power, j

      call bring_to_one(a, power, error)
      if (allocated(error)) return
      allocate (product(size(a, 1), size(a, 2)), better(size(values)), left(size(u, 1), size(u, 2)), &
                right(size(v, 1), size(v, 2)))
      call exact_product(a, v, product)
      call run_dgejsv(job_u, 'V', product, better, left, right, error)
      if (allocated(error)) return
      if (.not. any(better > least*better(1) .and. better < small*better(1))) return
      where (better > least*better(1)) values = scale(better, power)
      do j = 2, size(values)
         values(j) = min(values(j), values(j - 1))
      end do
      v = matmul(v, right)
      u = left
   end subroutine refine

   !> dgejsv takes no matrix of more columns than rows.
   pure subroutine transpose_to(a, tall, error)
      real(wp), intent(in) :: a(:, :)
      real(wp), allocatable, intent(out) :: tall(:, :)
      type(error_t), allocatable, intent(out) :: error
      integer :: info

      allocate (tall(size(a, 2), size(a, 1)), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
      else
         tall = transpose(a)
      end if
   end subroutine transpose_to

   !> For m >= n, with rows sorted by size before the QR factorisation (joba
   !> 'F'). Values below about 1e-308 of the largest become zero (jobr 'R').
   pure subroutine run_dgejsv(job_u, job_v, a, values, u, v, error)
      character, intent(in) :: job_u, job_v
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), v(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: m, n, power, length, info

      m = size(a, 1)
      n = size(a, 2)
      call bring_to_one(a, power, error)
      if (allocated(error)) return
      info = 1
      ! dgejsv answers no query in every version of LAPACK; blocks of 32.
      length = 7*n + 64*m + 2*n*n
      if (fits_integer(m, n)) allocate (work(length), iwork(m + 3*n), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dgejsv('F', job_u, job_v, 'R', 'N', 'N', m, n, a, m, values, u, size(u, 1), v, size(v, 1), &
                  work, length, iwork, info)
      ! A value that vanishes only in the rotations would leave no left vector.
      if (info == 0 .and. iwork(2) >= iwork(1)) then
         values = scale(values*(work(1)/work(2)), power)
      else
         call fail(error_convergence, error)
      end if
   end subroutine run_dgejsv
end module flexact_jacobi
