! SPDX-License-Identifier: BSD-3-Clause
!> What can be analysed and is hardly meant: warnings about a sound model.
module flexact_silent_mistakes
   use flexact_coincident_nodes, only: check_coincident_nodes
   use flexact_configuration, only: leans_on_near_tie
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: element_kinds, vector_optional
   use flexact_kinds, only: wp
   use flexact_labels, only: names_t, element_label, two_labels, digits_of
   use flexact_model, only: model_t, class_fixed, class_independent
   use flexact_parallel_elements, only: check_parallel_elements
   use flexact_repeated_names, only: check_repeated_names
   use flexact_roles, only: role_bending_xz_p, role_bending_xz_q, role_bending_xy_p, role_bending_xy_q, &
                            role_offset_y, role_offset_z, role_tilt_y, role_tilt_z
   use flexact_slots, only: node_planar_position, node_position, node_orientation
   implicit none
   private
   public :: check_silent_mistakes

   !> Lengths that differ by more are hardly of one unit: millimetres beside metres.
   real(wp), parameter :: most_apart = 1.0e3_wp

contains

   !> Warn of what a designer is not likely to mean. The model has no errors; `names`
   !> are those of its elements and nodes.
   subroutine check_silent_mistakes(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics

      call check_support(model, diagnostics)
      call check_lengths(model, names, diagnostics)
      call check_axes(model, names, diagnostics)
      call check_coincident_nodes(model, names, diagnostics)
      call check_parallel_elements(model, names, diagnostics)
      call check_repeated_names(model, names, diagnostics)
   end subroutine check_silent_mistakes

   !> Where nothing is fixed the mechanism moves as a whole. Who declares as many
   !> degrees of freedom as that has knows it.
   subroutine check_support(model, diagnostics)
      type(model_t), intent(in) :: model
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: motions

      if (any(model%coordinate_class == class_fixed)) return
      motions = merge(6, 3, any(model%node_kind == node_position .or. model%node_kind == node_orientation))
      if (count(model%coordinate_class == class_independent) >= motions) return
      call diagnostics%warning('no-support', span_t(), 'nothing is fixed, so that the mechanism can move as a whole', '', &
                               'fix the points that are clamped to the ground')
   end subroutine check_support

   subroutine check_lengths(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      real(wp) :: length, least, most
      integer :: k, shortest, longest

      least = huge(1.0_wp)
      most = 0.0_wp
      do k = 1, model%elements
         if (.not. element_kinds(model%element_kind(k))%needs_length) cycle
         length = length_between(model, model%element_node(1, k), model%element_node(3, k))
         if (length < least) shortest = k
         if (length > most) longest = k
         least = min(least, length)
         most = max(most, length)
      end do
      if (.not. most/most_apart > least) return
      call diagnostics%warning('lengths-differ', span_t(model%element_origin(longest), 0), &
                               two_labels(model, names, longest, shortest, ' is '//times(most/least)//' as long as '), &
                               'the longest', 'give all positions in one unit, metres', &
                               span_t(model%element_origin(shortest), 0))
   end subroutine check_lengths

   !> Of the elements whose deformations depend on an axis that a tiny difference has chosen,
   !> the first.
   subroutine check_axes(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=:), allocatable :: others, mend
      integer :: k, first, found

      found = 0
      do k = 1, model%elements
         if (.not. tells_axes_apart(model, k)) cycle
         if (.not. leans_on_near_tie(model, k)) cycle
         found = found + 1
         if (found == 1) first = k
      end do
      if (found == 0) return
      others = ''
      if (found > 1) others = ', and of '//digits_of(found - 1)//merge(' others', ' other ', found > 2)
      if (element_kinds(model%element_kind(first))%vector == vector_optional) then
         mend = 'give the vector that its local y axis is towards'
      else
         mend = 'give coordinates that make these components equal, or clearly different'
      end if
      call diagnostics%warning('nearly-equal-components', span_t(model%element_origin(first), 0), &
                               'a difference of rounding chooses the local y axis of '//element_label(model, names, first) &
                               //trim(others)//', and what is held depends on it', &
                               'two components of its direction are equal in size but for that', mend)
   end subroutine check_axes

   !> Whether it matters which way the axes across element k point: not where what each does
   !> along ey and along ez has one class.
   pure logical function tells_axes_apart(model, k)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      integer, parameter :: y(4) = [role_bending_xz_p, role_bending_xz_q, role_offset_y, role_tilt_y]
      integer, parameter :: z(4) = [role_bending_xy_p, role_bending_xy_q, role_offset_z, role_tilt_z]
      integer :: i

      associate (role => element_kinds(model%element_kind(k))%role, class => model%deformation_class(:, k))
         tells_axes_apart = .false.
         do i = 1, size(y)
            ! Planar elements have the first alone.
            if (.not. (any(role == y(i)) .and. any(role == z(i)))) cycle
            if (class(findloc(role, y(i), 1)) /= class(findloc(role, z(i), 1))) tells_axes_apart = .true.
         end do
      end associate
   end function tells_axes_apart

   pure real(wp) function length_between(model, p, q) result(length)
      type(model_t), intent(in) :: model
      integer, intent(in) :: p, q
      integer :: axes

      axes = merge(2, 3, any(model%node_kind([p, q]) == node_planar_position))
      ! Its square stays in range, because the length of a sound element does.
      length = sqrt(sum((model%node_value(:axes, q) - model%node_value(:axes, p))**2))
   end function length_between

   pure function times(ratio) result(words)
      real(wp), intent(in) :: ratio
      character(len=:), allocatable :: words

      if (ratio < 1.0e9_wp) then
         words = digits_of(nint(ratio))//' times'
      else
         words = 'more than a thousand million times'
      end if
   end function times
end module flexact_silent_mistakes
