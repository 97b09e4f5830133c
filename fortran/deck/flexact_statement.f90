! SPDX-License-Identifier: BSD-3-Clause
!> From the text to statements: which block each line stands in, and what its
!> keyword is. Operands are left to those who know what they mean.
module flexact_statement
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: find_element_kind, beam_with_warping
   use flexact_keywords, only: keywords, find_keyword, nearest_keyword, why_uncovered, instead_of_uncovered, &
                               block_kinematics, block_dynamics, block_closed, block_inout, block_picture, &
                               role_element, role_uncovered, role_unknown, role_picture, role_ending
   use flexact_lexer, only: line_t, next_line, next_word, upper_case
   implicit none
   private
   public :: statement_t, reader_t, read_statements, read_line, find_unreadable, has_warping

   !> One statement: its keyword's place and role, where its operands may
   !> stand, and the comment behind it.
   type :: statement_t
      integer :: block = block_kinematics
      integer :: role = 0
      !> Row of the keyword table, or element kind where the role is an element;
      !> 0 for a group of the picture block that is not known.
      integer :: what = 0
      type(span_t) :: keyword
      !> Last character of the statement, its comment left out.
      integer :: last = 0
      type(span_t) :: comment
   end type statement_t

   !> What is remembered from line to line.
   type :: reader_t
      integer :: block = block_kinematics
      logical :: block_is_empty = .true.
      logical :: reported_tail = .false.
      !> The last statement stood in a wrong block, which was reported.
      logical :: reported_block = .false.
      !> The last keyword and what it was: decks repeat themselves.
      character(len=16) :: word = ''
      integer :: role = 0
      integer :: what = 0
      integer :: found_in = 0
   end type reader_t

