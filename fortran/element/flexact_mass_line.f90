! SPDX-License-Identifier: BSD-3-Clause
!> The line along which an element has its mass: of a beam the cubic from p to q with
!> the ends' tangents, of a bar or an arm of a rigid body the straight line.
module flexact_mass_line
   use flexact_element_table, only: element_kinds, member_bar, member_beam, member_link
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t, reference_t
   use flexact_second_order, only: skew
   use flexact_slots, only: node_angle
   use flexact_vectors, only: planar_turn
   implicit none
   private
   public :: has_mass_line, line_products, line_means, end_tangent, line_rates

   !> Integrals of products of the weights h of r = h1 xp + h2 l0 ax_p + h3 xq + h4 l0 ax_q
   !> along a unit length, and of the weights themselves. Cubic: Hermite's polynomials.
   real(wp), parameter :: cubic_products(4, 4) = reshape([156, 22, 54, -13, 22, 4, 13, -3, &
                                                          54, 13, 156, -22, -13, -3, -22, 4], [4, 4])/420.0_wp
   real(wp), parameter :: cubic_means(4) = [6, 1, 6, -1]/12.0_wp
   real(wp), parameter :: straight_products(4, 4) = reshape([2, 0, 1, 0, 0, 0, 0, 0, &
                                                             1, 0, 2, 0, 0, 0, 0, 0], [4, 4])/6.0_wp
   real(wp), parameter :: straight_means(4) = [1, 0, 1, 0]/2.0_wp

contains

   !> Whether an element of this kind extends along a line.
   pure logical function has_mass_line(kind)
      integer, intent(in) :: kind
      has_mass_line = any(element_kinds(kind)%member == [member_bar, member_beam, member_link])
   end function has_mass_line

   pure function line_products(kind) result(products)
      integer, intent(in) :: kind
      real(wp) :: products(4, 4)

      products = straight_products
      if (element_kinds(kind)%member == member_beam) products = cubic_products
   end function line_products

   pure function line_means(kind) result(means)
      integer, intent(in) :: kind
      real(wp) :: means(4)

      means = straight_means
      if (element_kinds(kind)%member == member_beam) means = cubic_means
   end function line_means

   !> l0 ax of an end, by the slot (2 or 4) that turns it: the vector from p to q of the
   !> reference configuration, which the end has turned.
   pure function end_tangent(kind, slot, reference, pose) result(tangent)
      integer, intent(in) :: kind, slot
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: pose
      real(wp) :: tangent(3)

      if (element_kinds(kind)%slot_kind(slot) == node_angle) then
         tangent = planar_turn(pose%angle, reference%offset)
      else
         tangent = matmul(pose%rotation, reference%offset)
      end if
   end function end_tangent

   !> Derivatives (3, 12, 4) of xp, l0 ax_p, xq and l0 ax_q with respect to the position
   !> of p, spin of p, position of q, spin of q.
   pure function line_rates(kind, reference, p, q) result(rates)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp) :: rates(3, 12, 4)
      integer :: i

      rates = 0.0_wp
      do i = 1, 3
         rates(i, i, 1) = 1.0_wp
         rates(i, 6 + i, 3) = 1.0_wp
      end do
      rates(:, 4:6, 2) = -skew(end_tangent(kind, 2, reference, p))
      rates(:, 10:12, 4) = -skew(end_tangent(kind, 4, reference, q))
   end function line_rates
end module flexact_mass_line
