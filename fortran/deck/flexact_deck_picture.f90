! SPDX-License-Identifier: BSD-3-Clause
!> The picture block: how the elements are to be drawn. What is wrong in it is
!> reported by a warning and left out, because a picture must not stop an analysis;
!> a group of elements that do not exist is an error, as everywhere.
module flexact_deck_picture
   use flexact_deck_model, only: deck_model_t, take_element
   use flexact_deck_sections, only: sections_t, read_crosstype, read_crossdim, read_older_form, settle_sizes
   use flexact_diagnostics, only: span_t
   use flexact_keywords, only: keywords, block_picture, role_form, role_picture
   use flexact_kinds, only: wp
   use flexact_appearance, only: appearance_t, make_appearance
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_picture

   !> What option lines speak of: elements, or something that is not drawn.
   type :: group_t
      logical :: of_elements = .true.
      integer, allocatable :: element(:)
   end type group_t

contains

   !> Read the appearance of the elements; of two statements for one element the last
   !> counts. Options of what is not drawn become statements that are not used.
   subroutine read_picture(statements, deck)
      type(statement_t), intent(inout) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(group_t) :: group
      type(sections_t) :: sections
      integer :: i

      if (.not. any(statements%role == role_picture)) return
      allocate (deck%appearance, source=make_appearance(deck%model%elements))
      allocate (sections%stated(count(statements%block == block_picture)))
      allocate (sections%of_element(deck%model%elements), source=0)
      group%element = all_elements(deck)
      do i = 1, size(statements)
         if (statements(i)%block /= block_picture) cycle
         call read_statement(statements(i), group, deck, sections)
      end do
      call settle_sizes(sections, deck)
   end subroutine read_picture

   subroutine read_statement(statement, group, deck, sections)
      type(statement_t), intent(inout) :: statement
      type(group_t), intent(inout) :: group
      type(deck_model_t), intent(inout) :: deck
      type(sections_t), intent(inout) :: sections
      type(operands_t) :: operands
      integer, allocatable :: elements(:)
      integer :: i

      ! A group that is not known: its options are not those of the group before.
      group%of_elements = group%of_elements .and. statement%what > 0
      if (statement%what == 0) return
      operands = operands_of(deck%text, deck%diagnostics, statement)
      operands%length_power = deck%length_power
      select case (keywords(statement%what)%name)
      case ('BEAMPROPS', 'GRAPHICS')
         group%of_elements = .true.
         call take_elements(operands, deck, group%element)
      case ('INITIAL', 'LIGHT', 'AXISPROPS', 'TRAJECT')
         group%of_elements = .false.
      case ('DONOTDRAW')
         if (operands%left() == 0) call operands%word_operand('element number')
         if (operands%fine) call take_elements(operands, deck, elements)
         if (.not. operands%fine) return
         do i = 1, size(elements)
            deck%appearance%drawn(elements(i)) = .false.
         end do
      case ('BEAMVIS')
         call read_older_form(operands, 'BEAM', deck, sections)
      case ('TRUSSVIS')
         call read_older_form(operands, 'TRUSS', deck, sections)
      case ('VISUALIZATION')
         return
      case default
         if (statement%role == role_form) return
         if (group%of_elements) then
            call read_option(operands, keywords(statement%what)%name, group%element, deck%appearance, sections)
         else
            statement%role = role_form
         end if
      end select
   end subroutine read_statement

   !> One option of the elements of a group.
   subroutine read_option(operands, name, elements, appearance, sections)
      character(len=*), intent(in) :: name
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: elements(:)
      type(appearance_t), intent(inout) :: appearance
      type(sections_t), intent(inout) :: sections
      real(wp) :: colour(3), opacity(1)
      integer :: i

      select case (name)
      case ('CROSSTYPE')
         call read_crosstype(operands, elements, appearance)
      case ('CROSSDIM')
         call read_crossdim(operands, elements, sections)
      case ('FACECOLOR')
         call take_colour(operands, name, colour)
         if (operands%fine) call paint(appearance%colour, elements, colour)
      case ('EDGECOLOR')
         call take_colour(operands, name, colour)
         if (operands%fine) call paint(appearance%edge_colour, elements, colour)
      case ('OPACITY')
         call take_in_range(operands, ['opacity'], 'OPACITY value', 1.0_wp, opacity, 'bad-opacity', &
                            'an opacity is out of range', 'not from 0 to 1', &
                            'give 0 for invisible, 1 for opaque, or a number between them')
         if (.not. operands%fine) return
         do i = 1, size(elements)
            appearance%opacity(elements(i)) = opacity(1)
         end do
      end select
   end subroutine read_option

   !> Element by element: a statement may name one twice.
   pure subroutine paint(colours, elements, colour)
      real(wp), intent(inout) :: colours(:, :)
      integer, intent(in) :: elements(:)
      real(wp), intent(in) :: colour(3)
      integer :: i

      do i = 1, size(elements)
         colours(:, elements(i)) = colour
      end do
   end subroutine paint

   !> The elements of a statement, all where it names none.
   subroutine take_elements(operands, deck, elements)
      type(operands_t), intent(inout) :: operands
      type(deck_model_t), intent(in) :: deck
      integer, allocatable, intent(inout) :: elements(:)
      integer, allocatable :: found(:)
      integer :: i, count

      allocate (found(operands%left()))
      operands%forgiving = .false.
      count = 0
      do i = 1, size(found)
         call take_element(deck, operands, found(count + 1))
         if (found(count + 1) > 0) count = count + 1
      end do
      if (size(found) > 0) then
         elements = found(:count)
      else
         elements = all_elements(deck)
      end if
   end subroutine take_elements

   !> Red, green and blue: from 0 to 1, or from 0 to 255 where one exceeds 1.
   subroutine take_colour(operands, name, colour)
      type(operands_t), intent(inout) :: operands
      character(len=*), intent(in) :: name
      real(wp), intent(out) :: colour(3)
      character(len=*), parameter :: part(3) = ['red  ', 'green', 'blue ']

      call take_in_range(operands, part, trim(name)//' red green blue', 255.0_wp, colour, 'bad-colour', &
                         'a part of a colour is out of range', 'not from 0 to 255', &
                         'give red, green and blue from 0 to 1, or from 0 to 255')
      if (any(colour > 1.0_wp)) colour = colour/255.0_wp
   end subroutine take_colour

   !> Take numbers from 0 to a largest one, all that a statement of this form has.
   subroutine take_in_range(operands, part, form, largest, value, code, message, label, help)
      type(operands_t), intent(inout) :: operands
      character(len=*), intent(in) :: part(:), form, code, message, label, help
      real(wp), intent(in) :: largest
      real(wp), intent(out) :: value(:)
      type(span_t) :: wrong
      integer :: i

      do i = 1, size(part)
         call operands%real_number(trim(part(i)), value(i))
         if (value(i) < 0.0_wp .or. value(i) > largest) wrong = operands%word
      end do
      call operands%finish(form)
      if (.not. operands%fine .or. wrong%first == 0) return
      call operands%diagnostics%warning(code, wrong, message//'; the option is left out', label, help)
      operands%fine = .false.
   end subroutine take_in_range

   pure function all_elements(deck) result(elements)
      type(deck_model_t), intent(in) :: deck
      integer, allocatable :: elements(:)
      integer :: k

      elements = [(k, k=1, deck%model%elements)]
   end function all_elements
end module flexact_deck_picture
