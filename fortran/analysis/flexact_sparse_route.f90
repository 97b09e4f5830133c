!> Rank and null spaces part by part from pinned Cholesky factorisations.
!>
!> Two independent routes lead to the count of zeros of a part: vectors that D(c)
!> itself sends to zero show that there are so many, and a factorisation that
!> runs to its end shows that there are no more (`flexact_pinned`).
module flexact_sparse_route
   use flexact_kinds, only: wp
   use flexact_answer, only: options_t, answer_t, most_pairs, &
                             stage_motions, stage_stresses, stage_values
   use flexact_decomposition, only: singular_values, status_fine, status_no_convergence
   use flexact_basis, only: basis_t, new_basis
   use flexact_local, only: find_local_vectors, find_scattered_vectors
   use flexact_modes, only: untangle, add_modes, add_sparse_modes
   use flexact_null_space, only: operator_t, seek_pins, repin, low_end, pinned_space, next_space, &
                                 left_null_space, not_found
   use flexact_pairs, only: offer_pair
   use flexact_parts, only: shape_of
   use flexact_pinned, only: pinned_t, make_pinned, lift_and_mark, apply_inverse, release, pinned_fine, pinned_not_definite
   use flexact_problem, only: problem_t
   use flexact_rank, only: rank_t, decide_rank
   use flexact_sort, only: sort_descending
   use flexact_sparse, only: sparse_t, part_of, transposed, times_transposed, norm_bound
   use flexact_vectors, only: length_of
   implicit none
   private
   public :: analyse_sparse

   !> A part, or its transpose, so that there are no fewer rows than columns, or
   !> only a few in a large one.
   type :: part_t
      logical :: is_turned = .false.
      type(operator_t) :: matrix
      !> Where the rows and columns of the matrix stand in D(c), and which of its
      !> columns belong to one node (or element).
      integer, allocatable :: row(:), column(:), group(:)
   end type part_t

   !> The low end of a part: values ascend; vectors (columns, k) and the directions
   !> of their images (rows, k). The first `pins` of them span what was pinned.
   type :: low_end_t
      integer :: pins = 0
      !> Vectors with the value zero that live on few columns, beside those, and the
      !> same made orthonormal.
      type(basis_t) :: local, apart
      real(wp), allocatable :: values(:), vectors(:, :), images(:, :)
      type(rank_t) :: decision
   end type low_end_t

   !> From this size on a part is gone through once, with all care.
   integer, parameter :: large = 500
   integer, parameter :: most_values = 256
   !> So many pins are dealt with together; more where they live.
   integer, parameter :: few = 16
   integer, parameter :: most_dense = 800
   real(wp), parameter :: most_entries = 5.0e7_wp
   !> Of more vectors of the longer side than these, and than that much work turns
   !> into a basis, the first are given.
   integer, parameter :: most_left = 64
   real(wp), parameter :: most_work = 5.0e7_wp
   integer, parameter :: first_left = 6
   !> Less of a unit vector at the pins is little.
   real(wp), parameter :: weak = 0.05_wp

