! SPDX-License-Identifier: BSD-3-Clause
!> The elements of a model in a configuration: their references, and the poses
!> of their ends.
module flexact_configuration
   use flexact_element, only: make_reference, reference_frame
   use flexact_element_table, only: element_kinds
   use flexact_euler, only: relative_rotation
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_pose, only: pose_t, reference_t
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation
   implicit none
   private
   public :: element_reference, element_frames, make_poses

contains

   !> What element k measures its deformations from.
   pure subroutine element_reference(model, k, reference)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(reference_t), intent(out) :: reference
      type(pose_t) :: p, q

      call make_poses(model, k, model%node_value, p, q)
      call make_reference(model%element_kind(k), q%position - p%position, model%element_vector(:, k), reference)
   end subroutine element_reference

   !> The reference frame of every element, (3, 3, elements) with the axes as
   !> columns, and its length [m], (elements).
   pure subroutine element_frames(model, frame, length)
      type(model_t), intent(in) :: model
      real(wp), intent(out) :: frame(:, :, :), length(:)
      type(reference_t) :: reference
      integer :: k

      do k = 1, model%elements
         call element_reference(model, k, reference)
         frame(:, :, k) = reference_frame(model%element_kind(k), reference%offset, model%element_vector(:, k))
         length(k) = reference%length
      end do
   end subroutine element_frames

   !> The ends of element k in a configuration given as node values,
   !> (4, nodes). A slot without a node leaves its part of the pose at rest; a
   !> planar element sees x and y of its nodes alone.
   pure subroutine make_poses(model, k, configuration, p, q)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(in) :: configuration(:, :)
      type(pose_t), intent(out) :: p, q

      associate (node => model%element_node(:, k), wanted => element_kinds(model%element_kind(k))%slot_kind)
         call place(model, node(1), wanted(1), configuration, p)
         call place(model, node(2), wanted(2), configuration, p)
         call place(model, node(3), wanted(3), configuration, q)
         call place(model, node(4), wanted(4), configuration, q)
      end associate
   end subroutine make_poses

   !> Put into a pose what one node says of it to a slot of this node kind.
   pure subroutine place(model, node, wanted, configuration, pose)
      type(model_t), intent(in) :: model
      integer, intent(in) :: node, wanted
      real(wp), intent(in) :: configuration(:, :)
      type(pose_t), intent(inout) :: pose

      select case (wanted)
      case (node_planar_position)
         pose%position(1:2) = configuration(1:2, node)
      case (node_position)
         pose%position = configuration(1:3, node)
      case (node_angle)
         pose%angle = configuration(1, node) - model%node_value(1, node)
      case (node_orientation)
         ! At rest it is the identity, as most are that anybody asks for.
         if (any(configuration(:, node) /= model%node_value(:, node))) &
            pose%rotation = relative_rotation(configuration(:, node), model%node_value(:, node))
      end select
   end subroutine place
end module flexact_configuration
