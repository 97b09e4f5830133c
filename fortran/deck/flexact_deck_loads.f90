! SPDX-License-Identifier: BSD-3-Clause
!> The statements that give loads: XF (FORCE), DELXF and GRAVITY. Of two for one node
!> the last counts.
module flexact_deck_loads
   use flexact_deck_model, only: deck_model_t, take_node
   use flexact_deck_numbers, only: meaning_t, take_numbers
   use flexact_diagnostics, only: span_t
   use flexact_keywords, only: keywords, role_load
   use flexact_kinds, only: wp
   use flexact_loads, only: make_loads
   use flexact_operands, only: operands_t, operands_of
   use flexact_slots, only: axes, has_axis, node_planar_position, node_angle, node_position, node_orientation
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_loads

   !> Where each thing was stated last.
   type :: places_t
      type(span_t), allocatable :: force(:), increment(:)
      type(span_t) :: gravity
   end type places_t

contains

   subroutine read_loads(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(places_t) :: stated
      type(operands_t) :: operands
      integer :: i, node

      if (.not. any(statements%role == role_load)) return
      allocate (deck%loads, source=make_loads(deck%model%nodes))
      allocate (stated%force(deck%model%nodes), stated%increment(deck%model%nodes))
      do i = 1, size(statements)
         if (statements(i)%role /= role_load) cycle
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         operands%length_power = deck%length_power
         if (keywords(statements(i)%what)%name == 'GRAVITY') then
            call take(operands, gravity_of(deck), deck%loads%gravity, stated%gravity)
            cycle
         end if
         call take_node(deck, operands, node)
         if (node == 0) cycle
         if (keywords(statements(i)%what)%name == 'DELXF') then
            call take(operands, load_of(deck%model%node_kind(node)), deck%loads%increment(:, node), stated%increment(node))
         else
            call take(operands, load_of(deck%model%node_kind(node)), deck%loads%force(:, node), stated%force(node))
         end if
      end do
   end subroutine read_loads

   !> Take the numbers of a statement that is fine; a single one of an angle is about z.
   subroutine take(operands, meaning, load, stated)
      type(operands_t), intent(inout) :: operands
      type(meaning_t), intent(in) :: meaning
      real(wp), intent(inout) :: load(axes)
      type(span_t), intent(inout) :: stated
      real(wp) :: value(6)
      integer :: count

      call take_numbers(operands, meaning, value, count, stated)
      if (.not. operands%fine) return
      load = 0.0_wp
      if (meaning%numbers == 1) then
         load(axes) = value(1)
      else if (count > 0) then
         load(:meaning%numbers) = value(:meaning%numbers)
      end if
   end subroutine take

   !> What a node of this kind can bear. More than three numbers at an orientation are
   !> hardly moments, so that none of them is used.
   function load_of(kind) result(meaning)
      integer, intent(in) :: kind
      type(meaning_t) :: meaning
      integer :: axis

      meaning%what = 'a load'
      meaning%numbers = count([(has_axis(kind, axis), axis=1, axes)])
      select case (kind)
      case (node_planar_position)
         meaning%form = 'a node of planar elements takes Fx Fy'
      case (node_position)
         meaning%form = 'a position node takes Fx Fy Fz'
      case (node_angle)
         meaning%lengths = 1
         meaning%form = 'an orientation node of planar elements takes one moment'
      case (node_orientation)
         meaning%lengths = 1
         meaning%form = 'an orientation node takes the moments Mx My Mz'
         meaning%most = axes
      end select
   end function load_of

   function gravity_of(deck) result(meaning)
      type(deck_model_t), intent(in) :: deck
      type(meaning_t) :: meaning

      meaning%what = 'gravity'
      meaning%lengths = 1
      meaning%least = 2
      meaning%numbers = merge(3, 2, any(deck%model%node_kind == node_position .or. deck%model%node_kind == node_orientation))
      meaning%form = 'GRAVITY takes gx gy gz, in a plane gx gy'
   end function gravity_of
end module flexact_deck_loads
