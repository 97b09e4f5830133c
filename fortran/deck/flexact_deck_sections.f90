! SPDX-License-Identifier: BSD-3-Clause
!> Cross-sections in the picture block: CROSSTYPE, CROSSDIM, and the older
!> BEAMVIS and TRUSSVIS, which give both. How many sizes are wanted depends on
!> the kind, which may be stated later: sizes are given to the appearance at the end.
module flexact_deck_sections
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_element_table, only: element_kinds
   use flexact_keywords, only: edit_distance
   use flexact_kinds, only: wp
   use flexact_lexer, only: upper_case, listed
   use flexact_appearance, only: appearance_t, section_none, section_rect, section_circ, section_line, section_names, section_sizes
   use flexact_operands, only: operands_t
   implicit none
   private
   public :: sections_t, read_crosstype, read_crossdim, read_older_form, settle_sizes

   !> The numbers of one statement.
   type :: sizes_t
      real(wp) :: value(2) = 0.0_wp
      integer :: count = 0
      type(span_t) :: place
      !> What is wrong with it was reported.
      logical :: reported = .false.
   end type sizes_t

   type :: sections_t
      integer :: count = 0
      type(sizes_t), allocatable :: stated(:)
      !> Which of them is an element's, 0 for none.
      integer, allocatable :: of_element(:)
   end type sections_t

