! SPDX-License-Identifier: BSD-3-Clause
!> A factorisation that bounds how many singular values of a matrix A, with no
!> fewer rows than columns, can be zero, and solves for what belongs to them.
!>
!> Some columns P are pinned, so that F = A'A + E_P E_P' - t**2 I is positive
!> definite. Then at most as many singular values of A as there are pins lie
!> below t: of one more vector x with |A x| < t |x| some combination would have
!> x_P = 0, and x'F x < 0. Cholesky's factorisation that runs to its end shows this up
!> to its rounding, which is bounded by d from the factor that has come out (Rump,
!> BIT 46, 2006; `flexact_backward_error`): what is shown holds up to the root of
!> t**2 - d. Where d is large, t is raised; theory.md (30), (31) and (34).
module flexact_pinned
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_backward_error, only: error_of_gram
   use flexact_blas, only: blas_threads
   use flexact_error, only: error_t, fail, is_kind, error_memory, error_not_definite
   use flexact_factor, only: factor_t, analyse, factorise, get_pivots, error_of_factor, solve, release_factor => release
   use flexact_gram, only: gram_t, make_gram, most_bytes
   use flexact_kinds, only: wp
   use flexact_nested_order, only: elimination_order
   use flexact_pin_groups, only: pin_groups
   use flexact_progress, only: progress_t, stage_ordering, stage_factorising
   use flexact_sparse, only: sparse_t, operator_t
   use flexact_threads, only: run_tasks
   implicit none
   private
   public :: pinned_t, make_pinned, assure, shift, shift_and_mark, pin, apply_inverse, release

   !> t**2 over the largest diagonal entry of A'A, at least; and over the bound of the
   !> rounding, below which t is raised, and to which.
   real(wp), parameter :: least_square = 1.0e-13_wp
   real(wp), parameter :: safe = 1.25_wp, raised = 1.5_wp
   !> Bounds below these parts of t**2 are as good as any, that of A'A and that of all rounding:
   !> t is not raised.
   real(wp), parameter :: little = 0.1_wp, enough = 0.75_wp
   !> t**2 over the largest diagonal entry for each entry of the longest column of the
   !> factor: above what bounds come out at, so that t need not be raised later.
   real(wp), parameter :: expected = 4.0e-15_wp
   !> Pivots below this many times t**2, which the shift adds to them, are pinned. To pin
   !> one too many does no harm: so a thousand times that where nothing is shown anyway.
   real(wp), parameter :: small_pivot = 10.0_wp
   real(wp), parameter :: doubtful_pivot = 1000*small_pivot
   !> Thresholds for pivots that are tried after the first, each a hundred times larger.
   integer, parameter :: most_attempts = 2

   type :: pinned_t
      integer :: n = 0
      integer :: pins = 0
      integer, allocatable :: pin(:)
      !> t: what is below is taken for low.
      real(wp) :: least = 0.0_wp
      !> No more singular values than pins are below: that much is shown.
      real(wp) :: bound = 0.0_wp
      !> What A'A may be off by, and the product of its factor too.
      real(wp) :: error_of_gram = 0.0_wp, rounding = 0.0_wp
      !> Bytes that the factor needs, where it was too large.
      real(wp) :: bytes = 0.0_wp
      !> The column at which the last factorisation failed.
      integer :: failed = 0
      !> Whether it is A'A + t**2 I that is factorised, and no columns are pinned.
      logical :: is_shifted = .false.
      !> Where A stands for A diag(1/scale), its columns made equally long.
      real(wp), allocatable :: scale(:)
      type(gram_t) :: gram
      type(factor_t) :: factor
      type(progress_t) :: progress
   end type pinned_t

   !> A'A and its order of elimination, which know nothing of each other.
   type :: start_t
      type(operator_t), pointer :: a => null()
      integer, pointer, contiguous :: group(:) => null()
      type(pinned_t), pointer :: pinned => null()
      real(wp) :: memory = 0.0_wp
      !> Whether A'A fits for certain, so that nothing waits for it.
      logical :: is_certain = .false.
      integer, allocatable :: order(:)
      type(error_t), allocatable :: error
   end type start_t
   !> Columns from which threads are worth their start.
   integer, parameter :: worth_threads = 20000

