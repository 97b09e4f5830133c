! SPDX-License-Identifier: BSD-3-Clause
!> The low end of a connected matrix A with no fewer rows than columns, or only a
!> few: how many singular values are zero, the smallest of the others, and their
!> vectors.
!>
!> Two independent routes lead to the count of zeros: vectors that A itself sends
!> to zero give a lower bound, and a factorisation that runs to its end
!> gives an upper one (`flexact_pinned`); theory.md (31), (35) and (36).
module flexact_low_end
   use flexact_decomposition, only: singular_values
   use flexact_error, only: error_t, is_kind, error_not_definite, error_not_found
   use flexact_first_block, only: first_block_t, make_first_block
   use flexact_kinds, only: wp
   use flexact_lanczos, only: next_space
   use flexact_local_vectors, only: find_local_vectors
   use flexact_pin_search, only: seek_pins, repin, low_end
   use flexact_pinned, only: pinned_t, make_pinned, assure, shift_and_mark
   use flexact_pinned_space, only: pinned_space, show_values
   use flexact_progress, only: progress_t, stage_motions, stage_values
   use flexact_rank, only: rank_rule_t, rank_t, decide_rank
   use flexact_scaled_basis, only: add_scaled_sparse
   use flexact_scaled_norm, only: length_of
   use flexact_sparse, only: operator_t, operator_of, times_transposed, norm_bound
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   implicit none
   private
   public :: low_end_t, request_t, factorise_low_end, find_low_end, few, large

   !> What is asked for.
   type :: request_t
      type(rank_rule_t) :: rule
      !> Bytes of memory that may be used.
      real(wp) :: memory = huge(1.0_wp)
      type(progress_t) :: progress
      !> Of A as it stands, its columns of several units, only the smallest values.
      logical :: values_only = .false.
      !> How many values beside the zeros; of one an estimate from above.
      integer :: values = 1
   end type request_t

   !> Values ascend; vectors (columns, k) and the directions of their images (rows,
   !> k). The first `pins` of them span what was pinned.
   type :: low_end_t
      !> Whether both routes lead to this count of zeros.
      logical :: confirmed = .true.
      !> No more values than were pinned lie below.
      real(wp) :: bound = 0.0_wp
      integer :: pins = 0
      !> Vectors with the value zero that live on few columns, beside those, and the
      !> same made orthonormal, from which all others are deflated.
      type(sparse_basis_t) :: local, deflated
      real(wp), allocatable :: values(:), vectors(:, :), images(:, :)
      type(rank_t) :: decision
   end type low_end_t

   !> From this size on a matrix is gone through once, with all care, and its stages are
   !> reported.
   integer, parameter :: large = 500
   !> How many values a search goes up to that finds none above the tolerance: a guard
   !> of time; beyond, the count is not confirmed.
   integer, parameter :: most_values = 256
   !> Up to these pins are dealt with together; of more, vectors are sought where
   !> they live.
   integer, parameter :: few = 16
   !> Other pins, and columns times their number squared, that are dealt with at most: guards
   !> of time, some seconds; beyond, the count is not confirmed.
   integer, parameter :: most_dense = 800
   real(wp), parameter :: most_work = 4.5e8_wp
   !> The same where nothing is shown anyway: as much memory as the factor takes.
   real(wp), parameter :: most_unshown = 2.9e7_wp
   !> A pinned space that has less of a unit vector at the pins is pinned anew: the
   !> condition of F grows with its inverse squared.
   real(wp), parameter :: weak = 0.05_wp

