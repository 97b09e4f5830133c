!> Between flat arrays of C types and the core's types; what bindings.f90 needs.
module flexact_exchange
   use, intrinsic :: iso_c_binding, only: c_signed_char
   use flexact_basis, only: basis_t
   use flexact_deck, only: locate
   use flexact_diagnostics, only: span_t, diagnostics_t, most_shown, text_length
   use flexact_kinds, only: wp
   use flexact_look, only: look_t
   use flexact_model, only: model_t, slots, most_deformations
   implicit none
   private
   public :: to_text, from_text, make_model, give_diagnostics, give_basis, give_look

contains

   subroutine to_text(bytes, text)
      integer(c_signed_char), intent(in) :: bytes(:)
      character(len=:), allocatable, intent(out) :: text
      integer :: i

      allocate (character(len=size(bytes)) :: text)
      do i = 1, size(bytes)
         text(i:i) = transfer(bytes(i), 'a')
      end do
   end subroutine to_text

   !> The characters as bytes, blanks behind them.
   pure subroutine from_text(text, bytes)
      character(len=*), intent(in) :: text
      integer(c_signed_char), intent(out) :: bytes(:)
      integer :: i

      bytes = int(iachar(' '), c_signed_char)
      do i = 1, min(len_trim(text), size(bytes))
         bytes(i) = transfer(text(i:i), bytes(i))
      end do
   end subroutine from_text

   !> A model without a deck from its arrays.
   subroutine make_model(node_number, node_kind, node_value, coordinate_class, &
                         element_number, element_kind, element_node, element_vector, deformation_class, model)
      integer, intent(in) :: node_number(:), node_kind(:), coordinate_class(:, :)
      integer, intent(in) :: element_number(:), element_kind(:), element_node(:, :), deformation_class(:, :)
      real(wp), intent(in) :: node_value(:, :), element_vector(:, :)
      type(model_t), intent(out) :: model

      model%nodes = size(node_number)
      model%elements = size(element_number)
      allocate (model%node_number(model%nodes), source=node_number)
      allocate (model%node_kind(model%nodes), source=node_kind)
      allocate (model%node_value(4, model%nodes), source=node_value)
      allocate (model%coordinate_class(3, model%nodes), source=coordinate_class)
      allocate (model%element_number(model%elements), source=element_number)
      allocate (model%element_kind(model%elements), source=element_kind)
      allocate (model%element_node(slots, model%elements), source=element_node)
      allocate (model%element_vector(3, model%elements), source=element_vector)
      allocate (model%deformation_class(most_deformations, model%elements), source=deformation_class)
      allocate (model%element_origin(model%elements), source=0)
   end subroutine make_model

   !> A basis as arrays; only as many vectors as fit.
   pure subroutine give_basis(basis, start, place, value, given)
      type(basis_t), intent(in) :: basis
      integer, intent(inout) :: start(:), place(:)
      real(wp), intent(inout) :: value(:)
      integer, intent(out) :: given
      integer :: entries

      given = min(basis%vectors, size(start) - 1)
      do while (basis%start(given + 1) - 1 > size(place))
         given = given - 1
      end do
      entries = basis%start(given + 1) - 1
      start(:given + 1) = basis%start(:given + 1) - 1
      place(:entries) = basis%place(:entries) - 1
      value(:entries) = basis%value(:entries)
   end subroutine give_basis

   !> How elements are drawn, as arrays. choice: kind of cross-section, 1 where
   !> drawn. value: dimensions, colour, colour of edges, opacity.
   pure subroutine give_look(look, choice, value)
      type(look_t), intent(in) :: look
      integer, intent(inout) :: choice(:, :)
      real(wp), intent(inout) :: value(:, :)

      choice(1, :) = look%cross_section
      choice(2, :) = merge(1, 0, look%drawn)
      value(1:2, :) = look%dimensions
      value(3:5, :) = look%colour
      value(6:8, :) = look%edge_colour
      value(9, :) = look%opacity
   end subroutine give_look

   !> Diagnostics as arrays. count: errors, warnings, notes, shown. number:
   !> severity, line, first and last column, the same three of the other place,
   !> 0. words: code, message, label, help.
   subroutine give_diagnostics(text, diagnostics, count, number, words)
      character(len=*), intent(in) :: text
      type(diagnostics_t), intent(in) :: diagnostics
      integer, intent(out) :: count(4), number(8, most_shown)
      integer(c_signed_char), intent(out) :: words(text_length, 4, most_shown)
      integer :: i, shown

      shown = min(diagnostics%kept, most_shown)
      count = [diagnostics%count, shown]
      number = 0
      words(:, :, shown + 1:) = 0_c_signed_char
      do i = 1, shown
         associate (item => diagnostics%item(i))
            number(1, i) = item%severity
            call give_place(text, item%place, number(2:4, i))
            call give_place(text, item%other, number(5:7, i))
            call from_text(item%code, words(:, 1, i))
            call from_text(item%message, words(:, 2, i))
            call from_text(item%label, words(:, 3, i))
            call from_text(item%help, words(:, 4, i))
         end associate
      end do
   end subroutine give_diagnostics

   subroutine give_place(text, place, number)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: place
      integer, intent(out) :: number(3)

      number = 0
      if (place%first == 0) return
      call locate(text, place%first, number(1), number(2))
      number(3) = number(2) + max(0, place%last - place%first)
   end subroutine give_place
end module flexact_exchange
