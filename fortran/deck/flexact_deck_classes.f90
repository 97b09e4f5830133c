!> The statements that give coordinates and deformations their class.
module flexact_deck_classes
   use flexact_deck_scene, only: scene_t, take_node, take_element
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: element_kinds
   use flexact_keywords, only: keywords, role_coordinate, role_deformation
   use flexact_lexer, only: next_line, next_word, line_t
   use flexact_model, only: class_none, class_fixed, class_dependent, class_independent, most_deformations, &
                            node_planar_position, node_position, node_angle
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
      integer :: i

      allocate (coordinate_origin(3, scene%model%nodes), source=0)
      allocate (deformation_origin(most_deformations, scene%model%elements), source=0)
      do i = 1, size(statements)
         select case (statements(i)%role)
         case (role_coordinate)
            call read_coordinates(text, statements(i), scene, coordinate_origin, diagnostics)
         case (role_deformation)
            call read_deformations(text, statements(i), scene, deformation_origin, diagnostics)
         end select
      end do
   end subroutine read_classes

   subroutine read_coordinates(text, statement, scene, origin, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(in) :: statement
      type(scene_t), intent(inout) :: scene
      integer, intent(inout) :: origin(:, :)
      type(diagnostics_t), intent(inout) :: diagnostics
      type(operands_t) :: operands, ahead
      integer :: node, component, axis, class

      operands = operands_of(statement)
      call take_node(text, scene, operands, node, diagnostics)
      if (node == 0) return
      class = class_of(keywords(statement%what)%name)
      associate (classes => scene%model%coordinate_class(:, node), kind => scene%model%node_kind(node))
         ahead = operands
         if (.not. ahead%another(text)) then
            call give_class(text, 'a coordinate', operands%word, classes /= class_none, class, classes, &
                            origin(:, node), diagnostics)
            return
         end if
         do
            ahead = operands
            if (.not. ahead%another(text)) exit
            call operands%positive_integer(text, 'component', component, diagnostics)
            if (component == 0) cycle
            axis = axis_of(kind, component)
            if (axis < 0) then
               call diagnostics%error('component-out-of-range', operands%word, &
                                      'the node has no component '//text(operands%word%first:operands%word%last), &
                                      components_of(kind), 'name a component that the node has')
            else if (axis == 0) then
               call first_euler_parameter(operands, class, diagnostics)
            else
               call give_class(text, 'a coordinate', operands%word, axis == [1, 2, 3], class, classes, &
                               origin(:, node), diagnostics)
            end if
         end do
      end associate
   end subroutine read_coordinates

   subroutine read_deformations(text, statement, scene, origin, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(in) :: statement
      type(scene_t), intent(inout) :: scene
      integer, intent(inout) :: origin(:, :)
      type(diagnostics_t), intent(inout) :: diagnostics
      type(operands_t) :: operands, ahead
      integer :: element, mode, class, i
      character :: last

      operands = operands_of(statement)
      call take_element(text, scene, operands, element, diagnostics)
      if (element == 0) return
      class = class_of(keywords(statement%what)%name)
      associate (classes => scene%model%deformation_class(:, element), &
                 kind => element_kinds(scene%model%element_kind(element)))
         ahead = operands
         if (.not. ahead%another(text)) then
            call give_class(text, 'a deformation', operands%word, classes /= class_none, class, classes, &
                            origin(:, element), diagnostics)
            return
         end if
         do
            ahead = operands
            if (.not. ahead%another(text)) exit
            call operands%positive_integer(text, 'deformation', mode, diagnostics)
            if (mode == 0) cycle
            if (mode > kind%deformations) then
               last = achar(iachar('0') + kind%deformations)
               call diagnostics%error('component-out-of-range', operands%word, &
                                      'the element has no deformation '//text(operands%word%first:operands%word%last), &
                                      trim(kind%keyword)//' has 1 to '//last, 'name a deformation that the element has')
            else
               call give_class(text, 'a deformation', operands%word, mode == [(i, i=1, most_deformations)], class, &
                               classes, origin(:, element), diagnostics)
            end if
         end do
      end associate
   end subroutine read_deformations

   !> Give the chosen entries their class; one conflict is told for a word.
   subroutine give_class(text, what, word, chosen, class, classes, origin, diagnostics)
      character(len=*), intent(in) :: text, what
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
                                   what//' is given two classes: '//class_name(classes(i))//' and '//class_name(class), &
                                   'stated '//class_name(class)//' here', &
                                   'keep one of the two statements, or name other components', &
                                   word_at(text, origin(i)))
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

   !> The axis of a component; 0 for lambda0, which has none, -1 where the
   !> component does not exist.
   pure integer function axis_of(kind, component) result(axis)
      integer, intent(in) :: kind, component

      axis = -1
      select case (kind)
      case (node_planar_position)
         if (component <= 2) axis = component
      case (node_position)
         if (component <= 3) axis = component
      case (node_angle)
         if (component == 1) axis = 3
      case default
         if (component <= 4) axis = component - 1
      end select
   end function axis_of

   pure function components_of(kind) result(label)
      integer, intent(in) :: kind
      character(len=:), allocatable :: label

      select case (kind)
      case (node_planar_position)
         label = 'a planar position has 1 and 2'
      case (node_position)
         label = 'a position has 1 to 3'
      case (node_angle)
         label = 'a planar orientation has 1'
      case default
         label = 'an orientation has 1 to 4'
      end select
   end function components_of

   pure function word_at(text, first) result(word)
      character(len=*), intent(in) :: text
      integer, intent(in) :: first
      type(span_t) :: word
      type(line_t) :: line
      integer :: position

      position = first
      call next_line(text, position, .false., line)
      position = first
      call next_word(text, position, line%body%last, word)
   end function word_at
end module flexact_deck_classes
