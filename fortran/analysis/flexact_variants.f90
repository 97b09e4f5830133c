! SPDX-License-Identifier: BSD-3-Clause
!> Many variants of a model: their ranks, whether there is a doubt in them, and the values that
!> tell how near another rank is, each by the cheapest route that can confirm it.
module flexact_variants
   use flexact_determinacy, only: analyse
   use flexact_error, only: error_t
   use flexact_full_rank, only: make_dense_gram, is_above
   use flexact_geometry, only: is_sound
   use flexact_gram_lanes, only: gram_pattern_t, make_gram_pattern, make_gram, find_above, spread_gram, traces_of
   use flexact_kinds, only: wp, lanes
   use flexact_lowest_pairs, only: lowest_spaces, lowest_pairs, find_ends, have_lost_digits, decompose_ends
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_problem, only: problem_t
   use flexact_problem_lanes, only: layout_t, make_layout, problem_lanes_t, new_problem_lanes, take_variant, scale_lanes, &
                                    scaling_of, matrix_of
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaling, only: scaling_t
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities_within
   use flexact_slots, only: axes, has_axis, is_position
   use flexact_smallest_values, only: settle_equal
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
      !> Of D(c).
      integer :: rows = 0, columns = 0
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

   !> What variants of one topology have in common, and those of a block.
   type :: part_t
      type(partition_t) :: partition
      !> Whether D(c) is looked at as a whole; else nothing else is there.
      logical :: is_small = .false.
      type(layout_t) :: layout
      type(problem_lanes_t) :: problem
      !> A'A or A A' of the scaled D(c): of several lanes by the pattern, of one as a dense matrix.
      type(gram_pattern_t) :: pattern
      real(wp), allocatable :: gram(:, :)
   end type part_t

   !> Variants that are taken side by side: variant i is lane lane_of(i) of part part_of(i).
   type :: block_t
      !> Whether all are of one topology, which is one part then.
      logical :: is_shared = .false.
      type(part_t), allocatable :: part(:)
      integer :: part_of(lanes) = 0, lane_of(lanes) = 0
      !> Of each variant a basis for the vectors of its smallest values, (lanes, side, pairs), and the
      !> squares of the smallest and the largest singular value of D(c) itself.
      real(wp), allocatable :: basis(:, :, :)
      logical :: is_found(lanes) = .false.
      real(wp) :: squares(lanes, 2) = 0.0_wp
   end type block_t

