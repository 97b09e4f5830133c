! SPDX-License-Identifier: BSD-3-Clause
!> Many variants of a model: their ranks, whether there is a doubt in them, and the values that
!> tell how near another rank is, each by the cheapest route that can confirm it.
module flexact_variants
   use flexact_determinacy, only: analyse
   use flexact_error, only: error_t
   use flexact_full_rank, only: make_dense_gram, is_above
   use flexact_geometry, only: is_sound
   use flexact_gram_lanes, only: lanes, gram_pattern_t, make_gram_pattern, make_gram, find_above, traces_of
   use flexact_kinds, only: wp
   use flexact_lowest_pairs, only: lowest_pairs, find_ends
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t
   use flexact_problem, only: problem_t
   use flexact_problem_lanes, only: layout_t, make_layout, problem_lanes_t, new_problem_lanes, take_variant, scale_lanes, &
                                    scaling_of, matrix_of, plain_matrix_of
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaling, only: scaling_t
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   use flexact_slots, only: axes, has_axis, is_position
   use flexact_zero_margins, only: zero_limits_t, find_zero_changes
   implicit none
   private
   public :: analyse_variants, variant_t, question_t

   !> Up to these sides a matrix is looked at as a whole.
   integer, parameter :: small_side = 200, small_longer_side = 600

   !> What is asked of each variant.
   type :: question_t
      !> Values up to this multiple of the noise are near.
      real(wp) :: near = 0.0_wp
      !> Values up to this multiple of what digits may make are in doubt; and no more than
      !> this can a digit make.
      real(wp) :: cut_off = 0.0_wp, most_reach = 0.0_wp
      !> Whether values and margins are wanted beside the rank.
      logical :: with_values = .false.
      type(zero_limits_t) :: zeros
      type(options_t) :: options
   end type question_t

   !> What is known of a variant.
   type :: variant_t
      !> Whether the rank is known and nothing is in doubt; else a complete analysis is needed.
      logical :: is_decided = .false.
      integer :: rank = 0
      !> The largest value of the scaled matrix that counts as zero, negative without one.
      real(wp) :: largest_zero = -1.0_wp
      !> Whether the move of one node, or the turn of one element, lifts some zero.
      logical :: zero_moves = .false., zero_turns = .false.
      !> Of D(c) itself; negative where it is not known.
      real(wp) :: smallest = -1.0_wp, largest = -1.0_wp
      real(wp) :: characteristic_length = 1.0_wp
      !> The smallest values of the scaled matrix that are not zero, ascending, and what each
      !> changes by a move of one node and by a turn of one element.
      integer :: pairs = 0
      real(wp) :: value(most_pairs) = 0.0_wp, by_move(most_pairs) = 0.0_wp, by_turn(most_pairs) = 0.0_wp
   end type variant_t

