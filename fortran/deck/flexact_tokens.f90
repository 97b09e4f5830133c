! SPDX-License-Identifier: BSD-3-Clause
!> The lines and the words of a deck as the reader takes them, for those who edit, compare,
!> colour or explain its text.
module flexact_tokens
   use flexact_diagnostics, only: diagnostics_t, span_t
   use flexact_element_table, only: element_kinds
   use flexact_keywords, only: keywords, role_element, role_ending
   use flexact_lexer, only: line_t, next_word
   use flexact_numbers, only: read_integer, number_fine
   use flexact_statement, only: statement_t, reader_t, read_line, has_warping
   implicit none
   private
   public :: read_tokens

contains

   !> As many lines as there is room for; a text has one more than line feeds. Places are bytes
   !> from 0. lines: first byte, the byte behind the last, where its comment starts (behind the
   !> line where there is none), how many words this line and those before it have, block, kind of
   !> the element that it makes or 0, and row of the keyword table, 0 without one and -1 where the
   !> line ends a block. words, as many as there is room for: first byte, the byte behind the last,
   !> letter and kind of node as describe_word says, and the whole number from 1 that it is, or 0.
   subroutine read_tokens(text, lines, words)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: lines(:, :), words(:, :)
      type(diagnostics_t) :: diagnostics
      type(reader_t) :: reader
      type(statement_t) :: statement
      type(line_t) :: line
      integer :: i, position, start, used, block, row

      position = 1
      used = 0
      do i = 1, size(lines, 2)
         start = position
         if (position > len(text)) then
            lines(:, i) = [len(text), len(text), len(text), used, reader%block, 0, 0]
            cycle
         end if
         block = reader%block
         call read_line(text, position, reader, line, statement, diagnostics)
         ! What ends a block stands in it, what opens the picture block stands in that.
         if (statement%role /= role_ending) block = reader%block
         call read_words(text, line%body, statement, words, used)
         row = merge(-1, statement%what, statement%role == role_ending)
         lines(:, i) = [start - 1, min(position - 2, len(text)), line%body%last, used, block, &
                        merge(row, 0, statement%role == role_element), merge(0, row, statement%role == role_element)]
      end do
   end subroutine read_tokens

   subroutine read_words(text, body, statement, words, used)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: body
      type(statement_t), intent(in) :: statement
      integer, intent(inout) :: words(:, :), used
      type(span_t) :: word
      integer :: position, place, number, status, kind
      character :: letter
      logical :: warps

      position = body%first
      place = 0
      warps = .false.
      if (statement%role == role_element) warps = has_warping(text, statement%keyword%first)
      do while (used < size(words, 2))
         call next_word(text, position, body%last, word)
         if (word%first == 0) exit
         used = used + 1
         call describe_word(statement, place, warps, letter, kind)
         call read_integer(text(word%first:word%last), number, status)
         if (status /= number_fine) number = 0
         words(:, used) = [word%first - 1, word%last, iachar(letter), kind, max(number, 0)]
         place = place + 1
      end do
   end subroutine read_words

   !> What word 0, 1, 2, ... of a statement is. letter: k keyword, E the number that an element
   !> gets, n its nodes, v its vector, and else that of the form of its keyword; blank where it is
   !> not known. kind: what the node of an element must be, -1 for one of warping; else 0.
   pure subroutine describe_word(statement, place, warps, letter, kind)
      type(statement_t), intent(in) :: statement
      integer, intent(in) :: place
      logical, intent(in) :: warps
      character, intent(out) :: letter
      integer, intent(out) :: kind
      integer :: at
      integer, allocatable :: nodes(:)

      letter = ' '
      kind = 0
      if (place == 0) then
         letter = 'k'
      else if (statement%role == role_element) then
         letter = 'v'
         if (place == 1) letter = 'E'
         nodes = pack(element_kinds(statement%what)%slot_kind, element_kinds(statement%what)%slot_kind > 0)
         if (warps) nodes = [nodes(:2), -1, nodes(3:), -1]
         if (place == 1 .or. place > 1 + size(nodes)) return
         letter = 'n'
         kind = nodes(place - 1)
      else if (statement%what > 0) then
         at = min(place, len_trim(keywords(statement%what)%form))
         letter = keywords(statement%what)%form(at:at)
      end if
   end subroutine describe_word
end module flexact_tokens
