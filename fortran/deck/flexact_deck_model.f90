! SPDX-License-Identifier: BSD-3-Clause
!> What the statements about nodes and elements share: the model in the making,
!> the deck's numbers, and how a number that is not there is reported.
module flexact_deck_model
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_appearance, only: appearance_t
   use flexact_loads, only: loads_t
   use flexact_model, only: model_t
   use flexact_numbering, only: numbering_t
   use flexact_operands, only: operands_t
   use flexact_properties, only: properties_t
   implicit none
   private
   public :: deck_model_t, take_node, take_element

   type :: deck_model_t
      !> The deck, and where what is wrong with it is kept; while it is read.
      character(len=:), pointer :: text => null()
      type(diagnostics_t), pointer :: diagnostics => null()
      type(model_t) :: model
      type(numbering_t) :: nodes
      type(numbering_t) :: element_numbers
      !> The element of each number in element_numbers.
      integer, allocatable :: element_of(:)
      !> Name of each element, as a place in the text.
      type(span_t), allocatable :: element_names(:)
      !> Name of each node, likewise: the comment of its X statement.
      type(span_t), allocatable :: node_names(:)
      !> Numbers in element statements that could not be read: nodes or elements
      !> perhaps, so that it is not reported that they do not exist.
      type(numbering_t) :: excused
      !> Nodes of the deck that the model does not have: of warping, and points of the ground.
      type(numbering_t) :: left_out
      !> Whether the geometry was typed with more digits than its numbers hold.
      logical :: has_long_numbers = .false.
      !> Numbers of the warping nodes at p and q of each element, 0 where there is none.
      integer, allocatable :: warping_node(:, :)
      type(numbering_t) :: warping_nodes
      !> Class of the warping of each of warping_nodes, (1, nodes).
      integer, allocatable :: warping_class(:, :)
      !> Whether each element is stated as a beam with warping.
      logical, allocatable :: has_warping(:)
      !> Power of ten of the unit of its lengths in metres.
      integer :: length_power = 0
      !> How the elements are to be drawn, where the deck says something about it.
      type(appearance_t), allocatable :: appearance
      !> Stiffness and mass, where the deck says something about them.
      type(properties_t), allocatable :: properties
      !> Loads, likewise.
      type(loads_t), allocatable :: loads
   end type deck_model_t

contains

   !> Take a node number; the index is 0 where there is no such node, which
   !> has then been reported.
   subroutine take_node(deck, operands, node)
      type(deck_model_t), intent(in) :: deck
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: node
      integer :: number

      node = 0
      call operands%positive_integer('node number', number)
      if (number == 0) return
      node = deck%nodes%find(number)
      if (node > 0) return
      operands%fine = .false.
      if (deck%excused%find(number) > 0 .or. deck%left_out%find(number) > 0) return
      call operands%diagnostics%error('no-such-node', operands%word, &
                                      'there is no node '//operands%spelling(), &
                                      'no element uses this node', &
                                      'correct the number, or name the node in an element')
   end subroutine take_node

   !> Take an element number; as with nodes.
   subroutine take_element(deck, operands, element)
      type(deck_model_t), intent(in) :: deck
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: element
      integer :: number, index

      element = 0
      call operands%positive_integer('element number', number)
      if (number == 0) return
      index = deck%element_numbers%find(number)
      if (index > 0) element = deck%element_of(index)
      if (element > 0) return
      operands%fine = .false.
      if (deck%excused%find(number) > 0) return
      call operands%diagnostics%error('no-such-element', operands%word, &
                                      'there is no element '//operands%spelling(), &
                                      'no statement makes this element', &
                                      'correct the number, or add the element')
   end subroutine take_element
end module flexact_deck_model