contains

   !> Variants that differ in places alone, (3, nodes, variants), or in nothing, (3, nodes, 1).
   subroutine analyse_variants(model, partition, place, question, variant)
      type(model_t), intent(inout) :: model
      type(partition_t), intent(in) :: partition
      real(wp), intent(in) :: place(:, :, :)
      type(question_t), intent(in) :: question
      type(variant_t), intent(out) :: variant(:)
      type(layout_t) :: layout
      type(gram_pattern_t) :: pattern
      type(problem_lanes_t) :: problem
      logical :: is_small
      integer :: first, width

      associate (m => partition%count%rows, n => partition%count%columns)
         is_small = min(m, n) > 0 .and. min(m, n) <= small_side .and. max(m, n) <= small_longer_side
      end associate
      ! The pattern of the factor takes as long as some variants.
      width = merge(lanes, 1, is_small .and. size(variant) >= lanes)
      if (is_small) then
         call make_layout(model, partition, layout)
         if (width > 1) call make_gram_pattern(layout%rows, layout%columns, layout%row, layout%column, pattern)
         call new_problem_lanes(layout, width, problem)
      end if
      do first = 1, size(variant), width
         associate (some => variant(first:min(first + width - 1, size(variant))))
            if (is_small) then
               call analyse_block(model, partition, layout, pattern, place, first, question, problem, some)
            else
               call place_nodes(place, first, model)
               if (is_sound(model)) call analyse_completely(model, question, some(1))
            end if
         end associate
      end do
   end subroutine analyse_variants

   !> What stands for other nodes than positions, and for z in the plane, is passed over.
   pure subroutine place_nodes(place, variant, model)
      real(wp), intent(in) :: place(:, :, :)
      integer, intent(in) :: variant
      type(model_t), intent(inout) :: model
      integer :: node, axis, i

      i = min(variant, size(place, 3))
      do node = 1, model%nodes
         if (.not. is_position(model%node_kind(node))) cycle
         do axis = 1, axes
            if (has_axis(model%node_kind(node), axis)) model%node_value(axis, node) = place(axis, node, i)
         end do
      end do
   end subroutine place_nodes

   subroutine analyse_block(model, partition, layout, pattern, place, first, question, problem, variant)
      type(model_t), intent(inout) :: model
      type(partition_t), intent(in) :: partition
      type(layout_t), intent(in) :: layout
      type(gram_pattern_t), intent(in) :: pattern
      real(wp), intent(in) :: place(:, :, :)
      integer, intent(in) :: first
      type(question_t), intent(in) :: question
      type(problem_lanes_t), intent(inout) :: problem
      type(variant_t), intent(inout) :: variant(:)
      logical, dimension(size(problem%is_made)) :: is_there, is_full, is_clear
      integer :: i

      is_there = .false.
      problem%is_made = .false.
      do i = 1, size(variant)
         call place_nodes(place, first + i - 1, model)
         is_there(i) = is_sound(model)
         if (is_there(i)) call take_variant(model, partition, layout, i, problem)
      end do
      call scale_lanes(layout, problem)
      if (size(is_full) == 1) then
         call look_at_one(layout, problem, question, is_full(1), is_clear(1))
      else
         call look_at_lanes(layout, pattern, problem, question, is_full, is_clear)
      end if
      do i = 1, size(variant)
         if (.not. is_there(i)) cycle
         if (size(variant) > 1 .and. .not. (is_clear(i) .and. .not. question%with_values)) &
            call place_nodes(place, first + i - 1, model)
         if (is_full(i)) then
            variant(i)%rank = min(layout%rows, layout%columns)
            variant(i)%is_decided = is_clear(i)
            variant(i)%characteristic_length = problem%scaling(i)%characteristic_length
            if (question%with_values .or. .not. is_clear(i)) call find_values(model, layout, problem, i, question, variant(i))
         else
            call analyse_completely(model, question, variant(i))
         end if
      end do
   end subroutine analyse_block

   !> is_full: whether all singular values are clearly not zero, which decides the rank; is_clear:
   !> whether digits can make none of them, either.
   subroutine look_at_one(layout, problem, question, is_full, is_clear)
      type(layout_t), intent(in) :: layout
      type(problem_lanes_t), intent(in) :: problem
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full, is_clear
      real(wp) :: matrix(layout%rows, layout%columns), gram(min(layout%rows, layout%columns), min(layout%rows, layout%columns))
      real(wp) :: told, reach

      is_full = .false.
      is_clear = .false.
      if (.not. problem%is_made(1)) return
      matrix = matrix_of(layout, problem, 1)
      call make_dense_gram(matrix, gram)
      told = told_of(problem%scaling(1), question, maxval(shape(matrix)), norm2(matrix))
      reach = reach_of(problem%scaling(1), question)
      call is_above(gram, sum(shape(matrix)), max(told, reach), is_clear)
      is_full = is_clear
      if (.not. is_full .and. reach > told) call is_above(gram, sum(shape(matrix)), told, is_full)
   end subroutine look_at_one

   !> The same of all lanes at once.
   subroutine look_at_lanes(layout, pattern, problem, question, is_full, is_clear)
      type(layout_t), intent(in) :: layout
      type(gram_pattern_t), intent(in) :: pattern
      type(problem_lanes_t), intent(in) :: problem
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full(lanes), is_clear(lanes)
      real(wp) :: gram(lanes, size(pattern%place, 2)), norm(lanes), told(lanes), reach(lanes)
      integer :: i

      call make_gram(pattern, problem%value, gram)
      norm = sqrt(traces_of(pattern, gram))
      told = [(told_of(problem%scaling(i), question, max(layout%rows, layout%columns), norm(i)), i=1, lanes)]
      reach = [(reach_of(problem%scaling(i), question), i=1, lanes)]
      call find_above(pattern, gram, max(told, reach), is_clear)
      is_clear = is_clear .and. problem%is_made
      is_full = is_clear
      if (.not. any(problem%is_made .and. .not. is_full .and. reach > told)) return
      call find_above(pattern, gram, told, is_full)
      is_full = is_clear .or. (is_full .and. problem%is_made)
   end subroutine look_at_lanes

   !> Below this a value may be near rounding, or a digit may have made it. norm: by the sum of
   !> squares, no less than the largest value.
   pure real(wp) function told_of(scaling, question, side, norm) result(told)
      type(scaling_t), intent(in) :: scaling
      type(question_t), intent(in) :: question
      integer, intent(in) :: side
      real(wp), intent(in) :: norm

      told = max(question%near*(scaling%error_of_bits + epsilon(1.0_wp)*side*norm), scaling%error_of_digits)
   end function told_of

   !> The smallest values with what changes them, and whether digits may make one zero.
   subroutine find_values(model, layout, problem, lane, question, variant)
      type(model_t), intent(in) :: model
      type(layout_t), intent(in) :: layout
      type(problem_lanes_t), intent(in) :: problem
      integer, intent(in) :: lane
      type(question_t), intent(in) :: question
      type(variant_t), intent(inout) :: variant
      real(wp) :: matrix(layout%rows, layout%columns), gram(min(layout%rows, layout%columns), min(layout%rows, layout%columns))
      real(wp) :: left(layout%rows, most_pairs), right(layout%columns, most_pairs)
      type(scaling_t) :: scaling
      type(error_t), allocatable :: error

      matrix = matrix_of(layout, problem, lane)
      call make_dense_gram(matrix, gram)
      call lowest_pairs(matrix, gram, variant%value, left, right, variant%pairs, error)
      if (.not. allocated(error) .and. question%with_values) &
         call find_ends(plain_matrix_of(layout, problem, lane), variant%smallest, variant%largest, error)
      if (allocated(error)) then
         variant%is_decided = .false.
         return
      end if
      scaling = scaling_of(layout, problem, lane)
      call judge(model, scaling, left(:, :variant%pairs), right(:, :variant%pairs), question, reach_of(scaling, question), variant)
   end subroutine find_values

   !> Values up to here may be made by digits that are missing.
   pure real(wp) function reach_of(scaling, question)
      type(scaling_t), intent(in) :: scaling
      type(question_t), intent(in) :: question
      reach_of = min(question%most_reach, question%cut_off*scaling%reach_of_digits)
   end function reach_of

   !> What changes the values of pairs of vectors of the scaled matrix, and whether digits
   !> explain one.
   subroutine judge(model, scaling, left, right, question, reach, variant)
      type(model_t), intent(in) :: model
      type(scaling_t), intent(in) :: scaling
      real(wp), intent(in) :: left(:, :), right(:, :)
      type(question_t), intent(in) :: question
      real(wp), intent(in) :: reach
      type(variant_t), intent(inout) :: variant
      type(sensitivity_t) :: found(size(left, 2))
      logical :: is_near
      integer :: k

      is_near = any(variant%value(:variant%pairs) <= reach)
      if (question%with_values .or. is_near) &
         call find_sensitivities(model, spread(scaling%row, 2, size(found))*left, &
                                 spread(scaling%column, 2, size(found))*right, &
                                 reshape([(k, k, k=1, size(found))], [2, size(found)]), found,.not. is_near)
      variant%by_move(:size(found)) = found%by_move
      variant%by_turn(:size(found)) = found%by_turn
      variant%is_decided = .not. any(variant%value(:size(found)) <= question%cut_off*found%lift_of_digits)
   end subroutine judge

   !> By a complete analysis, as it is done for a single model: decided if nothing is in doubt.
   subroutine analyse_completely(model, question, variant)
      type(model_t), intent(in) :: model
      type(question_t), intent(in) :: question
      type(variant_t), intent(inout) :: variant
      type(problem_t) :: problem
      type(result_t) :: result

      variant%is_decided = .false.
      call analyse(model, question%options, problem, result)
      if (allocated(result%error)) return
      variant%rank = result%decision%rank
      variant%characteristic_length = problem%scaling%characteristic_length
      variant%pairs = size(result%pair_value)
      variant%value(:variant%pairs) = result%pair_value
      if (.not. is_clear(problem, question, result)) return
      call judge(model, problem%scaling, result%pair_stress, result%pair_motion, question, &
                 reach_of(problem%scaling, question), variant)
      if (variant%is_decided .and. question%with_values) call find_other_values(model, problem, question, result, variant)
   end subroutine analyse_completely

   !> Whether the rank is proven, or full and confirmed, and no value is near rounding.
   pure logical function is_clear(problem, question, result)
      type(problem_t), intent(in) :: problem
      type(question_t), intent(in) :: question
      type(result_t), intent(in) :: result

      is_clear = result%proof%total() == result%decision%rank .or. &
                 (result%confirmed .and. result%decision%rank == min(size(problem%scaling%row), size(problem%scaling%column)))
      is_clear = is_clear .and. result%undecided == 0 .and. result%unseen == 0 .and. &
                 .not. any(result%pair_value <= question%near*result%decision%noise)
   end function is_clear

   !> What counts as zero and what lifts it, and the values of D(c) itself.
   subroutine find_other_values(model, problem, question, result, variant)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      type(question_t), intent(in) :: question
      type(result_t), intent(in) :: result
      type(variant_t), intent(inout) :: variant
      type(problem_t) :: plain_problem
      type(result_t) :: plain
      type(options_t) :: options
      integer :: side

      side = min(size(problem%scaling%row), size(problem%scaling%column))
      associate (values => result%scaled_values, first => variant%rank - (side - size(result%scaled_values)) + 1)
         if (variant%rank < side .and. size(values) > 0) variant%largest_zero = abs(values(max(first, 1)))
      end associate
      call find_zero_changes(model, problem, result, question%zeros, variant%zero_moves, variant%zero_turns)
      options = question%options
      options%method = result%method
      options%only_plain_values = .true.
      call analyse(model, options, plain_problem, plain)
      if (allocated(plain%error)) then
         variant%is_decided = .false.
      else if (size(plain%scaled_values) > 0) then
         variant%smallest = plain%scaled_values(size(plain%scaled_values))
         if (size(plain%scaled_values) == side) variant%largest = plain%scaled_values(1)
      end if
   end subroutine find_other_values
end module flexact_variants
