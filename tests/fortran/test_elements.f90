! SPDX-License-Identifier: BSD-3-Clause
!> Deformations of single elements whose values follow from geometry.
program test_elements
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_euler, only: relative_rotation, no_rotation
   use flexact_element, only: element_deformation
   use flexact_element_table, only: find_element_kind
   use flexact_testing, only: tally_t
   implicit none

   type(tally_t) :: tally
   real(wp), parameter :: pi = acos(-1.0_wp)
   real(wp), parameter :: x(3) = [1.0_wp, 0.0_wp, 0.0_wp]
   real(wp), parameter :: y(3) = [0.0_wp, 1.0_wp, 0.0_wp]
   real(wp), parameter :: z(3) = [0.0_wp, 0.0_wp, 1.0_wp]

   call test_truss()
   call test_beam_modes()
   call test_circular_arcs()
   call test_twist()
   call test_paper_formulas()
   call test_choice_of_frame()
   call test_rigid_beams()
   call test_hinge()
   call test_planar_hinge()
   call test_extreme_sizes()
   call tally%finish()

contains

   !> An element along x with the global axes as its frame.
   pure type(reference_t) function along_x(length) result(reference)
      real(wp), intent(in) :: length
      reference%offset = length*x
      reference%length = length
      reference%frame = reshape([x, y, z], [3, 3])
   end function along_x

   pure function turn(axis, angle) result(rotation)
      real(wp), intent(in) :: axis(3), angle
      real(wp) :: rotation(3, 3)
      rotation = relative_rotation([cos(angle/2), sin(angle/2)*axis], no_rotation)
   end function turn

   function deformation_of(kind, reference, p, q) result(e)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp) :: e(6), derivative(6, 12)
      call element_deformation(kind, reference, p, q, e, derivative)
   end function deformation_of

   subroutine test_truss()
      type(pose_t) :: p, q
      real(wp) :: e(6)

      q%position = [2.0_wp, 0.0_wp, 0.0_wp] + [1.0_wp, 4.0_wp, 0.0_wp]
      e = deformation_of(find_element_kind('TRUSS'), along_x(2.0_wp), p, q)
      call tally%near(e, [3.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, 'a 3-4-5 truss')
      q%position = 2*x + 1.0e-9_wp*y
      e = deformation_of(find_element_kind('TRUSS'), along_x(2.0_wp), p, q)
      call tally%near(e(1:1)/1.0e-18_wp, [0.25_wp], 1.0e-12_wp, 'elongation of second order: v**2/(2 l)')
   end subroutine test_truss

   !> Fig. 1 of the paper: each mode by a small motion of q. The linear parts
   !> of eq. (4): e2 = l0 theta_x; e4 = -l0 theta_y; e6 = l0 theta_z; a
   !> displacement w in z gives e3 = -w, e4 = w; v in y gives e5 = v, e6 = -v.
   subroutine test_beam_modes()
      type(reference_t) :: reference
      type(pose_t) :: p
      real(wp), parameter :: d = 1.0e-7_wp, l = 2.0_wp
      real(wp) :: linear(6, 6), e(6), derivative(6, 12)

      reference = along_x(l)
      linear = 0.0_wp
      linear(1, 1) = 1.0_wp
      linear(5:6, 2) = [1.0_wp, -1.0_wp]
      linear(3:4, 3) = [-1.0_wp, 1.0_wp]
      linear(2, 4) = l
      linear(4, 5) = l
      linear(6, 6) = l
      call element_deformation(find_element_kind('BEAM'), reference, p, pose_at(l*x), e, derivative)
      call tally%near(e, [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'straight beam')
      call tally%near(reshape(derivative(:, 7:12), [36]), reshape(linear, [36]), 1.0e-15_wp, 'beam modes')
      e = deformation_of(find_element_kind('BEAM'), reference, p, pose_at(l*x + d*y))
      call tally%near(e(5:6)/d, [1.0_wp, -1.0_wp], 1.0e-12_wp, 'bending in the xy plane')
   end subroutine test_beam_modes

   pure type(pose_t) function pose_at(position)
      real(wp), intent(in) :: position(3)
      pose_at%position = position
   end function pose_at

   !> A beam bent into a circular arc of its own length is not elongated: the
   !> quadratic terms make up for the shorter chord, 2 sin(a)/(2 a), up to
   !> 0.047 l a**4, with a half the angle of the arc.
   subroutine test_circular_arcs()
      type(pose_t) :: p, q
      real(wp), parameter :: a = 0.05_wp, l = 3.0_wp
      real(wp) :: e(6)

      q%position = l*sin(a)/a*x
      p%rotation = turn(z, -a)
      q%rotation = turn(z, a)
      e = deformation_of(find_element_kind('BEAM'), along_x(l), p, q)
      call tally%near(e, l*[0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, sin(a), sin(a)], l*a**4/20, 'arc in the xy plane')
      p%rotation = turn(y, a)
      q%rotation = turn(y, -a)
      e = deformation_of(find_element_kind('BEAM'), along_x(l), p, q)
      call tally%near(e, l*[0.0_wp, 0.0_wp, -sin(a), -sin(a), 0.0_wp, 0.0_wp], l*a**4/20, 'arc in the xz plane')
      p%angle = -a
      q%angle = a
      e = deformation_of(find_element_kind('PLBEAM'), along_x(l), p, q)
      call tally%near(e, l*[0.0_wp, -sin(a), -sin(a), 0.0_wp, 0.0_wp, 0.0_wp], l*a**4/20, 'planar arc')
   end subroutine test_circular_arcs

   subroutine test_twist()
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp), parameter :: phi = 0.2_wp, l = 3.0_wp, c_t = 0.07_wp
      real(wp) :: e(6)

      reference = along_x(l)
      reference%c_t = c_t
      q%position = l*x
      q%rotation = turn(x, phi)
      e = deformation_of(find_element_kind('BEAM'), reference, p, q)
      call tally%near(e, [c_t*sin(phi)**2/(2*l), l*sin(phi), 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, &
                      'twist, with its elongation')
   end subroutine test_twist

   !> The ends of a beam along x that is bent in both planes and twisted.
   subroutine bend(p, q)
      type(pose_t), intent(out) :: p, q

      p%position = [0.2_wp, -0.1_wp, 0.3_wp]
      p%rotation = relative_rotation([1.0_wp, 0.02_wp, -0.1_wp, 0.15_wp], no_rotation)
      q%position = p%position + [2.8_wp, 0.5_wp, 0.7_wp]
      q%rotation = relative_rotation([1.0_wp, 0.2_wp, 0.05_wp, -0.12_wp], no_rotation)
   end subroutine bend

   !> Eqs. (3) and (4) as they are printed.
   subroutine test_paper_formulas()
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: b(6), e(6), l, el(3)

      reference = along_x(3.0_wp)
      reference%c_t = 0.2_wp
      call bend(p, q)
      l = norm2(q%position - p%position)
      el = (q%position - p%position)/l
      associate (l0 => reference%length, c_t => reference%c_t, &
                 eyp => p%rotation(:, 2), ezp => p%rotation(:, 3), eyq => q%rotation(:, 2), ezq => q%rotation(:, 3))
         b = [l - l0, l0*(dot_product(ezp, eyq) - dot_product(eyp, ezq))/2, -l0*dot_product(el, ezp), &
              l0*dot_product(el, ezq), l0*dot_product(el, eyp), -l0*dot_product(el, eyq)]
         e(1) = b(1) + (2*b(3)**2 + b(3)*b(4) + 2*b(4)**2 + 2*b(5)**2 + b(5)*b(6) + 2*b(6)**2)/(30*l0) &
                + c_t*b(2)**2/(2*l0**3)
         e(2) = b(2) + (-b(3)*b(6) + b(4)*b(5))/l0
         e(3) = b(3) + b(2)*(b(5) + b(6))/(6*l0)
         e(4) = b(4) - b(2)*(b(5) + b(6))/(6*l0)
         e(5) = b(5) - b(2)*(b(3) + b(4))/(6*l0)
         e(6) = b(6) + b(2)*(b(3) + b(4))/(6*l0)
      end associate
      call tally%near(deformation_of(find_element_kind('BEAM'), reference, p, q), e, 1.0e-14_wp, 'eqs. (3) and (4)')
   end subroutine test_paper_formulas

   !> Turning the local frame a quarter about the beam exchanges its bending
   !> planes and leaves elongation and torsion.
   subroutine test_choice_of_frame()
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(6), turned_e(6)

      reference = along_x(3.0_wp)
      call bend(p, q)
      e = deformation_of(find_element_kind('BEAM'), reference, p, q)
      reference%frame = reshape([x, z, -y], [3, 3])
      turned_e = deformation_of(find_element_kind('BEAM'), reference, p, q)
      call tally%near(turned_e, [e(1), e(2), e(5), e(6), -e(3), -e(4)], 1.0e-14_wp, 'frame turned by a quarter')
   end subroutine test_choice_of_frame

   subroutine test_rigid_beams()
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(6)

      p%position = [1.0_wp, 1.0_wp, 1.0_wp]
      p%rotation = turn(z, pi/2)
      p%angle = pi/2
      q%position = p%position + [0.5_wp, 3.0_wp, 0.25_wp]
      e = deformation_of(find_element_kind('RBEAM'), along_x(2.0_wp), p, q)
      call tally%near(e(1:3), [1.0_wp, -0.5_wp, 0.25_wp], 1.0e-15_wp, 'q in the frame of a turned p')
      q%position(3) = p%position(3)
      e = deformation_of(find_element_kind('PLRBEAM'), along_x(2.0_wp), p, q)
      call tally%near(e(1:2), [1.0_wp, -0.5_wp], 1.0e-15_wp, 'q in the planar frame of a turned p')
      reference%frame = reshape([x, y, z], [3, 3])
      q%position = p%position + [0.5_wp, 3.0_wp, 0.25_wp]
      e = deformation_of(find_element_kind('PINBODY'), reference, p, q)
      call tally%near(e(1:3), [3.0_wp, -0.5_wp, 0.25_wp], 1.0e-15_wp, 'a pin whose points coincided')
   end subroutine test_rigid_beams

   subroutine test_hinge()
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(6), angle
      integer :: i

      reference = along_x(0.0_wp)
      p%rotation = turn(y, 0.8_wp)
      do i = -17, 17
         angle = i*pi/18
         q%rotation = matmul(p%rotation, turn(x, angle))
         e = deformation_of(find_element_kind('HINGE'), reference, p, q)
         call tally%near(e(1:3), [angle, 0.0_wp, 0.0_wp], 1.0e-14_wp, 'finite hinge angle')
      end do
      angle = 0.3_wp
      e = deformation_of(find_element_kind('HINGE'), reference, turned(x, 0.0_wp), turned(y, angle))
      call tally%near(e(1:3), [0.0_wp, sin(angle), 0.0_wp], 1.0e-15_wp, 'hinge bent about y')
      e = deformation_of(find_element_kind('HINGE'), reference, turned(x, 0.0_wp), turned(z, angle))
      call tally%near(e(1:3), [0.0_wp, 0.0_wp, sin(angle)], 1.0e-15_wp, 'hinge bent about z')
      e = deformation_of(find_element_kind('HINGE'), reference, turned(x, 0.0_wp), turned(y, pi))
      call tally%check(all(abs(e) < 10), 'an axis turned over gives finite numbers')
   end subroutine test_hinge

   pure type(pose_t) function turned(axis, angle)
      real(wp), intent(in) :: axis(3), angle
      turned%rotation = turn(axis, angle)
   end function turned

   subroutine test_planar_hinge()
      type(pose_t) :: p, q
      real(wp) :: e(6)

      p%angle = 1.0_wp
      q%angle = 1.0_wp + 5*pi
      e = deformation_of(find_element_kind('PLHINGE'), along_x(0.0_wp), p, q)
      call tally%near(e(1:1), [5*pi], 1.0e-14_wp, 'planar hinge of several turns')
   end subroutine test_planar_hinge

   !> Lengths near both ends of what a number can hold.
   subroutine test_extreme_sizes()
      real(wp), parameter :: sizes(2) = [1.0e300_wp, 1.0e-310_wp]
      type(pose_t) :: p
      real(wp) :: e(6), derivative(6, 12)
      integer :: i

      do i = 1, size(sizes)
         call element_deformation(find_element_kind('BEAM'), along_x(sizes(i)), p, pose_at(sizes(i)*x), e, derivative)
         call tally%near(derivative(3, 7:9), [0.0_wp, 0.0_wp, -1.0_wp], 1.0e-12_wp, 'beam of extreme length')
         call tally%near(derivative(5:6, 6)/sizes(i), [-1.0_wp, 0.0_wp], 1.0e-12_wp, 'its rotation')
         call element_deformation(find_element_kind('TRUSS'), along_x(sizes(i)), p, pose_at(sizes(i)*[1.0_wp, 1.0_wp, 0.0_wp]), &
                                  e, derivative)
         call tally%near(e(1:1)/sizes(i), [sqrt(2.0_wp) - 1], 1.0e-12_wp, 'truss of extreme length')
      end do
   end subroutine test_extreme_sizes
end program test_elements
