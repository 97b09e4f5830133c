! SPDX-License-Identifier: BSD-3-Clause
!> What messages call the parts and points of a model: by their names, or by numbers
!> where they have none.
module flexact_labels
   use flexact_diagnostics, only: span_t
   use flexact_element_table, only: element_kinds
   use flexact_model, only: model_t
   implicit none
   private
   public :: names_t, element_label, digits_of, part_name, part_label, two_labels, node_label, quoted_name

   !> Names as spans of one text: a deck, or one that was made for them. first = 0: none.
   type :: names_t
      character(len=:), pointer :: text => null()
      type(span_t), allocatable :: element(:)
      type(span_t), allocatable :: node(:)
   end type names_t

   !> Bytes of a name in a message.
   integer, parameter :: longest = 48

contains

   !> Keyword and number.
   pure function element_name(model, k) result(name)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      character(len=:), allocatable :: name

      name = trim(element_kinds(model%element_kind(k))%keyword)
      ! A number that could not be read is zero.
      if (model%element_number(k) > 0) name = name//' '//digits_of(model%element_number(k))
   end function element_name

   !> Its name, or keyword and number where it has none.
   pure function element_label(model, names, k) result(label)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      character(len=:), allocatable :: label

      associate (name => names%element(k))
         if (name%first > 0) then
            label = quoted_name(names%text(name%first:name%last))
         else
            label = element_name(model, k)
         end if
      end associate
   end function element_label

   !> The name of the part that element k belongs to: its own without what counts the
   !> elements of a part, ", 3" or ", part 3 of 4"; of "element 2 beam 3", as SPACAR
   !> Light calls the beams of an element, "element 2".
   pure type(span_t) function part_name(names, k) result(span)
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      integer :: comma, beam

      span = names%element(k)
      if (span%first < 1) return
      beam = index(names%text(span%first:span%last), ' beam ')
      if (beam > len('element ')) then
         if (names%text(span%first:span%first + 7) == 'element ' .and. &
             is_whole(names%text(span%first + 8:span%first + beam - 1)) .and. &
             is_whole(names%text(span%first + beam + 5:span%last))) then
            span%last = span%first - 1 + len_trim(names%text(span%first:span%first + beam - 1))
            return
         end if
      end if
      comma = index(names%text(span%first:span%last), ',', back=.true.)
      if (comma < 2) return
      if (.not. counts(names%text(span%first + comma:span%last))) return
      span%last = span%first - 1 + len_trim(names%text(span%first:span%first + comma - 2))
   end function part_name

   !> Whether this is a whole number, or "part" of it "of" another.
   pure logical function counts(words)
      character(len=*), intent(in) :: words
      character(len=len(words)) :: trimmed
      integer :: middle

      counts = is_whole(words)
      trimmed = adjustl(words)
      if (counts .or. len_trim(trimmed) < len('part 1 of 1')) return
      middle = index(trimmed, ' of ')
      if (trimmed(:5) == 'part ' .and. middle > 5) counts = is_whole(trimmed(6:middle)) .and. is_whole(trimmed(middle + 4:))
   end function counts

   pure logical function is_whole(word)
      character(len=*), intent(in) :: word
      is_whole = len_trim(word) > 0 .and. verify(trim(adjustl(word)), '0123456789') == 0
   end function is_whole

   !> The part that element k belongs to.
   pure function part_label(model, names, k) result(label)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k
      character(len=:), allocatable :: label
      type(span_t) :: name

      name = part_name(names, k)
      if (name%first > 0) then
         label = quoted_name(names%text(name%first:name%last))
      else
         label = element_name(model, k)
      end if
   end function part_label

   !> Two of them; where they have one name, with their numbers.
   pure function two_labels(model, names, k, other, between) result(labels)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: k, other
      character(len=*), intent(in) :: between
      character(len=:), allocatable :: labels, one, two

      one = part_label(model, names, k)
      two = part_label(model, names, other)
      if (one == two) then
         one = one//' ('//element_name(model, k)//')'
         two = two//' ('//element_name(model, other)//')'
      end if
      labels = one//between//two
   end function two_labels

   !> A point by its position node.
   pure function node_label(model, names, node) result(label)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      integer, intent(in) :: node
      character(len=:), allocatable :: label

      associate (name => names%node(node))
         if (name%first > 0) then
            label = quoted_name(names%text(name%first:name%last))
         else
            label = 'node '//digits_of(model%node_number(node))
         end if
      end associate
   end function node_label

   !> A name in quotes, cut between two characters of UTF-8 where it is long.
   pure function quoted_name(name) result(quoted)
      character(len=*), intent(in) :: name
      character(len=:), allocatable :: quoted
      integer :: last

      if (len(name) <= longest) then
         quoted = "'"//name//"'"
         return
      end if
      last = longest - 3
      do while (last > 1 .and. iachar(name(last + 1:last + 1)) >= 128 .and. iachar(name(last + 1:last + 1)) < 192)
         last = last - 1
      end do
      quoted = "'"//name(:last)//"...'"
   end function quoted_name

   pure function digits_of(number) result(digits)
      integer, intent(in) :: number
      character(len=:), allocatable :: digits
      character(len=12) :: room

      write (room, '(i0)') number
      digits = trim(room)
   end function digits_of
end module flexact_labels
