!> The operands of a statement, taken one by one; what is wrong with one is
!> said at its place.
module flexact_operands
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_keywords, only: block_picture
   use flexact_kinds, only: wp
   use flexact_lexer, only: next_word
   use flexact_numbers, only: read_integer, read_real, number_fine, number_malformed, number_not_whole, &
                              number_not_finite, number_too_large
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: operands_t, operands_of

   type :: operands_t
      !> The operand that was taken last.
      type(span_t) :: word
      !> Whether every operand so far was what it should be.
      logical :: fine = .true.
      !> What is wrong with one is a warning, and the statement is not used.
      logical :: forgiving = .false.
      integer, private :: position = 1
      integer, private :: last = 0
      type(span_t), private :: keyword
   contains
      procedure :: another
      procedure :: left
      procedure :: word_operand
      procedure :: positive_integer
      procedure :: real_number
      procedure :: finish
      procedure, private :: error => tell
   end type operands_t

contains

   pure function operands_of(statement) result(operands)
      type(statement_t), intent(in) :: statement
      type(operands_t) :: operands

      operands%position = statement%keyword%last + 1
      operands%last = statement%last
      operands%keyword = statement%keyword
      operands%forgiving = statement%block == block_picture
      operands%word = statement%keyword
   end function operands_of

   !> Take the next operand as it stands; false at the end of the statement.
   logical function another(self, text)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text
      type(span_t) :: word

      call next_word(text, self%position, self%last, word)
      another = word%first > 0
      if (another) self%word = word
   end function another

   !> How many operands are still to be taken.
   pure integer function left(self, text)
      class(operands_t), intent(in) :: self
      character(len=*), intent(in) :: text
      type(span_t) :: word
      integer :: position

      position = self%position
      left = -1
      do
         left = left + 1
         call next_word(text, position, self%last, word)
         if (word%first == 0) exit
      end do
   end function left

   !> Take a word of any kind; its absence is reported.
   subroutine word_operand(self, text, what, diagnostics)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text, what
      type(diagnostics_t), intent(inout) :: diagnostics
      logical :: there

      there = required(self, text, what, diagnostics)
   end subroutine word_operand

   !> Take a number that counts from one: an element, a node, a component.
   !> Zero where it is missing or wrong.
   subroutine positive_integer(self, text, what, value, diagnostics)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text, what
      integer, intent(out) :: value
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: status

      value = 0
      if (.not. required(self, text, what, diagnostics)) return
      associate (word => text(self%word%first:self%word%last))
         call read_integer(word, value, status)
         if (status == number_fine .and. value < 1) then
            call self%error('bad-number', self%word, quoted(word)//' is less than 1', &
                            'expected here: '//trim(what), 'elements, nodes and components count from 1', diagnostics)
            value = 0
            self%fine = .false.
         else if (status /= number_fine) then
            value = 0
            call wrong_number(self, word, what, status, diagnostics)
         end if
      end associate
   end subroutine positive_integer

   !> Take a real number; zero where it is missing or wrong.
   subroutine real_number(self, text, what, value, diagnostics)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text, what
      real(wp), intent(out) :: value
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: status

      value = 0.0_wp
      if (.not. required(self, text, what, diagnostics)) return
      associate (word => text(self%word%first:self%word%last))
         call read_real(word, value, status)
         if (status /= number_fine) call wrong_number(self, word, what, status, diagnostics)
      end associate
   end subroutine real_number

   !> Say that operands are left over, where they are.
   subroutine finish(self, text, form, diagnostics)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text, form
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: surplus

      if (.not. self%another(text)) return
      surplus = self%word
      if (is_semicolon(text, surplus)) then
         call semicolon(self, diagnostics)
         return
      end if
      do while (self%another(text))
         surplus%last = self%word%last
      end do
      call self%error('surplus-operand', surplus, &
                      text(self%keyword%first:self%keyword%last)//' has more operands than it takes', &
                      'nothing may stand here', 'its form is: '//form, diagnostics)
      self%fine = .false.
   end subroutine finish

   !> Report what is wrong with an operand.
   subroutine tell(self, code, place, message, label, help, diagnostics)
      class(operands_t), intent(in) :: self
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place
      type(diagnostics_t), intent(inout) :: diagnostics

      if (self%forgiving) then
         call diagnostics%warning(code, place, message//'; the option is left out', label, help)
      else
         call diagnostics%error(code, place, message, label, help)
      end if
   end subroutine tell

   logical function required(self, text, what, diagnostics)
      type(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: text, what
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: behind

      required = self%another(text)
      if (required) return
      behind = self%word%last + 1
      ! One missing operand is said once, not once for each that would follow.
      if (self%position < huge(1)) then
         call self%error('missing-operand', span_t(behind, behind), &
                         text(self%keyword%first:self%keyword%last)//' needs one more operand: '//trim(what), &
                         'expected here: '//trim(what), 'add it', diagnostics)
      end if
      self%position = huge(1)
      self%fine = .false.
   end function required

   subroutine wrong_number(self, word, what, status, diagnostics)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: word, what
      integer, intent(in) :: status
      type(diagnostics_t), intent(inout) :: diagnostics

      self%fine = .false.
      if (word(1:1) == ';') then
         call semicolon(self, diagnostics)
         return
      end if
      select case (status)
      case (number_malformed)
         call self%error('bad-number', self%word, quoted(word)//' is not a number', &
                         'expected here: '//trim(what), 'write a number such as 3, -0.5 or 1.0e-3', diagnostics)
      case (number_not_whole)
         call self%error('not-whole', self%word, quoted(word)//' is not a whole number', &
                         'expected here: '//trim(what), 'write a whole number, without point and exponent', diagnostics)
      case (number_not_finite)
         call self%error('not-finite', self%word, quoted(word)//' is not a finite number', &
                         'expected here: '//trim(what), 'write a finite number', diagnostics)
      case (number_too_large)
         call self%error('number-too-large', self%word, quoted(word)//' is larger than it can be', &
                         'expected here: '//trim(what), &
                         'whole numbers go up to 2147483647, others up to 1.79e308', diagnostics)
      end select
   end subroutine wrong_number

   pure logical function is_semicolon(text, word)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: word
      is_semicolon = text(word%first:word%first) == ';'
   end function is_semicolon

   !> What was meant as a comment is told once, and nothing behind it is read.
   subroutine semicolon(self, diagnostics)
      type(operands_t), intent(inout) :: self
      type(diagnostics_t), intent(inout) :: diagnostics

      call self%error('bad-comment', self%word, 'a semicolon opens a comment in the picture block alone', &
                      'not a comment here', 'write % or # instead', diagnostics)
      self%fine = .false.
      self%position = huge(1)
   end subroutine semicolon

   !> The word in quotes, cut where it is long.
   pure function quoted(word)
      character(len=*), intent(in) :: word
      character(len=:), allocatable :: quoted

      if (len(word) > 40) then
         quoted = "'"//word(:37)//"...'"
      else
         quoted = "'"//word//"'"
      end if
   end function quoted
end module flexact_operands
