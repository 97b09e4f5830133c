! SPDX-License-Identifier: BSD-3-Clause
!> Second derivatives of every element in large configurations: against differences
!> of first derivatives, and against the deformations themselves along a path.
program test_curvature
   use flexact_element, only: element_deformation
   use flexact_element_curvature, only: element_curvature
   use flexact_element_table, only: element_kinds, coordinates_of
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_random_elements, only: random_ends, moved
   use flexact_second_order, only: skew
   use flexact_testing, only: tally_t, set_random
   implicit none

   type(tally_t) :: tally
   type(reference_t) :: reference
   type(pose_t) :: p, q
   real(wp) :: sigma(6), h(12, 12)
   integer :: kind, trial

   call set_random()
   do kind = 1, size(element_kinds)
      do trial = 1, 20
         call random_ends(kind, reference, p, q)
         call random_number(sigma)
         call element_curvature(kind, reference, p, q, sigma, h)
         call tally%near(reshape(h, [144]), reshape(transpose(h), [144]), 1.0e-14_wp, &
                         'symmetry of the curvature of '//element_kinds(kind)%keyword)
         call compare_with_differences()
         call compare_along_a_path()
      end do
   end do
   call test_degenerate()
   call tally%finish()

contains

   !> Ends that have come to coincide, and an axis turned right over, give finite numbers.
   subroutine test_degenerate()
      real(wp), parameter :: half_a_turn(3, 3) = real(reshape([-1, 0, 0, 0, -1, 0, 0, 0, 1], [3, 3]), wp)

      do kind = 1, size(element_kinds)
         call random_ends(kind, reference, p, q)
         q = p
         q%rotation = matmul(matmul(matmul(p%rotation, reference%frame), half_a_turn), transpose(reference%frame))
         call element_curvature(kind, reference, p, q, sigma, h)
         call tally%check(all(abs(h) <= huge(h)), 'curvature of a collapsed '//element_kinds(kind)%keyword)
      end do
   end subroutine test_degenerate

   !> sigma' e and its gradient sigma' D, at p and q moved by a change.
   subroutine evaluate(change, value, gradient)
      real(wp), intent(in) :: change(12)
      real(wp), intent(out) :: value, gradient(12)
      real(wp) :: e(6), derivative(6, 12)

      call element_deformation(kind, reference, moved(p, change(1:6)), moved(q, change(7:12)), e, derivative)
      value = dot_product(sigma, e)
      gradient = matmul(sigma, derivative)
   end subroutine evaluate

   !> Turns made one after the other do not commute: differences of first derivatives
   !> in spins are H - skew(m)/2, m the moment sigma' D of the node.
   subroutine compare_with_differences()
      real(wp), parameter :: step = 1.0e-3_wp
      real(wp) :: wanted(12, 12), gradient(12), change(12), at(12, -2:2), value
      integer :: column, i

      change = 0.0_wp
      call evaluate(change, value, gradient)
      wanted = h
      do i = 4, 10, 6
         wanted(i:i + 2, i:i + 2) = h(i:i + 2, i:i + 2) - skew(gradient(i:i + 2))/2
      end do
      associate (has => coordinates_of(kind))
         do column = 1, 12
            if (.not. has(column)) then
               call tally%check(all(abs(h(:, column)) <= 0), 'no curvature where there is no coordinate')
               cycle
            end if
            do i = -2, 2
               change = 0.0_wp
               change(column) = i*step
               call evaluate(change, value, at(:, i))
            end do
            gradient = (8*(at(:, 1) - at(:, -1)) - (at(:, 2) - at(:, -2)))/(12*step)
            call tally%near(pack(wanted(:, column), has), pack(gradient, has), 1.0e-8_wp, &
                            'curvature of '//element_kinds(kind)%keyword)
         end do
      end associate
   end subroutine compare_with_differences

   !> All ends moved along a line and turned about one axis each: the second derivative
   !> of sigma' e along the path is v' H v.
   subroutine compare_along_a_path()
      real(wp), parameter :: step = 3.0e-3_wp
      real(wp) :: direction(12), value(-2:2), unused(12)
      integer :: i

      call random_number(direction)
      where (.not. coordinates_of(kind)) direction = 0.0_wp
      do i = -2, 2
         call evaluate(i*step*direction, value(i), unused)
      end do
      call tally%near([dot_product(direction, matmul(h, direction))], &
                      [(16*(value(1) + value(-1)) - (value(2) + value(-2)) - 30*value(0))/(12*step**2)], 1.0e-7_wp, &
                      'curvature along a path of '//element_kinds(kind)%keyword)
   end subroutine compare_along_a_path
end program test_curvature
