! SPDX-License-Identifier: BSD-3-Clause
!> Points that a deck places and fixes, and that no element uses: programs that write
!> decks leave such points of the ground. They change nothing, and are left out.
module flexact_ground_points
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t
   use flexact_keywords, only: keywords, role_value, role_coordinate
   use flexact_numbering, only: numbering_t, make_numbering
   use flexact_numbers, only: leading_integer
   use flexact_operands, only: operands_t, operands_of
   use flexact_slots, only: node_position
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: excuse_ground_points

contains

   !> Excuse such points with a warning: what is said of them is no error then.
   subroutine excuse_ground_points(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(numbering_t) :: placed
      integer, allocatable :: number(:), row(:)
      type(span_t), allocatable :: place(:)
      logical, allocatable :: is_fixed(:, :)
      type(operands_t) :: operands
      integer :: i, at

      call find_placed(statements, deck, number, row)
      if (size(number) == 0) return
      placed = make_numbering(number)
      allocate (is_fixed(3, size(placed%number)), source=.false.)
      allocate (place(size(placed%number)))
      do i = size(row), 1, -1
         operands = operands_of(deck%text, deck%diagnostics, statements(row(i)))
         if (operands%another()) place(placed%find(number(i))) = operands%word
      end do
      if (.not. any(deck%model%node_kind == node_position)) is_fixed(3, :) = .true.
      do i = 1, size(statements)
         if (statements(i)%role /= role_coordinate) cycle
         if (keywords(statements(i)%what)%name /= 'FIX') cycle
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         if (.not. operands%another()) cycle
         at = placed%find(leading_integer(operands%spelling()))
         if (at > 0) call fix(operands, is_fixed(:, at))
      end do
      deck%left_out = make_numbering([deck%left_out%number, pack(placed%number, all(is_fixed, dim=1))])
      do i = 1, size(place)
         if (all(is_fixed(:, i))) &
            call deck%diagnostics%warning('unused-node', place(i), 'a fixed point that no element uses is left out', &
                                          'nothing is joined to it', 'remove it, or join an element to it')
      end do
   end subroutine excuse_ground_points

   !> The numbers of X statements that are no nodes, and the statements.
   subroutine find_placed(statements, deck, number, row)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(in) :: deck
      integer, allocatable, intent(out) :: number(:), row(:)
      integer :: found(size(statements)), i
      type(operands_t) :: operands

      found = 0
      do i = 1, size(statements)
         if (statements(i)%role /= role_value) cycle
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         if (operands%another()) found(i) = leading_integer(operands%spelling())
         if (found(i) == 0) cycle
         if (deck%nodes%find(found(i)) > 0 .or. deck%excused%find(found(i)) > 0 .or. &
             deck%left_out%find(found(i)) > 0) found(i) = 0
      end do
      number = pack(found, found > 0)
      row = pack([(i, i=1, size(statements))], found > 0)
   end subroutine find_placed

   !> Mark what a FIX statement fixes, all of it where it names no component.
   subroutine fix(operands, is_fixed)
      type(operands_t), intent(inout) :: operands
      logical, intent(inout) :: is_fixed(3)
      integer :: component

      if (.not. operands%another()) then
         is_fixed = .true.
         return
      end if
      do
         component = leading_integer(operands%spelling())
         if (component >= 1 .and. component <= 3) is_fixed(component) = .true.
         if (.not. operands%another()) exit
      end do
   end subroutine fix
end module flexact_ground_points
