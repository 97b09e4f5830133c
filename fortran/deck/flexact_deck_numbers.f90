! SPDX-License-Identifier: BSD-3-Clause
!> The numbers of a statement of the dynamics block, and what they can mean.
module flexact_deck_numbers
   use flexact_diagnostics, only: span_t
   use flexact_kinds, only: wp
   use flexact_operands, only: operands_t
   implicit none
   private
   public :: meaning_t, take_numbers

   !> What a statement may give.
   type :: meaning_t
      !> Of what, in words, and what it takes.
      character(len=:), allocatable :: what, form
      !> How many numbers there must be at least, and how many mean something.
      integer :: least = 1
      integer :: numbers = 0
      !> That many behind these, and no others, are passed over without a word.
      integer :: passed_over = 0
      !> More than these, and none of them is used.
      integer :: most = huge(1)
      !> The power of the length in the unit of each.
      integer :: lengths(6) = 0
      !> Which of them cannot be less than zero.
      logical :: not_negative(6) = .false.
   end type meaning_t

contains

   !> Take the numbers behind the element or the node, zero behind the last; count is zero
   !> where none is to be used. stated: where they were given before.
   subroutine take_numbers(operands, meaning, value, count, stated)
      type(operands_t), intent(inout) :: operands
      type(meaning_t), intent(in) :: meaning
      real(wp), intent(out) :: value(6)
      integer, intent(out) :: count
      type(span_t), intent(inout) :: stated
      type(operands_t) :: ahead
      type(span_t) :: owner, surplus, negative
      real(wp) :: next
      integer :: given, last

      owner = operands%word
      value = 0.0_wp
      count = 0
      given = 0
      last = 0
      do
         given = given + 1
         call operands%real_number('number', next, meaning%lengths(min(given, size(meaning%lengths))))
         if (.not. operands%fine) return
         if (given <= meaning%numbers) then
            value(given) = next
            if (meaning%not_negative(given) .and. next < 0.0_wp .and. negative%first == 0) negative = operands%word
         else if (abs(next) > 0.0_wp) then
            ! A surplus zero says nothing.
            if (surplus%first == 0) surplus = operands%word
            last = given
         end if
         ahead = operands
         if (given >= meaning%least .and. .not. ahead%another()) exit
      end do
      call warn(operands, meaning, last, owner, surplus, negative, stated)
      stated = owner
      if (last <= meaning%most) count = min(given, meaning%numbers)
   end subroutine take_numbers

   !> Say what is odd about it; last: place of the last number that is surplus and not zero.
   subroutine warn(operands, meaning, last, owner, surplus, negative, stated)
      type(operands_t), intent(inout) :: operands
      type(meaning_t), intent(in) :: meaning
      integer, intent(in) :: last
      type(span_t), intent(in) :: owner, surplus, negative, stated

      associate (diagnostics => operands%diagnostics, form => meaning%form)
         if (meaning%numbers == 0) then
            if (last > 0) call diagnostics%warning('no-meaning', owner, meaning%what//' has no meaning, and is not used', &
                                                   'it has none of its own', form)
            return
         end if
         if (last > meaning%most) then
            call diagnostics%warning('surplus-operand', surplus, 'there are more numbers than can be meant; '// &
                                     'none of them is used', 'from here on', form)
         else if (last > meaning%numbers + meaning%passed_over) then
            call diagnostics%warning('surplus-operand', surplus, 'there are more numbers than can be meant; '// &
                                     'they are left out', 'from here on', form)
         end if
         if (negative%first > 0) &
            call diagnostics%warning('negative-number', negative, meaning%what//' is less than zero', &
                                     'not negative as a rule', 'correct it, unless it is meant')
         if (stated%first > 0) &
            call diagnostics%warning('repeated-value', owner, 'the same is given already', 'this one counts', &
                                     'remove one of the two statements', stated)
      end associate
   end subroutine warn
end module flexact_deck_numbers
