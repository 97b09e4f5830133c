! SPDX-License-Identifier: BSD-3-Clause
!> Many variants of a model as flat arrays: what is asked, and what comes back of each.
module flexact_variant_exchange
   use flexact_blas, only: blas_work_t, blas_begin, blas_end
   use flexact_exchange, only: unpack_model
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t, make_partition
   use flexact_result, only: most_pairs
   use flexact_slots, only: axes, has_axis, is_position
   use flexact_variants, only: analyse_variant, question_t, variant_t
   use flexact_zero_margins, only: zero_limits_t
   implicit none
   private
   public :: run_variants, variant_fact_names

   !> What each fact of a variant is; then come the values of pairs, what they change by a
   !> move and what by a turn, room for as many as there may be each.
   character(len=24), parameter :: variant_fact_names(*) = [character(len=24) :: &
                                                            'decided', 'rows', 'columns', 'rank', 'largest zero', &
                                                            'zero moves', 'zero turns', 'smallest', 'largest', &
                                                            'characteristic length', 'pairs']

contains

   !> wishes: what a value is near the noise by, what digits may have been cut off, the most
   !> that a digit reaches, 1 if values are wanted, bytes of memory, how it is proven, 1 if
   !> numbers are no decimals, and the limits of flexact_zero_margins. position (3, nodes, variants): where nodes are, and class
   !> (6, elements, variants) of the deformations; either may be one for all.
   subroutine run_variants(nodes, places, elements, vectors, wishes, position, class, facts)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      real(wp), intent(in) :: wishes(:), position(:, :, :)
      integer, intent(in) :: class(:, :, :)
      real(wp), intent(out) :: facts(:, :)
      type(model_t) :: model
      type(question_t) :: question
      type(partition_t) :: partition
      type(variant_t) :: variant
      type(blas_work_t) :: work
      integer :: i, before

      facts = 0.0_wp
      question%near = wishes(1)
      question%cut_off = wishes(2)
      question%most_reach = wishes(3)
      question%with_values = wishes(4) > 0
      question%options%memory = wishes(5)
      question%options%prove = nint(wishes(6))
      question%options%as_stored = wishes(7) > 0
      question%zeros = zero_limits_t(nint(wishes(8)), nint(wishes(9)), wishes(10), wishes(11))
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
         call give(partition, variant, facts(:, i))
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

   pure subroutine give(partition, variant, facts)
      type(partition_t), intent(in) :: partition
      type(variant_t), intent(in) :: variant
      real(wp), intent(out) :: facts(:)
      integer :: first

      first = size(variant_fact_names)
      facts(:first) = [real([merge(1, 0, variant%is_decided), partition%count%rows, partition%count%columns, &
                             variant%rank], wp), variant%largest_zero, &
                       real([merge(1, 0, variant%zero_moves), merge(1, 0, variant%zero_turns)], wp), &
                       variant%smallest, variant%largest, variant%characteristic_length, real(variant%pairs, wp)]
      facts(first + 1:first + 3*most_pairs) = [variant%value, variant%by_move, variant%by_turn]
   end subroutine give
end module flexact_variant_exchange
