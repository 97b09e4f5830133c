!> Singular value decomposition and orthonormal bases, with every shape from
!> 0 x 0 on as an ordinary one and failures as values.
module flexact_decomposition
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_vectors, only: length_of
   use flexact_lapack, only: dgesdd, dgeqrf, dorgqr
   implicit none
   private
   public :: status_fine, status_no_convergence, status_no_memory
   public :: is_feasible, decompose, singular_values, orthonormalise

   integer, parameter :: status_fine = 0
   !> LAPACK gave up, or the matrix holds a number that is not finite.
   integer, parameter :: status_no_convergence = 1
   !> The work arrays cannot be had, or are too long for LAPACK's integers.
   integer, parameter :: status_no_memory = 2

contains

   !> Whether a full decomposition of an m x n matrix, everything included, is
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
      allocate (probe(rows*rows + columns*columns + rows*columns + 4*min(rows, columns)**2), stat=info)
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

   !> Whether dgesdd can count its work array with default integers.
   pure logical function fits_integer(m, n)
      integer, intent(in) :: m, n
      real(wp) :: short, long

      short = min(m, n)
      long = max(m, n)
      fits_integer = 4*short*short + 7*short + 64*long < huge(1)
   end function fits_integer

   !> The work array of the length that a query has returned.
   pure subroutine allocate_work(work, length, info)
      real(wp), allocatable, intent(out) :: work(:)
      real(wp), intent(in) :: length
      integer, intent(out) :: info

      info = 1
      if (length < real(huge(1), wp)) allocate (work(max(1, int(length))), stat=info)
   end subroutine allocate_work

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

   pure subroutine set_identity(a)
      real(wp), intent(inout) :: a(:, :)
      integer :: i

      a = 0.0_wp
      do i = 1, size(a, 1)
         a(i, i) = 1.0_wp
      end do
   end subroutine set_identity
end module flexact_decomposition
