! SPDX-License-Identifier: BSD-3-Clause
!> Local frames, and rotations from Euler parameters.
program test_frames
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_slots, only: node_position, node_orientation, node_planar_position, node_angle
   use flexact_pose, only: pose_t, reference_t
   use flexact_vectors, only: axis_across, cross, is_near_tie
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_configuration, only: element_reference
   use flexact_configuration, only: make_poses
   use flexact_element_table, only: find_element_kind
   use flexact_testing, only: tally_t, set_random
   use flexact_test_models, only: new_model, set_node, set_element
   implicit none

   type(tally_t) :: tally
   real(wp), parameter :: x(3) = [1.0_wp, 0.0_wp, 0.0_wp]
   real(wp), parameter :: y(3) = [0.0_wp, 1.0_wp, 0.0_wp]
   real(wp), parameter :: z(3) = [0.0_wp, 0.0_wp, 1.0_wp]
   real(wp), parameter :: none(3) = 0.0_wp

   call set_random()
   call test_beam_frames()
   call test_ties()
   call test_ties_of_odd_numbers()
   call test_hinge_frames()
   call test_planar_frame()
   call test_rotation_matrix()
   call test_relative_rotation()
   call test_poses()
   call tally%finish()

contains

   !> The reference of an element of a kind with slots p, op, q, oq from the
   !> origin to a point.
   function reference_of(kind, point, vector) result(reference)
      integer, intent(in) :: kind
      real(wp), intent(in) :: point(3), vector(3)
      type(reference_t) :: reference
      type(model_t) :: model

      model = new_model(4, 1)
      call set_node(model, 1, node_position, none)
      call set_node(model, 2, node_orientation, [1.0_wp, none])
      call set_node(model, 3, node_position, point)
      call set_node(model, 4, node_orientation, [1.0_wp, none])
      call set_element(model, 1, kind, [1, 2, 3, 4], vector)
      if (kind == find_element_kind('HINGE')) model%element_node(:, 1) = [0, 2, 0, 4]
      call element_reference(model, 1, reference)
   end function reference_of

   subroutine check_frame(reference, ex, ey, name)
      type(reference_t), intent(in) :: reference
      real(wp), intent(in) :: ex(3), ey(3)
      character(len=*), intent(in) :: name
      call tally%near(reshape(reference%frame, [9]), [ex, ey, cross(ex, ey)], 1.0e-15_wp, name)
   end subroutine check_frame

   subroutine test_beam_frames()
      type(reference_t) :: reference
      real(wp), parameter :: r = 1/sqrt(2.0_wp)
      real(wp) :: size

      reference = reference_of(find_element_kind('BEAM'), 2*x, [5.0_wp, 3.0_wp, 0.0_wp])
      call check_frame(reference, x, y, 'vector made perpendicular to the beam')
      call tally%near([reference%length, reference%offset], [2.0_wp, 2*x], 0.0_wp, 'length and offset')
      call check_frame(reference_of(find_element_kind('BEAM'), -z, -y), -z, -y, 'vector as it is')
      call check_frame(reference_of(find_element_kind('BEAM'), [3.0_wp, 2.0_wp, 0.0_wp], z), &
                       [3.0_wp, 2.0_wp, 0.0_wp]/sqrt(13.0_wp), z, 'oblique beam')
      call check_frame(reference_of(find_element_kind('BEAM'), [1.0_wp, 0.0_wp, 1.0_wp], none), [r, 0.0_wp, r], y, &
                       'without a vector the axis least along the beam')
      call check_frame(reference_of(find_element_kind('BEAM'), x, none), x, y, 'and the first of equals')
      call check_frame(reference_of(find_element_kind('BEAM'), x, 7*x), x, y, 'a parallel vector is as none')
      reference = reference_of(find_element_kind('BEAM'), x, [1.0_wp, 1.0e-9_wp, 0.0_wp])
      call check_frame(reference, x, y, 'a nearly parallel vector still gives right angles')
      call check_frame(reference_of(find_element_kind('PINBODY'), none, none), x, y, 'a pin without length has the global axes')
      call check_frame(reference_of(find_element_kind('PINBODY'), z, none), z, x, 'a pin with length has its direction')
      size = 1.0e300_wp
      call check_frame(reference_of(find_element_kind('BEAM'), size*[1, 0, 1], size*y), [r, 0.0_wp, r], y, 'huge coordinates')
      size = 1.0e-310_wp
      call check_frame(reference_of(find_element_kind('BEAM'), size*[1, 0, 1], size*y), [r, 0.0_wp, r], y, 'subnormal coordinates')
   end subroutine test_beam_frames

   !> On lattices of hundredths, in three units, moved: the axis is that of whole numbers.
   subroutine test_ties()
      integer, parameter :: places(3) = [100, 10, 1]
      integer :: p(3), q(3), move(3), size(3), expected, round, i, unlike
      real(wp) :: random(9), from(3), to(3)

      unlike = 0
      do round = 1, 20000
         call random_number(random)
         p = int(41*random(:3)) - 20
         size = int(4*random(4:6))
         q = p + merge(size, -size, random(7:9) < 0.5_wp)
         move = int(1999*random(7:9)) - 999
         expected = minloc(size, 1)
         do i = 1, 3
            from = real(p, wp)/places(i)
            to = real(q, wp)/places(i)
            if (maxloc(axis_across(from, to), 1) /= expected) unlike = unlike + 1
            if (is_near_tie(from, to)) unlike = unlike + 1
            from = real(p + move, wp)/places(i)
            to = real(q + move, wp)/places(i)
            if (maxloc(axis_across(from, to), 1) /= expected) unlike = unlike + 1
            if (is_near_tie(from, to)) unlike = unlike + 1
         end do
      end do
      call tally%check(unlike == 0, 'ties of decimals, X before Y before Z')
   end subroutine test_ties

   subroutine test_ties_of_odd_numbers()
      real(wp), parameter :: tiny = 1.0e-40_wp, s = sqrt(0.02_wp)

      call tally%near(axis_across([0.0_wp, tiny, 0.0_wp], [1.0_wp, -1.0_wp, 5.0_wp]), x, 0.0_wp, 'smaller by 1e-40')
      call tally%near(axis_across([tiny, 0.0_wp, 0.0_wp], [-1.0_wp, 1.0_wp, 5.0_wp]), y, 0.0_wp, 'larger by 1e-40')
      call tally%near(axis_across([-tiny, 0.0_wp, 0.0_wp], [-1.0_wp, 1.0_wp, 5.0_wp]), x, 0.0_wp, 'smaller again')
      call tally%check(is_near_tie([tiny, 0.0_wp, 0.0_wp], [-1.0_wp, 1.0_wp, 5.0_wp]), 'hardly meant to be larger')
      call tally%near(axis_across(none, [0.123456789012346_wp, 0.123456789012345_wp, 5.0_wp]), y, 0.0_wp, 'fifteen digits')
      call tally%near(axis_across(none, [nearest(s, 1.0_wp), s, 5.0_wp]), x, 0.0_wp, 'no decimals, and a bit apart')
      call tally%check(is_near_tie(none, [nearest(s, 1.0_wp), s, 5.0_wp]), 'which is told')
      call tally%check(.not. is_near_tie(none, [s, s, 5.0_wp]), 'one number twice is no near tie')
      call tally%near(axis_across(none, [s + 1.0e-8_wp, s, 5.0_wp]), y, 0.0_wp, 'far enough apart')
      call tally%near(axis_across(none, [1.0e-17_wp, 0.0_wp, 0.1_wp]), y, 0.0_wp, 'decimals though hardly meant')
      call tally%near(axis_across(none, [0.1_wp*cos(2*atan(1.0_wp)), 0.0_wp, 0.1_wp]), x, 0.0_wp, 'rounding of a quarter turn')
   end subroutine test_ties_of_odd_numbers

   subroutine test_hinge_frames()
      type(reference_t) :: reference

      reference = reference_of(find_element_kind('HINGE'), none, 3*y)
      call check_frame(reference, y, x, 'hinge axis and the global axis least along it')
      call tally%near([reference%length], [0.0_wp], 0.0_wp, 'a hinge has no length')
   end subroutine test_hinge_frames

   subroutine test_planar_frame()
      type(model_t) :: model
      type(reference_t) :: reference

      model = new_model(4, 1)
      call set_node(model, 1, node_planar_position, [1.0_wp, 1.0_wp])
      call set_node(model, 2, node_angle, [0.4_wp])
      call set_node(model, 3, node_planar_position, [1.0_wp, 3.0_wp])
      call set_node(model, 4, node_angle, [-0.3_wp])
      call set_element(model, 1, find_element_kind('PLBEAM'), [1, 2, 3, 4])
      call element_reference(model, 1, reference)
      call check_frame(reference, y, -x, 'planar beam')
   end subroutine test_planar_frame

   subroutine test_rotation_matrix()
      real(wp), parameter :: half = 0.5_wp
      real(wp) :: r(3, 3)

      r = relative_rotation([half, half, half, half], no_rotation)
      call tally%near(reshape(r, [9]), [y, z, x], 0.0_wp, 'a third of a turn about (1,1,1) takes x to y to z')
      r = relative_rotation([2.0_wp, 0.0_wp, 0.0_wp, 2.0_wp], no_rotation)
      call tally%near(reshape(r, [9]), [y, -x, z], 1.0e-15_wp, 'a quarter about z, not normalised')
      r = relative_rotation([0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], no_rotation)
      call tally%near(reshape(r, [9]), [x, y, z], 0.0_wp, 'no parameters, no rotation')
      r = relative_rotation(1.0e-320_wp*[1, 0, 0, 1], no_rotation)
      call tally%near(reshape(r, [9]), [y, -x, z], 1.0e-3_wp, 'subnormal parameters')
   end subroutine test_rotation_matrix

   subroutine test_relative_rotation()
      real(wp) :: a(4), b(4), expected(3, 3)
      integer :: i

      do i = 1, 20
         call random_number(a)
         call random_number(b)
         a = a - 0.5_wp
         b = b - 0.5_wp
         expected = matmul(relative_rotation(a, no_rotation), transpose(relative_rotation(b, no_rotation)))
         call tally%near(reshape(relative_rotation(a, b), [9]), reshape(expected, [9]), 1.0e-14_wp, &
                         'product of two rotation matrices')
         call tally%near(reshape(relative_rotation(a, a), [9]), [x, y, z], 0.0_wp, 'exactly the identity')
      end do
   end subroutine test_relative_rotation

   !> Nodes 1, 2 belong to planar elements, the position 3 to both kinds.
   subroutine test_poses()
      type(model_t) :: model
      type(pose_t) :: p, q
      real(wp) :: configuration(4, 6)

      model = new_model(6, 2)
      call set_node(model, 1, node_planar_position, [1.0_wp, 1.0_wp])
      call set_node(model, 2, node_angle, [0.4_wp])
      call set_node(model, 3, node_position, x)
      call set_node(model, 4, node_orientation, [1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp])
      call set_node(model, 5, node_angle, [0.0_wp])
      call set_node(model, 6, node_orientation, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      call set_element(model, 1, find_element_kind('BEAM'), [3, 4, 3, 6])
      call set_element(model, 2, find_element_kind('PLBEAM'), [1, 2, 3, 5])
      configuration = 0.0_wp
      configuration(:, 1) = 9.0_wp
      configuration(1, 2) = 0.6_wp
      configuration(1:3, 3) = [2.0_wp, 3.0_wp, 4.0_wp]
      configuration(:, 4) = [1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp]
      configuration(1, 6) = 1.0_wp
      call make_poses(model, 1, configuration, p, q)
      call tally%near(p%position, [2.0_wp, 3.0_wp, 4.0_wp], 0.0_wp, 'position')
      call tally%near(reshape(p%rotation, [9]), [-x, -y, z], 1.0e-15_wp, 'half a turn from the reference')
      call make_poses(model, 2, configuration, p, q)
      call tally%near(p%position, [9.0_wp, 9.0_wp, 0.0_wp], 0.0_wp, 'a planar element sees x and y')
      call tally%near(q%position, [2.0_wp, 3.0_wp, 0.0_wp], 0.0_wp, 'of a spatial position, too')
      call tally%near([p%angle], [0.2_wp], 1.0e-15_wp, 'angle from the reference')
   end subroutine test_poses
end program test_frames
