! SPDX-License-Identifier: BSD-3-Clause
!> Derivatives of every element against central differences, and no
!> deformation in a motion of the element as a rigid body.
program test_derivatives
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_vectors, only: frame_along, planar_frame_along, planar_turn
   use flexact_element, only: element_deformation
   use flexact_element_table, only: element_kinds
   use flexact_slots, only: node_planar_position, node_angle
   use flexact_testing, only: tally_t, set_random
   implicit none

   type(tally_t) :: tally
   integer :: kind, trial

   call set_random()
   do kind = 1, size(element_kinds)
      do trial = 1, 20
         call compare_derivatives(kind)
         call move_rigidly(kind)
      end do
   end do
   call tally%finish()

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

   !> Move or turn an end by one of the columns of the derivative, 1 to 6.
   pure function nudged(pose, column, step) result(moved)
      type(pose_t), intent(in) :: pose
      integer, intent(in) :: column
      real(wp), intent(in) :: step
      type(pose_t) :: moved
      real(wp) :: axis(3)

      moved = pose
      axis = 0.0_wp
      axis(modulo(column - 1, 3) + 1) = 1.0_wp
      if (column <= 3) then
         moved%position = pose%position + step*axis
      else
         moved%rotation = matmul(relative_rotation([cos(step/2), sin(step/2)*axis], no_rotation), pose%rotation)
         if (column == 6) moved%angle = pose%angle + step
      end if
   end function nudged

   subroutine compare_derivatives(kind)
      integer, intent(in) :: kind
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: e(6), derivative(6, 12), ahead(6), back(6), unused(6, 12)
      integer :: column

      reference = random_reference(is_planar(kind))
      p = random_pose([0.0_wp, 0.0_wp, 0.0_wp], is_planar(kind))
      q = random_pose(reference%offset, is_planar(kind))
      call element_deformation(kind, reference, p, q, e, derivative)
      do column = 1, 12
         if (is_planar(kind) .and. any(column == [3, 9])) cycle
         if (column <= 6) then
            call element_deformation(kind, reference, nudged(p, column, step), q, ahead, unused)
            call element_deformation(kind, reference, nudged(p, column, -step), q, back, unused)
         else
            call element_deformation(kind, reference, p, nudged(q, column - 6, step), ahead, unused)
            call element_deformation(kind, reference, p, nudged(q, column - 6, -step), back, unused)
         end if
         call tally%near(derivative(:, column), (ahead - back)/(2*step), 1.0e-7_wp, &
                         'derivative of '//element_kinds(kind)%keyword)
      end do
   end subroutine compare_derivatives

   subroutine move_rigidly(kind)
      integer, intent(in) :: kind
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(6), derivative(6, 12)

      reference = random_reference(is_planar(kind))
      p = random_pose([0.0_wp, 0.0_wp, 0.0_wp], is_planar(kind))
      q = p
      if (is_planar(kind)) then
         q%position = p%position + planar_turn(p%angle, reference%offset)
      else
         q%position = p%position + matmul(p%rotation, reference%offset)
      end if
      call element_deformation(kind, reference, p, q, e, derivative)
      call tally%near(e/reference%length, 0*e, 1.0e-12_wp, 'rigid motion of '//element_kinds(kind)%keyword)
   end subroutine move_rigidly
end program test_derivatives
