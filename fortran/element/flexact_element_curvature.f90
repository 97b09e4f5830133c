! SPDX-License-Identifier: BSD-3-Clause
!> Second derivatives of the deformations of an element of any kind, as its
!> stresses weigh them: the geometric stiffness.
module flexact_element_curvature
   use flexact_beam_curvature, only: beam_curvature
   use flexact_bearing, only: bearing_curvature
   use flexact_element_table, only: element_kinds, coordinates_of
   use flexact_hinge, only: hinge_curvature
   use flexact_kinds, only: wp
   use flexact_plbeam, only: plbeam_curvature
   use flexact_pose, only: pose_t, reference_t
   use flexact_rbeam, only: rbeam_curvature, plrbeam_curvature
   use flexact_truss, only: truss_curvature
   implicit none
   private
   public :: element_curvature

contains

   !> H = sum of sigma_k d2e_k, (12, 12) and symmetric, with respect to the position
   !> of p, rotation of p, position of q, rotation of q; zero where the element has
   !> no coordinate. A rotation is a spin w about the global axes that turns a node
   !> to exp(w) R. sigma: stress of each deformation, zero or anything finite
   !> beyond the last.
   pure subroutine element_curvature(kind, reference, p, q, sigma, h)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(in) :: sigma(6)
      real(wp), intent(out) :: h(12, 12)
      logical :: has(12)

      select case (element_kinds(kind)%keyword)
      case ('TRUSS', 'PLTRUSS'); h = truss_curvature(reference, p, q, sigma)
      case ('BEAM'); h = beam_curvature(reference, p, q, sigma)
      case ('RBEAM', 'PINBODY'); h = rbeam_curvature(reference, p, q, sigma)
      case ('HINGE'); h = hinge_curvature(reference, p, q, sigma)
      case ('PLBEAM'); h = plbeam_curvature(reference, p, q, sigma)
      case ('PLRBEAM'); h = plrbeam_curvature(reference, p, q, sigma)
      case ('BEARING'); h = bearing_curvature(reference, p, q, sigma)
      case default
         ! PLHINGE is linear.
         h = 0.0_wp
      end select
      has = coordinates_of(kind)
      where (.not. (spread(has, 1, 12) .and. spread(has, 2, 12))) h = 0.0_wp
   end subroutine element_curvature
end module flexact_element_curvature
