! SPDX-License-Identifier: BSD-3-Clause
!> What must hold of every model, from a deck or not, before it is analysed.
module flexact_checks
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: element_kinds, vector_required
   use flexact_geometry, only: fault_of, fault_not_finite, fault_zero_length, fault_out_of_range, fault_vector_not_finite, &
                               fault_parallel
   use flexact_kinds, only: wp
   use flexact_labels, only: names_t, element_label, node_label
   use flexact_model, only: model_t
   use flexact_slots, only: slots, is_position
   implicit none
   private
   public :: check_model, is_consistent

contains

   !> Report all that is wrong with a model whose elements and nodes have these names;
   !> elements whose nodes are not known (their statements were reported) are passed over.
   subroutine check_model(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: k

      if (model%elements == 0) then
         if (.not. diagnostics%has_errors()) then
            call diagnostics%error('nothing-to-analyse', span_t(), 'there is nothing to analyse: no elements', '', &
                                   'state at least one element, such as TRUSS 1 1 2')
         end if
         return
      end if
      do k = 1, model%elements
         call check_element(model, names, k, diagnostics)
      end do
   end subroutine check_model

   subroutine check_element(model, names, k, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: place

      associate (kind => element_kinds(model%element_kind(k)), node => model%element_node(:, k))
         if (any(kind%slot_kind /= 0 .and. node == 0)) return
         place = span_t(model%element_origin(k), 0)
         if (has_twice(node)) then
            call diagnostics%error('same-node', place, 'both ends of '//element_label(model, names, k)//' are one node', &
                                   'one node at both ends', 'give the two ends different nodes')
            return
         end if
         if (kind%vector == vector_required) call check_axis(model, names, k, place, diagnostics)
         if (node(1) > 0 .and. node(3) > 0) call check_positions(model, names, k, place, diagnostics)
      end associate
   end subroutine check_element

   !> The positions of p and q, and a y vector against the line that joins them.
   subroutine check_positions(model, names, k, place, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      type(span_t), intent(in) :: place
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: words(2)

      select case (fault_of(model, k))
      case (fault_not_finite)
         ! A deck's own numbers were reported where they stand.
         if (place%first == 0) &
            call diagnostics%error('not-finite', place, element_label(model, names, k)//' has a node at no finite place', &
                                   'its coordinates are not finite', 'give its nodes finite coordinates')
      case (fault_zero_length)
         call diagnostics%error('zero-length', place, element_label(model, names, k)//' has zero length: '// &
                                node_label(model, names, model%element_node(1, k))//' and '// &
                                node_label(model, names, model%element_node(3, k))//' are at one place', &
                                'zero length', 'give the two nodes different positions')
      case (fault_out_of_range)
         call diagnostics%error('length-out-of-range', place, element_label(model, names, k)// &
                                ' is too long or too short to compute with', 'length out of range', &
                                'lengths from 1e-90 to 1e90 can be analysed: choose another unit')
      case (fault_vector_not_finite)
         call diagnostics%error('not-finite', place, 'the y vector of '//element_label(model, names, k)//' is not finite', &
                                'not finite', 'give a finite vector')
      case (fault_parallel)
         words(1) = 3 + count(element_kinds(model%element_kind(k))%slot_kind /= 0)
         words(2) = words(1) + 2
         call diagnostics%error('parallel-vector', place, 'the y vector of '//element_label(model, names, k)// &
                                ' is parallel to it', 'parallel to the line from p to q', &
                                'give a vector across the element, or none', words=words)
      end select
   end subroutine check_positions

   pure logical function has_twice(node)
      integer, intent(in) :: node(slots)
      has_twice = (node(1) == node(3) .and. node(1) > 0) .or. (node(2) == node(4) .and. node(2) > 0)
   end function has_twice

   subroutine check_axis(model, names, k, place, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      type(span_t), intent(in) :: place
      type(diagnostics_t), intent(inout) :: diagnostics

      if (.not. all(ieee_is_finite(model%element_vector(:, k)))) then
         call diagnostics%error('not-finite', place, 'the axis of '//element_label(model, names, k)//' is not finite', &
                                'not finite', 'give a finite vector')
      else if (all(abs(model%element_vector(:, k)) <= 0.0_wp) .and. model%element_origin(k) == 0) then
         ! A deck's own zero vector was reported where it stands.
         call diagnostics%error('zero-vector', place, 'the axis of '//element_label(model, names, k)//' is zero', &
                                'has no direction', 'give a vector that is not zero')
      end if
   end subroutine check_axis

   !> Whether the arrays fit together: kinds that exist, nodes that exist and
   !> are of the kind that their slots ask for.
   pure logical function is_consistent(model)
      type(model_t), intent(in) :: model
      integer :: k, slot, wanted, node

      is_consistent = .false.
      do k = 1, model%elements
         if (model%element_kind(k) < 1 .or. model%element_kind(k) > size(element_kinds)) return
         do slot = 1, slots
            wanted = element_kinds(model%element_kind(k))%slot_kind(slot)
            node = model%element_node(slot, k)
            if (wanted == 0) then
               if (node /= 0) return
            else if (node < 1 .or. node > model%nodes) then
               return
            else if (is_position(wanted)) then
               if (.not. is_position(model%node_kind(node))) return
            else if (model%node_kind(node) /= wanted) then
               return
            end if
         end do
      end do
      is_consistent = .true.
   end function is_consistent
end module flexact_checks
