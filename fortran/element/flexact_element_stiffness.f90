! SPDX-License-Identifier: BSD-3-Clause
!> The stiffness of an element by the roles of its deformations, and what a notch
!> leaves of it.
module flexact_element_stiffness
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use flexact_element_table, only: element_kinds, member_link
   use flexact_given, only: given
   use flexact_kinds, only: wp
   use flexact_roles, only: role_elongation, role_torsion, role_bending_xz_p, role_bending_xy_p, role_planar_bending_p, &
                            role_offset_x, role_offset_y, role_offset_z, role_rotation, role_tilt_y, role_tilt_z, role_angle
   implicit none
   private
   public :: element_stiffness, torsion_elongation

   !> Beams whose shear, EI/(G A k), is more than this in their length squared, both ways.
   real(wp), parameter :: straight = 10.0_wp

contains

   !> S (6, 6) of sigma = S e: symmetric and positive semidefinite for numbers that
   !> are not negative.
   pure subroutine element_stiffness(kind, length, numbers, notch, s)
      integer, intent(in) :: kind
      !> l0 [m].
      real(wp), intent(in) :: length
      !> As ESTIFF has them; NaN where not given, which is none.
      real(wp), intent(in) :: numbers(6)
      !> NaN: as it is; else the stiffness of a notch in series with the deformation,
      !> in its units (N/m; N m/rad for hinges), zero for one that takes no stress.
      real(wp), intent(in) :: notch(6)
      real(wp), intent(out) :: s(6, 6)
      integer :: k

      s = 0.0_wp
      do k = 1, 6
         call add_role(kind, k, length, given(numbers), s)
      end do
      do k = 1, 6
         call put_in_series(k, notch(k), s)
      end do
   end subroutine element_stiffness

   !> Bending at p and q stands in two deformations, one behind the other. The parts of
   !> a rigid body have no stiffness that could be given.
   pure subroutine add_role(kind, k, length, numbers, s)
      integer, intent(in) :: kind, k
      real(wp), intent(in) :: length, numbers(6)
      real(wp), intent(inout) :: s(6, 6)

      select case (element_kinds(kind)%role(k))
      case (role_elongation)
         s(k, k) = numbers(1)/length
      case (role_torsion)
         s(k, k) = numbers(2)/length/length/length
      case (role_bending_xz_p)
         s(k:k + 1, k:k + 1) = bending(length, numbers(3), numbers(5))
      case (role_bending_xy_p)
         s(k:k + 1, k:k + 1) = bending(length, numbers(4), numbers(6))
      case (role_planar_bending_p)
         s(k:k + 1, k:k + 1) = bending(length, numbers(2), numbers(3))
      case (role_offset_x, role_offset_y, role_offset_z, role_rotation, role_tilt_y, role_tilt_z, role_angle)
         if (element_kinds(kind)%member /= member_link) s(k, k) = numbers(k)
      end select
   end subroutine add_role

   !> Bending at both ends by EI [N m^2] and EI/(G A k) [m^2] of shear.
   pure function bending(length, ei, shear) result(s)
      real(wp), intent(in) :: length, ei, shear
      real(wp) :: s(2, 2)
      real(wp) :: p

      p = 12*shear/length/length
      s = reshape([4 + p, p - 2, p - 2, 4 + p], [2, 2])/(1 + p)*(ei/length/length/length)
      s(2, 1) = s(1, 2)
   end function bending

   !> S - S_r S_r'/(S_rr + k), in a form that leaves exactly nothing of row r where k is
   !> zero. Several one after the other are in series in any order: each minimises the
   !> energy over what its own notch gives way.
   pure subroutine put_in_series(r, k, s)
      integer, intent(in) :: r
      real(wp), intent(in) :: k
      real(wp), intent(inout) :: s(6, 6)
      real(wp) :: row(6), share
      integer :: i

      ! Neither NaN nor infinite; and what takes no stress has nothing to lose.
      if (.not. ieee_is_finite(k) .or. .not. s(r, r) > 0.0_wp) return
      row = s(:, r)
      share = k/(row(r) + k)
      do i = 1, 6
         s(:, i) = s(:, i) - row*(row(i)/(row(r) + k))
      end do
      s(:, r) = share*row
      s(r, :) = share*row
   end subroutine put_in_series

   !> c_t of eq. (3), the polar second moment of area over the area [m^2]: from the
   !> stiffness, else from the inertia per length; zero where neither says. The stiffness
   !> of what stays straight, as a half of a notch, says nothing of its section.
   pure real(wp) function torsion_elongation(kind, length, stiffness, mass) result(c_t)
      integer, intent(in) :: kind
      !> l0 [m].
      real(wp), intent(in) :: length
      !> As ESTIFF (6) and EM (5) have them; NaN where not given.
      real(wp), intent(in) :: stiffness(:), mass(:)

      c_t = 0.0_wp
      if (.not. any(element_kinds(kind)%role == role_torsion)) return
      if (given(stiffness(1)) > 0.0_wp .and. &
          .not. minval(given(stiffness(5:6))) > straight*length**2) then
         c_t = sum(given(stiffness(3:4)))/stiffness(1)
      else if (given(mass(1)) > 0.0_wp) then
         c_t = given(mass(2))/mass(1)
      end if
   end function torsion_elongation
end module flexact_element_stiffness
