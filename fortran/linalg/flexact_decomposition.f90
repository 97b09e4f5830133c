! SPDX-License-Identifier: BSD-3-Clause
!> Singular value decomposition, with every shape from 0 x 0 on as an ordinary
!> one and failures as values.
module flexact_decomposition
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_dense, only: fits_integer, allocate_work, set_identity
   use flexact_error, only: error_t, fail, error_convergence, error_memory
   use flexact_jacobi, only: decompose_by_jacobi, values_by_jacobi
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgesdd
   implicit none
   private
   public :: method_svd, method_jacobi
   public :: is_feasible, decompose, decompose_by, singular_values, singular_values_by

   !> The methods that give all singular values and both sets of vectors.
   integer, parameter :: method_svd = 1, method_jacobi = 2

contains

   !> Whether any decomposition of an m x n matrix, everything included, is within
   !> LAPACK's integers and what the system grants in one piece; is_thin: with no more
   !> left vectors than columns. To be asked before the matrix is filled: some systems
   !> grant single arrays of which they cannot hold all.
   logical function is_feasible(m, n, is_thin)
      integer, intent(in) :: m, n
      logical, intent(in) :: is_thin
      ! Volatile, lest the compiler leave out what is never used.
      real(wp), allocatable, volatile :: probe(:)
      integer(int64) :: rows, columns
      integer :: info

      is_feasible = fits_integer(m, n)
      if (.not. is_feasible) return
      rows = m
      columns = n
      allocate (probe(rows*merge(columns, rows, is_thin) + columns*columns + 2*rows*columns + 4*min(rows, columns)**2), stat=info)
      is_feasible = info == 0
   end function is_feasible

   !> A = U diag(values) V', eq. (16), with all columns of U (m, m) and all
   !> rows of V' (n, n); values (min(m, n)) descend. A (m, n) is destroyed. Of a tall
   !> matrix only the first n columns of U may be asked for, by its shape.
   pure subroutine decompose(a, values, u, vt, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      type(error_t), allocatable, intent(out) :: error

      if (any(shape(a) == 0)) then
         call set_identity(u)
         call set_identity(vt)
      else
         call run_dgesdd(merge('S', 'A', size(u, 2) < size(u, 1)), a, values, u, vt, error)
      end if
   end subroutine decompose

   !> The singular values (min(m, n)) of A (m, n), descending. A is destroyed.
   pure subroutine singular_values(a, values, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: unused(1, 1)

      if (all(shape(a) > 0)) call run_dgesdd('N', a, values, unused, unused, error)
   end subroutine singular_values

   !> As `decompose`, by one of the methods above.
   pure subroutine decompose_by(method, a, values, u, vt, error)
      integer, intent(in) :: method
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      type(error_t), allocatable, intent(out) :: error

      if (method == method_jacobi) then
         call decompose_by_jacobi(a, values, u, vt, error)
      else
         call decompose(a, values, u, vt, error)
      end if
   end subroutine decompose_by

   !> As `singular_values`, by one of the methods above.
   pure subroutine singular_values_by(method, a, values, error)
      integer, intent(in) :: method
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error

      if (method == method_jacobi) then
         call values_by_jacobi(a, values, error)
      else
         call singular_values(a, values, error)
      end if
   end subroutine singular_values_by

   pure subroutine run_dgesdd(job, a, values, u, vt, error)
      character, intent(in) :: job
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: length(1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: m, n, info, no_iwork(1)

      m = size(a, 1)
      n = size(a, 2)
      info = 1
      if (fits_integer(m, n)) allocate (iwork(8*min(m, n)), stat=info)
      if (info == 0) call dgesdd(job, m, n, a, m, values, u, size(u, 1), vt, size(vt, 1), length, -1, no_iwork, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dgesdd(job, m, n, a, m, values, u, size(u, 1), vt, size(vt, 1), work, size(work), iwork, info)
      if (info /= 0) call fail(error_convergence, error)
   end subroutine run_dgesdd
end module flexact_decomposition
