! SPDX-License-Identifier: BSD-3-Clause
!> Mass and weight of every element and node, against the line of mass itself, cut into
!> points by Gauss's rule, and against rigid bodies.
program test_mass
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_element_gravity, only: element_gravity, node_gravity
   use flexact_element_mass, only: element_mass, node_mass
   use flexact_element_table, only: element_kinds, coordinates_of, member_hinge, member_beam
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_random_elements, only: is_planar, random_ends, random_vector, move_rigidly, moved
   use flexact_second_order, only: skew
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation
   use flexact_testing, only: tally_t, set_random
   use flexact_vectors, only: cross, planar_turn
   implicit none

   type(tally_t) :: tally
   type(reference_t) :: reference
   type(pose_t) :: p, q
   real(wp), parameter :: numbers(5) = [0.7_wp, 0.5_wp, 0.3_wp, 0.4_wp, -0.1_wp]
   real(wp), parameter :: no_inertia(5) = [0.7_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
   real(wp) :: none(6), m(12, 12), f(12), h(12, 12), g(3)
   integer :: kind, trial

   call set_random()
   none = ieee_value(1.0_wp, ieee_quiet_nan)
   do kind = 1, size(element_kinds)
      call test_no_numbers()
      do trial = 1, 20
         call test_velocities()
         call test_rigid_motion()
         call test_weight()
      end do
   end do
   call test_nodes()
   call tally%finish()

contains

   !> A point of the line at xi of its length, with the ends moved by a change.
   function point(xi, change) result(r)
      real(wp), intent(in) :: xi, change(12)
      real(wp) :: r(3)
      type(pose_t) :: at_p, at_q

      at_p = moved(p, change(1:6))
      at_q = moved(q, change(7:12))
      r = (1 - xi)*at_p%position + xi*at_q%position
      if (element_kinds(kind)%member /= member_beam) return
      r = (1 - 3*xi**2 + 2*xi**3)*at_p%position + (3*xi**2 - 2*xi**3)*at_q%position &
          + (xi - 2*xi**2 + xi**3)*tangent(at_p) + (xi**3 - xi**2)*tangent(at_q)
   end function point

   function tangent(pose)
      type(pose_t), intent(in) :: pose
      real(wp) :: tangent(3)
      tangent = matmul(pose%rotation, reference%offset)
      if (is_planar(kind)) tangent = planar_turn(pose%angle, reference%offset)
   end function tangent

   !> Gauss's rule of four points, exact for polynomials of degree 7.
   subroutine gauss(at, weight)
      real(wp), intent(out) :: at(4), weight(4)
      real(wp) :: s

      s = 2*sqrt(6/5.0_wp)/7
      at(1:2) = sqrt(3/7.0_wp + [-s, s])
      at = (1 + [at(1), at(2), -at(1), -at(2)])/2
      weight = (18 + sqrt(30.0_wp)*[1, -1, 1, -1])/72
   end subroutine gauss

   function random_velocity() result(v)
      real(wp) :: v(12)
      call random_number(v)
      v = 2*v - 1
      where (.not. coordinates_of(kind)) v = 0.0_wp
   end function random_velocity

   subroutine test_no_numbers()
      call random_ends(kind, reference, p, q)
      call element_mass(kind, reference, p, q, none(1:5), m)
      call element_gravity(kind, reference, p, q, none(1:5), [1.0_wp, 2.0_wp, 3.0_wp], f, h)
      call tally%check(all(abs(m) <= 0) .and. all(abs(h) <= 0) .and. all(abs(f) <= 0), 'no numbers, no mass')
   end subroutine test_no_numbers

   !> v'Mv/2 is the energy of the points of the line and of the inertia at the ends.
   subroutine test_velocities()
      real(wp), parameter :: step = 1.0e-4_wp
      real(wp) :: v(12), r(3), at(4), weight(4), energy
      integer :: i

      call random_ends(kind, reference, p, q)
      call element_mass(kind, reference, p, q, no_inertia, m)
      call tally%near(reshape(m, [144]), reshape(transpose(m), [144]), 0.0_wp, 'symmetric mass')
      v = random_velocity()
      call gauss(at, weight)
      energy = 0.0_wp
      do i = 1, 4
         r = (point(at(i), step*v) - point(at(i), -step*v))/(2*step)
         energy = energy + weight(i)*numbers(1)*reference%length*dot_product(r, r)/2
      end do
      if (element_kinds(kind)%member == member_hinge) energy = 0.0_wp
      call tally%near([dot_product(v, matmul(m, v))/2], [energy], 1.0e-7_wp, 'energy of '//element_kinds(kind)%keyword)
   end subroutine test_velocities

   !> A rigid rod of length l with its inertia J l about its own axes.
   subroutine test_rigid_motion()
      real(wp) :: v(12), spin(3), centre(3), middle(3), along(3), own(3), energy
      integer :: ends

      call move_rigidly(kind, reference, p, q)
      call element_mass(kind, reference, p, q, numbers, m)
      along = q%position - p%position
      middle = random_vector(1.0_wp, is_planar(kind))
      spin = random_vector(1.0_wp, .false.)
      if (is_planar(kind)) spin(1:2) = 0.0_wp
      centre = middle + cross(spin, along)/2
      v = [middle, spin, middle + cross(spin, along), spin]
      where (.not. coordinates_of(kind)) v = 0.0_wp
      ends = count(element_kinds(kind)%slot_kind([2, 4]) /= 0)
      own = matmul(spin, matmul(p%rotation, reference%frame))
      energy = numbers(1)*(dot_product(centre, centre) + dot_product(cross(spin, along), cross(spin, along))/12)/2
      if (ends > 0 .and. is_planar(kind)) energy = energy + numbers(2)*spin(3)**2/2
      if (ends > 0 .and. .not. is_planar(kind)) &
         energy = energy + (numbers(2)*own(1)**2 + numbers(3)*own(2)**2 + numbers(4)*own(3)**2 + 2*numbers(5)*own(2)*own(3))/2
      if (element_kinds(kind)%member == member_hinge) energy = 0.0_wp
      call tally%near([dot_product(v, matmul(m, v))/2], [reference%length*energy], 1.0e-13_wp, &
                      'energy of a rigid '//element_kinds(kind)%keyword)
   end subroutine test_rigid_motion

   !> -m g.r of the points, moved by a change.
   function potential(change) result(v)
      real(wp), intent(in) :: change(12)
      real(wp) :: v
      real(wp) :: at(4), weight(4)
      integer :: i

      v = 0.0_wp
      if (element_kinds(kind)%member == member_hinge) return
      call gauss(at, weight)
      do i = 1, 4
         v = v - weight(i)*numbers(1)*reference%length*dot_product(g, point(at(i), change))
      end do
   end function potential

   !> f and H against differences of the potential and of f; of f, which is -dV/dx, they
   !> are H + skew(f)/2 in spins.
   subroutine test_weight()
      real(wp), parameter :: step = 1.0e-4_wp
      real(wp) :: wanted(12, 12), change(12), ahead(12), back(12), unused(12, 12)
      integer :: i

      call random_ends(kind, reference, p, q)
      g = random_vector(1.0_wp, is_planar(kind))
      call element_gravity(kind, reference, p, q, numbers, g, f, h)
      call tally%near(reshape(h, [144]), reshape(transpose(h), [144]), 0.0_wp, 'symmetric weight')
      wanted = h
      do i = 4, 10, 6
         wanted(i:i + 2, i:i + 2) = h(i:i + 2, i:i + 2) + skew(f(i:i + 2))/2
      end do
      associate (has => coordinates_of(kind))
         do i = 1, 12
            if (.not. has(i)) cycle
            change = 0.0_wp
            change(i) = step
            call tally%near([-f(i)], [(potential(change) - potential(-change))/(2*step)], 1.0e-7_wp, &
                            'weight of '//element_kinds(kind)%keyword)
            call element_gravity(kind, reference, moved(p, change(1:6)), moved(q, change(7:12)), numbers, g, ahead, unused)
            change = -change
            call element_gravity(kind, reference, moved(p, change(1:6)), moved(q, change(7:12)), numbers, g, back, unused)
            call tally%near(pack(wanted(:, i), has), pack(back - ahead, has)/(2*step), 1.0e-7_wp, &
                            'weight that moves with '//element_kinds(kind)%keyword)
         end do
      end associate
   end subroutine test_weight

   !> J in the frame that turns with the node: turned by R it is R J R'.
   subroutine test_nodes()
      real(wp), parameter :: inertia(6) = [4.0_wp, 0.5_wp, -0.3_wp, 3.0_wp, 0.2_wp, 2.0_wp]
      real(wp) :: here(3, 3), euler(4), r(3, 3), spin(3)
      integer, parameter :: kinds(4) = [node_planar_position, node_position, node_angle, node_orientation]
      integer :: i

      do i = 1, 4
         call node_mass(kinds(i), no_rotation, none, here)
         call tally%check(all(abs(here) <= 0), 'a node without mass')
      end do
      call node_mass(node_position, no_rotation, inertia, here)
      call tally%near(reshape(here, [9]), 4.0_wp*[1, 0, 0, 0, 1, 0, 0, 0, 1], 0.0_wp, 'a point mass')
      call node_mass(node_planar_position, no_rotation, inertia, here)
      call tally%near(reshape(here, [9]), 4.0_wp*[1, 0, 0, 0, 1, 0, 0, 0, 0], 0.0_wp, 'a point mass in the plane')
      call node_mass(node_angle, no_rotation, inertia, here)
      call tally%near(reshape(here, [9]), 4.0_wp*[0, 0, 0, 0, 0, 0, 0, 0, 1], 0.0_wp, 'an inertia in the plane')
      euler = [0.3_wp, -0.7_wp, 0.2_wp, 0.6_wp]
      call node_mass(node_orientation, euler, inertia, here)
      r = relative_rotation(euler, no_rotation)
      spin = matmul(r, [1.0_wp, 2.0_wp, 3.0_wp])
      ! 4 + 3*4 + 2*9 and twice 0.5*2, -0.3*3, 0.2*6.
      call tally%near([dot_product(spin, matmul(here, spin))], [34 + 2*(1 - 0.9_wp + 1.2_wp)], 1.0e-13_wp, 'a turned inertia')
      call tally%near([node_gravity(node_position, inertia, spin), node_gravity(node_planar_position, inertia, spin), &
                       node_gravity(node_orientation, inertia, spin)], &
                      [4*spin, 4*spin(1:2), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 1.0e-14_wp, 'weight of a node')
   end subroutine test_nodes
end program test_mass
