! SPDX-License-Identifier: BSD-3-Clause
!> States of an elastic model, and how they change under increments.
module flexact_elastic_state
   use flexact_elastic_model, only: elastic_model_t
   use flexact_kinds, only: wp
   use flexact_slots, only: axes, node_angle, node_orientation
   use flexact_vectors, only: cross
   implicit none
   private
   public :: state_t, waypoint_t, between, moved, put_supports, increment_between, unit_parameters, turned, rotation_between

   !> configuration (4, nodes) as node values, Euler parameters of unit length; stress (6,
   !> elements), of rigid deformations the multipliers; reaction (3, nodes) at what is held:
   !> force or moment on the mechanism; of a single Euler parameter the moment that does work
   !> on twice its change.
   type :: state_t
      real(wp), allocatable :: configuration(:, :), stress(:, :), reaction(:, :)
   end type state_t

   !> target (4, nodes): where held coordinates are; misfit (6, elements): deformations without
   !> stress; force (3 nodes): dead loads, moments dual to the spin; gravity (3).
   type :: waypoint_t
      real(wp), allocatable :: target(:, :), misfit(:, :), force(:)
      real(wp) :: gravity(3) = 0.0_wp
   end type waypoint_t

contains

   !> What is given at a fraction t of the way; orientations turn by the shortest rotation.
   pure function between(elastic, begin, end, t) result(there)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: begin, end
      real(wp), intent(in) :: t
      type(waypoint_t) :: there
      integer :: node, first

      if (t >= 1) then
         there = end
         return
      end if
      there%target = begin%target + t*(end%target - begin%target)
      there%misfit = begin%misfit + t*(end%misfit - begin%misfit)
      there%force = begin%force + t*(end%force - begin%force)
      there%gravity = begin%gravity + t*(end%gravity - begin%gravity)
      do node = 1, elastic%model%nodes
         first = axes*(node - 1) + 1
         if (elastic%model%node_kind(node) /= node_orientation .or. .not. elastic%is_held(first)) cycle
         there%target(:, node) = turned(begin%target(:, node), &
                                        t*rotation_between(begin%target(:, node), end%target(:, node)))
      end do
   end function between

   !> The increment that leads from one configuration to another.
   pure function increment_between(elastic, from, to) result(way)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: from(:, :), to(:, :)
      real(wp) :: way(axes*size(to, 2))
      integer :: node

      way = 0.0_wp
      do node = 1, elastic%model%nodes
         associate (w => way(axes*(node - 1) + 1:axes*node))
            select case (elastic%model%node_kind(node))
            case (node_orientation); w = rotation_between(from(:, node), to(:, node))
            case (node_angle); w(axes) = to(1, node) - from(1, node)
            case default; w = to(:axes, node) - from(:axes, node)
            end select
         end associate
      end do
   end function increment_between

   !> The configuration after an increment.
   pure subroutine moved(elastic, increment, configuration)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: increment(:)
      real(wp), intent(inout) :: configuration(:, :)
      integer :: node

      do node = 1, elastic%model%nodes
         associate (w => increment(axes*(node - 1) + 1:axes*node), value => configuration(:, node))
            select case (elastic%model%node_kind(node))
            case (node_orientation); if (any(abs(w) > 0)) value = turned(value, w)
            case (node_angle); value(1) = value(1) + w(axes)
            case default; value(:axes) = value(:axes) + w
            end select
         end associate
      end do
   end subroutine moved

   !> What is held, exactly at its target.
   pure subroutine put_supports(elastic, target, configuration)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: target(:, :)
      real(wp), intent(inout) :: configuration(:, :)
      integer :: node, axis

      do node = 1, elastic%model%nodes
         if (elastic%is_turn(axes*node)) then
            if (elastic%is_held(axes*node)) configuration(:, node) = target(:, node)
            cycle
         end if
         do axis = 1, axes
            if (elastic%is_held(axes*(node - 1) + axis)) configuration(axis, node) = target(axis, node)
         end do
      end do
   end subroutine put_supports

   !> Euler parameters of unit length; four zeros are no rotation.
   pure function unit_parameters(euler) result(unit)
      real(wp), intent(in) :: euler(4)
      real(wp) :: unit(4)

      unit = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      if (norm2(euler) > 0) unit = euler/norm2(euler)
   end function unit_parameters

   !> Euler parameters after a further rotation by a vector w.
   pure function turned(euler, w) result(after)
      real(wp), intent(in) :: euler(4), w(3)
      real(wp) :: after(4)
      real(wp) :: angle, s, v(3)

      angle = norm2(w)
      s = cos(angle/2)
      v = w/2*(1 - angle**2/24)
      if (angle > 1.0e-4_wp) v = w*(sin(angle/2)/angle)
      after(1) = s*euler(1) - dot_product(v, euler(2:))
      after(2:) = s*euler(2:) + euler(1)*v + cross(v, euler(2:))
      after = unit_parameters(after)
   end function turned

   !> The shortest rotation vector from one orientation to another.
   pure function rotation_between(from, to) result(w)
      real(wp), intent(in) :: from(4), to(4)
      real(wp) :: w(3)
      real(wp) :: a(4), b(4), change(4), s, v(3)

      a = unit_parameters(from)
      b = unit_parameters(to)
      if (dot_product(a, b) < 0) b = -b
      change = b - a
      s = dot_product(a, b)
      v = a(1)*change(2:) - change(1)*a(2:) - cross(change(2:), a(2:))
      w = 2*v
      if (norm2(v) > 1.0e-8_wp) w = 2*atan2(norm2(v), s)*v/norm2(v)
   end function rotation_between
end module flexact_elastic_state
