! SPDX-License-Identifier: BSD-3-Clause
!> Between flat arrays of C types and the core's types; what bindings.f90 needs.
module flexact_exchange
   use, intrinsic :: iso_c_binding, only: c_signed_char
   use flexact_sparse_basis, only: sparse_basis_t
   use flexact_deck, only: locate
   use flexact_diagnostics, only: span_t, diagnostics_t, most_shown
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: class_count_t
   implicit none
   private
   public :: to_text, from_text, counts_of, unpack_model, give_diagnostics, give_basis

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

   !> A model without a deck from its packed arrays. nodes (5, nn): number, kind,
   !> class of each axis. places (4, nn): value. elements (12, ne): number, kind,
   !> node in each slot, class of each deformation. vectors (3, ne).
   pure subroutine unpack_model(nodes, places, elements, vectors, model)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :)
      type(model_t), intent(out) :: model

      model%nodes = size(nodes, 2)
      model%elements = size(elements, 2)
      model%node_number = nodes(1, :)
      model%node_kind = nodes(2, :)
      model%coordinate_class = nodes(3:5, :)
      model%node_value = places
      model%element_number = elements(1, :)
      model%element_kind = elements(2, :)
      model%element_node = elements(3:6, :)
      model%deformation_class = elements(7:12, :)
      model%element_vector = vectors
      allocate (model%element_origin(model%elements), source=0)
      allocate (model%node_origin(model%nodes), source=0)
   end subroutine unpack_model

   !> Append the vectors of a basis, whose places lie behind `before` others; only
   !> as many as fit. start(k): where vector k begins, from 0.
   pure subroutine give_basis(basis, before, start, place, value, vectors, given)
      type(sparse_basis_t), intent(in) :: basis
      integer, intent(in) :: before
      integer, intent(inout) :: start(:), place(:), vectors
      real(wp), intent(inout) :: value(:)
      integer, intent(out) :: given
      integer :: first, entries

      first = start(vectors + 1)
      given = min(basis%vectors, size(start) - 1 - vectors)
      do while (first + basis%start(given + 1) - 1 > size(place))
         given = given - 1
      end do
      entries = basis%start(given + 1) - 1
      start(vectors + 1:vectors + given + 1) = first + basis%start(:given + 1) - 1
      place(first + 1:first + entries) = basis%place(:entries) - 1 + before
      value(first + 1:first + entries) = basis%value(:entries)
      vectors = vectors + given
   end subroutine give_basis

   !> Total, fixed, dependent, independent.
   pure function counts_of(counts) result(numbers)
      type(class_count_t), intent(in) :: counts
      integer :: numbers(4)
      numbers = [counts%total, counts%fixed, counts%dependent, counts%independent]
   end function counts_of

   !> Diagnostics as arrays. count: errors, warnings, notes, shown. number:
   !> severity, line, first and last column, the same three of the other place,
   !> 0. words: code, message, label, help.
   subroutine give_diagnostics(text, diagnostics, count, number, words)
      character(len=*), intent(in) :: text
      type(diagnostics_t), intent(in) :: diagnostics
      integer, intent(out) :: count(:), number(:, :)
      integer(c_signed_char), intent(out) :: words(:, :, :)
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
