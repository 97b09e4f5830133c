! SPDX-License-Identifier: BSD-3-Clause
!> Elements of every kind with a random reference, at random poses far from it.
module flexact_random_elements
   use flexact_element_table, only: element_kinds
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_slots, only: node_planar_position, node_angle
   use flexact_vectors, only: frame_along, planar_frame_along, planar_turn
   implicit none
   private
   public :: is_planar, random_vector, random_reference, random_pose, random_ends, move_rigidly, nudged, moved

contains

   logical function is_planar(kind)
      integer, intent(in) :: kind
      is_planar = any(element_kinds(kind)%slot_kind == node_planar_position .or. element_kinds(kind)%slot_kind == node_angle)
   end function is_planar

   !> Components between -size and size; without z in the plane.
   function random_vector(size, planar) result(vector)
      real(wp), intent(in) :: size
      logical, intent(in) :: planar
      real(wp) :: vector(3)

      call random_number(vector)
      vector = size*(2*vector - 1)
      if (planar) vector(3) = 0.0_wp
   end function random_vector

   function random_reference(planar) result(reference)
      logical, intent(in) :: planar
      type(reference_t) :: reference

      reference%offset = [1.5_wp, 0.3_wp, 0.0_wp] + random_vector(0.5_wp, planar)
      reference%length = norm2(reference%offset)
      reference%c_t = 0.3_wp
      if (planar) then
         reference%frame = planar_frame_along(reference%offset)
      else
         reference%frame = frame_along(reference%offset, random_vector(1.0_wp, planar))
      end if
   end function random_reference

   !> A pose turned by up to two thirds of a turn.
   function random_pose(position, planar) result(pose)
      real(wp), intent(in) :: position(3)
      logical, intent(in) :: planar
      type(pose_t) :: pose
      real(wp) :: turn(3)

      turn = random_vector(1.2_wp, .false.)
      pose%position = position + random_vector(0.4_wp, planar)
      if (planar) then
         pose%angle = turn(3)
      else
         pose%rotation = relative_rotation([1.0_wp, turn], no_rotation)
      end if
   end function random_pose

   subroutine random_ends(kind, reference, p, q)
      integer, intent(in) :: kind
      type(reference_t), intent(out) :: reference
      type(pose_t), intent(out) :: p, q

      reference = random_reference(is_planar(kind))
      p = random_pose([0.0_wp, 0.0_wp, 0.0_wp], is_planar(kind))
      q = random_pose(reference%offset, is_planar(kind))
   end subroutine random_ends

   !> An element that has moved as a rigid body.
   subroutine move_rigidly(kind, reference, p, q)
      integer, intent(in) :: kind
      type(reference_t), intent(out) :: reference
      type(pose_t), intent(out) :: p, q

      reference = random_reference(is_planar(kind))
      p = random_pose([0.0_wp, 0.0_wp, 0.0_wp], is_planar(kind))
      q = p
      if (is_planar(kind)) then
         q%position = p%position + planar_turn(p%angle, reference%offset)
      else
         q%position = p%position + matmul(p%rotation, reference%offset)
      end if
   end subroutine move_rigidly

   !> Move or turn an end by one of the columns of the derivative, 1 to 6.
   pure function nudged(pose, column, step) result(there)
      type(pose_t), intent(in) :: pose
      integer, intent(in) :: column
      real(wp), intent(in) :: step
      type(pose_t) :: there
      real(wp) :: change(6)

      change = 0.0_wp
      change(column) = step
      there = moved(pose, change)
   end function nudged

   !> Move by a vector, and turn by exp of a rotation vector about the global axes; a
   !> planar angle by its third component.
   pure function moved(pose, change) result(there)
      type(pose_t), intent(in) :: pose
      real(wp), intent(in) :: change(6)
      type(pose_t) :: there
      real(wp) :: angle

      there%position = pose%position + change(1:3)
      there%angle = pose%angle + change(6)
      angle = norm2(change(4:6))
      there%rotation = pose%rotation
      if (angle > 0.0_wp) &
         there%rotation = matmul(relative_rotation([cos(angle/2), sin(angle/2)*change(4:6)/angle], no_rotation), pose%rotation)
   end function moved
end module flexact_random_elements
