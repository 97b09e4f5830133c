! SPDX-License-Identifier: BSD-3-Clause
!> An element of any kind: its deformation functions with their first derivatives.
module flexact_element
   use flexact_beam, only: beam_deformation
   use flexact_bearing, only: bearing_deformation
   use flexact_element_table, only: element_kinds
   use flexact_hinge, only: hinge_deformation
   use flexact_kinds, only: wp
   use flexact_plbeam, only: plbeam_deformation
   use flexact_plhinge, only: plhinge_deformation
   use flexact_pose, only: pose_t, reference_t
   use flexact_rbeam, only: rbeam_deformation, plrbeam_deformation
   use flexact_truss, only: truss_deformation
   implicit none
   private
   public :: element_deformation

contains

   !> Deformations (6) of an element and their derivatives (6, 12) with respect
   !> to the position of p, rotation of p, position of q, rotation of q;
   !> zero beyond the last deformation. A rotation is three instantaneous
   !> components about the global axes, dR = [phi]x R, in radians.
   pure subroutine element_deformation(kind, reference, p, q, e, derivative)
      integer, intent(in) :: kind
      type(reference_t), intent(in) :: reference
      type(pose_t), intent(in) :: p, q
      real(wp), intent(out) :: e(6), derivative(6, 12)

      select case (element_kinds(kind)%keyword)
      case ('TRUSS', 'PLTRUSS'); call truss_deformation(reference, p, q, e, derivative)
      case ('BEAM'); call beam_deformation(reference, p, q, e, derivative)
      case ('RBEAM', 'PINBODY'); call rbeam_deformation(reference, p, q, e, derivative)
      case ('HINGE'); call hinge_deformation(reference, p, q, e, derivative)
      case ('PLBEAM'); call plbeam_deformation(reference, p, q, e, derivative)
      case ('PLRBEAM'); call plrbeam_deformation(reference, p, q, e, derivative)
      case ('PLHINGE'); call plhinge_deformation(p, q, e, derivative)
      case ('BEARING'); call bearing_deformation(reference, p, q, e, derivative)
      case default
         e = 0.0_wp
         derivative = 0.0_wp
      end select
   end subroutine element_deformation
end module flexact_element
