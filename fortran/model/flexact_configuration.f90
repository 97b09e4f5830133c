! SPDX-License-Identifier: BSD-3-Clause
!> The elements of a model in a configuration: their references, and the poses
!> of their ends.
module flexact_configuration
   use flexact_element_table, only: element_kinds, member_bar, rule_along => frame_along, frame_about, frame_planar
   use flexact_euler, only: relative_rotation
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_pose, only: pose_t, reference_t
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation
   use flexact_vectors, only: axis_across, frame_along, is_near_tie, length_of, planar_frame_along
   implicit none
   private
   public :: element_reference, element_frame, element_frames, make_poses
   public :: stand_in, leans_on_near_tie

contains

   !> What element k measures its deformations from, and where its ends are then.
   pure subroutine element_reference(model, k, reference, at_p, at_q)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(reference_t), intent(out) :: reference
      type(pose_t), intent(out), optional :: at_p, at_q
      type(pose_t) :: p, q

      call make_poses(model, k, model%node_value, p, q)
      if (present(at_p)) at_p = p
      if (present(at_q)) at_q = q
      reference%offset = q%position - p%position
      reference%length = length_of(reference%offset)
      ! A bar's deformation needs no frame, and bars are many.
      if (element_kinds(model%element_kind(k))%member /= member_bar) reference%frame = element_frame(model, k)
   end subroutine element_reference

   !> The local axes ex, ey, ez of element k as columns, by the rule of its kind. An element
   !> in the plane without a line has z as ex.
   pure function element_frame(model, k) result(frame)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: frame(3, 3)
      real(wp) :: from(3), to(3)

      call find_line(model, k, from, to)
      associate (vector => model%element_vector(:, k))
         select case (element_kinds(model%element_kind(k))%frame)
         case (rule_along)
            if (any(abs(vector) > 0)) then
               frame = frame_along(to - from, vector)
            else
               frame = frame_along(to - from, stand_in(model, k))
            end if
         case (frame_about)
            frame = frame_along(vector, stand_in(model, k))
         case (frame_planar)
            frame = planar_frame_along(to - from)
         case default
            frame = frame_along([0.0_wp, 0.0_wp, 1.0_wp], stand_in(model, k))
         end select
      end associate
   end function element_frame

   !> The global axis that ey of element k is towards where no vector says so.
   pure function stand_in(model, k) result(axis)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: axis(3)
      real(wp) :: from(3), to(3)

      call find_line(model, k, from, to)
      axis = axis_across(from, to)
   end function stand_in

   !> Whether that axis is chosen by a difference that is hardly meant.
   pure logical function leans_on_near_tie(model, k)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: from(3), to(3)

      call find_line(model, k, from, to)
      associate (rule => element_kinds(model%element_kind(k))%frame)
         leans_on_near_tie = rule == frame_about .or. (rule == rule_along .and. all(abs(model%element_vector(:, k)) <= 0))
      end associate
      if (leans_on_near_tie) leans_on_near_tie = is_near_tie(from, to)
   end function leans_on_near_tie

   !> Two points of the line that ex of element k is along: its ends, or the origin and its axis.
   pure subroutine find_line(model, k, from, to)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(out) :: from(3), to(3)
      integer :: seen

      from = 0.0_wp
      to = 0.0_wp
      associate (kind => element_kinds(model%element_kind(k)), p => model%element_node(1, k), q => model%element_node(3, k))
         if (kind%frame == frame_about) then
            to = model%element_vector(:, k)
         else if (p > 0 .and. q > 0) then
            ! A planar element sees x and y alone.
            seen = merge(2, 3, kind%slot_kind(1) == node_planar_position)
            from(:seen) = model%node_value(:seen, p)
            to(:seen) = model%node_value(:seen, q)
         end if
      end associate
   end subroutine find_line

   !> The reference frame of every element, (3, 3, elements) with the axes as
   !> columns, and its length [m], (elements).
   pure subroutine element_frames(model, frame, length)
      type(model_t), intent(in) :: model
      real(wp), intent(out) :: frame(:, :, :), length(:)
      type(reference_t) :: reference
      integer :: k

      do k = 1, model%elements
         call element_reference(model, k, reference)
         frame(:, :, k) = element_frame(model, k)
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
