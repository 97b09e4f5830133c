! SPDX-License-Identifier: BSD-3-Clause
!> Lines and words of a deck. Nothing here knows what a word means.
module flexact_lexer
   use flexact_diagnostics, only: span_t
   implicit none
   private
   public :: line_t, next_line, next_word, operand_span, upper_case, listed

   !> One line of the text: what stands before its comment, and the comment
   !> without its mark and the blanks around it (last < first: there is none).
   type :: line_t
      type(span_t) :: body
      type(span_t) :: comment
   end type line_t

   character, parameter :: line_feed = achar(10)

contains

   !> Take the line that starts at `position` and move `position` behind it.
   !> In the picture block a semicolon opens a comment, too.
   pure subroutine next_line(text, position, in_picture, line)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      logical, intent(in) :: in_picture
      type(line_t), intent(out) :: line
      integer :: i, finish, mark

      finish = len(text)
      mark = 0
      if (text(position:position) == '*') mark = position
      do i = position, len(text)
         ! Most characters come behind both marks and the line's end.
         if (iachar(text(i:i)) > iachar('%') .and. .not. in_picture) cycle
         select case (text(i:i))
         case (line_feed)
            finish = i - 1
            exit
         case ('%', '#')
            if (mark == 0) mark = i
         case (';')
            if (mark == 0 .and. in_picture) mark = i
         end select
      end do
      if (mark == 0) then
         line%body = span_t(position, finish)
      else
         line%body = span_t(position, mark - 1)
         line%comment = trimmed(text, mark + 1, finish)
      end if
      ! The longest text ends at the largest integer.
      position = min(finish, huge(finish) - 2) + 2
   end subroutine next_line

   !> Take the next word at or behind `position`, none (first = 0) behind `last`.
   pure subroutine next_word(text, position, last, word)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      integer, intent(in) :: last
      type(span_t), intent(out) :: word
      integer :: start

      do start = position, last
         if (.not. is_blank(text(start:start))) exit
      end do
      position = start
      if (start > last) return
      do position = start + 1, last
         if (is_blank(text(position:position))) exit
      end do
      word = span_t(start, position - 1)
   end subroutine next_word

   !> From the word number `first` (1 is the keyword) to the word number `last`
   !> of the statement that starts at `origin`; up to its end where it has fewer.
   !> What stands behind these words, perhaps a very long line, is not looked at.
   pure function operand_span(text, origin, first, last) result(span)
      character(len=*), intent(in) :: text
      integer, intent(in) :: origin, first, last
      type(span_t) :: span, word
      integer :: position, number, behind, mark

      position = origin
      do number = 1, last
         behind = position
         call next_word(text, position, len(text), word)
         if (word%first == 0) exit
         if (scan(text(behind:word%first), line_feed//'%#') > 0) exit
         mark = scan(text(word%first:word%last), '%#')
         if (mark > 0) then
            word%last = word%first + mark - 2
            position = word%last + 1
         end if
         if (number <= first) span%first = word%first
         span%last = word%last
      end do
   end function operand_span

   pure function trimmed(text, first, last) result(span)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first, last
      type(span_t) :: span

      span = span_t(first, last)
      do while (span%first <= span%last)
         if (.not. (is_blank(text(span%first:span%first)) .or. scan(text(span%first:span%first), '%#') > 0)) exit
         span%first = span%first + 1
      end do
      do while (span%last >= span%first)
         if (.not. is_blank(text(span%last:span%last))) exit
         span%last = span%last - 1
      end do
      if (span%first > span%last) span = span_t()
   end function trimmed

   !> Blanks, tabs and the other white space; no text that is read holds
   !> further control characters.
   pure elemental logical function is_blank(c)
      character, intent(in) :: c
      is_blank = iachar(c) <= iachar(' ')
   end function is_blank

   pure function upper_case(word) result(upper)
      character(len=*), intent(in) :: word
      character(len=len(word)) :: upper
      integer :: i

      do i = 1, len(word)
         if (word(i:i) >= 'a' .and. word(i:i) <= 'z') then
            upper(i:i) = achar(iachar(word(i:i)) - 32)
         else
            upper(i:i) = word(i:i)
         end if
      end do
   end function upper_case

   !> Words as a list in a sentence.
   pure function listed(words) result(list)
      character(len=*), intent(in) :: words(:)
      character(len=:), allocatable :: list
      integer :: i

      list = trim(words(1))
      do i = 2, size(words)
         list = list//', '//trim(words(i))
      end do
   end function listed
end module flexact_lexer
