!> A factorisation that tells how many singular values of a matrix A, with no
!> fewer rows than columns, can be zero, and solves for what belongs to them.
!>
!> Some columns P are pinned, so that F = A'A + E_P E_P' - t**2 I is positive
!> definite. Then at most as many singular values of A as there are pins lie
!> below t: of one more vector x with |A x| < t |x| some combination would have
!> x_P = 0, and x'F x < 0. Cholesky's factorisation that runs to its end proves
!> this up to its rounding, which t is chosen to exceed (Rump, BIT 46, 2006).
module flexact_pinned
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated
   use flexact_kinds, only: wp
   use flexact_answer, only: options_t, status_no_library, stage_ordering, stage_factorising
   use flexact_decomposition, only: status_fine, status_no_memory
   use flexact_sparse, only: sparse_t
   use flexact_envelope, only: envelope_t, factorise, solve
   use flexact_gram, only: gram_t, breadth_first_order, envelope_size, fill_envelope, make_gram, group_graph
   use flexact_cholmod, only: cholmod_is_there, cholmod_order, cholmod_analyse, cholmod_factor, cholmod_pivots, &
                              cholmod_solve, cholmod_free
   implicit none
   private
   public :: pinned_t, make_pinned, lift, lift_and_mark, pin, apply_inverse, release
   public :: pinned_fine, pinned_no_memory, pinned_not_definite, pinned_no_library

   !> Statuses, beside and like those of an answer.
   integer, parameter :: pinned_fine = status_fine
   integer, parameter :: pinned_no_memory = status_no_memory
   integer, parameter :: pinned_no_library = status_no_library
   integer, parameter :: pinned_not_definite = 6

   !> t**2 over the largest diagonal entry of A'A: well above the rounding of the
   !> factorisation.
   real(wp), parameter :: least_square = 1.0e-13_wp
   !> Pivots below this part of the largest diagonal entry are pinned. To pin one
   !> too many does no harm.
   real(wp), parameter :: small_pivot = 1.0e-12_wp
   real(wp), parameter :: doubtful_pivot = 1.0e-9_wp
   !> So wide an envelope a column is as quick as any sparse factorisation.
   real(wp), parameter :: narrow = 40.0_wp
   !> Thresholds that are tried after the first.
   integer, parameter :: most_attempts = 2

   type :: pinned_t
      integer :: n = 0
      integer :: pins = 0
      integer, allocatable :: pin(:)
      !> t: no more singular values than pins are below it.
      real(wp) :: least = 0.0_wp
      !> Bytes that the factor needs, where it was too large.
      real(wp) :: bytes = 0.0_wp
      !> The column at which the last factorisation failed.
      integer :: failed = 0
      logical :: is_narrow = .false.
      !> Whether A'A was lifted, and no columns are pinned.
      logical :: is_lifted = .false.
      !> Place of each column in the envelope.
      integer, allocatable :: place_of(:)
      !> Where A stands for A diag(1/scale), its columns made equally long.
      real(wp), allocatable :: scale(:)
      type(envelope_t) :: envelope
      type(gram_t) :: gram
      type(c_ptr) :: handle = c_null_ptr
   end type pinned_t

