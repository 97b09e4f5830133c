! SPDX-License-Identifier: BSD-3-Clause
!> Many variants of a model as flat arrays: what is asked, and what comes back of each.
module flexact_variant_exchange
   use flexact_blas, only: blas_work_t, blas_begin, blas_end
   use flexact_exchange, only: unpack_model
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_slots, only: axes, has_axis, is_position
   use flexact_variants, only: analyse_variant, question_t, variant_t
   use flexact_zero_margins, only: zero_limits_t
   implicit none
   private
   public :: run_variants, variant_fact_names

   !> What each fact of a variant is.
   character(len=24), parameter :: variant_fact_names(*) = [character(len=24) :: &
                                                            'decided', 'rows', 'columns', 'rank', 'largest zero', &
                                                            'zero moves', 'zero turns', 'smallest', 'largest', &
                                                            'characteristic length', 'pairs']

contains

   subroutine run_variants(nodes, places, elements, vectors, near, cut_off, most_reach, with_values, memory, prove, as_stored, &
                           zero_counts, zero_limits, position, class, facts, pair_value, by_move, by_turn)
      integer, intent(in) :: nodes(:, :), elements(:, :), class(:, :, :), prove, zero_counts(:)
      real(wp), intent(in) :: places(:, :), vectors(:, :), position(:, :, :), near, cut_off, most_reach, memory, zero_limits(:)
      logical, intent(in) :: with_values, as_stored
      real(wp), intent(out) :: facts(:, :), pair_value(:, :), by_move(:, :), by_turn(:, :)
      type(model_t) :: model
      type(question_t) :: question
      type(partition_t) :: partition
      type(variant_t) :: variant
      type(blas_work_t) :: work
      integer :: i, before

      facts = 0
      pair_value = 0
      by_move = 0
      by_turn = 0
      question%near = near
      question%cut_off = cut_off
      question%most_reach = most_reach
      question%with_values = with_values
      question%options%memory = memory
      question%options%prove = prove
      question%options%as_stored = as_stored
      question%zeros = zero_limits_t(zero_counts(1), zero_counts(2), zero_limits(1), zero_limits(2))
      if (blas_begin(1, 0.0_wp, work) /= 0) return
      call unpack_model(nodes, places, elements, vectors, model)
      before = 0
      do i = 1, size(facts, 2)
         call place_nodes(position(:, :, min(i, size(position, 3))), model)
         if (min(i, size(class, 3)) /= before) then
            before = min(i, size(class, 3))
            model%deformation_class = class(:, :, before)
            call make_partition(model, partition)
         end if
         call analyse_variant(model, partition, question, variant)
         facts(:, i) = facts_of(partition, variant)
         pair_value(:, i) = variant%value
         by_move(:, i) = variant%by_move
         by_turn(:, i) = variant%by_turn
      end do
      call blas_end(work)
   end subroutine run_variants

   !> What stands for other nodes than positions, and for z in the plane, is passed over.
   pure subroutine place_nodes(position, model)
      real(wp), intent(in) :: position(:, :)
      type(model_t), intent(inout) :: model
      integer :: node, axis

      do node = 1, model%nodes
         if (.not. is_position(model%node_kind(node))) cycle
         do axis = 1, axes
            if (has_axis(model%node_kind(node), axis)) model%node_value(axis, node) = position(axis, node)
         end do
      end do
   end subroutine place_nodes

   pure function facts_of(partition, variant) result(facts)
      type(partition_t), intent(in) :: partition
      type(variant_t), intent(in) :: variant
      real(wp) :: facts(size(variant_fact_names))

      facts = [real([merge(1, 0, variant%is_decided), partition%count%rows, partition%count%columns, variant%rank], wp), &
               variant%largest_zero, real([merge(1, 0, variant%zero_moves), merge(1, 0, variant%zero_turns)], wp), &
               variant%smallest, variant%largest, variant%characteristic_length, real(variant%pairs, wp)]
   end function facts_of
end module flexact_variant_exchange
