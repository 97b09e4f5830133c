!> Singular value decomposition by preconditioned Jacobi rotations (Drmac and
!> Veselic, SIAM J. Matrix Anal. Appl. 29, 2008, pp. 1322-1362). Rows and
!> columns may be graded: the small singular values of diag(d1) B diag(d2) are
!> as exact relative to themselves as the condition of B permits, where other
!> methods are exact relative to the largest one. Where B is ill-conditioned too,
!> they are refined (see `flexact_refinement`).
module flexact_jacobi
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgejsv
   use flexact_dense, only: status_fine, status_no_convergence, status_no_memory, fits_integer, &
                            bring_to_one, set_identity, transpose_in_place
   use flexact_refinement, only: is_refinable, refine
   implicit none
   private
   public :: decompose_by_jacobi, values_by_jacobi

contains

   !> A = U diag(values) V', with all columns of U (m, m) and all rows of V'
   !> (n, n); values (min(m, n)) descend. A (m, n) is destroyed.
   pure subroutine decompose_by_jacobi(a, values, u, vt, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), vt(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: turned(:, :)

      if (any(shape(a) == 0)) then
         call set_identity(u)
         call set_identity(vt)
         status = status_fine
      else if (size(a, 1) >= size(a, 2)) then
         call decompose_tall(a, values, u, vt, status)
      else
         call turn(a, turned, status)
         if (status == status_fine) call decompose_tall(turned, values, vt, u, status)
      end if
      if (status == status_fine) call transpose_in_place(vt)
   end subroutine decompose_by_jacobi

   !> The singular values (min(m, n)) of A (m, n), descending. A is destroyed.
   pure subroutine values_by_jacobi(a, values, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: turned(:, :)

      status = status_fine
      if (any(shape(a) == 0)) return
      if (size(a, 1) >= size(a, 2)) then
         call values_of_tall(a, values, status)
      else
         call turn(a, turned, status)
         if (status == status_fine) call values_of_tall(turned, values, status)
      end if
   end subroutine values_by_jacobi

   !> A = U diag(values) V' for m >= n, with V (n, n), not its transpose.
   pure subroutine decompose_tall(a, values, u, v, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), v(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: copy(:, :)

      if (is_refinable(size(a, 1), size(a, 2))) copy = a
      call run_dgejsv('F', 'V', a, values, u, v, status)
      if (status == status_fine .and. allocated(copy)) call refine(copy, values, v, u)
   end subroutine decompose_tall

   !> The vectors are wanted for the refinement.
   pure subroutine values_of_tall(a, values, status)
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: copy(:, :), v(:, :)
      real(wp) :: unused(1, 1)

      if (is_refinable(size(a, 1), size(a, 2))) then
         copy = a
         allocate (v(size(a, 2), size(a, 2)))
         call run_dgejsv('N', 'V', a, values, unused, v, status)
         if (status == status_fine) call refine(copy, values, v)
      else
         call run_dgejsv('N', 'N', a, values, unused, unused, status)
      end if
   end subroutine values_of_tall

   !> dgejsv takes no matrix of more columns than rows.
   pure subroutine turn(a, turned, status)
      real(wp), intent(in) :: a(:, :)
      real(wp), allocatable, intent(out) :: turned(:, :)
      integer, intent(out) :: status
      integer :: i, info

      allocate (turned(size(a, 2), size(a, 1)), stat=info)
      status = merge(status_fine, status_no_memory, info == 0)
      if (info /= 0) return
      do i = 1, size(a, 1)
         turned(:, i) = a(i, :)
      end do
   end subroutine turn

   !> For m >= n, with rows sorted by size before the QR factorisation (joba
   !> 'F'). Values below about 1e-308 of the largest become zero (jobr 'R').
   pure subroutine run_dgejsv(job_u, job_v, a, values, u, v, status)
      character, intent(in) :: job_u, job_v
      real(wp), intent(inout), contiguous :: a(:, :)
      real(wp), intent(out), contiguous :: values(:)
      real(wp), intent(inout), contiguous :: u(:, :), v(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: work(:)
      integer, allocatable :: iwork(:)
      integer :: m, n, power, length, info

      m = size(a, 1)
      n = size(a, 2)
      call bring_to_one(a, power, status)
      if (status /= status_fine) return
      status = status_no_memory
      if (.not. fits_integer(m, n)) return
      ! dgejsv answers no query in every version of LAPACK; blocks of 32.
      length = 7*n + 64*m
      if (job_v /= 'N') length = length + 2*n*n
      allocate (work(length), iwork(m + 3*n), stat=info)
      if (info /= 0) return
      call dgejsv('F', job_u, job_v, 'R', 'N', 'N', m, n, a, m, values, u, size(u, 1), v, size(v, 1), &
                  work, length, iwork, info)
      ! A value that vanishes only in the rotations would leave no left vector.
      status = merge(status_fine, status_no_convergence, info == 0 .and. iwork(2) >= iwork(1))
      if (status == status_fine) values = scale(values*(work(1)/work(2)), power)
   end subroutine run_dgejsv
end module flexact_jacobi
