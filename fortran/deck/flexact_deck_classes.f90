! SPDX-License-Identifier: BSD-3-Clause
!> The statements that give coordinates and deformations their class.
module flexact_deck_classes
   use flexact_choice, only: choice_t, components_of, deformations_of, warping_components, take_choice
   use flexact_deck_model, only: deck_model_t, take_node, take_element
   use flexact_element_table, only: beam_with_warping
   use flexact_keywords, only: keywords, role_coordinate, role_deformation
   use flexact_lexer, only: operand_span
   use flexact_model, only: class_none, class_fixed, class_dependent, class_independent
   use flexact_numbers, only: leading_integer
   use flexact_slots, only: most_deformations
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_classes

   !> Those of the model, and two of warping, which are calculable whatever is said.
   integer, parameter :: most_stated = most_deformations + 2

   !> Where each class was stated first, 0 where none was.
   type :: origins_t
      integer, allocatable :: coordinate(:, :), warping(:, :), deformation(:, :)
   end type origins_t

   !> The classes from class_fixed on.
   character(len=*), parameter :: class_word(3) = ['fixed      ', 'released   ', 'independent']

contains

   !> Apply FIX, DYNX, INPUTX, RLSE, DYNE, INPUTE; statements add up, and two
   !> that give one thing different classes are an error with both places.
   subroutine read_classes(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(origins_t) :: origins
      integer :: i

      allocate (origins%coordinate(3, deck%model%nodes), source=0)
      allocate (origins%warping(1, size(deck%warping_nodes%number)), source=0)
      allocate (origins%deformation(most_deformations, deck%model%elements), source=0)
      do i = 1, size(statements)
         select case (statements(i)%role)
         case (role_coordinate)
            call read_of_node(statements(i), deck, origins)
         case (role_deformation)
            call read_of_element(statements(i), deck, origins)
         end select
      end do
   end subroutine read_classes

   subroutine read_of_node(statement, deck, origins)
      type(statement_t), intent(in) :: statement
      type(deck_model_t), intent(inout) :: deck
      type(origins_t), intent(inout) :: origins
      type(operands_t) :: operands
      integer :: node, class

      operands = operands_of(deck%text, deck%diagnostics, statement)
      class = class_of(keywords(statement%what)%name)
      call take_warping_node(deck, operands, node)
      if (node > 0) then
         call read_choice(operands, warping_components(), class, &
                          deck%warping_class(:, node), origins%warping(:, node))
         return
      end if
      call take_node(deck, operands, node)
      if (node == 0) return
      call read_choice(operands, components_of(deck%model%node_kind(node)), class, &
                       deck%model%coordinate_class(:, node), origins%coordinate(:, node))
   end subroutine read_of_node

   subroutine read_of_element(statement, deck, origins)
      type(statement_t), intent(in) :: statement
      type(deck_model_t), intent(inout) :: deck
      type(origins_t), intent(inout) :: origins
      type(operands_t) :: operands
      integer :: element, classes(most_stated), origin(most_stated)

      operands = operands_of(deck%text, deck%diagnostics, statement)
      call take_element(deck, operands, element)
      if (element == 0) return
      classes = [deck%model%deformation_class(:, element), class_none, class_none]
      origin = [origins%deformation(:, element), 0, 0]
      call read_choice(operands, deformations_of(deck%model%element_kind(element), deck%has_warping(element)), &
                       class_of(keywords(statement%what)%name), classes, origin)
      origins%deformation(:, element) = origin(:most_deformations)
      deck%model%deformation_class(:, element) = classes(:most_deformations)
      if (any(classes(most_deformations + 1:) == class_independent)) call warping_is_calculable(statement, deck)
   end subroutine read_of_element

   !> What SPACAR makes of such a statement is not known.
   subroutine warping_is_calculable(statement, deck)
      type(statement_t), intent(in) :: statement
      type(deck_model_t), intent(in) :: deck
      type(operands_t) :: operands
      integer :: words

      operands = operands_of(deck%text, deck%diagnostics, statement)
      words = 0
      do while (operands%another())
         words = words + 1
         if (words > 1 .and. leading_integer(operands%spelling()) > most_deformations) exit
      end do
      call operands%diagnostics%error('not-covered', operands%word, &
                                      'Flexact does not analyse '//beam_with_warping//' with an independent 7 or 8: '// &
                                      'in SPACAR they are always calculable', 'not covered', &
                                      'leave them out; FIX holds the warping at a node, DYNX declares it')
   end subroutine warping_is_calculable

   !> Take the number of a warping node; 0, and nothing taken, where it is none.
   subroutine take_warping_node(deck, operands, node)
      type(deck_model_t), intent(in) :: deck
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: node
      type(operands_t) :: ahead

      node = 0
      if (size(deck%warping_nodes%number) == 0) return
      ahead = operands
      if (.not. ahead%another()) return
      node = deck%warping_nodes%find(leading_integer(ahead%spelling()))
      if (node > 0) operands = ahead
   end subroutine take_warping_node

   !> Give the named entries their class, all of them where none is named.
   subroutine read_choice(operands, choice, class, classes, origin)
      type(operands_t), intent(inout) :: operands
      type(choice_t), intent(in) :: choice
      integer, intent(in) :: class
      integer, intent(inout) :: classes(:), origin(:)
      type(operands_t) :: ahead
      integer :: number, i

      ahead = operands
      if (.not. ahead%another()) then
         call give_class(operands, choice, classes /= class_none, class, classes, origin)
         return
      end if
      do
         ahead = operands
         if (.not. ahead%another()) exit
         call take_choice(operands, choice, number)
         if (number == 0) cycle
         if (choice%entry(number) == 0) then
            call first_euler_parameter(operands, class)
         else
            call give_class(operands, choice, choice%entry(number) == [(i, i=1, size(classes))], &
                            class, classes, origin)
         end if
      end do
   end subroutine read_choice

   !> Give the chosen entries their class; one conflict is reported for a word.
   subroutine give_class(operands, choice, chosen, class, classes, origin)
      type(operands_t), intent(in) :: operands
      type(choice_t), intent(in) :: choice
      logical, intent(in) :: chosen(:)
      integer, intent(in) :: class
      integer, intent(inout) :: classes(:), origin(:)
      integer :: i

      do i = 1, size(chosen)
         if (.not. chosen(i)) cycle
         if (origin(i) > 0 .and. classes(i) /= class) then
            call operands%diagnostics%error('class-conflict', operands%word, &
                                            'a '//trim(choice%what)//' is given two classes: '// &
                                            trim(class_word(classes(i)))//' and '//trim(class_word(class)), &
                                            'stated '//trim(class_word(class))//' here', &
                                            'keep one of the two statements, or name other components', &
                                            operand_span(operands%text, origin(i), 1, 1))
            return
         end if
         classes(i) = class
         if (origin(i) == 0) origin(i) = operands%word%first
      end do
   end subroutine give_class

   !> lambda0 follows from the norm: held or not makes no difference, but it
   !> cannot be a degree of freedom.
   subroutine first_euler_parameter(operands, class)
      type(operands_t), intent(in) :: operands
      integer, intent(in) :: class

      if (class == class_fixed) return
      call operands%diagnostics%warning('no-coordinate', operands%word, &
                                        'component 1 of an orientation (lambda0) is no coordinate of its own', 'not used', &
                                        'the rotations about x, y, z are the components 2, 3, 4')
   end subroutine first_euler_parameter

   pure integer function class_of(keyword) result(class)
      character(len=*), intent(in) :: keyword

      select case (keyword)
      case ('FIX')
         class = class_fixed
      case ('RLSE')
         class = class_dependent
      case default
         class = class_independent
      end select
   end function class_of
end module flexact_deck_classes
