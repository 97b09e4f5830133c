! SPDX-License-Identifier: BSD-3-Clause
!> Frames, deformations and their derivatives as flat arrays.
module flexact_geometry_exchange
   use flexact_configuration, only: element_frames
   use flexact_exchange, only: unpack_model
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   implicit none
   private
   public :: give_frames, give_jacobian

contains

   pure subroutine give_frames(nodes, places, elements, vectors, frame, length)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      real(wp), intent(out) :: frame(:, :, :), length(:)
      type(model_t) :: model

      call unpack_model(nodes, places, elements, vectors, model)
      call element_frames(model, frame, length)
   end subroutine give_frames

   !> As assemble in bindings.f90 says; no entries where there is no room for all.
   pure subroutine give_jacobian(nodes, places, elements, vectors, configuration, c_t, deformation, place, value, used)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      real(wp), intent(in) :: configuration(:, :), c_t(:)
      real(wp), intent(out) :: deformation(:, :)
      integer, intent(inout) :: place(:, :)
      real(wp), intent(inout) :: value(:)
      integer, intent(out) :: used
      type(model_t) :: model
      type(jacobian_t) :: jacobian

      call unpack_model(nodes, places, elements, vectors, model)
      call make_jacobian(model, configuration, jacobian, c_t)
      used = jacobian%entries
      deformation = jacobian%deformation
      if (used > size(value)) return
      place(1, :used) = 6*(jacobian%row(1, :used) - 1) + jacobian%row(2, :used) - 1
      place(2, :used) = 3*(jacobian%column(1, :used) - 1) + jacobian%column(2, :used) - 1
      value(:used) = jacobian%value(:used)
   end subroutine give_jacobian
end module flexact_geometry_exchange
