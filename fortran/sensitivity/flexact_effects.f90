! SPDX-License-Identifier: BSD-3-Clause
!> What small changes of an element's geometry make of u' D v; theory.md (20).
!>
!> At rest u' D v is a sum of products of the axes ex, ey, ez, of l0 and of the vector
!> from p to q with what the ends do. A small change turns the axes together by w: each
!> ei changes by w x ei, so that of sum_i ei . a_i it makes w . t, t = sum_i ei x a_i.
module flexact_effects
   use flexact_element_table, only: element_kinds, member_bar, frame_about, frame_planar, rule_along => frame_along
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_configuration, only: element_frame, element_reference, stand_in
   use flexact_pose, only: reference_t
   use flexact_roles, only: role_elongation, role_torsion, role_bending_xz_p, role_bending_xz_q, role_bending_xy_p, &
                            role_bending_xy_q, role_planar_bending_p, role_planar_bending_q, role_offset_x, role_offset_z, &
                            role_rotation, role_tilt_z
   use flexact_slots, only: has_axis
   use flexact_vectors, only: cross
   implicit none
   private
   public :: geometry_t, make_geometry, find_effects, parameters

   !> The numbers of an element's geometry: the vector from p to q, and the y vector of a
   !> beam or the axis of a hinge.
   integer, parameter :: parameters = 6
   !> Effects are differences: below this part of what is added up in them nothing is left,
   !> as u and v are known to ten digits or so.
   real(wp), parameter :: negligible = 1.0e-8_wp

   !> An element at rest, and how its frame follows its vectors.
   type :: geometry_t
      integer :: kind = 0
      real(wp) :: offset(3) = 0.0_wp, vector(3) = 0.0_wp
      real(wp) :: length = 0.0_wp
      real(wp) :: frame(3, 3) = 0.0_wp
      !> Along which axes q can be moved against p.
      logical :: moves(3) = .false.
      !> The length of the vector that ex is along, 0 where no geometry turns it.
      real(wp) :: along = 0.0_wp
      !> Of the vector that ey is towards: its part along ex, and that along ey.
      real(wp) :: part_along = 0.0_wp, part_across = 1.0_wp
   end type geometry_t