contains

   subroutine analyse_sparse(problem, options, answer)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(answer_t), intent(inout) :: answer
      integer :: candidate(most_pairs), i, missing
      real(wp) :: lowest(most_pairs), estimate
      real(wp), allocatable :: zeros(:)
      integer, allocatable :: new_row(:)
      logical :: careful

      allocate (zeros(0))
      allocate (new_row(max(problem%by_column%rows, problem%by_column%columns)), source=0)
      candidate = 0
      lowest = huge(1.0_wp)
      do i = 1, problem%parts%count
         careful = problem%parts%count <= most_pairs .or. minval(shape_of(problem%parts, i)) >= large
         call take_part(problem, options, i, careful, .true., new_row, answer, zeros, estimate)
         if (answer%status /= status_fine) return
         if (.not. careful) call keep_lowest(estimate, i, lowest, candidate)
      end do
      do i = 1, most_pairs
         if (candidate(i) == 0) exit
         call take_part(problem, options, candidate(i), .true., .false., new_row, answer, zeros, estimate)
         if (answer%status /= status_fine) return
      end do
      call sort_descending(zeros)
      ! Zeros of a matrix whose parts are not all of full shape.
      missing = min(problem%by_column%rows, problem%by_column%columns)
      do i = 1, problem%parts%count
         missing = missing - minval(shape_of(problem%parts, i))
      end do
      answer%scaled_values = [answer%pair_value(size(answer%pair_value):1:-1), zeros, [(0.0_wp, i=1, missing)]]
      allocate (answer%singular_values(0))
   end subroutine analyse_sparse

   !> Keep a part among those whose smallest non-zero values are the smallest.
   pure subroutine keep_lowest(estimate, part, lowest, candidate)
      real(wp), intent(in) :: estimate
      integer, intent(in) :: part
      real(wp), intent(inout) :: lowest(:)
      integer, intent(inout) :: candidate(:)
      integer :: at

      at = count(lowest <= estimate) + 1
      if (at > size(lowest)) return
      lowest(at + 1:) = lowest(at:size(lowest) - 1)
      candidate(at + 1:) = candidate(at:size(candidate) - 1)
      lowest(at) = estimate
      candidate(at) = part
   end subroutine keep_lowest

   !> Count the zeros of part i, add its modes, and offer its smallest non-zero
   !> values, where it is gone through with care; else only estimate the smallest.
   !> first_time: the zeros and modes have not been taken yet.
   subroutine take_part(problem, options, i, careful, first_time, new_row, answer, zeros, estimate)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      integer, intent(in) :: i
      logical, intent(in) :: careful, first_time
      integer, intent(inout) :: new_row(:)
      type(answer_t), intent(inout) :: answer
      real(wp), allocatable, intent(inout) :: zeros(:)
      real(wp), intent(out) :: estimate
      type(part_t) :: part
      type(pinned_t) :: pinned
      type(low_end_t) :: low
      real(wp), allocatable :: found(:)
      integer :: rank, k

      estimate = huge(estimate)
      call make_part(problem, i, new_row, part)
      if (size(part%column) == 0) then
         if (first_time) call add_unit(part, answer)
         return
      end if
      call pin_part(part, options, pinned, answer)
      if (answer%status == pinned_fine) then
         call find_low_end(part, pinned, problem, options, careful, low, answer)
         if (answer%status == status_fine .and. first_time .and. .not. options%only_plain_values) &
            call add_null_spaces(problem, options, part, pinned, low, answer)
         ! Above t the count is not proven from both sides.
         if (low%decision%tolerance > pinned%least) answer%confirmed = .false.
      end if
      answer%bytes = pinned%bytes
      call release(pinned)
      if (answer%status == not_found .or. answer%status == pinned_not_definite) answer%status = status_no_convergence
      if (answer%status /= status_fine) return
      rank = count(low%values > low%decision%tolerance)
      if (first_time) then
         found = [[(0.0_wp, k=1, low%local%vectors)], pack(low%values, low%values <= low%decision%tolerance)]
         ! Columns beyond the number of rows have no singular values.
         zeros = [zeros, found(max(0, size(part%column) - size(part%row)) + 1:)]
         answer%decision%rank = answer%decision%rank + size(part%column) - (size(low%values) - rank) - low%local%vectors
         answer%decision%noise = max(answer%decision%noise, low%decision%noise)
         answer%decision%tolerance = max(answer%decision%tolerance, low%decision%tolerance)
      end if
      if (rank > 0) estimate = minval(low%values, low%values > low%decision%tolerance)
      if (careful) call offer_all(part, low, answer)
   end subroutine take_part

   !> Factorise a part. Columns of D(c) itself are of several units: they are made
   !> equally long first.
   subroutine pin_part(part, options, pinned, answer)
      type(part_t), intent(in) :: part
      type(options_t), intent(in) :: options
      type(pinned_t), intent(out) :: pinned
      type(answer_t), intent(inout) :: answer
      type(sparse_t) :: by_column, by_row
      real(wp), allocatable :: scale(:)
      integer :: j

      if (.not. options%only_plain_values) then
         call make_pinned(part%matrix%by_column, part%matrix%by_row, part%group, options, pinned, answer%status)
         if (answer%status == pinned_not_definite) call seek_pins(part%matrix, pinned, answer%status)
         if (answer%status /= not_found .and. answer%status /= pinned_not_definite) return
         ! What the low end is then is not shown by two routes.
         answer%confirmed = .false.
         call lift_and_mark(pinned, answer%status)
         return
      end if
      by_column = part%matrix%by_column
      allocate (scale(by_column%columns))
      do j = 1, by_column%columns
         associate (from => by_column%start(j), to => by_column%start(j + 1) - 1)
            scale(j) = length_of(by_column%value(from:to))
            by_column%value(from:to) = by_column%value(from:to)/scale(j)
         end associate
      end do
      call transposed(by_column, by_row)
      call make_pinned(by_column, by_row, part%group, options, pinned, answer%status)
      call move_alloc(scale, pinned%scale)
   end subroutine pin_part

   !> Cut part i out of the scaled matrix.
   pure subroutine make_part(problem, i, new_row, part)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i
      integer, intent(inout) :: new_row(:)
      type(part_t), intent(out) :: part
      integer :: j

      associate (p => problem%parts)
         part%row = p%row(p%row_start(i):p%row_start(i + 1) - 1)
         part%column = p%column(p%column_start(i):p%column_start(i + 1) - 1)
      end associate
      part%is_turned = size(part%row) < size(part%column)
      if (size(part%row) >= large .and. size(part%column) - size(part%row) <= few) part%is_turned = .false.
      if (part%is_turned) call swap(part%row, part%column)
      new_row(part%row) = [(j, j=1, size(part%row))]
      allocate (part%group(size(part%column)))
      if (part%is_turned) then
         call part_of(problem%by_row, size(part%row), part%column, new_row, part%matrix%by_column)
         call number_groups(problem%partition%row_label(1, part%column), part%group)
      else
         call part_of(problem%by_column, size(part%row), part%column, new_row, part%matrix%by_column)
         call number_groups(problem%partition%column_label(1, part%column), part%group)
      end if
      call transposed(part%matrix%by_column, part%matrix%by_row)
   end subroutine make_part

   pure subroutine swap(a, b)
      integer, allocatable, intent(inout) :: a(:), b(:)
      integer, allocatable :: c(:)

      call move_alloc(a, c)
      call move_alloc(b, a)
      call move_alloc(c, b)
   end subroutine swap

   !> Number the runs of equal labels.
   pure subroutine number_groups(label, group)
      integer, intent(in) :: label(:)
      integer, intent(out) :: group(:)
      integer :: j

      do j = 1, size(label)
         if (j == 1) then
            group(j) = 1
         else
            group(j) = group(j - 1) + merge(0, 1, label(j) == label(j - 1))
         end if
      end do
   end subroutine number_groups

   !> A row without columns is a self-stress by itself, a column without rows a motion.
   pure subroutine add_unit(part, answer)
      type(part_t), intent(in) :: part
      type(answer_t), intent(inout) :: answer

      if (part%is_turned) then
         call answer%motions%add(part%row, [1.0_wp])
      else
         call answer%stresses%add(part%row, [1.0_wp])
      end if
   end subroutine add_unit

   !> The smallest singular values, as many as the decision needs.
   subroutine find_low_end(part, pinned, problem, options, careful, low, answer)
      type(part_t), intent(in) :: part
      type(pinned_t), intent(inout) :: pinned
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      logical, intent(in) :: careful
      type(low_end_t), intent(out) :: low
      type(answer_t), intent(inout) :: answer
      real(wp), allocatable :: spanned(:, :), next(:, :), in_pins(:), beyond(:)
      integer, allocatable :: pin(:)
      integer :: rest, wanted, k

      if (size(part%column) >= large) call options%tell(stage_motions, 0, 1)
      call split_pins(part, pinned, low, pin, answer)
      if (answer%status /= status_fine) return
      call pinned_space(part%matrix, pinned, pin, low%apart, spanned, in_pins, answer%status)
      if (answer%status /= status_fine) return
      if (.not. (pinned%is_lifted .or. options%only_plain_values) .and. &
          (any(in_pins > low_end*pinned%least) .or. is_weak(spanned(pin, :)))) then
         call unpin(part, in_pins, spanned, pin, pinned, answer)
         if (answer%status /= status_fine) return
      end if
      if (size(part%column) >= large) call options%tell(stage_values, 0, 1)
      rest = size(part%column) - low%local%vectors - size(pin)
      wanted = min(rest, merge(most_pairs, 1, careful))
      do
         call next_space(part%matrix, pinned, low%apart, spanned, wanted, careful, next, beyond, answer%status)
         if (answer%status /= status_fine) return
         low%decision = decide_rank(problem%scaling, [norm_bound(part%matrix%by_column), beyond(size(beyond):1:-1), &
                                                      in_pins(size(pin):1:-1)], options%tolerance)
         if (size(beyond) == rest) exit
         if (beyond(size(beyond)) > low%decision%tolerance) exit
         wanted = min(rest, 4*wanted)
         if (wanted > most_values) then
            answer%confirmed = .false.
            exit
         end if
      end do
      low%pins = size(pin)
      if (.not. options%only_plain_values .and. &
          any(in_pins > low%decision%tolerance .and. in_pins <= low_end*pinned%least)) &
         call prove_values(part, pinned, in_pins, spanned, low%decision%tolerance, answer)
      low%values = [in_pins, beyond]
      allocate (low%vectors(size(part%column), size(low%values)))
      low%vectors(:, :low%pins) = spanned
      low%vectors(:, low%pins + 1:) = next
      allocate (low%images(size(part%row), size(low%values)))
      call times_transposed(part%matrix%by_row, low%vectors, low%images)
      do k = 1, size(low%values)
         if (low%values(k) > 0) low%images(:, k) = low%images(:, k)/low%values(k)
      end do
   end subroutine find_low_end

   !> The count of zeros among what pins hold hangs on the other values there: of
   !> each of them the residual must be well below it.
   subroutine prove_values(part, pinned, values, vectors, tolerance, answer)
      type(part_t), intent(in) :: part
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in) :: values(:), tolerance
      real(wp), intent(in), contiguous :: vectors(:, :)
      type(answer_t), intent(inout) :: answer
      real(wp), dimension(size(part%row), 1) :: image, step
      real(wp) :: residual(size(part%column), 1)
      integer :: k, round

      do k = 1, size(values)
         if (values(k) <= tolerance) cycle
         call times_transposed(part%matrix%by_row, vectors(:, k:k), image)
         do round = 1, 2
            image = image/length_of(image(:, 1))
            call times_transposed(part%matrix%by_column, image, residual)
            residual = residual - values(k)*vectors(:, k:k)
            if (length_of(residual(:, 1)) <= values(k)/2) exit
            if (round == 2) then
               answer%confirmed = .false.
               return
            end if
            ! A tiny image is rounding in good part, which is taken from it.
            call apply_inverse(pinned, residual, answer%status)
            if (answer%status /= status_fine) return
            call times_transposed(part%matrix%by_row, residual, step)
            image = image - step
         end do
      end do
   end subroutine prove_values

   !> Whether pins hold some combination of their vectors (pins, pins) by little.
   logical function is_weak(at_pins)
      real(wp), intent(in) :: at_pins(:, :)
      real(wp) :: part(size(at_pins, 1), size(at_pins, 2)), values(size(at_pins, 1))
      integer :: status

      part = at_pins
      call singular_values(part, values, status)
      is_weak = any(values < weak)
   end function is_weak

   !> Let go of pins that hold more than vectors of tiny values, since they would hide
   !> the others, and pin where the vectors are largest.
   subroutine unpin(part, values, vectors, pin, pinned, answer)
      type(part_t), intent(in) :: part
      real(wp), intent(in) :: values(:), vectors(:, :)
      integer, intent(in) :: pin(:)
      type(pinned_t), intent(inout) :: pinned
      type(answer_t), intent(inout) :: answer
      logical :: is_other(size(pinned%pin))
      integer :: k, low

      is_other = [(all(pin /= pinned%pin(k)), k=1, size(pinned%pin))]
      low = count(values <= low_end*pinned%least)
      call repin(part%matrix, vectors(:, :low), pack(pinned%pin, is_other), pinned, answer%status)
   end subroutine unpin

   !> Find the vectors of many pins where they live; `pin` lists the other pins.
   subroutine split_pins(part, pinned, low, pin, answer)
      type(part_t), intent(in) :: part
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(inout) :: low
      integer, allocatable, intent(out) :: pin(:)
      type(answer_t), intent(inout) :: answer
      logical :: is_orthonormal
      integer :: i, most

      call new_basis(low%local)
      call new_basis(low%apart)
      pin = pinned%pin
      if (pinned%pins <= few) return
      call find_local_vectors(part%matrix, pinned%pin, low%local, pin)
      call add_sparse_modes(low%local, [(i, i=1, size(part%column))], [(1.0_wp, i=1, size(part%column))], low%apart, &
                            answer%status, is_orthonormal)
      ! What follows takes the vectors for orthonormal.
      if (.not. is_orthonormal) answer%confirmed = .false.
      most = min(most_dense, max(few, int(most_entries/size(part%column))))
      if (size(pin) <= most) return
      answer%confirmed = .false.
      pin = pin(:most)
   end subroutine split_pins

   !> Add the vectors of both null spaces to the answer.
   subroutine add_null_spaces(problem, options, part, pinned, low, answer)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(part_t), intent(in) :: part
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(in) :: low
      type(answer_t), intent(inout) :: answer
      real(wp), allocatable :: right(:, :), left(:, :)
      type(basis_t) :: many
      logical :: is_zero(size(low%values))
      integer :: k

      is_zero = low%values <= low%decision%tolerance
      right = low%vectors(:, pack([(k, k=1, size(is_zero))], is_zero))
      if (size(part%column) >= large) call options%tell(stage_stresses, 0, 1)
      call new_basis(many)
      call find_left(part, pinned, low, is_zero, left, many, answer%status)
      if (answer%status == not_found) then
         answer%confirmed = .false.
         answer%status = status_fine
      end if
      if (answer%status /= status_fine) return
      call untangle(right)
      call untangle(left)
      associate (scaling => problem%scaling)
         if (part%is_turned) then
            call add_both(low%local, right, part%column, scaling%row(part%column), answer%stresses, answer%status)
            call add_both(many, left, part%row, scaling%column(part%row), answer%motions, answer%status)
         else
            call add_both(low%local, right, part%column, scaling%column(part%column), answer%motions, answer%status)
            call add_both(many, left, part%row, scaling%row(part%row), answer%stresses, answer%status)
         end if
      end associate
   end subroutine add_null_spaces

   subroutine add_both(sparse, dense, place, scale, basis, status)
      type(basis_t), intent(in) :: sparse
      real(wp), intent(inout) :: dense(:, :)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(basis_t), intent(inout) :: basis
      integer, intent(inout) :: status
      type(basis_t) :: both
      integer :: i, k

      if (status /= status_fine) return
      if (sparse%vectors == 0) then
         call add_modes(dense, place, scale, basis, status)
         return
      end if
      both = sparse
      do k = 1, size(dense, 2)
         associate (there => abs(dense(:, k)) > 0)
            call both%add(pack([(i, i=1, size(place))], there), pack(dense(:, k), there))
         end associate
      end do
      call add_sparse_modes(both, place, scale, basis, status)
   end subroutine add_both

   !> The left null space: a few vectors, or of very many some that are local.
   subroutine find_left(part, pinned, low, is_zero, left, many, status)
      type(part_t), intent(in) :: part
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(in) :: low
      logical, intent(in) :: is_zero(:)
      real(wp), allocatable, intent(out) :: left(:, :)
      type(basis_t), intent(inout) :: many
      integer, intent(out) :: status
      real(wp), allocatable :: projected(:, :)
      logical :: is_held(size(is_zero))
      integer, allocatable :: known(:), images(:)
      logical :: is_few
      integer :: k, wanted

      status = status_fine
      is_held = [(k <= low%pins .and. low%values(k) <= low_end*pinned%least, k=1, size(is_zero))]
      known = pack([(k, k=1, size(is_zero))], is_held .and. .not. is_zero)
      ! Of what counts as zero though no pin holds it, the images are the left vectors.
      images = pack([(k, k=1, size(is_zero))], is_zero .and. .not. is_held)
      wanted = size(part%row) - size(part%column) + low%local%vectors + count(is_held .and. is_zero)
      is_few = wanted <= most_left .or. size(part%row)*real(wanted, wp)**2 <= most_work
      if (.not. is_few .and. size(images) == 0) then
         call find_scattered_vectors(operator_t(part%matrix%by_row, part%matrix%by_column), first_left, many)
         if (many%vectors > 0) then
            allocate (left(size(part%row), 0))
            return
         end if
      end if
      call left_null_space(part%matrix, pinned, low%images(:, known), merge(wanted, first_left, is_few), &
                           projected, status)
      if (status /= status_fine .and. status /= not_found) return
      if (status == not_found) projected = projected(:, :0)
      allocate (left(size(part%row), size(projected, 2) + size(images)))
      left(:, :size(projected, 2)) = projected
      left(:, size(projected, 2) + 1:) = low%images(:, images)
   end subroutine find_left

   pure subroutine offer_all(part, low, answer)
      type(part_t), intent(in) :: part
      type(low_end_t), intent(in) :: low
      type(answer_t), intent(inout) :: answer
      integer :: k

      do k = 1, size(low%values)
         if (low%values(k) <= low%decision%tolerance) cycle
         if (part%is_turned) then
            call offer_pair(answer, low%values(k), part%row, low%images(:, k), part%column, low%vectors(:, k))
         else
            call offer_pair(answer, low%values(k), part%column, low%vectors(:, k), part%row, low%images(:, k))
         end if
      end do
   end subroutine offer_all
end module flexact_sparse_route
