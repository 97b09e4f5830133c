! SPDX-License-Identifier: BSD-3-Clause
!> The checks of a model that was made without a deck.
module flexact_model_check
   use, intrinsic :: iso_c_binding, only: c_signed_char
   use flexact_checks, only: check_model, is_consistent
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_exchange, only: to_text, unpack_model
   use flexact_kinds, only: wp
   use flexact_labels, only: names_t
   use flexact_model, only: model_t
   use flexact_silent_mistakes, only: check_silent_mistakes
   implicit none
   private
   public :: check_made_model

contains

   !> place: first and last letter of the name of each element, then of each node, 0
   !> where there is none.
   subroutine check_made_model(nodes, places, elements, vectors, bytes, place, diagnostics)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      integer(c_signed_char), intent(in) :: bytes(:)
      integer, intent(in) :: place(:, :)
      type(diagnostics_t), intent(inout) :: diagnostics
      type(model_t) :: model
      type(names_t) :: names
      character(len=:), allocatable, target :: text

      call to_text(bytes, text)
      call unpack_model(nodes, places, elements, vectors, model)
      if (.not. is_consistent(model)) then
         call diagnostics%error('inconsistent-model', span_t(), 'the arrays of the model do not fit together', '', &
                                'give every element nodes of the kinds that it joins')
         return
      end if
      names%text => text
      allocate (names%element(model%elements), names%node(model%nodes))
      names%element%first = place(1, :model%elements)
      names%element%last = place(2, :model%elements)
      names%node%first = place(1, model%elements + 1:)
      names%node%last = place(2, model%elements + 1:)
      call check_model(model, names, diagnostics)
      if (.not. diagnostics%has_errors()) call check_silent_mistakes(model, names, diagnostics)
   end subroutine check_made_model
end module flexact_model_check
