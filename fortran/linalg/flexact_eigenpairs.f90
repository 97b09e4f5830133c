! SPDX-License-Identifier: BSD-3-Clause
!> Eigenvalues and eigenvectors of small dense symmetric matrices.
module flexact_eigenpairs
   use flexact_dense, only: allocate_work
   use flexact_error, only: error_t, fail, error_convergence, error_memory, error_not_definite
   use flexact_kinds, only: wp
   use flexact_lapack, only: dsyevd, dsygv
   implicit none
   private
   public :: symmetric_eigenpairs, pencil_eigenpairs

contains

   !> Eigenvalues, ascending, of symmetric A (n, n), whose orthonormal eigenvectors take its
   !> place. Only its lower triangle is read.
   pure subroutine symmetric_eigenpairs(a, values, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: length(1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: n, info, count(1)

      n = size(a, 1)
      if (n == 0) return
      call dsyevd('V', 'L', n, a, n, values, length, -1, count, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info == 0) allocate (iwork(count(1)), stat=info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dsyevd('V', 'L', n, a, n, values, work, size(work), iwork, size(iwork), info)
      if (info /= 0) call fail(error_convergence, error)
   end subroutine symmetric_eigenpairs

   !> The same of A x = value B x, B positive definite and destroyed: x'B x = 1.
   pure subroutine pencil_eigenpairs(a, b, values, error)
      real(wp), intent(inout), contiguous :: a(:, :), b(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: work(34*size(a, 1))
      integer :: n, info

      n = size(a, 1)
      if (n == 0) return
      call dsygv(1, 'V', 'L', n, a, n, b, n, values, work, size(work), info)
      if (info > n) call fail(error_not_definite, error)
      if (info > 0 .and. info <= n) call fail(error_convergence, error)
   end subroutine pencil_eigenpairs
end module flexact_eigenpairs