contains

   !> CROSSTYPE kind.
   subroutine read_crosstype(operands, elements, appearance)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: elements(:)
      type(appearance_t), intent(inout) :: appearance
      integer :: kind, i

      call operands%word_operand('kind of cross-section')
      if (.not. operands%fine) return
      call find_section(operands, kind)
      if (operands%fine) call operands%finish('CROSSTYPE kind')
      if (.not. operands%fine) return
      do i = 1, size(elements)
         appearance%cross_section(elements(i)) = kind
      end do
   end subroutine read_crosstype

   !> CROSSDIM size...: outer sizes first, then walls of a hollow section.
   subroutine read_crossdim(operands, elements, sections)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: elements(:)
      type(sections_t), intent(inout) :: sections
      type(operands_t) :: ahead
      type(sizes_t) :: sizes

      do
         call take_size(operands, sizes)
         if (.not. operands%fine) return
         ahead = operands
         if (.not. ahead%another()) exit
      end do
      call state(sizes, elements, sections)
   end subroutine read_crossdim

   !> BEAMVIS or TRUSSVIS [kind] [e...] size...: RECT where no kind is stated, and all
   !> elements with this keyword where none is named.
   subroutine read_older_form(operands, keyword, deck, sections)
      character(len=*), intent(in) :: keyword
      type(operands_t), intent(inout) :: operands
      type(deck_model_t), intent(inout) :: deck
      type(sections_t), intent(inout) :: sections
      type(operands_t) :: ahead
      type(sizes_t) :: sizes
      integer, allocatable :: elements(:)
      integer :: kind, words, i

      kind = section_rect
      ahead = operands
      if (ahead%another()) then
         if (is_letter(operands%text(ahead%word%first:ahead%word%first))) then
            operands = ahead
            call find_section(operands, kind)
            if (.not. operands%fine) return
         end if
      end if
      words = operands%left()
      call take_elements(operands, words - section_sizes(kind), deck, elements)
      do i = 1, section_sizes(kind)
         call take_size(operands, sizes)
      end do
      if (.not. operands%fine) return
      if (words <= section_sizes(kind)) elements = elements_called(keyword, deck)
      do i = 1, size(elements)
         deck%appearance%cross_section(elements(i)) = kind
      end do
      call state(sizes, elements, sections)
   end subroutine read_older_form

   !> Give every element the sizes that were stated for it last. Without a kind,
   !> one number is a diameter and more are a rectangle.
   subroutine settle_sizes(sections, deck)
      type(sections_t), intent(inout) :: sections
      type(deck_model_t), intent(inout) :: deck
      integer :: k

      do k = 1, size(sections%of_element)
         if (sections%of_element(k) == 0) cycle
         associate (sizes => sections%stated(sections%of_element(k)), kind => deck%appearance%cross_section(k))
            if (kind == section_none) kind = merge(section_circ, section_rect, sizes%count == 1)
            if (.not. sizes%reported) call check_count(sizes, kind, deck%diagnostics)
            if (kind == section_line .or. sizes%count < section_sizes(kind)) cycle
            deck%appearance%dimensions(:, k) = sizes%value
            if (section_sizes(kind) == 1) deck%appearance%dimensions(2, k) = sizes%value(1)
         end associate
      end do
   end subroutine settle_sizes

   !> Too few numbers are left out; those that are too many are.
   subroutine check_count(sizes, kind, diagnostics)
      type(sizes_t), intent(inout) :: sizes
      integer, intent(in) :: kind
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=*), parameter :: wanted(0:2) = ['no number  ', 'one number ', 'two numbers']
      character(len=*), parameter :: help = 'RECT takes the sizes along local y and z, CIRC a diameter; '// &
                                     'hollow ones take walls behind them'

      associate (name => section_names(kind), least => section_sizes(kind))
         sizes%reported = .true.
         if (sizes%count < least) then
            call diagnostics%warning('missing-operand', sizes%place, 'a cross-section '//trim(name)//' needs '// &
                                     trim(wanted(least))//'; the option is left out', 'one number', help)
         else if (sizes%count > least .and. index(name, 'HOL') == 0) then
            call diagnostics%warning('surplus-operand', sizes%place, 'a cross-section '//trim(name)//' takes '// &
                                     trim(wanted(least))//'; what follows is left out', 'more than that', help)
         else
            sizes%reported = .false.
         end if
      end associate
   end subroutine check_count

   subroutine take_size(operands, sizes)
      type(operands_t), intent(inout) :: operands
      type(sizes_t), intent(inout) :: sizes
      real(wp) :: value

      call operands%real_number('size', value, 1)
      if (.not. operands%fine) return
      if (value <= 0.0_wp) then
         call operands%diagnostics%warning('bad-size', operands%word, &
                                           'a size of a cross-section is not positive; the option is left out', &
                                           'not more than zero', 'give sizes in metres, such as 0.0003')
         operands%fine = .false.
         return
      end if
      if (sizes%count == 0) sizes%place = operands%word
      sizes%place%last = operands%word%last
      sizes%count = sizes%count + 1
      if (sizes%count <= 2) sizes%value(sizes%count) = value
   end subroutine take_size

   pure subroutine state(sizes, elements, sections)
      type(sizes_t), intent(in) :: sizes
      integer, intent(in) :: elements(:)
      type(sections_t), intent(inout) :: sections
      integer :: i

      sections%count = sections%count + 1
      sections%stated(sections%count) = sizes
      do i = 1, size(elements)
         sections%of_element(elements(i)) = sections%count
      end do
   end subroutine state

   !> The kind that the word taken last names; an unknown one is reported.
   subroutine find_section(operands, kind)
      type(operands_t), intent(inout) :: operands
      integer, intent(out) :: kind
      character(len=:), allocatable :: word, help
      integer :: i, distance, best

      word = upper_case(operands%text(operands%word%first:min(operands%word%last, operands%word%first + 39)))
      kind = findloc(section_names == word, .true., dim=1)
      if (kind > 0) return
      help = 'it is one of '//listed(section_names)
      best = 3
      do i = 1, size(section_names)
         distance = edit_distance(word, trim(section_names(i)))
         if (distance >= best) cycle
         best = distance
         help = 'did you mean '//trim(section_names(i))//'?'
      end do
      call operands%diagnostics%warning('unknown-cross-section', operands%word, &
                                        word//' is not a cross-section; the option is left out', 'not used', help)
      operands%fine = .false.
   end subroutine find_section

   !> Take so many element numbers; here one that is not there is a warning,
   !> because older decks have other operands in these places.
   subroutine take_elements(operands, most, deck, elements)
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: most
      type(deck_model_t), intent(in) :: deck
      integer, allocatable, intent(out) :: elements(:)
      integer :: number, index, i

      allocate (elements(max(0, most)), source=0)
      do i = 1, most
         call operands%positive_integer('element number', number)
         if (.not. operands%fine) return
         index = deck%element_numbers%find(number)
         if (index > 0) elements(i) = deck%element_of(index)
         if (elements(i) > 0) cycle
         call operands%diagnostics%warning('no-such-element', operands%word, &
                                           'there is no element '//operands%spelling()// &
                                           '; the option is left out', 'no statement makes this element', 'correct the number')
         operands%fine = .false.
         return
      end do
   end subroutine take_elements

   !> All elements with this keyword, in the plane and in space.
   pure function elements_called(keyword, deck) result(elements)
      character(len=*), intent(in) :: keyword
      type(deck_model_t), intent(in) :: deck
      integer, allocatable :: elements(:)
      logical :: chosen(size(element_kinds))
      integer :: k

      chosen = element_kinds%keyword == keyword .or. element_kinds%keyword == 'PL'//keyword
      elements = pack([(k, k=1, deck%model%elements)], chosen(deck%model%element_kind))
   end function elements_called

   pure logical function is_letter(c)
      character, intent(in) :: c
      is_letter = (c >= 'A' .and. c <= 'Z') .or. (c >= 'a' .and. c <= 'z')
   end function is_letter
end module flexact_deck_sections
