! SPDX-License-Identifier: BSD-3-Clause
!> The mass of elements and nodes in any configuration: the kinetic energy is
!> v' M v/2 with the velocities of positions and the spins about the global axes.
module flexact_element_mass
   use flexact_element_table, only: element_kinds, coordinates_of
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_given, only: given
   use flexact_kinds, only: wp
   use flexact_mass_line, only: has_mass_line, line_products, line_rates
   use flexact_pose, only: pose_t, reference_t
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation
   use flexact_vectors, only: identity
   implicit none
   private
   public :: element_mass, node_mass

contains

   !> The consistent mass of the element's line, and its rotary inertia in equal shares at
   !> the orientation nodes that it has, in the frame that turns with each. An element
   !> without extent has none; an arm of a rigid body is a straight rod from p to q.
   pure subroutine element_mass(kind, reference, p, q, numbers, m)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      !> As EM has them: mass per length, then Jxx, Jyy, Jzz, Jyz per length, in the plane
      !> J; NaN where not given, which is none.
      real(wp), intent(in) :: numbers(5)
      real(wp), intent(out) :: m(12, 12)
      real(wp) :: rates(3, 12, 4), products(4, 4), total
      integer :: i, j

      m = 0.0_wp
      if (.not. has_mass_line(kind)) return
      rates = line_rates(kind, reference, p, q)
      products = line_products(kind)
      total = given(numbers(1))*reference%length
      do j = 1, 4
         do i = 1, 4
            if (abs(products(i, j)) > 0) &
               m = m + total*products(i, j)*matmul(transpose(rates(:, :, i)), rates(:, :, j))
         end do
      end do
      call add_rotary(kind, reference, p, q, given(numbers(2:5)), m)
      m = (m + transpose(m))/2
      where (.not. (spread(coordinates_of(kind), 1, 12) .and. spread(coordinates_of(kind), 2, 12))) m = 0.0_wp
   end subroutine element_mass

   pure subroutine add_rotary(kind, reference, p, q, numbers, m)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: numbers(4)
      real(wp), intent(inout) :: m(12, 12)
      real(wp) :: inertia(3, 3)

      associate (slot => element_kinds(kind)%slot_kind)
         inertia = tensor([numbers(1), 0.0_wp, 0.0_wp, numbers(2), numbers(4), numbers(3)])
         ! About the one axis of the plane, whatever the frame.
         if (any(slot == node_angle)) inertia = numbers(1)*identity
         inertia = inertia*reference%length/max(1, count(slot([2, 4]) /= 0))
         if (slot(2) /= 0) m(4:6, 4:6) = m(4:6, 4:6) + turned(matmul(p%rotation, reference%frame), inertia)
         if (slot(4) /= 0) m(10:12, 10:12) = m(10:12, 10:12) + turned(matmul(q%rotation, reference%frame), inertia)
      end associate
   end subroutine add_rotary

   !> The mass at a node of any kind, (3, 3) for its axes.
   pure subroutine node_mass(kind, value, numbers, m)
      !> Kind of node and its value in the configuration (4): Euler parameters of an
      !> orientation node.
      integer, intent(in) :: kind
      real(wp), intent(in) :: value(4)
      !> As XM has them: mass of a position; Jxx, Jxy, Jxz, Jyy, Jyz, Jzz of an
      !> orientation in the frame that turns with the node, the global axes where its
      !> Euler parameters are (1, 0, 0, 0); J of an angle. NaN where not given.
      real(wp), intent(in) :: numbers(6)
      real(wp), intent(out) :: m(3, 3)

      m = 0.0_wp
      select case (kind)
      case (node_position)
         m = given(numbers(1))*identity
      case (node_planar_position)
         m(1:2, 1:2) = given(numbers(1))*identity(1:2, 1:2)
      case (node_angle)
         m(3, 3) = given(numbers(1))
      case (node_orientation)
         m = turned(relative_rotation(value, no_rotation), tensor(given(numbers)))
         m = (m + transpose(m))/2
      end select
   end subroutine node_mass

   !> R J R'.
   pure function turned(rotation, inertia) result(there)
      real(wp), intent(in) :: rotation(3, 3), inertia(3, 3)
      real(wp) :: there(3, 3)
      there = matmul(rotation, matmul(inertia, transpose(rotation)))
   end function turned

   !> Jxx, Jxy, Jxz, Jyy, Jyz, Jzz, the entries of the matrix as they stand in it.
   pure function tensor(j) result(matrix)
      real(wp), intent(in) :: j(6)
      real(wp) :: matrix(3, 3)
      matrix = reshape(j([1, 2, 3, 2, 4, 5, 3, 5, 6]), [3, 3])
   end function tensor
end module flexact_element_mass
