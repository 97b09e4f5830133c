!> The statements that give coordinates and deformations their class.
module flexact_deck_classes
   use flexact_choice, only: choice_t, components_of, deformations_of, take_choice
   use flexact_deck_scene, only: scene_t, take_node, take_element
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_keywords, only: keywords, role_coordinate, role_deformation
   use flexact_lexer, only: operand_span
   use flexact_model, only: class_none, class_fixed, class_dependent, class_independent, most_deformations
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_classes

contains

   !> Apply FIX, DYNX, INPUTX, RLSE, DYNE, INPUTE; statements add up, and two
   !> that give one thing different classes are an error with both places.
   subroutine read_classes(text, statements, scene, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(in) :: statements(:)
      type(scene_t), intent(inout) :: scene
      type(diagnostics_t), intent(inout) :: diagnostics
      !> Where each class was stated first, 0 where none was.
      integer, allocatable :: coordinate_origin(:, :), deformation_origin(:, :)
      type(operands_t) :: operands
      integer :: i, node, element, class

      allocate (coordinate_origin(3, scene%model%nodes), source=0)
      allocate (deformation_origin(most_deformations, scene%model%elements), source=0)
      do i = 1, size(statements)
         operands = operands_of(statements(i))
         select case (statements(i)%role)
         case (role_coordinate)
            call take_node(text, scene, operands, node, diagnostics)
            if (node == 0) cycle
            class = class_of(keywords(statements(i)%what)%name)
            call read_choice(text, operands, components_of(scene%model%node_kind(node)), class, &
                             scene%model%coordinate_class(:, node), coordinate_origin(:, node), diagnostics)
         case (role_deformation)
            call take_element(text, scene, operands, element, diagnostics)
            if (element == 0) cycle
            class = class_of(keywords(statements(i)%what)%name)
            call read_choice(text, operands, deformations_of(scene%model%element_kind(element)), class, &
                             scene%model%deformation_class(:, element), deformation_origin(:, element), diagnostics)
         end select
      end do
   end subroutine read_classes

   !> Give the named entries their class, all of them where none is named.
   subroutine read_choice(text, operands, choice, class, classes, origin, diagnostics)
      character(len=*), intent(in) :: text
      type(operands_t), intent(inout) :: operands
      type(choice_t), intent(in) :: choice
      integer, intent(in) :: class
      integer, intent(inout) :: classes(:), origin(:)
      type(diagnostics_t), intent(inout) :: diagnostics
      type(operands_t) :: ahead
      integer :: number, i

      ahead = operands
      if (.not. ahead%another(text)) then
         call give_class(text, choice, operands%word, classes /= class_none, class, classes, origin, diagnostics)
         return
      end if
      do
         ahead = operands
         if (.not. ahead%another(text)) exit
         call take_choice(text, operands, choice, number, diagnostics)
         if (number == 0) cycle
         if (choice%entry(number) == 0) then
            call first_euler_parameter(operands, class, diagnostics)
         else
            call give_class(text, choice, operands%word, choice%entry(number) == [(i, i=1, size(classes))], &
                            class, classes, origin, diagnostics)
         end if
      end do
   end subroutine read_choice

   !> Give the chosen entries their class; one conflict is told for a word.
   subroutine give_class(text, choice, word, chosen, class, classes, origin, diagnostics)
      character(len=*), intent(in) :: text
      type(choice_t), intent(in) :: choice
      type(span_t), intent(in) :: word
      logical, intent(in) :: chosen(:)
      integer, intent(in) :: class
      integer, intent(inout) :: classes(:), origin(:)
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: i

      do i = 1, size(chosen)
         if (.not. chosen(i)) cycle
         if (origin(i) > 0 .and. classes(i) /= class) then
            call diagnostics%error('class-conflict', word, &
                                   'a '//trim(choice%what)//' is given two classes: '// &
                                   class_name(classes(i))//' and '//class_name(class), &
                                   'stated '//class_name(class)//' here', &
                                   'keep one of the two statements, or name other components', &
                                   operand_span(text, origin(i), 1, 1))
            return
         end if
         classes(i) = class
         if (origin(i) == 0) origin(i) = word%first
      end do
   end subroutine give_class

   !> lambda0 follows from the norm: held or not makes no difference, but it
   !> cannot be a degree of freedom.
   subroutine first_euler_parameter(operands, class, diagnostics)
      type(operands_t), intent(in) :: operands
      integer, intent(in) :: class
      type(diagnostics_t), intent(inout) :: diagnostics

      if (class == class_fixed) return
      call diagnostics%warning('no-coordinate', operands%word, &
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

   pure function class_name(class) result(name)
      integer, intent(in) :: class
      character(len=:), allocatable :: name

      select case (class)
      case (class_fixed)
         name = 'fixed'
      case (class_dependent)
         name = 'released'
      case default
         name = 'independent'
      end select
   end function class_name
end module flexact_deck_classes
