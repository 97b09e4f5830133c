! SPDX-License-Identifier: BSD-3-Clause
!> What a deck holds as flat arrays.
module flexact_deck_exchange
   use flexact_deck_model, only: deck_model_t
   use flexact_kinds, only: wp
   use flexact_slots, only: node_position, node_orientation
   implicit none
   private
   public :: give_sizes, give_model, give_appearance, give_properties, give_loads

contains

   !> How many nodes and elements a deck has, and 1 or 0 for the rest: whether the model is planar,
   !> has more digits than its numbers hold, and which of the groups below it has.
   pure subroutine give_sizes(deck, nodes, elements, is_planar, has_long_numbers, has_appearance, has_properties, has_loads)
      type(deck_model_t), intent(in) :: deck
      integer, intent(out) :: nodes, elements, is_planar, has_long_numbers, has_appearance, has_properties, has_loads

      nodes = deck%model%nodes
      elements = deck%model%elements
      is_planar = merge(0, 1, any(deck%model%node_kind == node_position .or. deck%model%node_kind == node_orientation))
      has_long_numbers = merge(1, 0, deck%has_long_numbers)
      has_appearance = merge(1, 0, allocated(deck%appearance))
      has_properties = merge(1, 0, allocated(deck%properties))
      has_loads = merge(1, 0, allocated(deck%loads))
   end subroutine give_sizes

   !> A model as flexact_exchange packs it, and where in the text the names stand; there is room.
   pure subroutine give_model(deck, nodes, places, elements, vectors, element_name, node_name)
      type(deck_model_t), intent(in) :: deck
      integer, intent(inout) :: nodes(:, :), elements(:, :), element_name(:, :), node_name(:, :)
      real(wp), intent(inout) :: places(:, :), vectors(:, :)

      associate (model => deck%model, nn => deck%model%nodes, ne => deck%model%elements)
         nodes(1, :nn) = model%node_number
         nodes(2, :nn) = model%node_kind
         nodes(3:5, :nn) = model%coordinate_class
         places(:, :nn) = model%node_value
         elements(1, :ne) = model%element_number
         elements(2, :ne) = model%element_kind
         elements(3:6, :ne) = model%element_node
         elements(7:12, :ne) = model%deformation_class
         vectors(:, :ne) = model%element_vector
         element_name(1, :ne) = deck%element_names%first
         element_name(2, :ne) = deck%element_names%last
         node_name(1, :nn) = deck%node_names%first
         node_name(2, :nn) = deck%node_names%last
      end associate
   end subroutine give_model

   !> How elements are drawn, if the deck says it.
   pure subroutine give_appearance(deck, cross_section, drawn, dimensions, colour, edge_colour, opacity)
      type(deck_model_t), intent(in) :: deck
      integer, intent(inout) :: cross_section(:), drawn(:)
      real(wp), intent(inout) :: dimensions(:, :), colour(:, :), edge_colour(:, :), opacity(:)

      if (.not. allocated(deck%appearance)) return
      associate (ne => deck%model%elements)
         cross_section(:ne) = deck%appearance%cross_section
         drawn(:ne) = merge(1, 0, deck%appearance%drawn)
         dimensions(:, :ne) = deck%appearance%dimensions
         colour(:, :ne) = deck%appearance%colour
         edge_colour(:, :ne) = deck%appearance%edge_colour
         opacity(:ne) = deck%appearance%opacity
      end associate
   end subroutine give_appearance

   !> What parts are made of, if the deck gives it.
   pure subroutine give_properties(deck, stiffness, mass, strength, expansion, fillet, node_mass)
      type(deck_model_t), intent(in) :: deck
      real(wp), intent(inout) :: stiffness(:, :), mass(:, :), strength(:, :), expansion(:, :), fillet(:, :), node_mass(:, :)

      if (.not. allocated(deck%properties)) return
      stiffness(:, :deck%model%elements) = deck%properties%stiffness
      mass(:, :deck%model%elements) = deck%properties%mass
      strength(:, :deck%model%elements) = deck%properties%strength
      expansion(:, :deck%model%elements) = deck%properties%expansion
      fillet(:, :deck%model%elements) = deck%properties%fillet
      node_mass(:, :deck%model%nodes) = deck%properties%node_mass
   end subroutine give_properties

   !> Loads, if the deck gives them.
   pure subroutine give_loads(deck, force, increment, gravity)
      type(deck_model_t), intent(in) :: deck
      real(wp), intent(inout) :: force(:, :), increment(:, :), gravity(:)

      if (.not. allocated(deck%loads)) return
      force(:, :deck%model%nodes) = deck%loads%force
      increment(:, :deck%model%nodes) = deck%loads%increment
      gravity = deck%loads%gravity
   end subroutine give_loads
end module flexact_deck_exchange
