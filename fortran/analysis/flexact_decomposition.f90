!> Singular value decomposition and orthonormal bases, with every shape from
!> 0 x 0 on as an ordinary one and failures as values.
module flexact_decomposition
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_vectors, only: length_of
   use flexact_lapack, only: dgesdd, dgeqrf, dorgqr
   use flexact_dense, only: status_fine, status_no_convergence, status_no_memory, fits_integer, allocate_work, &
                            set_identity
   use flexact_jacobi, only: decompose_by_jacobi, values_by_jacobi
   implicit none
   private
   public :: status_fine, status_no_convergence, status_no_memory
   public :: method_svd, method_jacobi
   public :: is_feasible, decompose, decompose_by, singular_values, singular_values_by, orthonormalise

   !> The methods that give all singular values and both sets of vectors.
   integer, parameter :: method_svd = 1, method_jacobi = 2

contains

   !> Whether any full decomposition of an m x n matrix, everything included, is
   !> within LAPACK's integers and what the system grants in one piece. To be
   !> asked before the matrix is filled: some systems grant single arrays of
   !> which they cannot hold all.
   logical function is_feasible(m, n)
      integer, intent(in) :: m, n
      ! Volatile, lest the compiler leave out what is never used.
      real(wp), allocatable, volatile :: probe(:)
      integer(int64) :: rows, columns
      integer :: info

      is_feasible = fits_integer(m, n)
      if (.not. is_feasible) return
      rows = m
      columns = n
      allocate (probe(rows*rows + columns*columns + 2*rows*columns + 4*min(rows, columns)**2), stat=info)
      is_feasible = info == 0
   end function is_feasible

   !> A = U diag(values) V', eq. (16), with all columns of U (m, m) and all
   !> rows of V' (n, n); values (min(m, n)) descend. A (m, n) is destroyed.
   pure subroutine decompose(a, values, u, vt, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      integer, intent(out) :: status

      if (any(shape(a) == 0)) then
         call set_identity(u)
         call set_identity(vt)
         status = status_fine
      else
         call run_dgesdd('A', a, values, u, vt, status)
      end if
   end subroutine decompose

   !> The singular values (min(m, n)) of A (m, n), descending. A is destroyed.
   pure subroutine singular_values(a, values, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      integer, intent(out) :: status
      real(wp) :: unused(1, 1)

      status = status_fine
      if (all(shape(a) > 0)) call run_dgesdd('N', a, values, unused, unused, status)
   end subroutine singular_values

   !> As `decompose`, by one of the methods above.
   pure subroutine decompose_by(method, a, values, u, vt, status)
      integer, intent(in) :: method
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      integer, intent(out) :: status

      if (method == method_jacobi) then
         call decompose_by_jacobi(a, values, u, vt, status)
      else
         call decompose(a, values, u, vt, status)
      end if
   end subroutine decompose_by

   !> As `singular_values`, by one of the methods above.
   pure subroutine singular_values_by(method, a, values, status)
      integer, intent(in) :: method
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      integer, intent(out) :: status

      if (method == method_jacobi) then
         call values_by_jacobi(a, values, status)
      else
         call singular_values(a, values, status)
      end if
   end subroutine singular_values_by

   pure subroutine run_dgesdd(job, a, values, u, vt, status)
      character, intent(in) :: job
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      integer, intent(out) :: status
      real(wp) :: length(1)
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: m, n, info, no_iwork(1)

      m = size(a, 1)
      n = size(a, 2)
      status = status_no_memory
      if (.not. fits_integer(m, n)) return
      allocate (iwork(8*min(m, n)), stat=info)
      if (info /= 0) return
      call dgesdd(job, m, n, a, m, values, u, size(u, 1), vt, size(vt, 1), length, -1, no_iwork, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) return
      call dgesdd(job, m, n, a, m, values, u, size(u, 1), vt, size(vt, 1), work, size(work), iwork, info)
      status = merge(status_fine, status_no_convergence, info == 0)
   end subroutine run_dgesdd

   !> Replace independent columns (m, k), k <= m, by orthonormal ones that span
   !> the same space. One column is only divided by its length, which is as
   !> exact as can be.
   pure subroutine orthonormalise(basis, status)
      real(wp), intent(inout), contiguous :: basis(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: tau(:), work(:)
      real(wp) :: length(1)
      integer :: m, k, info

      m = size(basis, 1)
      k = size(basis, 2)
      status = status_fine
      if (k == 1) basis = basis/length_of(basis(:, 1))
      if (m == 0 .or. k < 2) return
      status = status_no_memory
      allocate (tau(k), stat=info)
      if (info /= 0) return
      call dorgqr(m, k, k, basis, m, tau, length, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) return
      call dgeqrf(m, k, basis, m, tau, work, size(work), info)
      call dorgqr(m, k, k, basis, m, tau, work, size(work), info)
      status = status_fine
   end subroutine orthonormalise
end module flexact_decomposition
