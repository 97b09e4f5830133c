! SPDX-License-Identifier: BSD-3-Clause
!> Which elements hold all their deformations, and which nodes are of one rigid body.
module flexact_rigid_bodies
   use flexact_element_table, only: element_kinds, deformations_of, member_bar, member_beam, member_link
   use flexact_model, only: model_t, class_fixed, class_none
   use flexact_sorting, only: root_of, join
   implicit none
   private
   public :: is_rigid, is_flexible, holds_something, find_bodies, is_ground

contains

   !> Whether element k holds all its deformations, and is no bar.
   pure logical function is_rigid(model, k)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k

      is_rigid = element_kinds(model%element_kind(k))%member /= member_bar
      if (is_rigid) is_rigid = all(model%deformation_class(:deformations_of(model%element_kind(k)), k) == class_fixed)
   end function is_rigid

   !> Whether element k is a beam, a link or a bar of which something is free.
   pure logical function is_flexible(model, k)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k

      associate (class => model%deformation_class(:deformations_of(model%element_kind(k)), k))
         is_flexible = any(element_kinds(model%element_kind(k))%member == [member_bar, member_beam, member_link]) &
                       .and. .not. all(class == class_fixed)
      end associate
   end function is_flexible

   pure logical function holds_something(model, k)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      holds_something = any(model%deformation_class(:, k) == class_fixed)
   end function holds_something

   !> Whether every coordinate of a node is fixed.
   pure logical function is_ground(model, node)
      type(model_t), intent(in) :: model
      integer, intent(in) :: node
      is_ground = all(model%coordinate_class(:, node) == class_fixed .or. model%coordinate_class(:, node) == class_none)
   end function is_ground

   !> The rigid body of each orientation node, as one of the nodes, and behind them that
   !> of the ground, (nodes + 1); of position nodes whether they are of the ground.
   pure subroutine find_bodies(model, body)
      type(model_t), intent(in) :: model
      integer, intent(out) :: body(:)
      integer :: parent(model%nodes + 1), k, node, root

      parent = [(node, node=1, model%nodes + 1)]
      do node = 1, model%nodes
         if (is_ground(model, node)) call join(parent, node, model%nodes + 1)
      end do
      do k = 1, model%elements
         associate (joined => model%element_node(:, k))
            if (joined(2) == 0 .or. joined(4) == 0) cycle
            if (is_rigid(model, k)) call join(parent, joined(2), joined(4))
         end associate
      end do
      do node = 1, model%nodes + 1
         call root_of(parent, node, root)
         body(node) = root
      end do
   end subroutine find_bodies
end module flexact_rigid_bodies
