! SPDX-License-Identifier: BSD-3-Clause
!> An element of any kind: its reference frame by the rule of its row in the
!> table, and its deformation functions with their first derivatives.
module flexact_element
   use flexact_beam, only: beam_deformation
   use flexact_bearing, only: bearing_deformation
   use flexact_element_table, only: element_kinds, member_bar, rule_along => frame_along, frame_about, frame_planar
   use flexact_hinge, only: hinge_deformation
   use flexact_kinds, only: wp
   use flexact_plbeam, only: plbeam_deformation
   use flexact_plhinge, only: plhinge_deformation
   use flexact_pose, only: pose_t, reference_t
   use flexact_rbeam, only: rbeam_deformation, plrbeam_deformation
   use flexact_truss, only: truss_deformation
   use flexact_vectors, only: length_of, frame_along, planar_frame_along
   implicit none
   private
   public :: make_reference, reference_frame, element_deformation

contains

   !> What an element measures its deformations from, by the vector from p to q
   !> and the vector of its statement (zero where none was given).
   pure subroutine make_reference(kind, offset, vector, reference)
      integer, intent(in) :: kind
      real(wp), intent(in) :: offset(3), vector(3)
      type(reference_t), intent(out) :: reference

      reference%offset = offset
      reference%length = length_of(offset)
      ! A bar's deformation needs no frame, and bars are many.
      if (element_kinds(kind)%member /= member_bar) reference%frame = reference_frame(kind, offset, vector)
   end subroutine make_reference

   !> The local axes ex, ey, ez as columns. stand_in: what takes the place of a
   !> vector that was not given or gives no direction; by default the global axis
   !> that `frame_along` chooses. An element in the plane without a line has z as ex.
   pure function reference_frame(kind, offset, vector, stand_in) result(frame)
      integer, intent(in) :: kind
      real(wp), intent(in) :: offset(3), vector(3)
      real(wp), intent(in), optional :: stand_in(3)
      real(wp) :: frame(3, 3)
      real(wp) :: hint(3)

      hint = 0.0_wp
      if (present(stand_in)) hint = stand_in
      select case (element_kinds(kind)%frame)
      case (rule_along)
         if (any(abs(vector) > 0)) hint = vector
         frame = frame_along(offset, hint)
      case (frame_about)
         frame = frame_along(vector, hint)
      case (frame_planar)
         frame = planar_frame_along(offset)
      case default
         frame = frame_along([0.0_wp, 0.0_wp, 1.0_wp], hint)
      end select
   end function reference_frame

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
