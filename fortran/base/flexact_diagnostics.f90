! SPDX-License-Identifier: BSD-3-Clause
!> Problems as values: severity, code, places and words, without any layout.
!>
!> A place is a span of characters in the deck's text; a model made without
!> a deck has no places. Whoever shows a diagnostic decides how it looks.
module flexact_diagnostics
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: span_t, diagnostic_t, diagnostics_t
   public :: severity_error, severity_warning, severity_note, severity_names
   public :: most_shown

   integer, parameter :: severity_error = 1
   integer, parameter :: severity_warning = 2
   integer, parameter :: severity_note = 3
   character(len=24), parameter :: severity_names(3) = [character(len=24) :: 'error', 'warning', 'note']

   !> All diagnostics are counted. At most these many are kept, the first that are met
   !> but errors before all others, and the first by place of these are shown, again
   !> errors before all others. The limits guard against a broken deck of millions of
   !> lines.
   integer, parameter :: most_kept = 2000
   integer, parameter :: most_shown = 100
   !> More than any place in a text.
   real(wp), parameter :: behind_all = 2.0_wp*huge(1)
   integer, parameter :: text_length = 240
   integer, parameter :: code_length = 32

   !> First and last character in the deck's text; first = 0 means no place.
   type :: span_t
      integer :: first = 0
      integer :: last = 0
   end type span_t

   type :: diagnostic_t
      integer :: severity = severity_error
      character(len=code_length) :: code = ''
      type(span_t) :: place
      !> The second place, where a problem has two (a duplicate, a conflict).
      type(span_t) :: other
      character(len=text_length) :: message = ''
      !> A few words that stand beside the caret.
      character(len=text_length) :: label = ''
      !> How to fix it.
      character(len=text_length) :: help = ''
      !> Words of the statement at `place` (1 is its keyword) that a check of the
      !> model means: who has the text narrows the place to them. 0: all of it.
      integer :: words(2) = 0
   end type diagnostic_t

   type :: diagnostics_t
      integer :: kept = 0
      !> How many were added of each severity, kept or not.
      integer :: count(3) = 0
      type(diagnostic_t), allocatable :: item(:)
   contains
      procedure :: error => add_error
      procedure :: warning => add_warning
      procedure :: note => add_note
      procedure :: has_errors
      procedure :: is_full
      procedure :: count_error
      procedure :: sort => sort_by_place
   end type diagnostics_t

contains

   !> Add an error; `other` is the second place where there is one.
   subroutine add_error(self, code, place, message, label, help, other, words)
      class(diagnostics_t), intent(inout) :: self
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place
      type(span_t), intent(in), optional :: other
      integer, intent(in), optional :: words(2)
      call add(self, severity_error, code, place, message, label, help, other, words)
   end subroutine add_error

   !> Add a warning: the deck can be analysed, but may not mean what it says.
   subroutine add_warning(self, code, place, message, label, help, other)
      class(diagnostics_t), intent(inout) :: self
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place
      type(span_t), intent(in), optional :: other
      call add(self, severity_warning, code, place, message, label, help, other)
   end subroutine add_warning

   !> Add a note: something that was read and not used, or that is often meant.
   subroutine add_note(self, code, place, message, label, help, other)
      class(diagnostics_t), intent(inout) :: self
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place
      type(span_t), intent(in), optional :: other
      call add(self, severity_note, code, place, message, label, help, other)
   end subroutine add_note

   subroutine add(self, severity, code, place, message, label, help, other, words)
      class(diagnostics_t), intent(inout) :: self
      integer, intent(in) :: severity
      character(len=*), intent(in) :: code, message, label, help
      type(span_t), intent(in) :: place
      type(span_t), intent(in), optional :: other
      integer, intent(in), optional :: words(2)
      integer :: at

      self%count(severity) = self%count(severity) + 1
      call make_room(self)
      at = self%kept + 1
      if (at > most_kept) then
         ! An error takes the place of the last thing that is none, while there is one.
         if (severity /= severity_error .or. self%count(severity_error) > most_kept) return
         at = findloc(self%item%severity /= severity_error, .true., dim=1, back=.true.)
      end if
      self%kept = max(self%kept, at)
      self%item(at) = diagnostic_t(severity, code, place, span_t(), message, label, help)
      if (present(other)) self%item(at)%other = other
      if (present(words)) self%item(at)%words = words
   end subroutine add

   subroutine make_room(self)
      type(diagnostics_t), intent(inout) :: self
      type(diagnostic_t), allocatable :: larger(:)

      if (.not. allocated(self%item)) then
         allocate (self%item(16))
      else if (self%kept == size(self%item) .and. self%kept < most_kept) then
         allocate (larger(min(2*self%kept, most_kept)))
         larger(:self%kept) = self%item
         call move_alloc(larger, self%item)
      end if
   end subroutine make_room

   pure logical function has_errors(self)
      class(diagnostics_t), intent(in) :: self
      has_errors = self%count(severity_error) > 0
   end function has_errors

   !> Whether a further error would only be counted; then its words are not
   !> worth making, and `count_error` does.
   pure logical function is_full(self)
      class(diagnostics_t), intent(in) :: self
      is_full = self%count(severity_error) >= most_kept
   end function is_full

   !> Count an error without words.
   pure subroutine count_error(self)
      class(diagnostics_t), intent(inout) :: self
      self%count(severity_error) = self%count(severity_error) + 1
   end subroutine count_error

   !> Those that are shown into the order of the text; those without a place come last.
   subroutine sort_by_place(self)
      class(diagnostics_t), intent(inout) :: self

      if (self%kept < 2) return
      associate (item => self%item(:self%kept))
         item = item(ascending(places(item) + merge(0.0_wp, behind_all, item%severity == severity_error)))
      end associate
      associate (shown => self%item(:min(self%kept, most_shown)))
         shown = shown(ascending(places(shown)))
      end associate
   end subroutine sort_by_place

   pure elemental real(wp) function places(item)
      type(diagnostic_t), intent(in) :: item
      places = real(merge(item%place%first, huge(1), item%place%first > 0), wp)
   end function places
end module flexact_diagnostics
