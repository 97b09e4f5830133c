!> The picture block: how the elements are to be drawn. What is wrong in it is
!> told by a warning and left out, because a picture must not stop an analysis;
!> a group of elements that do not exist is an error, as everywhere.
module flexact_deck_picture
   use flexact_deck_scene, only: scene_t, take_element
   use flexact_deck_sections, only: sections_t, make_sections, read_crosstype, read_crossdim, read_older_form, settle_sizes
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_keywords, only: keywords, block_picture, role_form, role_picture
   use flexact_kinds, only: wp
   use flexact_look, only: look_t, make_look
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

   !> Read the look of the elements; of two statements for one element the last
   !> counts. Options of what is not drawn become statements that are not used.
   subroutine read_picture(text, statements, scene, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(inout) :: statements(:)
      type(scene_t), intent(inout) :: scene
      type(diagnostics_t), intent(inout) :: diagnostics
      type(group_t) :: group
      type(sections_t) :: sections
      integer :: i

      if (.not. any(statements%role == role_picture)) return
      allocate (scene%look, source=make_look(scene%model%elements))
      sections = make_sections(count(statements%block == block_picture), scene%model%elements)
      group%element = all_elements(scene)
      do i = 1, size(statements)
         if (statements(i)%block /= block_picture) cycle
         call read_statement(text, statements(i), group, scene, sections, diagnostics)
      end do
      call settle_sizes(sections, scene%look, diagnostics)
   end subroutine read_picture

   subroutine read_statement(text, statement, group, scene, sections, diagnostics)
      character(len=*), intent(in) :: text
      type(statement_t), intent(inout) :: statement
      type(group_t), intent(inout) :: group
      type(scene_t), intent(inout) :: scene
      type(sections_t), intent(inout) :: sections
      type(diagnostics_t), intent(inout) :: diagnostics
      type(operands_t) :: operands
      integer, allocatable :: elements(:)

      ! A group that is not known: its options are not those of the group before.
      group%of_elements = group%of_elements .and. statement%what > 0
      if (statement%what == 0) return
      operands = operands_of(statement)
      select case (keywords(statement%what)%name)
      case ('BEAMPROPS', 'GRAPHICS')
         group%of_elements = .true.
         call take_elements(text, operands, scene, group%element, diagnostics)
      case ('INITIAL', 'LIGHT', 'AXISPROPS', 'TRAJECT')
         group%of_elements = .false.
      case ('DONOTDRAW')
         if (operands%left(text) == 0) call operands%word_operand(text, 'element number', diagnostics)
         if (operands%fine) call take_elements(text, operands, scene, elements, diagnostics)
         if (operands%fine) call hide(scene%look, elements)
      case ('BEAMVIS')
         call read_older_form(text, operands, 'BEAM', scene, sections, diagnostics)
      case ('TRUSSVIS')
         call read_older_form(text, operands, 'TRUSS', scene, sections, diagnostics)
      case ('VISUALIZATION')
         return
      case default
         if (statement%role == role_form) return
         if (group%of_elements) then
            call read_option(text, operands, keywords(statement%what)%name, group%element, scene%look, sections, diagnostics)
         else
            statement%role = role_form
         end if
      end select
   end subroutine read_statement

   !> One option of the elements of a group.
   subroutine read_option(text, operands, name, elements, look, sections, diagnostics)
      character(len=*), intent(in) :: text, name
      type(operands_t), intent(inout) :: operands
      integer, intent(in) :: elements(:)
      type(look_t), intent(inout) :: look
      type(sections_t), intent(inout) :: sections
      type(diagnostics_t), intent(inout) :: diagnostics
      real(wp) :: colour(3), opacity
      integer :: i

      select case (name)
      case ('CROSSTYPE')
         call read_crosstype(text, operands, elements, look, diagnostics)
      case ('CROSSDIM')
         call read_crossdim(text, operands, elements, sections, diagnostics)
      case ('FACECOLOR')
         call take_colour(text, operands, name, colour, diagnostics)
         if (operands%fine) call paint(look%colour, elements, colour)
      case ('EDGECOLOR')
         call take_colour(text, operands, name, colour, diagnostics)
         if (operands%fine) call paint(look%edge_colour, elements, colour)
      case ('OPACITY')
         call take_opacity(text, operands, opacity, diagnostics)
         if (.not. operands%fine) return
         do i = 1, size(elements)
            look%opacity(elements(i)) = opacity
         end do
      end select
   end subroutine read_option

   ! Element by element: a statement may name one twice.

   pure subroutine hide(look, elements)
      type(look_t), intent(inout) :: look
      integer, intent(in) :: elements(:)
      integer :: i

      do i = 1, size(elements)
         look%drawn(elements(i)) = .false.
      end do
   end subroutine hide

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
   subroutine take_elements(text, operands, scene, elements, diagnostics)
      character(len=*), intent(in) :: text
      type(operands_t), intent(inout) :: operands
      type(scene_t), intent(in) :: scene
      integer, allocatable, intent(inout) :: elements(:)
      type(diagnostics_t), intent(inout) :: diagnostics
      integer, allocatable :: found(:)
      integer :: i, count

      allocate (found(operands%left(text)))
      operands%forgiving = .false.
      count = 0
      do i = 1, size(found)
         call take_element(text, scene, operands, found(count + 1), diagnostics)
         if (found(count + 1) > 0) count = count + 1
      end do
      if (size(found) > 0) then
         elements = found(:count)
      else
         elements = all_elements(scene)
      end if
   end subroutine take_elements

   !> Red, green and blue: from 0 to 1, or from 0 to 255 where one exceeds 1.
   subroutine take_colour(text, operands, name, colour, diagnostics)
      character(len=*), intent(in) :: text, name
      type(operands_t), intent(inout) :: operands
      real(wp), intent(out) :: colour(3)
      type(diagnostics_t), intent(inout) :: diagnostics
      character(len=*), parameter :: part(3) = ['red  ', 'green', 'blue ']
      type(span_t) :: wrong
      integer :: i

      do i = 1, 3
         call operands%real_number(text, trim(part(i)), colour(i), diagnostics)
         if (colour(i) < 0.0_wp .or. colour(i) > 255.0_wp) wrong = operands%word
      end do
      call operands%finish(text, trim(name)//' red green blue', diagnostics)
      if (.not. operands%fine) return
      if (wrong%first > 0) then
         call diagnostics%warning('bad-colour', wrong, 'a part of a colour is out of range; the option is left out', &
                                  'not from 0 to 255', 'give red, green and blue from 0 to 1, or from 0 to 255')
         operands%fine = .false.
      end if
      if (any(colour > 1.0_wp)) colour = colour/255.0_wp
   end subroutine take_colour

   subroutine take_opacity(text, operands, opacity, diagnostics)
      character(len=*), intent(in) :: text
      type(operands_t), intent(inout) :: operands
      real(wp), intent(out) :: opacity
      type(diagnostics_t), intent(inout) :: diagnostics
      type(span_t) :: word

      call operands%real_number(text, 'opacity', opacity, diagnostics)
      word = operands%word
      call operands%finish(text, 'OPACITY value', diagnostics)
      if (.not. operands%fine) return
      if (opacity < 0.0_wp .or. opacity > 1.0_wp) then
         call diagnostics%warning('bad-opacity', word, 'an opacity is out of range; the option is left out', &
                                  'not from 0 to 1', 'give 0 for invisible, 1 for opaque, or a number between them')
         operands%fine = .false.
      end if
   end subroutine take_opacity

   pure function all_elements(scene) result(elements)
      type(scene_t), intent(in) :: scene
      integer, allocatable :: elements(:)
      integer :: k

      elements = [(k, k=1, scene%model%elements)]
   end function all_elements
end module flexact_deck_picture
