! SPDX-License-Identifier: BSD-3-Clause
!> An analysis as flat arrays: what is wished for, and what comes back.
module flexact_result_exchange
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_blas, only: blas_work_t, blas_begin, blas_end, blas_bytes, is_small
   use flexact_components, only: largest_component
   use flexact_determinacy, only: analyse
   use flexact_echelon, only: echelon_t, find_echelon
   use flexact_error, only: error_memory
   use flexact_exchange, only: give_basis, counts_of, unpack_model
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: model_count_t, count_model
   use flexact_problem, only: problem_t
   use flexact_result, only: result_t, options_t, most_pairs
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   implicit none
   private
   public :: run, give_sensitivities, give_echelon, fact_names

   !> What each of the facts is; values of pairs stand behind the last.
   character(len=24), parameter :: fact_names(*) = [character(len=24) :: &
                                                    'error', 'bytes needed', 'rows', 'columns', 'coordinates', &
                                                    'fixed coordinates', 'dependent coordinates', &
                                                    'independent coordinates', 'deformations', 'fixed deformations', &
                                                    'released deformations', 'independent deformations', 'rank', 'method', &
                                                    'confirmed', 'tolerance', 'characteristic length', 'noise', &
                                                    'reach of digits', 'components', 'rows of largest', &
                                                    'columns of largest', 'scaled values', 'pairs', 'motions', &
                                                    'self-stresses', 'proven rank', 'as typed', 'primes', &
                                                    'failure', 'undecided', 'unjudged', 'left', 'explained', &
                                                    'unseen', 'bound', 'fading']

   !> Bytes that an analysis takes besides the factors of D(c): for each row and each column (to
   !> 900 were measured, of chains, lattices and loose bars), and on every occasion. Where the
   !> address space has a limit, they must be there before it begins.
   real(wp), parameter :: bytes_each = 1100.0_wp
   real(wp), parameter :: aside = 16.0e6_wp

