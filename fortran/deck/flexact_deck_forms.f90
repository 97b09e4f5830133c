! SPDX-License-Identifier: BSD-3-Clause
!> Statements that are not used: dynamics, in/out, and of the picture what is not
!> drawn. Their form is checked, and what they name must exist.
module flexact_deck_forms
   use flexact_choice, only: choice_t, components_of, deformations_of, take_choice
   use flexact_deck_model, only: deck_model_t, take_node, take_element
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_keywords, only: keyword_t, keywords, role_form, block_kinematics
   use flexact_kinds, only: wp
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_forms, note_unused

contains

   !> Check the form of every such statement.
   subroutine read_forms(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(in) :: deck
      integer :: i

      do i = 1, size(statements)
         if (statements(i)%role == role_form) &
            call check_form(statements(i), keywords(statements(i)%what), deck)
      end do
   end subroutine read_forms

   !> Say once which statements were read and not used.
   subroutine note_unused(statements, unused, diagnostics)
      type(statement_t), intent(in) :: statements(:)
      integer, intent(out) :: unused
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=*), parameter :: help = 'the verdict needs the kinematics block alone; besides, stiffness, mass, loads '// &
                                     'and how elements are drawn are used'
      type(span_t) :: first
      integer :: times(size(keywords)), order(size(keywords)), kinds, i

      times = 0
      kinds = 0
      do i = 1, size(statements)
         if (statements(i)%role /= role_form .or. statements(i)%block == block_kinematics) cycle
         associate (what => statements(i)%what)
            if (kinds == 0) first = statements(i)%keyword
            if (times(what) == 0) then
               kinds = kinds + 1
               order(kinds) = what
            end if
            times(what) = times(what) + 1
         end associate
      end do
      unused = sum(times)
      if (unused == 0) return
      call diagnostics%note('not-used', first, number_of(unused, 'statement')//' not used: '// &
                            listed(order(:kinds), times), merge('this one         ', 'the first of them', unused == 1), help)
   end subroutine note_unused

   !> Keywords, and how often each stands; of very many the first.
   pure function listed(order, times) result(words)
      integer, intent(in) :: order(:), times(:)
      character(len=:), allocatable :: words
      integer, parameter :: most = 8
      character(len=12) :: number
      integer :: i

      words = ''
      do i = 1, min(size(order), most)
         if (i > 1) words = words//', '
         words = words//trim(keywords(order(i))%name)
         if (times(order(i)) == 1) cycle
         write (number, '(i0)') times(order(i))
         words = words//' ('//trim(number)//')'
      end do
      if (size(order) > most) words = words//' and others'
   end function listed

   pure function number_of(many, what) result(words)
      integer, intent(in) :: many
      character(len=*), intent(in) :: what
      character(len=:), allocatable :: words
      character(len=12) :: number

      write (number, '(i0)') many
      words = trim(number)//' '//what
      words = words//trim(merge('s were', ' was  ', many /= 1))
   end function number_of

   subroutine check_form(statement, keyword, deck)
      type(statement_t), intent(in) :: statement
      type(keyword_t), intent(in) :: keyword
      type(deck_model_t), intent(in) :: deck
      type(operands_t) :: operands, ahead
      type(choice_t) :: choice
      integer :: number

      operands = operands_of(deck%text, deck%diagnostics, statement)
      number = 0
      do
         ahead = operands
         if (number >= keyword%least) then
            if (.not. ahead%another()) return
         end if
         if (number == keyword%most) exit
         number = number + 1
         call take_by_form(keyword%form(min(number, len_trim(keyword%form)):), &
                           deck, operands, choice)
         if (.not. operands%fine) return
      end do
      call operands%finish(trim(keyword%name)//form_in_words(keyword))
   end subroutine check_form

   !> Take one operand; a node or an element says what may be named next.
   subroutine take_by_form(letter, deck, operands, choice)
      character, intent(in) :: letter
      type(deck_model_t), intent(in) :: deck
      type(operands_t), intent(inout) :: operands
      type(choice_t), intent(inout) :: choice
      integer :: whole
      real(wp) :: real_value

      select case (letter)
      case ('e')
         call take_element(deck, operands, whole)
         if (whole > 0) choice = deformations_of(deck%model%element_kind(whole), deck%has_warping(whole))
      case ('n')
         call take_node(deck, operands, whole)
         if (whole > 0) choice = components_of(deck%model%node_kind(whole))
      case ('w')
         call operands%word_operand('word')
      case ('i')
         call take_choice(operands, choice, whole)
      case default
         call operands%real_number('number', real_value)
      end select
   end subroutine take_by_form

   pure function form_in_words(keyword) result(words)
      type(keyword_t), intent(in) :: keyword
      character(len=:), allocatable :: words
      character(len=*), parameter :: operand(5) = ['element  ', 'node     ', 'component', 'word     ', 'value    ']
      integer :: i, place

      words = ''
      do i = 1, min(keyword%most, 8)
         place = min(i, len_trim(keyword%form))
         words = words//' '//trim(operand(index('eniwr', keyword%form(place:place))))
      end do
   end function form_in_words
end module flexact_deck_forms
