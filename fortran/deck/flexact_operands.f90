! SPDX-License-Identifier: BSD-3-Clause
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
      !> The deck, and where what is wrong with it is kept.
      character(len=:), pointer :: text => null()
      type(diagnostics_t), pointer :: diagnostics => null()
      !> The operand that was taken last.
      type(span_t) :: word
      !> Whether every operand so far was what it should be.
      logical :: fine = .true.
      !> Whether every real number so far has so few digits that they can be known again.
      logical :: is_short = .true.
      !> Power of ten of the unit of lengths in metres.
      integer :: length_power = 0
      !> What is wrong with one is a warning, and the statement is not used.
      logical :: forgiving = .false.
      integer, private :: position = 1
      integer, private :: last = 0
      type(span_t), private :: keyword
   contains
      procedure :: another
      procedure :: spelling
      procedure :: left
      procedure :: word_operand
      procedure :: positive_integer
      procedure :: real_number
      procedure :: finish
      procedure, private :: error => report_error
      procedure, private :: number_error
   end type operands_t

contains

   function operands_of(text, diagnostics, statement) result(operands)
      character(len=:), pointer, intent(in) :: text
      type(diagnostics_t), pointer, intent(in) :: diagnostics
      type(statement_t), intent(in) :: statement
      type(operands_t) :: operands

      operands%text => text
      operands%diagnostics => diagnostics
      operands%position = statement%keyword%last + 1
      operands%last = statement%last
      operands%keyword = statement%keyword
      operands%forgiving = statement%block == block_picture
      operands%word = statement%keyword
   end function operands_of

   !> Take the next operand as it stands; false at the end of the statement.
   logical function another(self)
      class(operands_t), intent(inout) :: self
      type(span_t) :: word

      call next_word(self%text, self%position, self%last, word)
      another = word%first > 0
      if (another) self%word = word
   end function another

   !> The operand that was taken last, as it stands.
   pure function spelling(self)
      class(operands_t), intent(in) :: self
      character(len=:), allocatable :: spelling
      spelling = self%text(self%word%first:self%word%last)
   end function spelling

   !> How many operands are still to be taken.
   pure integer function left(self)
      class(operands_t), intent(in) :: self
      type(span_t) :: word
      integer :: position

      position = self%position
      left = -1
      do
         left = left + 1
         call next_word(self%text, position, self%last, word)
         if (word%first == 0) exit
      end do
   end function left

   !> Take a word of any kind; its absence is reported.
   subroutine word_operand(self, what)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: what
      logical :: there

      there = required(self, what)
   end subroutine word_operand

   !> Take a number that counts from one: an element, a node, a component.
   !> Zero where it is missing or wrong.
   subroutine positive_integer(self, what, value)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: what
      integer, intent(out) :: value
      integer :: status

      value = 0
      if (.not. required(self, what)) return
      call read_integer(self%text(self%word%first:self%word%last), value, status)
      if (status == number_fine .and. value > 0) return
      value = 0
      if (status == number_fine) then
         call self%number_error('bad-number', what, 'is less than 1', 'elements, nodes and components count from 1')
      else
         call wrong_number(self, what, status)
      end if
   end subroutine positive_integer

   !> Take a real number, in SI; zero where it is missing or wrong. lengths: the power of the
   !> length in its unit.
   subroutine real_number(self, what, value, lengths)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: what
      real(wp), intent(out) :: value
      integer, intent(in), optional :: lengths
      integer :: status, power
      logical :: is_short

      value = 0.0_wp
      if (.not. required(self, what)) return
      power = 0
      if (present(lengths)) power = lengths*self%length_power
      call read_real(self%text(self%word%first:self%word%last), power, value, status, is_short)
      self%is_short = self%is_short .and. is_short
      if (status /= number_fine) call wrong_number(self, what, status)
   end subroutine real_number

   !> Say that operands are left over, where they are.
   subroutine finish(self, form)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: form
      type(span_t) :: surplus

      if (.not. self%another()) return
      surplus = self%word
      if (self%text(surplus%first:surplus%first) == ';') then
         call semicolon(self)
         return
      end if
      do while (self%another())
         surplus%last = self%word%last
      end do
      call self%error('surplus-operand', surplus, &
                      self%text(self%keyword%first:self%keyword%last)//' has more operands than it takes', &
                      'nothing may stand here', 'its form is: '//form)
      self%fine = .false.
   end subroutine finish

   !> Report what is wrong with an operand.
   subroutine report_error(self, code, place, message, label, help)
      class(operands_t), intent(in) :: self
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place

      if (self%forgiving) then
         call self%diagnostics%warning(code, place, message//'; the option is left out', label, help)
      else
         call self%diagnostics%error(code, place, message, label, help)
      end if
   end subroutine report_error

   logical function required(self, what)
      type(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: what
      integer :: behind

      required = self%another()
      if (required) return
      behind = self%word%last + 1
      ! One missing operand is said once, not once for each that would follow.
      if (self%position < huge(1)) then
         call self%error('missing-operand', span_t(behind, behind), &
                         self%text(self%keyword%first:self%keyword%last)//' needs one more operand: '//trim(what), &
                         'expected here: '//trim(what), 'add it')
      end if
      self%position = huge(1)
      self%fine = .false.
   end function required

   subroutine wrong_number(self, what, status)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: what
      integer, intent(in) :: status

      if (self%text(self%word%first:self%word%first) == ';') then
         call semicolon(self)
         return
      end if
      select case (status)
      case (number_malformed)
         call self%number_error('bad-number', what, 'is not a number', 'write a number such as 3, -0.5 or 1.0e-3')
      case (number_not_whole)
         call self%number_error('not-whole', what, 'is not a whole number', 'write a whole number, without point and exponent')
      case (number_not_finite)
         call self%number_error('not-finite', what, 'is not a finite number', 'write a finite number')
      case (number_too_large)
         call self%number_error('number-too-large', what, 'is larger than it can be', &
                                'whole numbers go up to 2147483647, others up to 1.79e308')
      end select
   end subroutine wrong_number

   subroutine number_error(self, code, what, message, help)
      class(operands_t), intent(inout) :: self
      character(len=*), intent(in) :: code, what, message, help

      call self%error(code, self%word, quoted(self%spelling())//' '//message, 'expected here: '//trim(what), help)
      self%fine = .false.
   end subroutine number_error

   !> What was meant as a comment is reported once, and nothing behind it is read.
   subroutine semicolon(self)
      type(operands_t), intent(inout) :: self

      call self%error('bad-comment', self%word, 'a semicolon opens a comment in the picture block alone', &
                      'not a comment here', 'write % or # instead')
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