contains

   !> group (columns) ascends: columns of one group share their rows. memory: bytes
   !> that may be used.
   subroutine make_pinned(a, group, memory, progress, pinned, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      real(wp), intent(in) :: memory
      type(progress_t), intent(in) :: progress
      type(pinned_t), intent(out) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: largest

      pinned%n = a%by_column%columns
      pinned%progress = progress
      largest = largest_diagonal(a%by_column)
      pinned%error_of_gram = error_of_gram(a, largest, little*least_square*largest)
      pinned%least = sqrt(max(least_square*largest, raised*pinned%error_of_gram))
      call analyse_pattern(a, group, memory, progress, pinned, error)
      if (allocated(error)) return
      call progress%report(stage_factorising)
      call choose_pins(a, group, pinned, error)
      if (.not. allocated(error)) call assure(pinned, error)
   end subroutine make_pinned

   !> Raise t where the rounding is not well below.
   subroutine assure(pinned, error)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      logical :: is_pinned(pinned%n)
      real(wp) :: rounding

      rounding = pinned%rounding
      if (safe*rounding <= pinned%least**2 .or. .not. rounding < huge(rounding)) return
      pinned%least = sqrt(raised*rounding)
      is_pinned = .false.
      is_pinned(pinned%pin) = .true.
      call pin(is_pinned, pinned, error)
   end subroutine assure

   !> What the factorisation, which ran to its end, shows.
   subroutine set_bound(pinned)
      type(pinned_t), intent(inout) :: pinned

      pinned%rounding = pinned%error_of_gram + error_of_factor(pinned%factor, enough*pinned%least**2 - pinned%error_of_gram)
      pinned%bound = 0.0_wp
      if (pinned%rounding < pinned%least**2) pinned%bound = sqrt(pinned%least**2 - pinned%rounding)
   end subroutine set_bound

   !> The largest diagonal entry of A'A, one where all are zero.
   pure real(wp) function largest_diagonal(by_column) result(largest)
      type(sparse_t), intent(in) :: by_column
      integer :: j

      largest = 0.0_wp
      do j = 1, by_column%columns
         largest = max(largest, sum(by_column%value(by_column%start(j):by_column%start(j + 1) - 1)**2))
      end do
      if (.not. largest > 0) largest = 1.0_wp
   end function largest_diagonal

   !> A'A, and all that its factorisation needs but the numbers.
   subroutine analyse_pattern(a, group, memory, progress, pinned, error)
      type(operator_t), intent(in), target :: a
      integer, intent(in), target, contiguous :: group(:)
      real(wp), intent(in) :: memory
      type(progress_t), intent(in) :: progress
      type(pinned_t), intent(inout), target :: pinned
      type(error_t), allocatable, intent(out) :: error
      type(start_t), target :: start

      call progress%report(stage_ordering)
      start%a => a
      start%group => group
      start%pinned => pinned
      start%memory = memory
      start%is_certain = pinned%n >= worth_threads .and. most_bytes(a) <= memory
      call run_tasks(2_c_int, int(merge(blas_threads(), 1, start%is_certain), c_int), c_funloc(make_start), c_loc(start))
      if (allocated(pinned%gram%value)) then
         call move_alloc(start%error, error)
         if (allocated(error)) return
         call analyse(pinned%gram%start, pinned%gram%place, start%order, blas_threads(), pinned%factor, error)
         if (allocated(error)) return
         pinned%least = max(pinned%least, sqrt(expected*pinned%factor%widest*largest_diagonal(a%by_column)))
         pinned%bytes = pinned%factor%bytes
         if (pinned%bytes <= memory) return
      end if
      call fail(error_memory, error)
   end subroutine analyse_pattern

   recursive subroutine make_start(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(start_t), pointer :: start
      logical :: is_wanted

      call c_f_pointer(data, start)
      if (task == 1) then
         call make_gram(start%a, start%memory, start%pinned%gram, start%pinned%bytes)
      else
         is_wanted = start%is_certain .and. worker > 0
         if (.not. is_wanted) is_wanted = allocated(start%pinned%gram%value)
         if (is_wanted) call elimination_order(start%a, start%group, start%order, start%error)
      end if
   end subroutine make_start

   !> Pin what depends on others of its group; where that does not do, columns at
   !> which pivots are small even so, of the matrix shifted upwards.
   subroutine choose_pins(a, group, pinned, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      logical :: is_pinned(pinned%n)
      real(wp) :: pivot(pinned%n)
      integer :: attempt

      call pin_groups(a%by_column, group, small_pivot*pinned%least**2, is_pinned)
      call pin(is_pinned, pinned, error)
      if (.not. is_kind(error, error_not_definite)) return
      call factorise_with(merge(1.0_wp, 0.0_wp, is_pinned) + pinned%least**2, pinned, error)
      if (allocated(error)) return
      call get_pivots(pinned%factor, pivot)
      do attempt = 0, most_attempts
         call pin(is_pinned .or. pivot < 100.0_wp**attempt*small_pivot*pinned%least**2, pinned, error)
         if (.not. is_kind(error, error_not_definite)) return
         is_pinned(pinned%failed) = .true.
      end do
   end subroutine choose_pins

   !> Factorise A'A + t**2 I, which runs to its end whatever A is: its inverse
   !> brings forth the null space, and pivots vanish at columns that depend on
   !> those before them.
   subroutine shift(pinned, error)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error

      call factorise_with(spread(pinned%least**2, 1, pinned%n), pinned, error)
      pinned%pin = [integer ::]
      pinned%pins = 0
      pinned%bound = 0.0_wp
      pinned%is_shifted = .true.
   end subroutine shift

   !> The same, and mark the columns with small pivots as if they were pinned.
   subroutine shift_and_mark(pinned, error)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: pivot(pinned%n)
      integer :: i

      call shift(pinned, error)
      if (allocated(error)) return
      call get_pivots(pinned%factor, pivot)
      pinned%pin = pack([(i, i=1, pinned%n)], pivot < doubtful_pivot*pinned%least**2)
      pinned%pins = size(pinned%pin)
   end subroutine shift_and_mark

   !> Factorise with these pins.
   subroutine pin(is_pinned, pinned, error)
      logical, intent(in) :: is_pinned(:)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      integer :: i

      pinned%is_shifted = .false.
      call factorise_with(merge(1.0_wp, 0.0_wp, is_pinned) - pinned%least**2, pinned, error)
      pinned%pin = pack([(i, i=1, pinned%n)], is_pinned)
      pinned%pins = size(pinned%pin)
      if (.not. allocated(error)) call set_bound(pinned)
   end subroutine pin

   !> Factorise A'A with this added to its diagonal.
   subroutine factorise_with(added, pinned, error)
      real(wp), intent(in) :: added(:)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: kept(size(added))

      associate (gram => pinned%gram)
         kept = gram%value(gram%diagonal)
         gram%value(gram%diagonal) = kept + added
         call factorise(pinned%factor, gram%value, pinned%progress, pinned%failed, error)
         gram%value(gram%diagonal) = kept
      end associate
   end subroutine factorise_with

   !> x = inverse(F) x, column by column.
   subroutine apply_inverse(pinned, x, error)
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(inout), contiguous :: x(:, :)
      type(error_t), allocatable, intent(out) :: error

      if (size(x) == 0) return
      if (allocated(pinned%scale)) call divide(pinned%scale, x)
      call solve(pinned%factor, x, error)
      if (allocated(pinned%scale)) call divide(pinned%scale, x)
   end subroutine apply_inverse

   pure subroutine divide(scale, x)
      real(wp), intent(in) :: scale(:)
      real(wp), intent(inout) :: x(:, :)
      integer :: k

      do k = 1, size(x, 2)
         x(:, k) = x(:, k)/scale
      end do
   end subroutine divide

   subroutine release(pinned)
      type(pinned_t), intent(inout) :: pinned

      call release_factor(pinned%factor)
   end subroutine release
end module flexact_pinned
