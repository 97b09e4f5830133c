! SPDX-License-Identifier: BSD-3-Clause
!> One of many variants of a model: its rank, whether there is a doubt in it, and the
!> values that tell how near another rank is, each by the cheapest route that can confirm it.
module flexact_variants
   use flexact_determinacy, only: analyse
   use flexact_error, only: error_t
   use flexact_full_rank, only: make_dense_gram, is_above
   use flexact_geometry, only: is_sound
   use flexact_kinds, only: wp
   use flexact_lowest_pairs, only: lowest_pairs, find_ends
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t
   use flexact_problem, only: problem_t
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaling, only: scaling_t
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   use flexact_small_problem, only: small_problem_t, make_small_problem, plain_matrix
   use flexact_zero_margins, only: zero_limits_t, find_zero_changes
   implicit none
   private
   public :: analyse_variant, variant_t, question_t

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

   subroutine analyse_variant(model, partition, question, variant)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(question_t), intent(in) :: question
      type(variant_t), intent(out) :: variant
      type(small_problem_t) :: problem
      logical :: is_small, is_full

      if (.not. is_sound(model)) return
      associate (m => partition%count%rows, n => partition%count%columns)
         is_small = min(m, n) > 0 .and. min(m, n) <= small_side .and. max(m, n) <= small_longer_side
      end associate
      is_full = .false.
      if (is_small) call make_small_problem(model, partition, problem, is_small)
      if (is_small) call look_for_full_rank(model, problem, question, is_full, variant)
      if (.not. is_full) call analyse_completely(model, question, variant)
   end subroutine analyse_variant

   !> is_full: whether all singular values are clearly not zero, which decides the rank.
   subroutine look_for_full_rank(model, problem, question, is_full, variant)
      type(model_t), intent(in) :: model
      type(small_problem_t), intent(in) :: problem
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full
      type(variant_t), intent(inout) :: variant
      real(wp) :: gram(minval(shape(problem%matrix)), minval(shape(problem%matrix))), told, reach
      logical :: is_clear

      associate (scaling => problem%scaling, side => maxval(shape(problem%matrix)))
         ! The norm by the sum of squares is no less than the largest value.
         told = max(question%near*(scaling%error_of_bits + epsilon(1.0_wp)*side*norm2(problem%matrix)), &
                    scaling%error_of_digits)
      end associate
      reach = reach_of(problem%scaling, question)
      call make_dense_gram(problem%matrix, gram)
      call is_above(gram, sum(shape(problem%matrix)), max(told, reach), is_clear)
      is_full = is_clear
      if (.not. is_full .and. reach > told) call is_above(gram, sum(shape(problem%matrix)), told, is_full)
      if (.not. is_full) return
      variant%rank = size(gram, 1)
      variant%is_decided = is_clear
      variant%characteristic_length = problem%scaling%characteristic_length
      if (question%with_values .or. .not. is_clear) call find_values(model, problem, gram, question, reach, variant)
   end subroutine look_for_full_rank

   !> The smallest values with what changes them, and whether digits may make one zero.
   subroutine find_values(model, problem, gram, question, reach, variant)
      type(model_t), intent(in) :: model
      type(small_problem_t), intent(in) :: problem
      real(wp), intent(in) :: gram(:, :), reach
      type(question_t), intent(in) :: question
      type(variant_t), intent(inout) :: variant
      real(wp) :: left(size(problem%matrix, 1), most_pairs), right(size(problem%matrix, 2), most_pairs)
      type(error_t), allocatable :: error

      call lowest_pairs(problem%matrix, gram, variant%value, left, right, variant%pairs, error)
      if (.not. allocated(error) .and. question%with_values) &
         call find_ends(plain_matrix(problem), variant%smallest, variant%largest, error)
      if (allocated(error)) then
         variant%is_decided = .false.
         return
      end if
      call judge(model, problem%scaling, left(:, :variant%pairs), right(:, :variant%pairs), question, reach, variant)
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
