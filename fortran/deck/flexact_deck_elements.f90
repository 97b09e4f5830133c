! SPDX-License-Identifier: BSD-3-Clause
!> Element statements into the element arrays of the model; nodes come into
!> being here, because an element names them.
module flexact_deck_elements
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: element_kinds, deformations_of, beam_with_warping, vector_none, vector_optional, vector_required
   use flexact_keywords, only: role_element, role_uncovered, role_unknown
   use flexact_kinds, only: wp
   use flexact_lexer, only: operand_span
   use flexact_model, only: model_t, class_none, class_fixed, class_dependent
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation, is_position, has_axis, &
                            slots, most_deformations
   use flexact_numbering, only: make_numbering
   use flexact_numbers, only: leading_integer
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t, has_warping
   implicit none
   private
   public :: read_elements

   character(len=*), parameter :: node_in_slot(slots) = [character(len=27) :: &
                                                         'node number (position p)', 'node number (orientation p)', &
                                                         'node number (position q)', 'node number (orientation q)']
   character(len=*), parameter :: warping_in_slot(2) = ['node number (warping p)', 'node number (warping q)']
   !> Of each kind of node.
   character(len=*), parameter :: node_in_words(4) = [character(len=14) :: &
                                                      'a position', 'a position', 'a planar angle', 'an orientation']