contains

   !> Variants that differ in places, (3, nodes, variants), in the classes of deformations, (6,
   !> elements, variants), or in both; of what does not differ there is one.
   subroutine analyse_variants(model, place, class, question, variant)
      type(model_t), intent(inout) :: model
      real(wp), intent(in) :: place(:, :, :)
      integer, intent(in) :: class(:, :, :)
      type(question_t), intent(in) :: question
      type(variant_t), intent(out) :: variant(:)
      type(block_t) :: block
      integer :: first, last

      block%is_shared = size(class, 3) == 1 .and. size(variant) >= lanes
      do first = 1, size(variant), lanes
         last = min(first + lanes - 1, size(variant))
         call analyse_block(model, place, class, first, question, block, variant(first:last))
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

   subroutine analyse_block(model, place, class, first, question, block, variant)
      type(model_t), intent(inout) :: model
      real(wp), intent(in) :: place(:, :, :)
      integer, intent(in) :: class(:, :, :), first
      type(question_t), intent(in) :: question
      type(block_t), intent(inout) :: block
      type(variant_t), intent(inout) :: variant(:)
      logical, dimension(lanes) :: is_there, is_full, is_clear, is_wanted
      integer :: i

      is_there = .false.
      call begin_block(block)
      do i = 1, size(variant)
         call place_nodes(place, first + i - 1, model)
         model%deformation_class = class(:, :, min(first + i - 1, size(class, 3)))
         call take_topology(model, i, first == 1 .or. .not. block%is_shared, block)
         associate (here => block%part(block%part_of(i)))
            variant(i)%rows = here%partition%count%rows
            variant(i)%columns = here%partition%count%columns
            is_there(i) = is_sound(model)
            if (is_there(i) .and. here%is_small) &
               call take_variant(model, here%partition, here%layout, block%lane_of(i), here%problem)
         end associate
      end do
      call look_for_full_rank(block, size(variant), question, is_full, is_clear)
      is_wanted = is_full .and. (question%with_values .or. .not. is_clear)
      if (any(is_wanted)) call find_spaces(is_wanted, question%with_values, block)
      do i = 1, size(variant)
         if (.not. is_there(i)) cycle
         if (is_wanted(i) .or. .not. is_full(i)) then
            call place_nodes(place, first + i - 1, model)
            model%deformation_class = class(:, :, min(first + i - 1, size(class, 3)))
         end if
         if (is_full(i)) then
            variant(i)%rank = min(variant(i)%rows, variant(i)%columns)
            variant(i)%is_decided = is_clear(i)
            variant(i)%characteristic_length = block%part(block%part_of(i))%problem%scaling(block%lane_of(i))%characteristic_length
            if (is_wanted(i)) call find_values(model, block, i, question, variant(i))
         else
            call analyse_completely(model, question, variant(i))
         end if
      end do
   end subroutine analyse_block

   !> No variant is there.
   pure subroutine begin_block(block)
      type(block_t), intent(inout) :: block
      integer :: i

      if (allocated(block%part)) then
         do i = 1, size(block%part)
            if (allocated(block%part(i)%problem%is_made)) block%part(i)%problem%is_made = .false.
         end do
      else
         allocate (block%part(merge(1, lanes, block%is_shared)))
         block%part_of = [(merge(1, i, block%is_shared), i=1, lanes)]
         block%lane_of = [(merge(i, 1, block%is_shared), i=1, lanes)]
      end if
   end subroutine begin_block

   !> What variant i shares with those of its topology. is_new: unless it is known already.
   pure subroutine take_topology(model, i, is_new, block)
      type(model_t), intent(in) :: model
      integer, intent(in) :: i
      logical, intent(in) :: is_new
      type(block_t), intent(inout) :: block

      if (.not. is_new .or. block%lane_of(i) > 1) return
      associate (here => block%part(block%part_of(i)))
         call make_partition(model, here%partition)
         associate (m => here%partition%count%rows, n => here%partition%count%columns)
            here%is_small = min(m, n) > 0 .and. min(m, n) <= small_side .and. max(m, n) <= small_longer_side
         end associate
         if (.not. here%is_small) return
         call make_layout(model, here%partition, here%layout)
         call new_problem_lanes(here%layout, merge(lanes, 1, block%is_shared), here%problem)
         ! The pattern of the factor takes as long as some variants.
         if (block%is_shared) then
            call make_gram_pattern(here%layout%rows, here%layout%columns, here%layout%row, here%layout%column, here%pattern)
            allocate (here%gram(lanes, size(here%pattern%place, 2)))
         else
            if (allocated(here%gram)) deallocate (here%gram)
            associate (side => min(here%layout%rows, here%layout%columns))
               allocate (here%gram(side, side))
            end associate
         end if
      end associate
   end subroutine take_topology

   !> is_full: whether all singular values are clearly not zero, which decides the rank; is_clear:
   !> whether digits can make none of them, either.
   subroutine look_for_full_rank(block, variants, question, is_full, is_clear)
      type(block_t), intent(inout) :: block
      integer, intent(in) :: variants
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full(lanes), is_clear(lanes)
      integer :: i

      is_full = .false.
      is_clear = .false.
      do i = 1, merge(1, variants, block%is_shared)
         associate (here => block%part(i))
            if (.not. here%is_small) cycle
            if (.not. any(here%problem%is_made)) cycle
            call scale_lanes(here%layout, here%problem)
            if (block%is_shared) then
               call look_at_lanes(here, question, is_full, is_clear)
            else if (here%problem%is_made(1)) then
               call look_at_one(here, question, is_full(i), is_clear(i))
            end if
         end associate
      end do
   end subroutine look_for_full_rank

   subroutine look_at_one(here, question, is_full, is_clear)
      type(part_t), intent(inout) :: here
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full, is_clear
      real(wp) :: matrix(here%layout%rows, here%layout%columns), told, reach

      matrix = matrix_of(here%layout, here%problem%value, 1)
      call make_dense_gram(matrix, here%gram)
      told = told_of(here%problem%scaling(1), question, maxval(shape(matrix)), norm2(matrix))
      reach = reach_of(here%problem%scaling(1), question)
      call is_above(here%gram, sum(shape(matrix)), max(told, reach), is_clear)
      is_full = is_clear
      if (.not. is_full .and. reach > told) call is_above(here%gram, sum(shape(matrix)), told, is_full)
   end subroutine look_at_one

   subroutine look_at_lanes(here, question, is_full, is_clear)
      type(part_t), intent(inout) :: here
      type(question_t), intent(in) :: question
      logical, intent(out) :: is_full(lanes), is_clear(lanes)
      real(wp) :: norm(lanes), told(lanes), reach(lanes)
      integer :: i

      associate (pattern => here%pattern, problem => here%problem, gram => here%gram)
         call make_gram(pattern, problem%value, gram)
         norm = sqrt(traces_of(pattern, gram))
         told = [(told_of(problem%scaling(i), question, max(here%layout%rows, here%layout%columns), norm(i)), i=1, lanes)]
         reach = [(reach_of(problem%scaling(i), question), i=1, lanes)]
         call find_above(pattern, gram, max(told, reach), is_clear)
         is_clear = is_clear .and. problem%is_made
         is_full = is_clear
         if (.not. any(problem%is_made .and. .not. is_full .and. reach > told)) return
         call find_above(pattern, gram, told, is_full)
         is_full = is_clear .or. (is_full .and. problem%is_made)
      end associate
   end subroutine look_at_lanes

   !> Vectors of the smallest values of the variants that are wanted, and the ends of D(c) itself, all at
   !> once. Other lanes repeat one of these.
   subroutine find_spaces(is_wanted, with_ends, block)
      logical, intent(in) :: is_wanted(lanes), with_ends
      type(block_t), intent(inout) :: block
      real(wp), allocatable :: gram(:, :, :)
      integer :: side, i

      side = 0
      do i = 1, size(block%part)
         if (block%is_shared .or. is_wanted(i)) side = max(side, min(block%part(i)%layout%rows, block%part(i)%layout%columns))
      end do
      do i = 1, size(block%part)
         if (block%is_shared .or. is_wanted(i)) call lay_gram(block%part(i), i, .false., side, gram)
      end do
      call repeat_lanes(is_wanted, gram)
      if (allocated(block%basis)) deallocate (block%basis)
      allocate (block%basis(lanes, side, min(side, most_pairs)))
      call lowest_spaces(gram, block%basis, block%is_found)
      if (.not. with_ends) return
      do i = 1, size(block%part)
         if (block%is_shared .or. is_wanted(i)) call lay_gram(block%part(i), i, .true., side, gram)
      end do
      call repeat_lanes(is_wanted, gram)
      call find_ends(gram, block%squares)
   end subroutine find_spaces
   !> Lanes that are not wanted repeat one that is.
   pure subroutine repeat_lanes(is_wanted, gram)
      logical, intent(in) :: is_wanted(lanes)
      real(wp), intent(inout) :: gram(:, :, :)
      integer :: i

      do i = 1, lanes
         if (.not. is_wanted(i)) gram(i, :, :) = gram(findloc(is_wanted, .true., 1), :, :)
      end do
   end subroutine repeat_lanes

   !> Below this a value may be near rounding, or a digit may have made it. norm: by the sum of
   !> squares, no less than the largest value.
   pure real(wp) function told_of(scaling, question, side, norm) result(told)
      type(scaling_t), intent(in) :: scaling
      type(question_t), intent(in) :: question
      integer, intent(in) :: side
      real(wp), intent(in) :: norm

      told = max(question%near*(scaling%error_of_bits + epsilon(1.0_wp)*side*norm), scaling%error_of_digits)
   end function told_of

   !> Lower triangles of A'A or A A', of D(c) itself or scaled, as dense matrices (lanes, side, side) of
   !> one side. To a smaller one is added what is neither its smallest nor its largest eigenvalue.
   subroutine lay_gram(here, lane, is_plain, side, gram)
      type(part_t), intent(in) :: here
      integer, intent(in) :: lane, side
      logical, intent(in) :: is_plain
      real(wp), allocatable, intent(inout) :: gram(:, :, :)
      real(wp) :: own(size(here%gram, 1), size(here%gram, 2)), beyond
      integer :: i

      if (.not. allocated(gram)) allocate (gram(lanes, side, side), source=0.0_wp)
      if (allocated(here%pattern%start)) then
         own = here%gram
         if (is_plain) call make_gram(here%pattern, here%problem%plain, own)
         call spread_gram(here%pattern, own, gram)
         return
      end if
      own = here%gram
      if (is_plain) call make_dense_gram(matrix_of(here%layout, here%problem%plain, 1), own)
      beyond = merge(own(1, 1), sum([(own(i, i), i=1, size(own, 1))]), is_plain)
      gram(lane, :, :) = 0.0_wp
      gram(lane, :size(own, 1), :size(own, 1)) = own
      do i = size(own, 1) + 1, side
         gram(lane, i, i) = beyond
      end do
   end subroutine lay_gram

   !> The smallest values with what changes them, and whether digits may make one zero.
   subroutine find_values(model, block, i, question, variant)
      type(model_t), intent(in) :: model
      type(block_t), intent(in) :: block
      integer, intent(in) :: i
      type(question_t), intent(in) :: question
      type(variant_t), intent(inout) :: variant
      real(wp), allocatable :: left(:, :), right(:, :)
      type(scaling_t) :: scaling
      type(error_t), allocatable :: error

      associate (here => block%part(block%part_of(i)), lane => block%lane_of(i), pairs => variant%pairs)
         pairs = min(variant%rank, most_pairs)
         allocate (left(variant%rows, pairs), right(variant%columns, pairs))
         call lowest_pairs(matrix_of(here%layout, here%problem%value, lane), block%basis(i, :variant%rank, :pairs), &
                           block%is_found(i), variant%value(:pairs), left, right, error)
         if (.not. allocated(error) .and. question%with_values) then
            variant%smallest = sqrt(block%squares(i, 1))
            variant%largest = sqrt(block%squares(i, 2))
            if (have_lost_digits(block%squares(i, :))) &
               call decompose_ends(matrix_of(here%layout, here%problem%plain, lane), variant%smallest, variant%largest, error)
         end if
         if (allocated(error)) then
            variant%is_decided = .false.
            return
         end if
         call settle_equal(variant%value(:pairs), right, left)
         scaling = scaling_of(here%layout, here%problem, lane)
         call judge(model, here%partition, scaling, left, right, question, reach_of(scaling, question), variant)
      end associate
   end subroutine find_values

   !> Values up to here may be made by digits that are missing.
   pure real(wp) function reach_of(scaling, question)
      type(scaling_t), intent(in) :: scaling
      type(question_t), intent(in) :: question
      reach_of = min(question%most_reach, question%cut_off*scaling%reach_of_digits)
   end function reach_of

   !> What changes the values of pairs of vectors of the scaled matrix, and whether digits
   !> explain one.
   subroutine judge(model, partition, scaling, left, right, question, reach, variant)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
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
         call find_sensitivities_within(model, partition, spread(scaling%row, 2, size(found))*left, &
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
      call judge(model, problem%partition, problem%scaling, result%pair_stress, result%pair_motion, question, &
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