contains

   !> Factorise A. group (columns) ascends: columns of one group share their rows.
   subroutine factorise_low_end(a, group, request, pinned, low, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      type(request_t), intent(in) :: request
      type(pinned_t), intent(out) :: pinned
      type(low_end_t), intent(out) :: low
      type(error_t), allocatable, intent(out) :: error

      if (request%values_only) then
         call factorise_equilibrated(a, group, request, pinned, error)
         return
      end if
      call make_pinned(a, group, request%memory, request%progress, pinned, error)
      if (is_kind(error, error_not_definite)) then
         call seek_pins(a, pinned, error)
         if (.not. allocated(error)) call assure(pinned, error)
      end if
      if (.not. (is_kind(error, error_not_definite) .or. is_kind(error, error_not_found))) return
      ! What the low end is then is not shown by two routes.
      low%confirmed = .false.
      call shift_and_mark(pinned, error)
   end subroutine factorise_low_end

   !> Columns of several units are made equally long first.
   subroutine factorise_equilibrated(a, group, request, pinned, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      type(request_t), intent(in) :: request
      type(pinned_t), intent(out) :: pinned
      type(error_t), allocatable, intent(out) :: error
      type(operator_t) :: equal
      real(wp), allocatable :: scale(:)
      integer :: j

      equal = a
      allocate (scale(a%by_column%columns))
      do j = 1, size(scale)
         associate (value => equal%by_column%value(a%by_column%start(j):a%by_column%start(j + 1) - 1))
            scale(j) = length_of(value)
            value = value/scale(j)
         end associate
      end do
      equal = operator_of(equal%by_column)
      call make_pinned(equal, group, request%memory, request%progress, pinned, error)
      call move_alloc(scale, pinned%scale)
   end subroutine factorise_equilibrated

   !> The smallest singular values, as many as the decision needs.
   subroutine find_low_end(a, request, pinned, low, error)
      type(operator_t), intent(in) :: a
      type(request_t), intent(in) :: request
      type(pinned_t), intent(inout) :: pinned
      type(low_end_t), intent(inout) :: low
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: spanned(:, :), next(:, :), in_pins(:), beyond(:)
      type(first_block_t) :: start
      integer, allocatable :: pin(:)
      logical :: is_shown

      if (pinned%n >= large) call request%progress%report(stage_motions)
      call split_pins(a, pinned, low, pin, error)
      if (allocated(error)) return
      associate (rest => pinned%n - low%local%vectors - size(pin))
         call make_first_block(pinned%n, rest, min(rest, request%values), request%values > 1, start%vectors)
      end associate
      call pinned_space(a, pinned, pin, low%deflated, spanned, in_pins, error, start)
      if (allocated(error)) return
      if (.not. (pinned%is_shifted .or. request%values_only)) then
         if (any(in_pins > low_end*pinned%least) .or. is_weak(spanned(pin, :))) &
            call unpin(a, in_pins, spanned, pin, pinned, start, error)
         if (allocated(error)) return
      end if
      if (pinned%n >= large) call request%progress%report(stage_values)
      call find_beyond(a, request, pinned, in_pins, spanned, start, low, next, beyond, error)
      if (allocated(error)) return
      if (.not. request%values_only .and. &
          any(in_pins > low%decision%tolerance .and. in_pins <= low_end*pinned%least)) then
         call show_values(a, pinned, in_pins, spanned, low%decision%tolerance, is_shown, error)
         if (.not. is_shown) low%confirmed = .false.
      end if
      low%pins = size(pin)
      call gather(a, [in_pins, beyond], spanned, next, low)
      low%bound = pinned%bound
      ! Above that the count is not shown from both sides.
      if (low%decision%tolerance > pinned%bound) low%confirmed = .false.
   end subroutine find_low_end

   !> Values beyond the pins until one is above the tolerance; start: of the first search.
   subroutine find_beyond(a, request, pinned, in_pins, spanned, start, low, next, beyond, error)
      type(operator_t), intent(in) :: a
      type(request_t), intent(in) :: request
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in) :: in_pins(:)
      real(wp), intent(in), contiguous :: spanned(:, :)
      type(first_block_t), intent(inout) :: start
      type(low_end_t), intent(inout) :: low
      real(wp), allocatable, intent(out) :: next(:, :), beyond(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: rest, wanted

      rest = pinned%n - low%local%vectors - size(in_pins)
      wanted = min(rest, request%values)
      do
         call next_space(a, pinned, low%deflated, spanned, wanted, request%values > 1, start, next, beyond, error)
         if (allocated(error)) return
         low%decision = decide_rank(request%rule, [norm_bound(a%by_column), beyond(size(beyond):1:-1), &
                                                   in_pins(size(in_pins):1:-1)])
         if (size(beyond) == rest) exit
         if (beyond(size(beyond)) > low%decision%tolerance) exit
         wanted = min(rest, 4*wanted)
         if (wanted > most_values) then
            low%confirmed = .false.
            exit
         end if
      end do
   end subroutine find_beyond

   !> All vectors side by side, with their images; `spanned` and `next` are given up for them.
   subroutine gather(a, values, spanned, next, low)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: values(:)
      real(wp), allocatable, intent(inout) :: spanned(:, :), next(:, :)
      type(low_end_t), intent(inout) :: low
      integer :: k

      low%values = values
      allocate (low%vectors(a%by_column%columns, size(values)), low%images(a%by_column%rows, size(values)))
      low%vectors(:, :low%pins) = spanned
      low%vectors(:, low%pins + 1:) = next
      deallocate (spanned, next)
      call times_transposed(a%by_row, low%vectors, low%images)
      do k = 1, size(values)
         if (values(k) > 0) low%images(:, k) = low%images(:, k)/values(k)
      end do
   end subroutine gather

   !> Whether pins hold some combination of their vectors (pins, pins) by little.
   logical function is_weak(at_pins)
      real(wp), intent(in) :: at_pins(:, :)
      real(wp) :: copy(size(at_pins, 1), size(at_pins, 2)), values(size(at_pins, 1))
      type(error_t), allocatable :: error

      copy = at_pins
      call singular_values(copy, values, error)
      is_weak = any(values < weak)
   end function is_weak

   !> Let go of pins that hold more than vectors of tiny values, since they would hide
   !> the others, and pin where the vectors are largest. start: what was made of it is so no more.
   subroutine unpin(a, values, vectors, pin, pinned, start, error)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: values(:), vectors(:, :)
      integer, intent(in) :: pin(:)
      type(pinned_t), intent(inout) :: pinned
      type(first_block_t), intent(inout) :: start
      type(error_t), allocatable, intent(out) :: error
      logical :: is_other(size(pinned%pin))
      integer :: k, low

      if (allocated(start%applied)) deallocate (start%applied)
      is_other = [(all(pin /= pinned%pin(k)), k=1, size(pinned%pin))]
      low = count(values <= low_end*pinned%least)
      call repin(vectors(:, :low), pack(pinned%pin, is_other), pinned, error)
   end subroutine unpin

   !> Find the vectors of many pins where they live; `pin` lists the other pins.
   subroutine split_pins(a, pinned, low, pin, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(inout) :: low
      integer, allocatable, intent(out) :: pin(:)
      type(error_t), allocatable, intent(out) :: error
      logical :: is_orthonormal
      integer :: i, most

      call new_sparse_basis(low%local)
      call new_sparse_basis(low%deflated)
      pin = pinned%pin
      if (pinned%pins <= few) return
      most = int(sqrt(merge(most_unshown, most_work, pinned%is_shifted)/pinned%n))
      most = min(most_dense, max(few, most))
      call find_local_vectors(a, pinned%pin, most, low%local, pin)
      call add_scaled_sparse(low%local, [(i, i=1, pinned%n)], [(1.0_wp, i=1, pinned%n)], low%deflated, error, is_orthonormal)
      ! What follows takes the vectors for orthonormal.
      if (.not. is_orthonormal) low%confirmed = .false.
      if (size(pin) <= most) return
      low%confirmed = .false.
      pin = pin(:most)
   end subroutine split_pins
end module flexact_low_end