contains

   !> All statements of the text that mean something, in order.
   subroutine read_statements(text, statements, count, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), allocatable, intent(out) :: statements(:)
      type(statement_t), allocatable :: larger(:)
      integer, intent(out) :: count
      type(diagnostics_t), intent(inout) :: diagnostics
      type(reader_t) :: reader
      type(statement_t) :: statement
      type(line_t) :: line
      integer :: position

      allocate (statements(64))
      count = 0
      position = 1
      do while (position <= len(text))
         call read_line(text, position, reader, line, statement, diagnostics)
         if (statement%role == 0 .or. statement%role == role_ending) cycle
         if (count == size(statements)) then
            allocate (larger(2*count))
            larger(:count) = statements
            call move_alloc(larger, statements)
         end if
         count = count + 1
         statements(count) = statement
      end do
   end subroutine read_statements

   !> Take the line that starts at `position`, what it says, and move `position` behind it. Role 0:
   !> the line has no words, or says nothing that is read.
   subroutine read_line(text, position, reader, line, statement, diagnostics)
      character(len=*), intent(in) :: text
      integer, intent(inout) :: position
      type(reader_t), intent(inout) :: reader
      type(line_t), intent(out) :: line
      type(statement_t), intent(out) :: statement
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: word
      integer :: start

      call next_line(text, position, reader%block == block_picture, line)
      start = line%body%first
      call next_word(text, start, line%body%last, word)
      statement = statement_t(reader%block, 0, 0, word, line%body%last, line%comment)
      if (word%first == 0) return
      call classify(text, reader, statement, diagnostics)
      if (statement%role /= 0 .and. statement%role /= role_ending) reader%block_is_empty = .false.
   end subroutine read_line

   !> Whether the statement that starts here is one of a beam with warping.
   pure logical function has_warping(text, first)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first
      integer :: behind

      has_warping = .false.
      behind = first + len(beam_with_warping)
      if (behind > len(text)) return
      if (iachar(text(behind:behind)) > iachar(' ')) return
      has_warping = upper_case(text(first:behind - 1)) == beam_with_warping
   end function has_warping

   !> The first character that no text holds (a NUL, another control
   !> character), 0 where all is readable.
   pure integer function find_unreadable(text) result(position)
      character(len=*), intent(in) :: text
      integer :: code

      do position = 1, len(text)
         code = iachar(text(position:position))
         if (code >= 32) cycle
         if (code >= 9 .and. code <= 13) cycle
         return
      end do
      position = 0
   end function find_unreadable

   !> Fill in what the keyword is; move from block to block where it says so.
   subroutine classify(text, reader, statement, diagnostics)
      character(len=*), intent(in) :: text
      type(reader_t), intent(inout) :: reader
      type(statement_t), intent(inout) :: statement
      type(diagnostics_t), intent(inout) :: diagnostics

      associate (key => statement%keyword)
         call look_up(text(key%first:key%last), reader)
      end associate
      if (reader%word == 'END' .or. reader%word == 'HALT') then
         call change_block(reader, statement, diagnostics)
         return
      end if
      if (reader%word == 'VISUALIZATION') then
         ! The picture block ends every other one but that of the kinematics.
         if (reader%block == block_kinematics) call end_is_missing(statement, 'VISUALIZATION', diagnostics)
         reader%block = block_picture
      end if
      if (reader%block == block_closed) then
         if (.not. reader%reported_tail) then
            call diagnostics%warning('not-read', statement%keyword, &
                                     'what stands behind the second END is not read', 'from here on', &
                                     'move the statement before END, or open a picture block with VISUALIZATION')
         end if
         reader%reported_tail = .true.
         return
      end if
      statement%block = reader%block
      statement%role = reader%role
      statement%what = reader%what
      if (reader%role == 0) then
         call unknown_keyword(text, reader, statement, diagnostics)
      else if (reader%found_in /= reader%block) then
         ! Reported for the first of a run; what it says is meant all the same.
         if (.not. reader%reported_block) call wrong_block(reader, statement, diagnostics)
         reader%reported_block = .true.
         statement%block = reader%found_in
      else
         reader%reported_block = .false.
         if (reader%role == role_uncovered) then
            call diagnostics%error('not-covered', statement%keyword, 'Flexact does not analyse '//trim(reader%word)// &
                                   ': '//why_uncovered(trim(reader%word)), 'not covered', &
                                   instead_of_uncovered(trim(reader%word)))
         end if
      end if
   end subroutine classify

   !> Look the word up, unless it is the last one again.
   subroutine look_up(word, reader)
      character(len=*), intent(in) :: word
      type(reader_t), intent(inout) :: reader
      integer :: row

      if (len(word) > len(reader%word)) then
         reader%word = word
         reader%role = 0
         reader%found_in = 0
         return
      end if
      if (reader%word == word .and. reader%found_in == reader%block) return
      reader%word = upper_case(word)
      reader%role = role_element
      reader%found_in = block_kinematics
      reader%what = find_element_kind(trim(reader%word))
      if (reader%what > 0) return
      row = find_keyword(trim(reader%word), reader%block)
      reader%what = row
      reader%role = 0
      reader%found_in = 0
      if (row == 0) return
      reader%role = keywords(row)%role
      reader%found_in = keywords(row)%block
   end subroutine look_up

   subroutine change_block(reader, statement, diagnostics)
      type(reader_t), intent(inout) :: reader
      type(statement_t), intent(inout) :: statement
      type(diagnostics_t), intent(inout) :: diagnostics

      statement%role = role_ending
      if (reader%block == block_picture) return
      if (reader%word == 'END') then
         reader%block = merge(block_dynamics, block_closed, reader%block == block_kinematics)
      else if (reader%block == block_closed) then
         reader%block = block_inout
      else if (reader%block == block_kinematics .or. .not. reader%block_is_empty) then
         call end_is_missing(statement, 'HALT', diagnostics)
         reader%block = merge(block_dynamics, block_inout, reader%block == block_kinematics)
      end if
      reader%block_is_empty = .true.
      reader%reported_block = .false.
   end subroutine change_block

   subroutine end_is_missing(statement, word, diagnostics)
      type(statement_t), intent(in) :: statement
      character(len=*), intent(in) :: word
      type(diagnostics_t), intent(inout) :: diagnostics
      call diagnostics%error('missing-end', statement%keyword, 'END is missing before '//word, &
                             'the block is not closed yet', 'write END in the line before it')
   end subroutine end_is_missing

   !> An unknown word; one that nearly spells an element or END is taken for it,
   !> so that what follows from it is not reported too.
   subroutine unknown_keyword(text, reader, statement, diagnostics)
      character(len=*), intent(in) :: text
      type(reader_t), intent(inout) :: reader
      type(statement_t), intent(inout) :: statement
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=13) :: nearest
      character(len=:), allocatable :: word, help

      if (diagnostics%is_full()) then
         call diagnostics%count_error()
         return
      end if
      associate (key => statement%keyword)
         word = upper_case(text(key%first:min(key%last, key%first + 39)))
      end associate
      nearest = nearest_keyword(word, reader%block)
      help = 'a line starts with a keyword; a comment starts with % or #'
      if (nearest /= '') help = 'did you mean '//trim(nearest)//'?'
      if (reader%block == block_picture) then
         ! Pictures do not touch the analysis, and dialects have more options than these.
         statement%what = 0
         if (opens_group(word, nearest)) statement%role = role_picture
         call diagnostics%warning('unknown-keyword', statement%keyword, &
                                  word//' is not a picture option that Flexact knows', &
                                  merge('not used, nor the options behind it', 'not used                           ', &
                                        statement%role == role_picture), help)
      else
         call diagnostics%error('unknown-keyword', statement%keyword, word//' is not a keyword of the '// &
                                trim(block_name(reader%block))//' block', 'unknown keyword', help)
         statement%what = find_element_kind(trim(nearest))
         if (statement%what > 0) then
            statement%role = role_element
         else if (nearest == 'END' .or. nearest == 'HALT') then
            reader%word = nearest
            call change_block(reader, statement, diagnostics)
         else if (reader%block == block_kinematics) then
            statement%role = role_unknown
         end if
      end if
   end subroutine unknown_keyword

   !> Whether an unknown word of the picture block seems to open a group, so that
   !> the options that follow are not those of the group before it.
   pure logical function opens_group(word, nearest)
      character(len=*), intent(in) :: word, nearest
      integer :: props

      props = index(word, 'PROPS', back=.true.)
      opens_group = (props > 0 .and. props == len(word) - 4) .or. &
                    any(nearest == [character(len=9) :: 'BEAMPROPS', 'GRAPHICS', 'INITIAL', 'AXISPROPS'])
   end function opens_group

   subroutine wrong_block(reader, statement, diagnostics)
      type(reader_t), intent(in) :: reader
      type(statement_t), intent(in) :: statement
      type(diagnostics_t), intent(inout) :: diagnostics
      !> None belongs behind the second END.
      character(len=*), parameter :: help(5) = [ &
                                     character(len=67) :: 'write it before the first END', &
                                                          'write it between the first END and the second', '', &
                                                          'write it between a HALT behind the second END and the next END', &
                                                          'write it behind VISUALIZATION, at the end of the deck']

      call diagnostics%error('wrong-block', statement%keyword, &
                             trim(reader%word)//' belongs in the '//trim(block_name(reader%found_in))// &
                             ' block, not in the '//trim(block_name(reader%block))//' block', &
                             'not in this block', trim(help(reader%found_in)))
   end subroutine wrong_block

   pure function block_name(block) result(name)
      integer, intent(in) :: block
      character(len=12) :: name
      character(len=12), parameter :: names(5) = [character(len=12) :: &
                                                  'kinematics', 'dynamics', 'closed', 'in/out', 'picture']
      name = names(block)
   end function block_name
end module flexact_statement
