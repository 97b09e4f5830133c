! SPDX-License-Identifier: BSD-3-Clause
!> Names that more than one part has, or more than one point.
module flexact_repeated_names
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_equal_texts, only: find_equal_texts
   use flexact_labels, only: names_t, part_name, quoted_name, digits_of
   use flexact_model, only: model_t
   use flexact_slots, only: slots, is_position
   use flexact_sorting, only: by_number, root_of, join
   implicit none
   private
   public :: check_repeated_names

contains

   !> Elements of one name that hang together by their nodes are one part. In a deck
   !> names are comments, which are often meant as such: there it is a note.
   subroutine check_repeated_names(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t), allocatable :: name(:)
      integer, allocatable :: group(:)
      integer :: groups, i, part(model%elements)

      if (any(names%element%first > 0)) then
         allocate (name(model%elements))
         do i = 1, model%elements
            name(i) = part_name(names, i)
            if (is_of_beams(names%text, name(i))) name(i) = span_t()
         end do
         allocate (group(model%elements))
         call find_equal_texts(names%text, name, group, groups)
         if (groups < count(group > 0)) then
            call find_parts(model, group, groups, part)
            call check(model, names, name, group, groups, part, 'parts that do not hang together are called', diagnostics)
         end if
      end if
      if (any(names%node%first > 0)) then
         name = names%node
         do i = 1, model%nodes
            if (.not. is_position(model%node_kind(i)) .or. is_intermediate(names%text, name(i))) name(i) = span_t()
         end do
         group = [(0, i=1, model%nodes)]
         call find_equal_texts(names%text, name, group, groups)
         if (groups < count(group > 0)) &
            call check(model, names, name, group, groups, [(i, i=1, model%nodes)], 'points are called', diagnostics)
      end if
   end subroutine check_repeated_names

   !> Whether a name is that which SPACAR Light gives to every inner node.
   pure logical function is_intermediate(text, name)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: name

      is_intermediate = .false.
      if (name%first > 0) is_intermediate = text(name%first:name%last) == 'intermediate node'
   end function is_intermediate

   !> Whether a name is one that SPACAR Light gives to beams of every element: "beam", "beam 2".
   pure logical function is_of_beams(text, name)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: name

      is_of_beams = .false.
      if (name%first < 1 .or. name%last < name%first + 3) return
      if (text(name%first:name%first + 3) /= 'beam') return
      is_of_beams = verify(text(name%first + 4:name%last), ' 0123456789') == 0
   end function is_of_beams

   !> The part of each element, as one of its elements.
   subroutine find_parts(model, group, groups, part)
      type(model_t), intent(in) :: model
      integer, intent(in) :: group(:), groups
      integer, intent(out) :: part(:)
      !> The group of names that a node was met with last, and by which element.
      integer :: met(model%nodes), by(model%nodes)
      integer :: parent(model%elements), i, slot, node

      parent = [(i, i=1, model%elements)]
      met = 0
      associate (order => by_number(group, groups))
         do i = 1, size(order)
            if (group(order(i)) == 0) cycle
            do slot = 1, slots
               node = model%element_node(slot, order(i))
               if (node == 0) cycle
               if (met(node) == group(order(i))) call join(parent, by(node), order(i))
               met(node) = group(order(i))
               by(node) = order(i)
            end do
         end do
      end associate
      do i = 1, model%elements
         call root_of(parent, i, part(i))
      end do
   end subroutine find_parts

   !> Report each name that more than one thing has; a thing is known by its first member.
   subroutine check(model, names, name, group, groups, thing, what, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(span_t), intent(in) :: name(:)
      integer, intent(in) :: group(:), groups, thing(:)
      character(len=*), intent(in) :: what
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: first(groups), second(groups), count(groups), i

      count = 0
      do i = 1, size(name)
         if (group(i) == 0 .or. thing(i) /= i) cycle
         count(group(i)) = count(group(i)) + 1
         if (count(group(i)) == 1) first(group(i)) = i
         if (count(group(i)) == 2) second(group(i)) = i
      end do
      do i = 1, groups
         if (count(i) < 2) cycle
         call report(digits_of(count(i))//' '//what//' '//quoted_name(names%text(name(first(i))%first:name(first(i))%last)), &
                     name(first(i)), name(second(i)), allocated(model%element_origin) .and. any(model%element_origin > 0), &
                     diagnostics)
      end do
   end subroutine check

   subroutine report(message, first, second, is_deck, diagnostics)
      character(len=*), intent(in) :: message
      type(span_t), intent(in) :: first, second
      logical, intent(in) :: is_deck
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=*), parameter :: help = 'give each a name of its own'

      if (is_deck) then
         call diagnostics%note('repeated-name', second, message, 'the same name', help, first)
      else
         call diagnostics%warning('repeated-name', span_t(), message, '', help)
      end if
   end subroutine report
end module flexact_repeated_names
