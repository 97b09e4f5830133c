! SPDX-License-Identifier: BSD-3-Clause
!> Finite rotations from Euler parameters (lambda0, lambda1, lambda2, lambda3),
!> the scalar part first; they need not be of unit length.
module flexact_euler
   use flexact_kinds, only: wp
   use flexact_vectors, only: length_of
   implicit none
   private
   public :: relative_rotation, no_rotation

   real(wp), parameter :: no_rotation(4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]

contains

   !> The rotation from the reference orientation to the present one, about
   !> global axes: R(euler) times the transpose of R(reference), (3, 3). The
   !> product of the parameters is formed from their difference, so that it is
   !> exactly the identity at the reference and small rotations keep their
   !> digits.
   pure function relative_rotation(euler, reference) result(rotation)
      real(wp), intent(in) :: euler(4), reference(4)
      real(wp) :: rotation(3, 3)
      real(wp) :: present(4), old(4), change(4), s, v(3)

      present = normalised(euler)
      old = normalised(reference)
      change = present - old
      s = dot_product(present, old)
      v = old(1)*change(2:4) - change(1)*old(2:4) &
          - [change(3)*old(4) - change(4)*old(3), change(4)*old(2) - change(2)*old(4), &
             change(2)*old(3) - change(3)*old(2)]
      rotation = matrix_of(s, v)
   end function relative_rotation

   !> I + 2 (s [v]x + [v]x [v]x) for parameters of unit length.
   pure function matrix_of(s, v) result(r)
      real(wp), intent(in) :: s, v(3)
      real(wp) :: r(3, 3)

      r(:, 1) = [1 - 2*(v(2)**2 + v(3)**2), 2*(v(1)*v(2) + s*v(3)), 2*(v(1)*v(3) - s*v(2))]
      r(:, 2) = [2*(v(1)*v(2) - s*v(3)), 1 - 2*(v(1)**2 + v(3)**2), 2*(v(2)*v(3) + s*v(1))]
      r(:, 3) = [2*(v(1)*v(3) + s*v(2)), 2*(v(2)*v(3) - s*v(1)), 1 - 2*(v(1)**2 + v(2)**2)]
   end function matrix_of

   !> Four zeros, which are no rotation at all, give the identity.
   pure function normalised(euler) result(unit)
      real(wp), intent(in) :: euler(4)
      real(wp) :: unit(4)
      real(wp) :: length

      length = length_of(euler)
      unit = no_rotation
      if (length > 0.0_wp) unit = euler/length
   end function normalised
end module flexact_euler
