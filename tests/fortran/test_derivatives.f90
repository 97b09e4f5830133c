! SPDX-License-Identifier: BSD-3-Clause
!> Derivatives of every element against central differences, and no
!> deformation in a motion of the element as a rigid body.
program test_derivatives
   use flexact_element, only: element_deformation
   use flexact_element_table, only: element_kinds
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_random_elements, only: is_planar, random_ends, move_rigidly, nudged
   use flexact_testing, only: tally_t, set_random
   implicit none

   type(tally_t) :: tally
   integer :: kind, trial

   call set_random()
   do kind = 1, size(element_kinds)
      do trial = 1, 20
         call compare_derivatives(kind)
         call stay_undeformed(kind)
      end do
   end do
   call tally%finish()

contains

   subroutine compare_derivatives(kind)
      integer, intent(in) :: kind
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp), parameter :: step = 1.0e-5_wp
      real(wp) :: e(6), derivative(6, 12), ahead(6), back(6), unused(6, 12)
      integer :: column

      call random_ends(kind, reference, p, q)
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

   subroutine stay_undeformed(kind)
      integer, intent(in) :: kind
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(6), derivative(6, 12)

      call move_rigidly(kind, reference, p, q)
      call element_deformation(kind, reference, p, q, e, derivative)
      call tally%near(e/reference%length, 0*e, 1.0e-12_wp, 'rigid motion of '//element_kinds(kind)%keyword)
   end subroutine stay_undeformed
end program test_derivatives
