! SPDX-License-Identifier: BSD-3-Clause
!> An analysis as flat arrays, which bindings.f90 explains: what is asked, and what comes back.
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
   use flexact_result, only: result_t, options_t
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   implicit none
   private
   public :: run, give_sensitivities, give_echelon, fact_names

   !> What each of the facts is.
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

   !> Analyse a model within what flexact_blas says of threads and memory.
   subroutine run(nodes, places, elements, vectors, method, tolerance, memory, only_plain_values, prove, as_stored, stage, label, &
                  first, place, value, scale, scaled_value, pair_vector, facts, pair_value)
      integer, intent(in) :: nodes(:, :), elements(:, :), method, prove
      real(wp), intent(in) :: places(:, :), vectors(:, :), tolerance, memory
      logical, intent(in) :: only_plain_values, as_stored
      integer, intent(inout), target :: stage(:)
      integer, intent(inout) :: label(:, :), first(:), place(:)
      real(wp), intent(inout) :: value(:), scale(:), scaled_value(:), pair_vector(:, :)
      real(wp), intent(out) :: facts(:), pair_value(:)
      type(model_t) :: model
      type(model_count_t) :: counts
      type(options_t) :: options
      type(problem_t) :: problem
      type(result_t) :: answer
      type(blas_work_t) :: work
      real(wp) :: bytes
      integer :: vectors_given, moving, stressed, pairs

      facts = 0
      pair_value = 0
      call unpack_model(nodes, places, elements, vectors, model)
      counts = count_model(model%coordinate_class, model%deformation_class)
      bytes = aside + bytes_each*(real(counts%rows, wp) + counts%columns)
      if (blas_begin(is_small(counts%rows, counts%columns), bytes, work) /= 0) then
         facts(:2) = [real(error_memory, wp), blas_bytes + bytes]
         return
      end if
      options%method = method
      if (tolerance >= 0) options%tolerance = tolerance
      options%memory = memory
      if (work%limited /= 0) options%memory = max(0.0_wp, memory - bytes)
      options%only_plain_values = only_plain_values
      options%prove = prove
      options%as_stored = as_stored
      options%progress%stage => stage
      call analyse(model, options, problem, answer)
      call blas_end(work)
      if (allocated(answer%error)) then
         facts(:12) = facts_of_size(problem, answer)
         if (work%limited /= 0 .and. answer%error%kind == error_memory) facts(2) = facts(2) + bytes
         return
      end if
      associate (m => problem%partition%count%rows, n => problem%partition%count%columns)
         pairs = min(size(pair_value), size(answer%pair_value))
         label(:, :m) = problem%partition%row_label
         label(:, m + 1:m + n) = problem%partition%column_label
         scale(:m) = problem%scaling%row
         scale(m + 1:m + n) = problem%scaling%column
         scaled_value(:size(answer%scaled_values)) = abs(answer%scaled_values)
         pair_value(:pairs) = answer%pair_value(:pairs)
         pair_vector(:m, :pairs) = answer%pair_stress(:, :pairs)
         pair_vector(m + 1:m + n, :pairs) = answer%pair_motion(:, :pairs)
         vectors_given = 0
         first(1) = 0
         call give_basis(answer%motions, m, first, place, value, vectors_given, moving)
         call give_basis(answer%stresses, 0, first, place, value, vectors_given, stressed)
      end associate
      associate (proof => answer%proof)
         facts = [facts_of_size(problem, answer), real([answer%decision%rank, answer%method, merge(1, 0, answer%confirmed)], wp), &
                  answer%decision%tolerance, problem%scaling%characteristic_length, answer%decision%noise, &
                  problem%scaling%reach_of_digits, &
                  real([problem%components%count, largest_component(problem%components), size(answer%scaled_values), pairs, &
                        moving, stressed, proof%total(), merge(1, 0, proof%as_typed), &
                        merge(-1, proof%primes, proof%is_too_large)], wp), proof%failure, &
                  real([answer%undecided, merge(1, 0, answer%unjudged)], wp), answer%left, answer%explained, &
                  real(answer%unseen, wp), answer%bound, real(answer%fading, wp)]
      end associate
   end subroutine run

   !> The facts that are known also where an analysis fails.
   pure function facts_of_size(problem, answer) result(facts)
      type(problem_t), intent(in) :: problem
      type(result_t), intent(in) :: answer
      real(wp) :: facts(12)

      facts(1) = 0
      if (allocated(answer%error)) facts(1) = answer%error%kind
      associate (count => problem%partition%count)
         facts(2:) = [answer%bytes, real([count%rows, count%columns, counts_of(count%coordinates), &
                                          counts_of(count%deformations)], wp)]
      end associate
   end function facts_of_size

   !> Nothing where sizes do not fit.
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

   subroutine give_echelon(nodes, places, elements, vectors, number, as_stored, is_transposed, pivot, entry, prime, as_typed, used)
      integer, intent(in) :: nodes(:, :), elements(:, :), number
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      logical, intent(in) :: as_stored, is_transposed
      integer, intent(inout) :: pivot(:), entry(:, :)
      integer, intent(out) :: prime(:), as_typed, used
      type(model_t) :: model
      type(echelon_t) :: echelon
      integer :: i, j

      call unpack_model(nodes, places, elements, vectors, model)
      call find_echelon(model, number, as_stored, is_transposed, echelon)
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
            if (used <= size(entry, 2)) entry(:, used) = [j - 1, echelon%pivot(i) - 1, halves(echelon%entry(j, i))]
         end do
      end do
      prime = halves(echelon%prime)
      as_typed = merge(1, 0, echelon%as_typed)
   end subroutine give_echelon

   !> 62 bits as two whole numbers.
   pure function halves(number)
      integer(int64), intent(in) :: number
      integer :: halves(2)
      halves = int([ishft(number, -31), iand(number, int(huge(1), int64))])
   end function halves
end module flexact_result_exchange
