! SPDX-License-Identifier: BSD-3-Clause
!> The UNITS statement, and which numbers of a deck it is about: those with a length in them.
!> With millimetres a number is read as if its exponent were another one, so that it is the
!> number that the same deck in metres has, to the last bit.
module flexact_deck_units
   use flexact_deck_model, only: deck_model_t
   use flexact_diagnostics, only: span_t
   use flexact_keywords, only: role_units
   use flexact_lexer, only: upper_case
   use flexact_operands, only: operands_t, operands_of
   use flexact_statement, only: statement_t
   implicit none
   private
   public :: read_units, powers_of_length

   character(len=2), parameter :: names(2) = ['M ', 'MM']
   !> Power of ten of each in metres.
   integer, parameter :: power(2) = [0, -3]

contains

   !> Find out in which unit the deck has lengths; metres where it does not say it.
   subroutine read_units(statements, deck)
      type(statement_t), intent(in) :: statements(:)
      type(deck_model_t), intent(inout) :: deck
      type(operands_t) :: operands
      type(span_t) :: stated
      integer :: i, which

      do i = 1, size(statements)
         if (statements(i)%role /= role_units) cycle
         operands = operands_of(deck%text, deck%diagnostics, statements(i))
         call operands%word_operand('m or mm')
         if (.not. operands%fine) cycle
         which = findloc(names, upper_case(operands%spelling()), dim=1)
         if (which == 0) then
            call operands%diagnostics%error('bad-units', operands%word, &
                                            "'"//operands%spelling()//"' are no units of a deck", 'expected here: m or mm', &
                                            'write UNITS m, or UNITS mm: lengths in mm, forces in N, ESTIFF in N and N mm^2')
            cycle
         end if
         if (stated%first > 0) &
            call operands%diagnostics%warning('repeated-value', operands%word, 'the units are given already', &
                                              'this one counts, for all of the deck', 'remove one of the two statements', stated)
         stated = operands%word
         deck%length_power = power(which)
         call operands%finish('UNITS m, or UNITS mm')
      end do
   end subroutine read_units

   !> The power of the length in each of some numbers, by what a column of the element table, or
   !> another list of meanings, says of their units: 2 of "G It (N m^2)", -1 of "(kg/m)".
   pure function powers_of_length(meanings) result(powers)
      character(len=*), intent(in) :: meanings
      integer :: powers(6)
      integer :: i, first, last, k

      powers = 0
      first = 1
      do i = 1, size(powers)
         last = index(trim(meanings(first:))//',', ',') + first - 2
         k = index(meanings(first:last), '(', back=.true.)
         if (k > 0) powers(i) = power_in(meanings(first + k:last - 1))
         first = last + 2
         if (first > len_trim(meanings)) exit
      end do
   end function powers_of_length

   !> The power of the length in a unit.
   pure integer function power_in(unit) result(power)
      character(len=*), intent(in) :: unit

      select case (unit)
      case ('m', 'N m', 'N m/rad', 'kg m', 'm/s^2')
         power = 1
      case ('m^2', 'N m^2', 'kg m^2')
         power = 2
      case ('N/m', 'kg/m')
         power = -1
      case ('Pa')
         power = -2
      case default
         power = 0
      end select
   end function power_in
end module flexact_deck_units
