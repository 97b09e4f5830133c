! SPDX-License-Identifier: BSD-3-Clause
!> What a deck holds as flat arrays.
module flexact_deck_exchange
   use flexact_appearance, only: appearance_t
   use flexact_deck_model, only: deck_model_t
   use flexact_kinds, only: wp
   use flexact_loads, only: loads_t
   use flexact_model, only: model_t
   use flexact_properties, only: properties_t
   use flexact_slots, only: node_position, node_orientation
   implicit none
   private
   public :: give_deck

contains

   !> What a deck holds, where there is room for it; its sizes in any case. words: names of the
   !> elements, names of the nodes, and what give_appearance chooses. value: as give_appearance,
   !> give_properties and give_loads say, where sizes says that they are filled. sizes: nodes,
   !> elements, 1 for a planar model, one that stays, 1 where the deck says how elements are
   !> drawn, where it has more digits than its numbers hold, where it gives stiffness or mass,
   !> and where it gives loads.
   pure subroutine give_deck(deck, nodes, places, elements, vectors, words, value, sizes)
      type(deck_model_t), intent(in) :: deck
      integer, intent(inout) :: nodes(:, :), elements(:, :), words(:, :), sizes(:)
      real(wp), intent(inout) :: places(:, :), vectors(:, :), value(:, :)

      associate (model => deck%model, nn => deck%model%nodes, ne => deck%model%elements)
         sizes(:2) = [nn, ne]
         sizes(3) = merge(0, 1, any(model%node_kind == node_position .or. model%node_kind == node_orientation))
         sizes(5) = merge(1, 0, allocated(deck%appearance))
         sizes(6) = merge(1, 0, deck%has_long_numbers)
         sizes(7) = merge(1, 0, allocated(deck%properties))
         sizes(8) = merge(1, 0, allocated(deck%loads))
         if (nn > size(nodes, 2) .or. ne > size(elements, 2)) return
         if (any(sizes([5, 7, 8]) == 1) .and. 2*ne + nn + 1 > size(value, 2)) return
         call pack_model(model, nodes, places, elements, vectors)
         words(1, :ne) = deck%element_names%first
         words(2, :ne) = deck%element_names%last
         words(1, ne + 1:ne + nn) = deck%node_names%first
         words(2, ne + 1:ne + nn) = deck%node_names%last
         if (allocated(deck%appearance)) &
            call give_appearance(deck%appearance, words(:, ne + nn + 1:ne + nn + ne), value(:, :ne))
         if (allocated(deck%properties)) call give_properties(deck%properties, value(:, ne + 1:))
         if (allocated(deck%loads)) call give_loads(deck%loads, value(7:, 2*ne + 1:))
      end associate
   end subroutine give_deck

   !> A model in packed arrays; there is room for it.
   pure subroutine pack_model(model, nodes, places, elements, vectors)
      type(model_t), intent(in) :: model
      integer, intent(inout) :: nodes(:, :), elements(:, :)
      real(wp), intent(inout) :: places(:, :), vectors(:, :)

      associate (nn => model%nodes, ne => model%elements)
         nodes(1, :nn) = model%node_number
         nodes(2, :nn) = model%node_kind
         nodes(3:5, :nn) = model%coordinate_class
         places(:, :nn) = model%node_value
         elements(1, :ne) = model%element_number
         elements(2, :ne) = model%element_kind
         elements(3:6, :ne) = model%element_node
         elements(7:12, :ne) = model%deformation_class
         vectors(:, :ne) = model%element_vector
      end associate
   end subroutine pack_model

   !> How elements are drawn, as arrays. choice: kind of cross-section, 1 where
   !> drawn. value: dimensions, colour, colour of edges, opacity.
   pure subroutine give_appearance(appearance, choice, value)
      type(appearance_t), intent(in) :: appearance
      integer, intent(inout) :: choice(:, :)
      real(wp), intent(inout) :: value(:, :)

      choice(1, :) = appearance%cross_section
      choice(2, :) = merge(1, 0, appearance%drawn)
      value(1:2, :) = appearance%dimensions
      value(3:5, :) = appearance%colour
      value(6:8, :) = appearance%edge_colour
      value(9, :) = appearance%opacity
   end subroutine give_appearance

   !> Stiffness and mass: 6 and 5 numbers a column, of the elements; then 6 numbers a
   !> column, of the nodes.
   pure subroutine give_properties(properties, value)
      type(properties_t), intent(in) :: properties
      real(wp), intent(inout) :: value(:, :)

      associate (ne => size(properties%mass, 2), nn => size(properties%node_mass, 2))
         value(1:6, :ne) = properties%stiffness
         value(7:11, :ne) = properties%mass
         value(1:6, ne + 1:ne + nn) = properties%node_mass
      end associate
   end subroutine give_properties

   !> Loads, 3 and 3 numbers a column, of the nodes; then gravity.
   pure subroutine give_loads(loads, value)
      type(loads_t), intent(in) :: loads
      real(wp), intent(inout) :: value(:, :)

      associate (nn => size(loads%force, 2))
         value(1:3, :nn) = loads%force
         value(4:6, :nn) = loads%increment
         value(1:3, nn + 1) = loads%gravity
      end associate
   end subroutine give_loads
end module flexact_deck_exchange