contains

   !> Analyse a model within what flexact_blas says of threads and memory; all as for run_with_blas.
   subroutine run(nodes, places, elements, vectors, wishes, stage, index, place, value, by_size, facts)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      real(wp), intent(in) :: wishes(:)
      integer, intent(inout), target :: stage(:)
      integer, intent(inout) :: index(:, :), place(:)
      real(wp), intent(inout) :: value(:), by_size(:, :)
      real(wp), intent(out) :: facts(:)
      type(model_t) :: model
      type(model_count_t) :: counts
      type(blas_work_t) :: work
      real(wp) :: bytes, limited(size(wishes))

      call unpack_model(nodes, places, elements, vectors, model)
      counts = count_model(model%coordinate_class, model%deformation_class)
      bytes = aside + bytes_each*(real(counts%rows, wp) + counts%columns)
      if (blas_begin(is_small(counts%rows, counts%columns), bytes, work) /= 0) then
         facts = 0
         facts(:2) = [real(error_memory, wp), blas_bytes + bytes]
         return
      end if
      limited = wishes
      if (work%limited /= 0) limited(3) = max(0.0_wp, wishes(3) - bytes)
      call run_with_blas(model, limited, stage, index, place, value, by_size, facts)
      call blas_end(work)
      if (work%limited /= 0 .and. nint(facts(1)) == error_memory) facts(2) = facts(2) + bytes
   end subroutine run

   !> Analyse a model. wishes: method, tolerance (negative: from the data), bytes
   !> of memory that may be used, 1 if only the singular values of D(c) itself
   !> are wanted (by sparse the smallest), which come as scaled values then, and
   !> whether the rank is to be proven (flexact_proof), and 1 if numbers are no decimals.
   !> Rows of D(c) stand before its columns in index(:2, i): owner and part of each, from 1;
   !> by_size: scale, singular values, and vectors of pairs.
   !> Vectors of motions, then of self-stresses: vector k begins at index(3, k)
   !> of place (from 0) and value.
   subroutine run_with_blas(model, wishes, stage, index, place, value, by_size, facts)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: wishes(:)
      integer, intent(inout), target :: stage(:)
      integer, intent(inout) :: index(:, :), place(:)
      real(wp), intent(inout) :: value(:), by_size(:, :)
      real(wp), intent(out) :: facts(:)
      type(options_t) :: options
      type(problem_t) :: problem
      type(result_t) :: answer
      integer :: vectors, moving, stressed

      options%method = nint(wishes(1))
      if (wishes(2) >= 0) options%tolerance = wishes(2)
      options%memory = wishes(3)
      options%only_plain_values = wishes(4) > 0
      options%prove = nint(wishes(5))
      options%as_stored = wishes(6) > 0
      options%progress%stage => stage
      call analyse(model, options, problem, answer)
      facts = 0
      if (allocated(answer%error)) facts(1) = answer%error%kind
      facts(2:12) = [answer%bytes, &
                     real([problem%partition%count%rows, problem%partition%count%columns, &
                           counts_of(problem%partition%count%coordinates), &
                           counts_of(problem%partition%count%deformations)], wp)]
      if (allocated(answer%error)) return
      facts(13:15) = [answer%decision%rank, answer%method, merge(1, 0, answer%confirmed)]
      facts(16:19) = [answer%decision%tolerance, problem%scaling%characteristic_length, answer%decision%noise, &
                      problem%scaling%reach_of_digits]
      facts(20:22) = [problem%components%count, largest_component(problem%components)]
      call give_labels(problem, index)
      call give_values(problem, answer, by_size, facts)
      vectors = 0
      index(3, 1) = 0
      call give_basis(answer%motions, problem%partition%count%rows, index(3, :), place, value, vectors, moving)
      call give_basis(answer%stresses, 0, index(3, :), place, value, vectors, stressed)
      facts(25:26) = [moving, stressed]
      associate (proof => answer%proof)
         facts(27:30) = [real(proof%total(), wp), merge(1.0_wp, 0.0_wp, proof%as_typed), &
                         merge(-1.0_wp, real(proof%primes, wp), proof%is_too_large), proof%failure]
      end associate
      facts(31:32) = [answer%undecided, merge(1, 0, answer%unjudged)]
      facts(33:35) = [answer%left, answer%explained, real(answer%unseen, wp)]
      facts(36:37) = [answer%bound, real(answer%fading, wp)]
   end subroutine run_with_blas

   !> As find_sensitivities in bindings.f90 says; nothing where sizes do not fit.
   subroutine give_sensitivities(nodes, places, elements, vectors, modes, pair, effect, place, used)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      real(wp), intent(in) :: modes(:, :)
      integer, intent(in) :: pair(:, :)
      real(wp), intent(out) :: effect(:, :)
      integer, intent(out) :: place(:, :), used
      type(model_t) :: model
      type(model_count_t) :: counts
      type(sensitivity_t) :: found(size(pair, 2))
      integer :: i

      effect = 0
      place = 0
      call unpack_model(nodes, places, elements, vectors, model)
      counts = count_model(model%coordinate_class, model%deformation_class)
      used = counts%rows + counts%columns
      if (used /= size(modes, 1) .or. any(pair < 1) .or. any(pair > size(modes, 2))) return
      call find_sensitivities(model, modes(:counts%rows, :), modes(counts%rows + 1:, :), pair, found)
      do i = 1, size(found)
         associate (f => found(i))
            effect(:, i) = [f%lift_of_bits, f%lift_of_digits, f%lift_of_storing, f%by_move, f%by_turn]
            place(:, i) = [f%node, f%element]
         end associate
      end do
   end subroutine give_sensitivities

   !> The reduced echelon form of D(c) modulo a prime. wishes: number of the prime, 1 if numbers
   !> are no decimals, 1 for the transpose. pivot: of each of its columns 1 where some row begins.
   !> place: for the other entries that are not zero the column, the one where their row
   !> begins, and the residue in two parts of 31 bits. facts: the prime in two parts,
   !> 1 if of decimals, columns, and entries, of which as many as fit are given.
   subroutine give_echelon(nodes, places, elements, vectors, wishes, pivot, place, facts)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      integer, intent(in) :: wishes(:)
      integer, intent(inout) :: pivot(:), place(:, :)
      integer, intent(out) :: facts(:)
      type(model_t) :: model
      type(echelon_t) :: echelon
      integer :: i, j, used

      call unpack_model(nodes, places, elements, vectors, model)
      call find_echelon(model, wishes(1), wishes(2) > 0, wishes(3) > 0, echelon)
      pivot = 0
      used = 0
      do i = 1, echelon%rank
         pivot(echelon%pivot(i)) = 1
      end do
      do j = 1, size(echelon%entry, 1)
         if (pivot(j) > 0) cycle
         do i = 1, echelon%rank
            if (echelon%entry(j, i) == 0) cycle
            used = used + 1
            if (used <= size(place, 2)) place(:, used) = [j - 1, echelon%pivot(i) - 1, halves(echelon%entry(j, i))]
         end do
      end do
      facts = [halves(echelon%prime), merge(1, 0, echelon%as_typed), size(echelon%entry, 1), used]
   end subroutine give_echelon

   !> 62 bits as two whole numbers.
   pure function halves(number)
      integer(int64), intent(in) :: number
      integer :: halves(2)
      halves = int([ishft(number, -31), iand(number, int(huge(1), int64))])
   end function halves

   pure subroutine give_labels(problem, index)
      type(problem_t), intent(in) :: problem
      integer, intent(inout) :: index(:, :)

      associate (m => problem%partition%count%rows, n => problem%partition%count%columns)
         index(:2, :m) = problem%partition%row_label
         index(:2, m + 1:m + n) = problem%partition%column_label
      end associate
   end subroutine give_labels

   pure subroutine give_values(problem, answer, by_size, facts)
      type(problem_t), intent(in) :: problem
      type(result_t), intent(in) :: answer
      real(wp), intent(inout) :: by_size(:, :), facts(:)

      associate (m => problem%partition%count%rows, n => problem%partition%count%columns, &
                 scaled => size(answer%scaled_values), &
                 pairs => min(most_pairs, size(answer%pair_value)))
         by_size(:m, 1) = problem%scaling%row
         by_size(m + 1:m + n, 1) = problem%scaling%column
         by_size(:scaled, 2) = abs(answer%scaled_values)
         by_size(:m, 3:pairs + 2) = answer%pair_stress(:, :pairs)
         by_size(m + 1:m + n, 3:pairs + 2) = answer%pair_motion(:, :pairs)
         facts(23:24) = [scaled, pairs]
         facts(size(fact_names) + 1:size(fact_names) + pairs) = answer%pair_value(:pairs)
      end associate
   end subroutine give_values
end module flexact_result_exchange
