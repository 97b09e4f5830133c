! SPDX-License-Identifier: BSD-3-Clause
!> A deck's text into a model, with every problem of the deck in one run.
module flexact_deck
   use flexact_checks, only: check_model
   use flexact_deck_classes, only: read_classes
   use flexact_deck_elements, only: read_elements
   use flexact_deck_forms, only: read_forms, note_unused
   use flexact_deck_loads, only: read_loads
   use flexact_deck_picture, only: read_picture
   use flexact_deck_model, only: deck_model_t
   use flexact_deck_properties, only: read_properties
   use flexact_deck_units, only: read_units
   use flexact_deck_warping, only: check_warping_nodes, excuse_fixed_warping, note_warping
   use flexact_deck_values, only: read_values
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_labels, only: names_t
   use flexact_ground_points, only: excuse_ground_points
   use flexact_lexer, only: operand_span
   use flexact_silent_mistakes, only: check_silent_mistakes
   use flexact_statement, only: statement_t, read_statements, find_unreadable, has_warping
   implicit none
   private
   public :: read_deck, locate

contains

   !> Read the text. The model is one to analyse where no error was
   !> reported. `unused` counts the statements that were read for their form alone.
   subroutine read_deck(text, deck, unused, diagnostics)
      character(len=*), target, intent(in) :: text
      type(deck_model_t), intent(out) :: deck
      integer, intent(out) :: unused
      type(diagnostics_t), target, intent(inout) :: diagnostics
      type(statement_t), allocatable :: statements(:)
      type(names_t) :: names
      integer :: count

      unused = 0
      call require_text(text, diagnostics)
      if (diagnostics%has_errors()) return
      call read_statements(text, statements, count, diagnostics)
      deck%text => text
      deck%diagnostics => diagnostics
      associate (all_statements => statements(:count))
         call read_units(all_statements, deck)
         call read_elements(all_statements, deck)
         if (deck%model%elements > 0) then
            call excuse_fixed_warping(all_statements, deck)
            call excuse_ground_points(all_statements, deck)
            call read_values(all_statements, deck)
            call read_classes(all_statements, deck)
            call check_warping_nodes(deck)
            call read_picture(all_statements, deck)
            call read_properties(all_statements, deck)
            call read_loads(all_statements, deck)
            call read_forms(all_statements, deck)
         end if
         names%text => text
         names%element = deck%element_names
         names%node = deck%node_names
         call check_model(deck%model, names, diagnostics)
         if (.not. diagnostics%has_errors()) then
            call check_silent_mistakes(deck%model, names, diagnostics)
            call note_warping(deck)
            call note_unused(all_statements, unused, diagnostics)
         end if
      end associate
      deck%text => null()
      deck%diagnostics => null()
      call narrow_places(text, diagnostics)
      call diagnostics%sort()
   end subroutine read_deck

   !> A character that no text holds is reported at its place, and ends the reading.
   subroutine require_text(text, diagnostics)
      character(len=*), intent(in) :: text
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: unreadable

      unreadable = find_unreadable(text)
      if (unreadable == 0) return
      if (iachar(text(unreadable:unreadable)) == 0) then
         call diagnostics%error('not-text', span_t(unreadable, unreadable), &
                                'the deck holds a NUL byte, so it is not text', '', 'take the byte away')
      else
         call diagnostics%error('not-text', span_t(unreadable, unreadable), &
                                'this is not a text: it holds a NUL or another control character', &
                                'no text holds this character', 'take it away, or give a deck: a plain text file')
      end if
   end subroutine require_text

   !> The checks of the model know the statement; here the words are found.
   subroutine narrow_places(text, diagnostics)
      character(len=*), intent(in) :: text
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: i

      do i = 1, diagnostics%kept
         associate (item => diagnostics%item(i))
            if (item%words(1) == 0) item%words = [1, huge(1) - 1]
            call narrow(text, item%words, item%place)
            call narrow(text, [1, huge(1) - 1], item%other)
         end associate
      end do
   end subroutine narrow_places

   !> From where a statement starts to these words of it.
   pure subroutine narrow(text, words, place)
      character(len=*), intent(in) :: text
      integer, intent(in) :: words(2)
      type(span_t), intent(inout) :: place

      integer :: behind

      if (place%first == 0 .or. place%last > 0) return
      behind = 0
      ! Of a beam with warping, what stands behind its nodes has two more words before it.
      if (words(1) > 6 .and. has_warping(text, place%first)) behind = 2
      place = operand_span(text, place%first, words(1) + behind, min(words(2), huge(1) - 2) + behind)
   end subroutine narrow

   !> The line and the column, both from 1, of a position in the text.
   pure subroutine locate(text, position, line, column)
      character(len=*), intent(in) :: text
      integer, intent(in) :: position
      integer, intent(out) :: line, column
      integer :: i, before

      before = min(position - 1, len(text))
      ! Nothing but a count, lest many places in a long text take long.
      line = 1
      do i = 1, before
         line = line + merge(1, 0, text(i:i) == achar(10))
      end do
      column = position - index(text(:before), achar(10), back=.true.)
   end subroutine locate
end module flexact_deck
