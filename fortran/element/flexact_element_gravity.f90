! SPDX-License-Identifier: BSD-3-Clause
!> The weight of elements and nodes, from the same line as the mass.
module flexact_element_gravity
   use flexact_element_table, only: coordinates_of
   use flexact_given, only: given
   use flexact_kinds, only: wp
   use flexact_mass_line, only: has_mass_line, line_means, line_rates, end_tangent
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: turned_once
   use flexact_slots, only: node_planar_position, node_position
   implicit none
   private
   public :: element_gravity, node_gravity

contains

   !> Force f = -dV/dx (12) and second derivative H = d2V/dx2 (12, 12) of the potential
   !> V = -m g.r of the element's line, with the coordinates of `element_curvature`; H is
   !> symmetric and part of the tangent stiffness.
   pure subroutine element_gravity(kind, reference, p, q, numbers, g, f, h)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> As EM has them, mass per length first; NaN where not given, which is none.
      real(wp), intent(in) :: numbers(5)
      !> Acceleration of gravity [m/s^2].
      real(wp), intent(in) :: g(3)
      real(wp), intent(out) :: f(12), h(12, 12)
      real(wp) :: rates(3, 12, 4), means(4)
      integer :: i

      f = 0.0_wp
      h = 0.0_wp
      if (.not. has_mass_line(kind)) return
      rates = line_rates(kind, reference, p, q)
      means = given(numbers(1))*reference%length*line_means(kind)
      do i = 1, 4
         f = f + means(i)*matmul(g, rates(:, :, i))
      end do
      h(4:6, 4:6) = -means(2)*turned_once(end_tangent(kind, 2, reference, p), g)
      h(10:12, 10:12) = -means(4)*turned_once(end_tangent(kind, 4, reference, q), g)
      associate (has => coordinates_of(kind))
         where (.not. has) f = 0.0_wp
         where (.not. (spread(has, 1, 12) .and. spread(has, 2, 12))) h = 0.0_wp
      end associate
   end subroutine element_gravity

   !> Force (3) on a node with the mass of XM; it does not change as the node moves.
   pure function node_gravity(kind, numbers, g) result(f)
      integer, intent(in) :: kind
      real(wp), intent(in) :: numbers(6), g(3)
      real(wp) :: f(3)

      f = 0.0_wp
      if (kind == node_position .or. kind == node_planar_position) f = given(numbers(1))*g
      if (kind == node_planar_position) f(3) = 0.0_wp
   end function node_gravity
end module flexact_element_gravity
