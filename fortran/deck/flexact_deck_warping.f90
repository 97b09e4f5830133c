! SPDX-License-Identifier: BSD-3-Clause
!> Beams with warping (BEAMW): where their warping decouples from everything else, they
!> are beams; elsewhere the verdict hangs on definitions that no public text gives.
!>
!> All that is used of the deformations 7 and 8 is that each changes with the warping
!> coordinate at its end of the beam, and not with the other. A warping coordinate that
!> is dependent and enters one independent deformation makes a row and a column of D(c)
!> that leave the rank of the rest as it is; one that is fixed or independent, and
!> enters none, makes neither.
module flexact_deck_warping
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: beam_with_warping
   use flexact_lexer, only: operand_span
   use flexact_model, only: class_dependent, class_independent
   implicit none
   private
   public :: check_warping

   character(len=*), parameter :: as_beam = 'write BEAM e p op q oq, which has the same six deformations'

contains

   !> Report the warping that does not decouple once, and note where it does.
   subroutine check_warping(deck)
      type(deck_model_t), intent(inout) :: deck
      integer :: rows(size(deck%warping_nodes%number)), user(size(deck%warping_nodes%number))
      integer :: k, end, node, wrong
      logical :: decouples(size(deck%warping_nodes%number))

      if (size(rows) == 0) return
      rows = 0
      user = 0
      do k = 1, deck%model%elements
         do end = 1, 2
            node = deck%warping_nodes%find(deck%warping_node(end, k))
            if (node == 0) cycle
            if (user(node) == 0) user(node) = k
            if (deck%warping_deformation(end, k) == class_independent) rows(node) = rows(node) + 1
         end do
      end do
      call check_kinds(deck, user)
      decouples = rows == merge(1, 0, deck%warping_class(1, :) == class_dependent)
      wrong = findloc(decouples, .false., dim=1)
      if (wrong == 0) then
         call note(deck, user(1))
      else
         call report(deck, wrong, user(wrong), rows(wrong), count(.not. decouples) - 1)
      end if
   end subroutine check_warping

   !> A warping node is no position and no orientation.
   subroutine check_kinds(deck, user)
      type(deck_model_t), intent(inout) :: deck
      integer, intent(in) :: user(:)
      type(span_t) :: place
      integer :: node

      do node = 1, size(user)
         if (deck%nodes%find(deck%warping_nodes%number(node)) == 0) cycle
         place = place_of(deck, user(node), deck%warping_nodes%number(node))
         call deck%diagnostics%error('two-kinds-of-node', place, &
                                     'node '//deck%text(place%first:place%last)//' is used as a warping node and as another one', &
                                     'here as a warping node', 'give the warping at this end a node of its own')
      end do
   end subroutine check_kinds

   subroutine report(deck, node, user, rows, others)
      type(deck_model_t), intent(inout) :: deck
      integer, intent(in) :: node, user, rows, others
      character(len=12) :: number, more
      character(len=:), allocatable :: why, help

      if (deck%diagnostics%has_errors()) return
      write (number, '(i0)') deck%warping_nodes%number(node)
      write (more, '(i0)') others
      if (rows == 0) then
         why = 'nothing determines'
         help = 'fix such warping nodes, make 7 at p or 8 at q independent, or '//as_beam
      else if (deck%warping_class(1, node) == class_dependent) then
         why = 'more than one deformation determines'
         help = 'release all but one of the deformations 7 and 8 at such a node, or '//as_beam
      else
         why = 'a deformation determines, though it is given,'
         help = 'release the deformations 7 and 8 at such a node, or '//as_beam
      end if
      number = trim(number)
      if (others > 0) number = trim(number)//', '//trim(more)//' more'
      call deck%diagnostics%error('not-covered', place_of(deck, user, 0), &
                                  'Flexact does not analyse '//beam_with_warping//' where '//why//' the warping (node '// &
                                  trim(number)//')', 'not covered', help)
   end subroutine report

   subroutine note(deck, user)
      type(deck_model_t), intent(inout) :: deck
      integer, intent(in) :: user
      character(len=12) :: number

      write (number, '(i0)') size(deck%warping_nodes%number)
      call deck%diagnostics%note('warping', place_of(deck, user, 0), &
                                 beam_with_warping//' is analysed as BEAM: its warping ('//trim(number)// &
                                 ' nodes) decouples from all else', 'the first of them', &
                                 'counts leave out the warping nodes and the deformations 7 and 8')
   end subroutine note

   !> The keyword of an element, or the word of its statement that names a warping node.
   pure function place_of(deck, element, number) result(place)
      type(deck_model_t), intent(in) :: deck
      integer, intent(in) :: element, number
      type(span_t) :: place
      integer :: word

      word = 1
      if (number > 0) word = 5 + 3*(findloc(deck%warping_node(:, element), number, dim=1) - 1)
      place = operand_span(deck%text, deck%model%element_origin(element), word, word)
   end function place_of
end module flexact_deck_warping
