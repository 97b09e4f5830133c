!> QR factorisation with column pivoting, the fastest of the dense methods. It
!> estimates the singular values and may miss a zero (Kahan's matrix). So it
!> works in steps: the caller decides the rank from the estimates, and gets the
!> null spaces for that rank, and the smallest values that are left, computed
!> better, by which to judge the decision.
module flexact_pivoting
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqp3, dormqr, dtzrzf, dormrz, dtrtrs
   use flexact_dense, only: status_fine, status_no_memory, fits_integer, allocate_work, bring_to_one
   use flexact_decomposition, only: decompose, orthonormalise
   implicit none
   private
   public :: pivoted_t, factorise, take_rank, null_spaces, smallest_values

   !> A P = Q R as dgeqp3 leaves it, of A times 2**(-power).
   type :: pivoted_t
      !> Estimates of the singular values, (min(m, n)), descending.
      real(wp), allocatable :: estimates(:)
      real(wp), allocatable, private :: factor(:, :), tau(:)
      !> Column j of A P is column pivot(j) of A.
      integer, allocatable, private :: pivot(:)
      integer, private :: power = 0
      !> The first rows of R, as many as the rank, as T Z: T triangular in the
      !> first columns (rank, rank), and Z orthogonal, as dtzrzf leaves it in
      !> the other columns and tau_z.
      real(wp), allocatable, private :: rows(:, :), tau_z(:)
   end type pivoted_t

contains

   !> Factorise A (m, n), which is taken over.
   pure subroutine factorise(a, pivoted, status)
      real(wp), allocatable, intent(inout) :: a(:, :)
      type(pivoted_t), intent(out) :: pivoted
      integer, intent(out) :: status
      real(wp), allocatable :: work(:)
      real(wp) :: length(1)
      integer :: m, n, info

      m = size(a, 1)
      n = size(a, 2)
      call move_alloc(a, pivoted%factor)
      status = status_no_memory
      if (.not. fits_integer(m, n)) return
      allocate (pivoted%estimates(min(m, n)), pivoted%tau(min(m, n)), pivoted%pivot(n), stat=info)
      if (info /= 0) return
      pivoted%pivot = 0
      call bring_to_one(pivoted%factor, pivoted%power, status)
      if (status /= status_fine .or. min(m, n) == 0) return
      status = status_no_memory
      call dgeqp3(m, n, pivoted%factor, m, pivoted%pivot, pivoted%tau, length, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) return
      call dgeqp3(m, n, pivoted%factor, m, pivoted%pivot, pivoted%tau, work, size(work), info)
      call estimate(pivoted)
      status = status_fine
   end subroutine factorise

   !> The diagonal of R, which descends but for rounding.
   pure subroutine estimate(pivoted)
      type(pivoted_t), intent(inout) :: pivoted
      real(wp) :: below
      integer :: i

      below = 0.0_wp
      do i = size(pivoted%estimates), 1, -1
         below = max(below, abs(pivoted%factor(i, i)))
         pivoted%estimates(i) = scale(below, pivoted%power)
      end do
   end subroutine estimate

   !> Take the rows of R after the first so many for zero. Another rank may be
   !> taken later.
   pure subroutine take_rank(pivoted, rank, status)
      type(pivoted_t), intent(inout) :: pivoted
      integer, intent(in) :: rank
      integer, intent(out) :: status
      real(wp), allocatable :: work(:)
      real(wp) :: length(1)
      integer :: n, j, info

      n = size(pivoted%factor, 2)
      if (allocated(pivoted%rows)) deallocate (pivoted%rows, pivoted%tau_z)
      status = status_no_memory
      allocate (pivoted%rows(rank, n), pivoted%tau_z(rank), source=0.0_wp, stat=info)
      if (info /= 0) return
      status = status_fine
      if (rank == 0) return
      status = status_no_memory
      do j = 1, n
         pivoted%rows(:min(j, rank), j) = pivoted%factor(:min(j, rank), j)
      end do
      call dtzrzf(rank, n, pivoted%rows, rank, pivoted%tau_z, length, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) return
      call dtzrzf(rank, n, pivoted%rows, rank, pivoted%tau_z, work, size(work), info)
      status = status_fine
   end subroutine take_rank

   !> For the rank taken, orthonormal bases of the null space of A, motions
   !> (n, n - rank), and of that of its transpose, stresses (m, m - rank).
   pure subroutine null_spaces(pivoted, motions, stresses, status)
      type(pivoted_t), intent(inout) :: pivoted
      real(wp), intent(inout), contiguous :: motions(:, :), stresses(:, :)
      integer, intent(out) :: status

      call set_trailing(motions)
      call set_trailing(stresses)
      call turn_right(pivoted, motions, status)
      if (status == status_fine) call turn_left(pivoted, stresses, status)
   end subroutine null_spaces

   !> The last columns of the identity.
   pure subroutine set_trailing(basis)
      real(wp), intent(inout) :: basis(:, :)
      integer :: j, rank

      rank = size(basis, 1) - size(basis, 2)
      basis = 0.0_wp
      do j = 1, size(basis, 2)
         basis(rank + j, j) = 1.0_wp
      end do
   end subroutine set_trailing

   !> The smallest of the singular values that the rank leaves, (k) for any k
   !> up to the rank, ascending, with left (m, k) and right (n, k) vectors. They
   !> are not below the true ones of those rows, but for rounding; a value of
   !> less than 1e-20 times the largest entry is zero.
   pure subroutine smallest_values(pivoted, values, left, right, status)
      type(pivoted_t), intent(inout) :: pivoted
      real(wp), intent(out) :: values(:)
      real(wp), intent(inout), contiguous :: left(:, :), right(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: triangle(:, :), y(:, :), z(:, :)
      integer :: rank, info

      status = status_fine
      if (size(values) == 0) return
      rank = size(pivoted%rows, 1)
      status = status_no_memory
      allocate (triangle(rank, rank), y(rank, size(values)), z(rank, size(values)), stat=info)
      if (info /= 0) return
      triangle = pivoted%rows(:, :rank)
      call iterate(triangle, values, y, z, status)
      values = scale(values, pivoted%power)
      left = 0.0_wp
      left(:rank, :) = y
      right = 0.0_wp
      right(:rank, :) = z
      if (status == status_fine) call turn_right(pivoted, right, status)
      if (status == status_fine) call turn_left(pivoted, left, status)
   end subroutine smallest_values

   !> Smallest singular values of a triangle and their vectors, from above, by
   !> inverse iteration with its transpose and itself in turn.
   pure subroutine iterate(triangle, values, left, right, status)
      real(wp), intent(inout), contiguous :: triangle(:, :)
      real(wp), intent(out) :: values(:)
      real(wp), intent(inout), contiguous :: left(:, :), right(:, :)
      integer, intent(out) :: status
      integer, parameter :: most_rounds = 30
      real(wp), parameter :: settled = 1.0e-8_wp, floor = 1.0e-24_wp, zero = 1.0e-20_wp
      real(wp) :: former(size(values))
      integer :: i, j, round

      do i = 1, size(triangle, 1)
         ! Far below what the factorisation tells from zero, and far above what
         ! would drown the other values.
         if (abs(triangle(i, i)) < floor) triangle(i, i) = floor
         right(i, :) = [(cos(real(i*j, wp)), j=1, size(values))]
      end do
      call orthonormalise(right, status)
      values = huge(floor)
      do round = 1, most_rounds
         if (status /= status_fine) return
         former = values
         call improve(triangle, values, left, right, status)
         if (all(values >= (1 - settled)*former)) exit
      end do
      where (values < zero) values = 0.0_wp
   end subroutine iterate

   !> One round: the vectors of T within the span of T**(-1) T'**(-1) right.
   pure subroutine improve(t, values, left, right, status)
      real(wp), intent(in), contiguous :: t(:, :)
      real(wp), intent(out) :: values(:)
      real(wp), intent(inout), contiguous :: left(:, :), right(:, :)
      integer, intent(out) :: status
      real(wp) :: inner(size(values), size(values)), inverse(size(values))
      real(wp) :: u(size(values), size(values)), vt(size(values), size(values))
      real(wp), allocatable :: solution(:, :)
      integer :: n, k, info

      n = size(t, 1)
      k = size(values)
      status = status_no_memory
      left = right
      call dtrtrs('U', 'T', 'N', n, k, t, n, left, n, info)
      call orthonormalise(left, status)
      if (status /= status_fine) return
      allocate (solution(n, k), stat=info)
      if (info /= 0) return
      solution = left
      call dtrtrs('U', 'N', 'N', n, k, t, n, solution, n, info)
      right = solution
      call orthonormalise(right, status)
      if (status /= status_fine) return
      inner = matmul(transpose(right), solution)
      call decompose(inner, inverse, u, vt, status)
      right = matmul(right, u)
      left = matmul(left, transpose(vt))
      values = 1/max(inverse, tiny(1.0_wp))
   end subroutine improve

   !> P Z' times vectors (n, :).
   pure subroutine turn_right(pivoted, vectors, status)
      type(pivoted_t), intent(inout) :: pivoted
      real(wp), intent(inout), contiguous :: vectors(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: work(:)
      real(wp) :: length(1)
      integer :: rank, n, k, j, info

      rank = size(pivoted%rows, 1)
      n = size(vectors, 1)
      k = size(vectors, 2)
      status = status_fine
      if (rank == 0 .or. k == 0) return
      status = status_no_memory
      length = n
      associate (rows => pivoted%rows, tau => pivoted%tau_z)
         if (rank < n) call dormrz('L', 'T', n, k, rank, n - rank, rows, rank, tau, vectors, n, length, -1, info)
         call allocate_work(work, max(length(1), real(n, wp)), info)
         if (info /= 0) return
         if (rank < n) call dormrz('L', 'T', n, k, rank, n - rank, rows, rank, tau, vectors, n, work, size(work), info)
      end associate
      do j = 1, k
         work(:n) = vectors(:, j)
         vectors(pivoted%pivot, j) = work(:n)
      end do
      status = status_fine
   end subroutine turn_right

   !> Q of as many reflections as the rank times vectors (m, :).
   pure subroutine turn_left(pivoted, vectors, status)
      type(pivoted_t), intent(inout) :: pivoted
      real(wp), intent(inout), contiguous :: vectors(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: work(:)
      real(wp) :: length(1)
      integer :: rank, m, k, info

      rank = size(pivoted%rows, 1)
      m = size(vectors, 1)
      k = size(vectors, 2)
      status = status_fine
      if (rank == 0 .or. k == 0) return
      status = status_no_memory
      associate (factor => pivoted%factor, tau => pivoted%tau)
         call dormqr('L', 'N', m, k, rank, factor, m, tau, vectors, m, length, -1, info)
         if (info == 0) call allocate_work(work, length(1), info)
         if (info /= 0) return
         call dormqr('L', 'N', m, k, rank, factor, m, tau, vectors, m, work, size(work), info)
      end associate
      status = status_fine
   end subroutine turn_left
end module flexact_pivoting
