! SPDX-License-Identifier: BSD-3-Clause
!> The statements that give stiffness and mass: ESTIFF, EM (EMASS) and XM (MASS).
!> They are kept for who reads the model; of two for one thing the last counts.
module flexact_deck_properties
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_deck_model, only: deck_model_t, take_node, take_element
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: element_kinds
   use flexact_keywords, only: keywords, role_property
   use flexact_kinds, only: wp
   use flexact_operands, only: operands_t, operands_of
   use flexact_properties, only: make_properties
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_properties

   !> Where each thing was stated last.
   type :: places_t
      type(span_t), allocatable :: stiffness(:), mass(:), node_mass(:)
   end type places_t

contains

   subroutine read_properties(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(places_t) :: stated
      integer :: i

      if (.not. any(statements%role == role_property)) return
      associate (elements => deck%model%elements, nodes => deck%model%nodes)
         allocate (deck%properties, source=make_properties(elements, nodes))
         allocate (stated%stiffness(elements), stated%mass(elements), stated%node_mass(nodes))
      end associate
      do i = 1, size(statements)
         if (statements(i)%role == role_property) call read_statement(statements(i), deck, stated)
      end do
   end subroutine read_properties

   subroutine read_statement(statement, deck, stated)
      type(statement_t), intent(in) :: statement
      type(deck_model_t), intent(inout) :: deck
      type(places_t), intent(inout) :: stated
      type(operands_t) :: operands
      integer :: owner, of_warping

      operands = operands_of(deck%text, deck%diagnostics, statement)
      associate (name => keywords(statement%what)%name, properties => deck%properties)
         if (name == 'XM' .or. name == 'MASS') then
            call take_node(deck, operands, owner)
            if (owner > 0) call take_numbers(operands, 0, properties%node_mass(:, owner), stated%node_mass(owner))
            return
         end if
         call take_element(deck, operands, owner)
         if (owner == 0) return
         of_warping = merge(1, 0, element_kinds(deck%model%element_kind(owner))%keyword == 'BEAM')
         if (name == 'ESTIFF') then
            call take_numbers(operands, of_warping, properties%stiffness(:, owner), stated%stiffness(owner))
         else
            call take_numbers(operands, of_warping, properties%mass(:, owner), stated%mass(owner))
         end if
      end associate
   end subroutine read_statement

   !> Take the numbers behind the element or the node, at least one; those that are
   !> more than there can be are left out. One of warping, behind the others, is not used.
   subroutine take_numbers(operands, of_warping, numbers, stated)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: of_warping
      real(wp), intent(inout) :: numbers(:)
      type(span_t), intent(inout) :: stated
      type(operands_t) :: ahead
      type(span_t) :: owner, surplus
      real(wp) :: value, taken(size(numbers))
      integer :: count

      owner = operands%word
      count = 0
      do
         call operands%real_number('number', value)
         if (.not. operands%fine) return
         count = count + 1
         if (count <= size(taken)) taken(count) = value
         if (count == size(taken) + 1) surplus = operands%word
         ahead = operands
         if (.not. ahead%another()) exit
      end do
      if (count > size(taken) .and. count /= size(taken) + of_warping) &
         call operands%diagnostics%warning('surplus-operand', surplus, 'there are more numbers than can be meant; '// &
                                           'they are left out', 'from here on', &
                                           'ESTIFF takes up to 6 numbers, EM up to 5, XM up to 6')
      if (stated%first > 0) &
         call operands%diagnostics%warning('repeated-value', owner, 'the same is given already', 'this one counts', &
                                           'remove one of the two statements', stated)
      stated = owner
      count = min(count, size(taken))
      ! Of an earlier statement nothing stays.
      numbers = ieee_value(1.0_wp, ieee_quiet_nan)
      numbers(:count) = taken(:count)
   end subroutine take_numbers
end module flexact_deck_properties