contains

   !> group (columns) ascends: columns of one group share their rows.
   subroutine make_pinned(by_column, by_row, group, options, pinned, status)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(in) :: group(:)
      type(options_t), intent(in) :: options
      type(pinned_t), intent(out) :: pinned
      integer, intent(out) :: status
      integer :: order(by_column%columns), first(by_column%columns), i
      real(wp) :: entries, largest

      pinned%n = by_column%columns
      largest = largest_diagonal(by_column)
      pinned%least = sqrt(least_square*largest)
      call breadth_first_order(by_column, by_row, order)
      allocate (pinned%place_of(pinned%n))
      do i = 1, pinned%n
         pinned%place_of(order(i)) = i
      end do
      call envelope_size(by_row, pinned%place_of, first, entries)
      pinned%is_narrow = entries <= narrow*pinned%n
      if (pinned%is_narrow) then
         call fill_envelope(by_row, pinned%place_of, first, pinned%least**2, pinned%envelope)
         allocate (pinned%pin(pinned%n))
         call factorise(pinned%envelope, small_pivot*largest, pinned%pin, pinned%pins)
         pinned%pin = order(pinned%pin(:pinned%pins))
         status = pinned_fine
      else
         call factorise_sparse(by_column, by_row, group, largest, options, pinned, status)
      end if
   end subroutine make_pinned

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

   subroutine factorise_sparse(by_column, by_row, group, largest, options, pinned, status)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(in) :: group(:)
      real(wp), intent(in) :: largest
      type(options_t), intent(in) :: options
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      integer, allocatable :: order(:)
      logical, allocatable :: is_pinned(:)
      real(wp), allocatable :: pivot(:)
      real(wp) :: entries
      integer :: attempt

      status = pinned_no_library
      if (cholmod_is_there() == 0) return
      call options%tell(stage_ordering, 0, 1)
      call make_gram(by_column, by_row, options%memory, pinned%gram, pinned%bytes)
      status = pinned_no_memory
      if (.not. allocated(pinned%gram%value)) return
      call nested_order(by_column, by_row, group, order, status)
      if (status /= pinned_fine) return
      status = pinned_no_memory
      pinned%handle = cholmod_analyse(pinned%n, pinned%gram%start, pinned%gram%place, order, entries)
      if (.not. c_associated(pinned%handle)) return
      pinned%bytes = 8*entries
      if (pinned%bytes > options%memory) return
      call options%tell(stage_factorising, 0, 1)
      allocate (pivot(pinned%n), is_pinned(pinned%n))
      call pin_groups(by_column, group, small_pivot*largest, is_pinned)
      call pin(by_row, is_pinned, pinned, status)
      if (status /= pinned_not_definite) return
      call lift(pinned, status)
      if (status == pinned_fine) call cholmod_pivots(pinned%handle, pivot)
      do attempt = 0, most_attempts
         if (status /= pinned_fine) exit
         call pin(by_row, is_pinned .or. pivot < 100.0_wp**attempt*small_pivot*largest, pinned, status)
         if (status /= pinned_not_definite) exit
         is_pinned(pinned%failed) = .true.
         if (attempt < most_attempts) status = pinned_fine
      end do
   end subroutine factorise_sparse

   !> A fill-reducing order of the columns (from 0), found on their groups.
   subroutine nested_order(by_column, by_row, group, order, status)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(in) :: group(:)
      integer, allocatable, intent(out) :: order(:)
      integer, intent(out) :: status
      type(gram_t) :: graph
      integer, allocatable :: of_groups(:), first(:)
      integer :: groups, i, j, g

      groups = group(size(group))
      call group_graph(by_column, by_row, group, groups, graph)
      allocate (of_groups(groups), order(size(group)), first(groups + 1))
      status = merge(pinned_fine, pinned_no_memory, cholmod_order(groups, graph%start, graph%place, of_groups) == 0)
      if (status /= pinned_fine) return
      first(groups + 1) = size(group) + 1
      do j = size(group), 1, -1
         first(group(j)) = j
      end do
      i = 0
      do g = 1, groups
         do j = first(of_groups(g) + 1), first(of_groups(g) + 2) - 1
            i = i + 1
            order(i) = j - 1
         end do
      end do
   end subroutine nested_order

   !> Factorise A'A + t**2 I, which runs to its end whatever A is: its inverse
   !> brings forth the null space, and pivots vanish at columns that depend on
   !> those before them.
   subroutine lift(pinned, status)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      real(wp) :: shift(pinned%n)

      shift = pinned%least**2
      call factorise_shifted(shift, pinned, status)
      pinned%pin = [integer ::]
      pinned%pins = 0
      pinned%is_lifted = .true.
   end subroutine lift

   !> The same, and mark the columns with small pivots as if they were pinned.
   subroutine lift_and_mark(pinned, status)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      real(wp) :: pivot(pinned%n)
      integer :: i

      call lift(pinned, status)
      if (status /= pinned_fine) return
      call cholmod_pivots(pinned%handle, pivot)
      pinned%pin = pack([(i, i=1, pinned%n)], pivot < doubtful_pivot*pinned%least**2/least_square)
      pinned%pins = size(pinned%pin)
   end subroutine lift_and_mark

   !> Factorise with these pins.
   subroutine pin(by_row, is_pinned, pinned, status)
      type(sparse_t), intent(in) :: by_row
      logical, intent(in) :: is_pinned(:)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      integer :: i

      pinned%is_lifted = .false.
      if (pinned%is_narrow) then
         call pin_narrow(by_row, is_pinned, pinned, status)
      else
         call factorise_shifted(merge(1.0_wp, 0.0_wp, is_pinned) - pinned%least**2, pinned, status)
      end if
      pinned%pin = pack([(i, i=1, pinned%n)], is_pinned)
      pinned%pins = size(pinned%pin)
   end subroutine pin

   subroutine pin_narrow(by_row, is_pinned, pinned, status)
      type(sparse_t), intent(in) :: by_row
      logical, intent(in) :: is_pinned(:)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      integer :: failed(pinned%n), first(pinned%n), fails, i, place

      first = pinned%envelope%first
      call fill_envelope(by_row, pinned%place_of, first, pinned%least**2, pinned%envelope)
      do i = 1, pinned%n
         place = pinned%place_of(i)
         associate (diagonal => pinned%envelope%value(pinned%envelope%base(place) + place))
            if (is_pinned(i)) diagonal = diagonal + 1.0_wp
         end associate
      end do
      call factorise(pinned%envelope, tiny(1.0_wp), failed, fails)
      status = merge(pinned_fine, pinned_not_definite, fails == 0)
      if (fails > 0) pinned%failed = findloc(pinned%place_of, failed(1), 1)
   end subroutine pin_narrow

   subroutine factorise_shifted(shift, pinned, status)
      real(wp), intent(in) :: shift(:)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      real(wp) :: kept(size(shift))

      associate (gram => pinned%gram)
         kept = gram%value(gram%diagonal)
         gram%value(gram%diagonal) = kept + shift
         pinned%failed = cholmod_factor(pinned%handle, pinned%n, gram%start, gram%place, gram%value)
         gram%value(gram%diagonal) = kept
      end associate
      status = pinned_fine
      if (pinned%failed < 0) status = pinned_no_memory
      if (pinned%failed > 0) status = pinned_not_definite
   end subroutine factorise_shifted

   !> Pin what a node (or element) can do by itself: columns that depend on others
   !> of their group.
   pure subroutine pin_groups(by_column, group, least, is_pinned)
      type(sparse_t), intent(in) :: by_column
      integer, intent(in) :: group(:)
      real(wp), intent(in) :: least
      logical, intent(out) :: is_pinned(:)
      integer :: first, last

      is_pinned = .false.
      first = 1
      do while (first <= size(group))
         last = first
         do while (last < size(group))
            if (group(last + 1) /= group(first)) exit
            last = last + 1
         end do
         call pin_group(by_column, first, last, least, is_pinned)
         first = last + 1
      end do
   end subroutine pin_groups

   !> The pivots of the block of A'A of columns first to last, of which there are
   !> few, decide.
   pure subroutine pin_group(by_column, first, last, least, is_pinned)
      type(sparse_t), intent(in) :: by_column
      integer, intent(in) :: first, last
      real(wp), intent(in) :: least
      logical, intent(inout) :: is_pinned(:)
      real(wp) :: l(last - first + 1, last - first + 1), pivot
      integer :: i, j

      do i = 1, size(l, 1)
         do j = 1, i - 1
            l(i, j) = (product_of(by_column, first + i - 1, first + j - 1) - dot_product(l(i, :j - 1), l(j, :j - 1)))/l(j, j)
         end do
         pivot = product_of(by_column, first + i - 1, first + i - 1) - sum(l(i, :i - 1)**2)
         if (pivot < least) then
            is_pinned(first + i - 1) = .true.
            pivot = pivot + 1.0_wp
         end if
         l(i, i) = sqrt(pivot)
      end do
   end subroutine pin_group

   !> The product of two columns.
   pure real(wp) function product_of(matrix, j, k) result(total)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: j, k
      integer :: a, b

      total = 0.0_wp
      a = matrix%start(j)
      b = matrix%start(k)
      do while (a < matrix%start(j + 1) .and. b < matrix%start(k + 1))
         if (matrix%place(a) == matrix%place(b)) total = total + matrix%value(a)*matrix%value(b)
         if (matrix%place(a) <= matrix%place(b)) then
            a = a + 1
            if (matrix%place(a - 1) == matrix%place(b)) b = b + 1
         else
            b = b + 1
         end if
      end do
   end function product_of

   !> x = inverse(F) x, column by column.
   subroutine apply_inverse(pinned, x, status)
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(inout), contiguous :: x(:, :)
      integer, intent(out) :: status
      real(wp) :: y(size(x, 1), size(x, 2))
      integer :: i

      status = pinned_fine
      if (size(x) == 0) return
      if (allocated(pinned%scale)) call divide(pinned%scale, x)
      if (pinned%is_narrow) then
         do i = 1, pinned%n
            y(pinned%place_of(i), :) = x(i, :)
         end do
         call solve(pinned%envelope, y)
         do i = 1, pinned%n
            x(i, :) = y(pinned%place_of(i), :)
         end do
      else
         if (cholmod_solve(pinned%handle, pinned%n, size(x, 2), x, y) /= 0) status = pinned_no_memory
         x = y
      end if
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

      if (c_associated(pinned%handle)) call cholmod_free(pinned%handle)
      pinned%handle = c_null_ptr
   end subroutine release
end module flexact_pinned
