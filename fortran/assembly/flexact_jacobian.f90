! SPDX-License-Identifier: BSD-3-Clause
!> The Jacobian D_x of all deformations with respect to all coordinates,
!> eq. (8), as a list of entries.
module flexact_jacobian
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_none
   use flexact_pose, only: pose_t, reference_t
   use flexact_element, only: element_deformation
   use flexact_configuration, only: element_reference, make_poses
   use flexact_element_table, only: element_kinds, deformations_of
   use flexact_slots, only: axes, most_deformations
   implicit none
   private
   public :: jacobian_t, make_jacobian, element_derivative

   !> Entry i stands at deformation row(2, i) of element row(1, i) and at axis
   !> column(2, i) of node column(1, i). No place occurs twice; the entries of
   !> one row stand together; exact zeros are left out.
   type :: jacobian_t
      integer :: entries = 0
      integer, allocatable :: row(:, :)
      integer, allocatable :: column(:, :)
      real(wp), allocatable :: value(:)
      !> Deformations, (6, elements), and reference lengths [m], (elements).
      real(wp), allocatable :: deformation(:, :)
      real(wp), allocatable :: length(:)
   end type jacobian_t

contains

   !> Deformations and D_x in a configuration given as node values (4, nodes);
   !> c_t (elements) is the constant in e1 of eq. (3), zero without it.
   pure subroutine make_jacobian(model, configuration, jacobian, c_t)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: configuration(:, :)
      type(jacobian_t), intent(out) :: jacobian
      real(wp), intent(in), optional :: c_t(:)
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: derivative(most_deformations, 12)
      integer :: k, room

      room = most_entries(model)
      allocate (jacobian%row(2, room), jacobian%column(2, room), jacobian%value(room))
      allocate (jacobian%deformation(most_deformations, model%elements), jacobian%length(model%elements))
      do k = 1, model%elements
         call element_reference(model, k, reference)
         if (present(c_t)) reference%c_t = c_t(k)
         call make_poses(model, k, configuration, p, q)
         call element_deformation(model%element_kind(k), reference, p, q, &
                                  jacobian%deformation(:, k), derivative)
         jacobian%length(k) = reference%length
         call join_ends(model%element_node(:, k), derivative)
         call add_element(model, k, derivative, jacobian)
      end do
   end subroutine make_jacobian

   !> The derivatives of the deformations of element k at rest, and its length.
   pure subroutine element_derivative(model, k, derivative, length)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(out) :: derivative(most_deformations, 12), length
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: deformation(most_deformations)

      call element_reference(model, k, reference, p, q)
      call element_deformation(model%element_kind(k), reference, p, q, deformation, derivative)
      call join_ends(model%element_node(:, k), derivative)
      length = reference%length
   end subroutine element_derivative

   !> D_x has no more entries than this: deformations of each element times the
   !> axes of its nodes.
   pure integer function most_entries(model) result(entries)
      type(model_t), intent(in) :: model
      integer :: of_kind(size(element_kinds)), kind, k

      do kind = 1, size(element_kinds)
         of_kind(kind) = axes*count(element_kinds(kind)%slot_kind /= 0)*deformations_of(kind)
      end do
      entries = 0
      do k = 1, model%elements
         entries = entries + of_kind(model%element_kind(k))
      end do
   end function most_entries

   !> Append the entries of element k.
   pure subroutine add_element(model, k, derivative, jacobian)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(in) :: derivative(:, :)
      type(jacobian_t), intent(inout) :: jacobian
      integer :: i, slot, axis, node

      do i = 1, deformations_of(model%element_kind(k))
         do slot = 1, 4
            node = model%element_node(slot, k)
            if (node == 0) cycle
            do axis = 1, axes
               associate (value => derivative(i, axes*(slot - 1) + axis))
                  if (model%coordinate_class(axis, node) == class_none .or. .not. abs(value) > 0) cycle
                  call add_entry(jacobian, [k, i], [node, axis], value)
               end associate
            end do
         end do
      end do
   end subroutine add_element

   !> Where both ends share a node, its derivative is the sum of the two.
   pure subroutine join_ends(node, derivative)
      integer, intent(in) :: node(:)
      real(wp), intent(inout) :: derivative(:, :)

      if (node(1) == node(3)) then
         derivative(:, 1:3) = derivative(:, 1:3) + derivative(:, 7:9)
         derivative(:, 7:9) = 0.0_wp
      end if
      if (node(2) == node(4)) then
         derivative(:, 4:6) = derivative(:, 4:6) + derivative(:, 10:12)
         derivative(:, 10:12) = 0.0_wp
      end if
   end subroutine join_ends

   pure subroutine add_entry(jacobian, row, column, value)
      type(jacobian_t), intent(inout) :: jacobian
      integer, intent(in) :: row(2), column(2)
      real(wp), intent(in) :: value

      jacobian%entries = jacobian%entries + 1
      jacobian%row(:, jacobian%entries) = row
      jacobian%column(:, jacobian%entries) = column
      jacobian%value(jacobian%entries) = value
   end subroutine add_entry
end module flexact_jacobian
