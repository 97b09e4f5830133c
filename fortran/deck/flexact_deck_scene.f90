!> What the statements about nodes and elements share: the model in the making,
!> the deck's numbers, and how a number that is not there is reported.
module flexact_deck_scene
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_look, only: look_t
   use flexact_model, only: model_t
   use flexact_numbering, only: numbering_t
   use flexact_operands, only: operands_t
   implicit none
   private
   public :: scene_t, take_node, take_element

   type :: scene_t
      type(model_t) :: model
      type(numbering_t) :: nodes
      type(numbering_t) :: element_numbers
      !> The element of each number in element_numbers.
      integer, allocatable :: element_of(:)
      !> Name of each element, as a place in the text.
      type(span_t), allocatable :: element_names(:)
      !> Numbers in element statements that could not be read: nodes or elements
      !> perhaps, so that nobody is told that they do not exist.
      type(numbering_t) :: excused
      !> How the elements are to be drawn, where the deck says something about it.
      type(look_t), allocatable :: look
   end type scene_t

contains

   !> Take a node number; the index is 0 where there is no such node, which
   !> has then been reported.
   subroutine take_node(text, scene, operands, node, diagnostics)
      character(len=*), intent(in) :: text
      type(scene_t), intent(in) :: scene
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: node
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: number

      node = 0
      call operands%positive_integer(text, 'node number', number, diagnostics)
      if (number == 0) return
      node = scene%nodes%find(number)
      if (node > 0) return
      operands%fine = .false.
      if (scene%excused%find(number) > 0) return
      call diagnostics%error('no-such-node', operands%word, &
                             'there is no node '//text(operands%word%first:operands%word%last), &
                             'no element uses this node', &
                             'correct the number, or name the node in an element')
   end subroutine take_node

   !> Take an element number; as with nodes.
   subroutine take_element(text, scene, operands, element, diagnostics)
      character(len=*), intent(in) :: text
      type(scene_t), intent(in) :: scene
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: element
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: number, index

      element = 0
      call operands%positive_integer(text, 'element number', number, diagnostics)
      if (number == 0) return
      index = scene%element_numbers%find(number)
      if (index > 0) element = scene%element_of(index)
      if (element > 0) return
      operands%fine = .false.
      if (scene%excused%find(number) > 0) return
      call diagnostics%error('no-such-element', operands%word, &
                             'there is no element '//text(operands%word%first:operands%word%last), &
                             'no statement makes this element', &
                             'correct the number, or add the element')
   end subroutine take_element
end module flexact_deck_scene
