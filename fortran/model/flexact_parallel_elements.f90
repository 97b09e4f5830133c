! SPDX-License-Identifier: BSD-3-Clause
!> Elements that join the same nodes: the same part twice, and something flexible
!> beside a rigid link.
module flexact_parallel_elements
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: element_kinds
   use flexact_labels, only: names_t, two_labels
   use flexact_model, only: model_t
   use flexact_rigid_bodies, only: is_rigid, is_flexible, holds_something
   use flexact_sorting, only: by_number
   implicit none
   private
   public :: check_parallel_elements

   !> In a bundle of more elements between two nodes not every pair is compared.
   integer, parameter :: most_compared = 100

contains

   !> Elements are in parallel whose two positions, or where they have none whose two
   !> orientations, are the same nodes.
   subroutine check_parallel_elements(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: ends(2, model%elements), order(model%elements), first, last

      call find_ends(model, ends)
      order = by_number(ends(2, :), model%nodes)
      order = order(by_number(ends(1, order), model%nodes))
      first = 1
      do while (first <= model%elements)
         last = first
         do while (last < model%elements)
            if (any(ends(:, order(last + 1)) /= ends(:, order(first)))) exit
            last = last + 1
         end do
         if (last > first) call check_bundle(model, names, order(first:last), diagnostics)
         first = last + 1
      end do
   end subroutine check_parallel_elements

   !> The two nodes of each element, the smaller one first.
   pure subroutine find_ends(model, ends)
      type(model_t), intent(in) :: model
      integer, intent(out) :: ends(:, :)
      integer :: k

      do k = 1, model%elements
         associate (node => model%element_node(:, k))
            ends(:, k) = node([1, 3])
            if (any(ends(:, k) == 0)) ends(:, k) = node([2, 4])
         end associate
         ends(:, k) = [minval(ends(:, k)), maxval(ends(:, k))]
      end do
   end subroutine find_ends

   !> What is wrong with elements between the same two nodes, in ascending order.
   subroutine check_bundle(model, names, bundle, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: bundle(:)
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: i, j, rigid

      do i = 2, size(bundle)
         do j = max(1, i - most_compared), i - 1
            if (.not. are_twins(model, bundle(j), bundle(i))) cycle
            call report_twins(model, names, bundle(j), bundle(i), diagnostics)
            exit
         end do
      end do
      rigid = 0
      do i = 1, size(bundle)
         if (rigid == 0 .and. is_rigid(model, bundle(i))) rigid = bundle(i)
      end do
      if (rigid == 0) return
      if (model%element_node(1, rigid) == 0) return
      do i = 1, size(bundle)
         if (is_flexible(model, bundle(i))) call report_beside_rigid(model, names, bundle(i), rigid, diagnostics)
      end do
   end subroutine check_bundle

   !> Whether two elements are of one kind and join the same nodes, from p to q or from
   !> q to p, and one does not merely measure what the other one holds.
   pure logical function are_twins(model, one, two)
      type(model_t), intent(in) :: model
      integer, intent(in) :: one, two

      associate (node => model%element_node)
         are_twins = model%element_kind(one) == model%element_kind(two) .and. &
                     (all(node(:, one) == node(:, two)) .or. all(node(:, one) == node([3, 4, 1, 2], two)))
      end associate
      if (.not. are_twins) return
      are_twins = holds_something(model, one) .and. holds_something(model, two) .and. &
                  .not. ((is_rigid(model, one) .and. is_flexible(model, two)) .or. &
                         (is_flexible(model, one) .and. is_rigid(model, two)))
   end function are_twins

   subroutine report_twins(model, names, one, two, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: one, two
      type(diagnostics_t), intent(inout) :: diagnostics

      call diagnostics%warning('same-part-twice', span_t(model%element_origin(two), 0), &
                               two_labels(model, names, one, two, ' and ')//' are the same part twice: each is a '// &
                               trim(element_kinds(model%element_kind(two))%keyword)//' between the same nodes', &
                               'between the same nodes', 'delete one of the two, or correct its nodes', &
                               span_t(model%element_origin(one), 0))
   end subroutine report_twins

   subroutine report_beside_rigid(model, names, flexible, rigid, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: flexible, rigid
      type(diagnostics_t), intent(inout) :: diagnostics

      call diagnostics%warning('beside-rigid-link', span_t(model%element_origin(flexible), 0), &
                               two_labels(model, names, flexible, rigid, ' lies beside ')// &
                               ', which is rigid, between the same two points', 'something rigid joins its ends', &
                               'delete one of the two: what is rigid holds what the other one leaves free', &
                               span_t(model%element_origin(rigid), 0))
   end subroutine report_beside_rigid
end module flexact_parallel_elements