contains

   pure subroutine make_geometry(model, k, geometry)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(geometry_t), intent(out) :: geometry
      type(reference_t) :: reference
      integer :: axis

      call element_reference(model, k, reference)
      geometry%kind = model%element_kind(k)
      geometry%offset = reference%offset
      geometry%length = reference%length
      geometry%vector = model%element_vector(:, k)
      geometry%frame = reference%frame
      if (element_kinds(geometry%kind)%member == member_bar) geometry%frame = element_frame(model, k)
      if (model%element_node(3, k) > 0) &
         geometry%moves = [(has_axis(model%node_kind(model%element_node(3, k)), axis), axis=1, 3)]
      select case (element_kinds(geometry%kind)%frame)
      case (rule_along)
         geometry%along = geometry%length
         if (.not. geometry%along > 0) return
         if (any(abs(geometry%vector) > 0)) then
            call take_parts(geometry%vector, geometry)
         else
            ! The global axis that stands in for it must not change with the geometry.
            call take_parts(stand_in(model, k), geometry)
         end if
      case (frame_about)
         geometry%along = norm2(geometry%vector)
         call take_parts(stand_in(model, k), geometry)
      case (frame_planar)
         geometry%along = geometry%length
      end select
   end subroutine make_geometry

   pure subroutine take_parts(hint, geometry)
      real(wp), intent(in) :: hint(3)
      type(geometry_t), intent(inout) :: geometry

      geometry%part_along = dot_product(hint, geometry%frame(:, 1))
      geometry%part_across = dot_product(hint, geometry%frame(:, 2))
   end subroutine take_parts

   !> The change of u' D v by each number of the geometry, zero where nothing is left of it;
   !> and what is nothing beside the offset's and the vector's. ends: what position and
   !> rotation of p, position and rotation of q do.
   pure subroutine find_effects(geometry, u, ends, effect, nothing)
      type(geometry_t), intent(in) :: geometry
      real(wp), intent(in) :: u(6), ends(12)
      real(wp), intent(out) :: effect(parameters), nothing(2)
      real(wp) :: a(3, 3), by_length, by_offset(3), t(3), turned(3)
      integer :: rule

      call gather(geometry, u, ends, a, by_length, by_offset)
      t = cross(geometry%frame(:, 1), a(:, 1)) + cross(geometry%frame(:, 2), a(:, 2)) + cross(geometry%frame(:, 3), a(:, 3))
      t = matmul(t, geometry%frame)
      effect = 0.0_wp
      rule = element_kinds(geometry%kind)%frame
      associate (ex => geometry%frame(:, 1), ey => geometry%frame(:, 2), ez => geometry%frame(:, 3), &
                 slope => geometry%part_along/geometry%part_across)
         effect(1:3) = by_offset
         if (geometry%along > 0) then
            turned = t(3)*ey/geometry%along
            if (rule /= frame_planar) turned = turned - (t(2) + t(1)*slope)*ez/geometry%along
            if (rule == frame_about) then
               effect(4:6) = turned
            else
               effect(1:3) = effect(1:3) + turned + by_length*ex
               if (any(abs(geometry%vector) > 0)) effect(4:6) = t(1)*ez/geometry%part_across
            end if
         end if
      end associate
      where (.not. geometry%moves) effect(1:3) = 0.0_wp
      nothing = negligible*norm2(u)*sizes(geometry, ends)
      where (abs(effect) <= [spread(nothing(1), 1, 3), spread(nothing(2), 1, 3)]) effect = 0.0_wp
   end subroutine find_effects

   !> u' D v = sum_i ei . a(:, i), and what it changes with the length and with the offset
   !> where they stand in it beside the axes.
   pure subroutine gather(geometry, u, ends, a, by_length, by_offset)
      type(geometry_t), intent(in) :: geometry
      real(wp), intent(in) :: u(6), ends(12)
      real(wp), intent(out) :: a(3, 3), by_length, by_offset(3)
      real(wp) :: apart(3), turn(3)
      integer :: i, axis

      a = 0.0_wp
      by_length = 0.0_wp
      by_offset = 0.0_wp
      apart = ends(7:9) - ends(1:3)
      turn = ends(10:12) - ends(4:6)
      associate (role => element_kinds(geometry%kind)%role)
         do i = 1, size(role)
            select case (role(i))
            case (0)
               exit
            case (role_elongation)
               a(:, 1) = a(:, 1) + u(i)*apart
            case (role_torsion)
               by_offset = by_offset + u(i)*turn
            case (role_bending_xz_p); call bend(geometry, -u(i), 3, 2, apart, ends(4:6), a, by_length)
            case (role_bending_xz_q); call bend(geometry, u(i), 3, 2, apart, ends(10:12), a, by_length)
            case (role_bending_xy_p); call bend(geometry, u(i), 2, 3, apart, -ends(4:6), a, by_length)
            case (role_bending_xy_q); call bend(geometry, -u(i), 2, 3, apart, -ends(10:12), a, by_length)
            case (role_planar_bending_p); call bend(geometry, -u(i), 2, 3, apart, -ends(4:6), a, by_length)
            case (role_planar_bending_q); call bend(geometry, u(i), 2, 3, apart, -ends(10:12), a, by_length)
            case (role_offset_x:role_offset_z)
               axis = role(i) - role_offset_x + 1
               a(:, axis) = a(:, axis) + u(i)*(apart + cross(geometry%offset, ends(4:6)))
               by_offset = by_offset + u(i)*cross(ends(4:6), geometry%frame(:, axis))
            case (role_rotation:role_tilt_z)
               axis = role(i) - role_rotation + 1
               a(:, axis) = a(:, axis) + u(i)*turn
            end select
         end do
      end associate
   end subroutine gather

   !> A bending: u (e_across . apart + l0 e_about . turn).
   pure subroutine bend(geometry, u, across, about, apart, turn, a, by_length)
      type(geometry_t), intent(in) :: geometry
      real(wp), intent(in) :: u, apart(3), turn(3)
      integer, intent(in) :: across, about
      real(wp), intent(inout) :: a(3, 3), by_length

      a(:, across) = a(:, across) + u*apart
      a(:, about) = a(:, about) + (u*geometry%length)*turn
      by_length = by_length + u*dot_product(geometry%frame(:, about), turn)
   end subroutine bend

   !> The size of what is added up in the effects of the offset and of the vector, for u = 1.
   pure function sizes(geometry, ends)
      type(geometry_t), intent(in) :: geometry
      real(wp), intent(in) :: ends(12)
      real(wp) :: sizes(2)
      real(wp) :: moved, turned, slope

      moved = sum(abs(ends(1:3))) + sum(abs(ends(7:9)))
      turned = sum(abs(ends(4:6))) + sum(abs(ends(10:12)))
      slope = 1 + abs(geometry%part_along/geometry%part_across)
      sizes = turned
      if (.not. geometry%along > 0) return
      if (element_kinds(geometry%kind)%frame == frame_about) then
         sizes(2) = slope*(moved + geometry%length*turned + turned)/geometry%along
      else
         sizes(1) = slope*(moved/geometry%length + turned)
         if (any(abs(geometry%vector) > 0)) sizes(2) = (moved + geometry%length*turned)/abs(geometry%part_across)
      end if
   end function sizes
end module flexact_effects
