! SPDX-License-Identifier: BSD-3-Clause
!> Beams with warping (BEAMW). In SPACAR the warping coordinate of a node is a degree of
!> freedom unless it is fixed, and the deformations 7 and 8 are always calculable, so
!> that D(c) has neither a column nor a row of them: it is that of the beams.
module flexact_deck_warping
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: beam_with_warping
   use flexact_keywords, only: keywords, role_coordinate
   use flexact_lexer, only: operand_span, upper_case
   use flexact_numbering, only: make_numbering
   use flexact_numbers, only: leading_integer
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: check_warping_nodes, excuse_fixed_warping, note_warping

contains

   !> A warping node is no position and no orientation.
   subroutine check_warping_nodes(deck)
      type(deck_model_t), intent(inout) :: deck
      type(span_t) :: place
      integer :: k, end

      if (size(deck%warping_nodes%number) == 0) return
      do k = 1, deck%model%elements
         do end = 1, 2
            if (deck%nodes%find(deck%warping_node(end, k)) == 0) cycle
            place = operand_span(deck%text, deck%model%element_origin(k), 2 + 3*end, 2 + 3*end)
            call deck%diagnostics%error('two-kinds-of-node', place, 'node '//deck%text(place%first:place%last)// &
                                        ' is used as a warping node and as another one', 'here as a warping node', &
                                        'give the warping at this end a node of its own')
            return
         end do
      end do
   end subroutine check_warping_nodes

   !> SPACAR Light fixes the warping of each node that it clamps, with the comment
   !> "warping", whether a beam has warping there or not: such a node may be missing.
   subroutine excuse_fixed_warping(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      integer :: number(size(statements)), i
      type(operands_t) :: operands

      number = 0
      do i = 1, size(statements)
         if (statements(i)%role /= role_coordinate .or. statements(i)%comment%first == 0) cycle
         if (keywords(statements(i)%what)%name /= 'FIX') cycle
         associate (comment => statements(i)%comment)
            if (upper_case(deck%text(comment%first:comment%last)) /= 'WARPING') cycle
         end associate
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         if (.not. operands%another()) cycle
         number(i) = leading_integer(operands%spelling())
         if (deck%nodes%find(number(i)) > 0) number(i) = 0
      end do
      if (any(number > 0)) deck%left_out = make_numbering([deck%left_out%number, pack(number, number > 0)])
   end subroutine excuse_fixed_warping

   !> Say once that beams with warping are read as beams.
   subroutine note_warping(deck)
      type(deck_model_t), intent(inout) :: deck
      integer :: first

      first = findloc(deck%has_warping, .true., dim=1)
      if (first == 0) return
      call deck%diagnostics%note('warping', operand_span(deck%text, deck%model%element_origin(first), 1, 1), &
                                 beam_with_warping//' is analysed as BEAM: warping holds nothing and is held by nothing', &
                                 'the first of them', 'counts leave out the warping nodes and the deformations 7 and 8')
   end subroutine note_warping
end module flexact_deck_warping
