! SPDX-License-Identifier: BSD-3-Clause
!> Many variants of a model as flat arrays: what is asked, and what comes back of each.
module flexact_variant_exchange
   use flexact_blas, only: blas_work_t, blas_begin, blas_end
   use flexact_exchange, only: unpack_model
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_variants, only: analyse_variants, question_t, variant_t
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
      type(variant_t) :: variant(size(facts, 2))
      type(blas_work_t) :: work
      integer :: i

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
      call analyse_variants(model, position, class, question, variant)
      do i = 1, size(variant)
         facts(:, i) = facts_of(variant(i))
         pair_value(:, i) = variant(i)%value
         by_move(:, i) = variant(i)%by_move
         by_turn(:, i) = variant(i)%by_turn
      end do
      call blas_end(work)
   end subroutine run_variants

   pure function facts_of(variant) result(facts)
      type(variant_t), intent(in) :: variant
      real(wp) :: facts(size(variant_fact_names))

      facts = [real([merge(1, 0, variant%is_decided), variant%rows, variant%columns, variant%rank], wp), &
               variant%largest_zero, real([merge(1, 0, variant%zero_moves), merge(1, 0, variant%zero_turns)], wp), &
               variant%smallest, variant%largest, variant%characteristic_length, real(variant%pairs, wp)]
   end function facts_of
end module flexact_variant_exchange