contains

   !> Read all element statements, make the nodes that they name, and find
   !> which element has which number.
   subroutine read_elements(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      integer, allocatable :: excused(:)
      integer :: i, k
      logical :: fine

      allocate (excused(0))
      associate (model => deck%model)
         model%elements = count(statements%role == role_element)
         call allocate_elements(model)
         allocate (deck%element_names(model%elements))
         allocate (deck%warping_node(2, model%elements), source=0)
         allocate (deck%has_warping(model%elements), source=.false.)
         k = 0
         do i = 1, size(statements)
            select case (statements(i)%role)
            case (role_element)
               k = k + 1
               deck%element_names(k) = statements(i)%comment
               call read_element(deck, statements(i), k, fine)
               if (.not. fine) call excuse(deck, statements(i), excused)
            case (role_unknown, role_uncovered)
               call excuse(deck, statements(i), excused)
            end select
         end do
         deck%warping_nodes = make_numbering(reshape(deck%warping_node, [2*model%elements]))
         allocate (deck%warping_class(1, size(deck%warping_nodes%number)), source=class_dependent)
         deck%excused = make_numbering(excused)
         ! What is said of a warping node is read with the classes alone.
         deck%left_out = deck%warping_nodes
         deck%nodes = make_numbering(reshape(model%element_node, [slots*model%elements]))
      end associate
      call make_nodes(deck)
      call find_elements(deck)
   end subroutine read_elements

   !> Remember the integers of a statement that could not be read, up to some
   !> number: a deck of nothing else is not a deck.
   subroutine excuse(deck, statement, excused)
      type(deck_model_t), intent(in) :: deck
      type(statement_t), intent(in) :: statement
      integer, allocatable, intent(inout) :: excused(:)
      type(operands_t) :: operands

      operands = operands_of(deck%text, deck%diagnostics, statement)
      do while (operands%another())
         if (size(excused) >= 10000) exit
         excused = [excused, leading_integer(operands%spelling())]
      end do
   end subroutine excuse

   subroutine allocate_elements(model)
      type(model_t), intent(inout) :: model

      allocate (model%element_number(model%elements), source=0)
      allocate (model%element_kind(model%elements), source=0)
      allocate (model%element_node(slots, model%elements), source=0)
      allocate (model%element_vector(3, model%elements), source=0.0_wp)
      allocate (model%deformation_class(most_deformations, model%elements), source=class_none)
      allocate (model%element_origin(model%elements), source=0)
   end subroutine allocate_elements

   !> One statement; the node slots hold numbers until all are known. An
   !> element whose statement is wrong keeps its number, so that statements
   !> about it are not reported as well, and loses its nodes where they are unknown.
   subroutine read_element(deck, statement, k, fine)
      type(deck_model_t), intent(inout) :: deck
      type(statement_t), intent(in) :: statement
      integer, intent(in) :: k
      logical, intent(out) :: fine
      type(operands_t) :: operands, ahead
      integer :: slot
      logical :: warps

      warps = has_warping(deck%text, statement%keyword%first)
      deck%has_warping(k) = warps
      associate (model => deck%model, kind => element_kinds(statement%what))
         model%element_kind(k) = statement%what
         model%element_origin(k) = statement%keyword%first
         model%deformation_class(:deformations_of(statement%what), k) = class_fixed
         operands = operands_of(deck%text, deck%diagnostics, statement)
         call operands%positive_integer('element number', model%element_number(k))
         do slot = 1, slots
            if (kind%slot_kind(slot) == 0) cycle
            call operands%positive_integer(node_in_slot(slot), model%element_node(slot, k))
            if (warps .and. modulo(slot, 2) == 0) &
               call operands%positive_integer(warping_in_slot(slot/2), deck%warping_node(slot/2, k))
         end do
         call read_vector(operands, kind%vector, model%element_vector(:, k))
         if (operands%fine) then
            ahead = operands
            if (ahead%another()) call operands%finish(form_of(statement%what, warps))
         end if
         fine = operands%fine
      end associate
      if (.not. operands%is_short) deck%has_long_numbers = .true.
   end subroutine read_element

   subroutine read_vector(operands, use_of_vector, vector)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: use_of_vector
      real(wp), intent(inout) :: vector(3)
      type(operands_t) :: ahead
      type(span_t) :: place
      character(len=*), parameter :: component(3, 2) = reshape( &
                                     ['x of the y vector', 'y of the y vector', 'z of the y vector', &
                                      'x of the axis    ', 'y of the axis    ', 'z of the axis    '], [3, 2])
      integer :: i

      if (use_of_vector == vector_none .or. .not. operands%fine) return
      if (use_of_vector == vector_optional) then
         ahead = operands
         if (.not. ahead%another()) return
      end if
      do i = 1, 3
         call operands%real_number(component(i, use_of_vector), vector(i))
         if (i == 1) place = operands%word
         place%last = operands%word%last
      end do
      ! A vector that is half known is not known.
      if (.not. operands%fine) vector = 0.0_wp
      if (operands%fine .and. all(abs(vector) <= 0.0_wp)) then
         call operands%diagnostics%error('zero-vector', place, 'the vector is zero', 'has no direction', &
                                         'give a vector that is not zero')
      end if
   end subroutine read_vector

   !> How a statement of this kind is written.
   function form_of(kind, warps) result(form)
      integer, intent(in) :: kind
      logical, intent(in) :: warps
      character(len=:), allocatable :: form
      character(len=*), parameter :: with_warping = ' e p op wp q oq wq'
      character(len=2), parameter :: slot_letters(slots) = ['p ', 'op', 'q ', 'oq']
      integer :: slot

      form = trim(element_kinds(kind)%keyword)//' e'
      do slot = 1, slots
         if (element_kinds(kind)%slot_kind(slot) /= 0) form = form//' '//trim(slot_letters(slot))
      end do
      if (warps) form = beam_with_warping//with_warping
      if (element_kinds(kind)%vector == vector_required) form = form//' ax ay az'
      if (element_kinds(kind)%vector == vector_optional) form = form//' [yx yy yz]'
   end function form_of

   !> Replace node numbers by indices; give each node its kind, the identity
   !> or zero as its value, and its coordinates, all dependent.
   subroutine make_nodes(deck)
      type(deck_model_t), intent(inout) :: deck
      integer :: first_user(size(deck%nodes%number)), k, slot, node, axis

      associate (model => deck%model, nodes => deck%nodes)
         model%nodes = size(nodes%number)
         allocate (model%node_number(model%nodes), source=nodes%number)
         allocate (model%node_kind(model%nodes), source=0)
         allocate (model%node_value(4, model%nodes), source=0.0_wp)
         allocate (model%coordinate_class(3, model%nodes), source=class_none)
         allocate (model%node_origin(model%nodes), source=0)
         allocate (deck%node_names(model%nodes))
         first_user = 0
         do k = 1, model%elements
            do slot = 1, slots
               node = nodes%find(model%element_node(slot, k))
               model%element_node(slot, k) = node
               if (node == 0) cycle
               call take_kind(deck, k, slot, first_user(node))
            end do
         end do
         do node = 1, model%nodes
            if (model%node_kind(node) == node_orientation) model%node_value(1, node) = 1.0_wp
            do axis = 1, 3
               if (has_axis(model%node_kind(node), axis)) model%coordinate_class(axis, node) = class_dependent
            end do
         end do
      end associate
   end subroutine make_nodes

   !> A node is what its first slot says; a planar position that a spatial
   !> element uses too has three components.
   subroutine take_kind(deck, k, slot, first_user)
      type(deck_model_t), intent(inout) :: deck
      integer, intent(in) :: k, slot
      integer, intent(inout) :: first_user
      type(span_t) :: place
      integer :: wanted

      wanted = element_kinds(deck%model%element_kind(k))%slot_kind(slot)
      associate (model => deck%model, kind => deck%model%node_kind(deck%model%element_node(slot, k)))
         if (kind == 0) then
            kind = wanted
            first_user = k
         else if (is_position(kind) .and. is_position(wanted)) then
            kind = max(kind, wanted)
         else if (kind /= wanted) then
            place = place_of_slot(deck, k, slot)
            call deck%diagnostics%error('two-kinds-of-node', place, &
                                        'node '//deck%text(place%first:place%last)//' is used as '//trim(node_in_words(wanted))// &
                                        ' and as '//trim(node_in_words(kind)), 'here as '//trim(node_in_words(wanted)), &
                                        'position and orientation of one point are two nodes with two numbers', &
                                        place_of_slot(deck, first_user, findloc(model%element_node(:, first_user), &
                                                                                model%element_node(slot, k), dim=1)))
            ! Not known: the element is not checked further.
            model%element_node(slot, k) = 0
         end if
      end associate
   end subroutine take_kind

   !> The word of an element's statement that names its node in this slot.
   pure function place_of_slot(deck, k, slot) result(place)
      type(deck_model_t), intent(in) :: deck
      integer, intent(in) :: k, slot
      type(span_t) :: place
      integer :: word

      word = 2 + count(element_kinds(deck%model%element_kind(k))%slot_kind(:slot) /= 0)
      if (slot > 2 .and. deck%has_warping(k)) word = word + 1
      place = operand_span(deck%text, deck%model%element_origin(k), word, word)
   end function place_of_slot

   !> The element of each number; a number that two elements have is reported
   !> with both places.
   subroutine find_elements(deck)
      type(deck_model_t), intent(inout) :: deck
      type(span_t) :: place
      integer :: k, index

      associate (model => deck%model)
         deck%element_numbers = make_numbering(model%element_number)
         allocate (deck%element_of(size(deck%element_numbers%number)), source=0)
         do k = 1, model%elements
            index = deck%element_numbers%find(model%element_number(k))
            if (index == 0) cycle
            if (deck%element_of(index) == 0) then
               deck%element_of(index) = k
            else if (deck%diagnostics%is_full()) then
               call deck%diagnostics%count_error()
            else
               place = operand_span(deck%text, model%element_origin(k), 2, 2)
               call deck%diagnostics%error( &
                  'duplicate-element', place, &
                  'element number '//deck%text(place%first:place%last)//' is used twice', &
                  'used again here', 'give each element a number of its own', &
                  operand_span(deck%text, model%element_origin(deck%element_of(index)), 2, 2))
            end if
         end do
      end associate
   end subroutine find_elements
end module flexact_deck_elements
