! SPDX-License-Identifier: BSD-3-Clause
!> How well the numbers that describe a model are known: to the last bit, or to
!> the digits that they were typed with; theory.md (4), (21) and (24).
module flexact_rounding
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp, qp
   implicit none
   private
   public :: decimal_t, decimal, difference, digits_of
   public :: typed_t, typed
   public :: coarsest_digit
   public :: last_bits, last_digit, looks_printed, looks_rounded, half_bit, half_units

   !> What arithmetic before us may have cost: where the model was made, and, of
   !> a model far from the origin, where it was moved to.
   real(wp), parameter :: bits_of_model = 12*epsilon(1.0_wp)
   real(wp), parameter :: bits_of_place = 4*epsilon(1.0_wp)
   !> A number of more digits cannot be told from one known to the last bit.
   integer, parameter :: most_digits = 14
   !> Any decimal of so many digits comes back from the number that is read of it.
   integer, parameter :: most_typed = 15
   !> Nobody means a number of this many digits as it stands: it was printed.
   integer, parameter :: printed_digits = 10
   !> Numbers up to this one are meant as they stand, times any power of ten, and
   !> their quarters, eighths, ... too; and two digits of which the last is a five.
   integer(int64), parameter :: largest_meant = 25
   !> The rounding of six coordinates adds up in the direction of an element:
   !> half a unit each, times the root of six.
   real(wp), parameter :: units = 1.25_wp

   !> Powers of ten that are exact, and their inverses.
   integer, parameter :: most_exact = 22
   integer :: i
   real(wp), parameter :: power_of_ten(-most_exact:most_exact) = [(10.0_wp**i, i=-most_exact, most_exact)]

   !> A number as it was typed: mantissa * 10**place, without trailing zeros.
   type :: decimal_t
      !> Whether so few digits give it.
      logical :: short = .false.
      integer(int64) :: mantissa = 0
      integer :: place = 0
   end type decimal_t

   !> A number by its shortest decimal, mantissa * 10**place.
   type :: typed_t
      !> Whether fifteen digits give it: then they are those that were typed, as no
      !> two decimals of so many digits are read as one number.
      logical :: short = .true.
      integer(int64) :: mantissa = 0
      integer :: place = 0
   end type typed_t

contains

   !> The decimal of at most fifteen digits that is read as this number.
   pure elemental type(typed_t) function typed(value)
      real(wp), intent(in) :: value
      integer :: place
      real(wp) :: power

      if (abs(value) < 1.0e15_wp .and. abs(value - anint(value)) <= 0) then
         typed%mantissa = nint(value, int64)
         return
      end if
      typed%short = .false.
      if (.not. (abs(value) > 1.0e-200_wp .and. abs(value) < 1.0e200_wp)) return
      place = floor(log10(abs(value))) - most_typed + 1
      typed%place = place
      if (place < 0 .and. place >= -22) then
         ! Such a power is exact, so that a quotient is rounded once, as in reading.
         power = 10.0_wp**(-place)
         typed%mantissa = nint(value*power, int64)
         typed%short = abs(typed%mantissa/power - value) <= 0
      else if (place < 0) then
         typed%mantissa = nearest_whole(value*10.0_qp**(-place))
         typed%short = abs(real(typed%mantissa/10.0_qp**(-place), wp) - value) <= 0
      else
         typed%mantissa = nearest_whole(value/10.0_qp**place)
         typed%short = abs(real(typed%mantissa*10.0_qp**place, wp) - value) <= 0
      end if
   end function typed

   !> Intrinsic nint would ask for a library of its own.
   pure elemental integer(int64) function nearest_whole(value)
      real(qp), intent(in) :: value
      nearest_whole = int(value + merge(-0.5_qp, 0.5_qp, value < 0), int64)
   end function nearest_whole

   !> By how much a number may be wrong in its last bits, in its own unit, in a
   !> model of this extent.
   pure elemental real(wp) function last_bits(value, extent)
      real(wp), intent(in) :: value, extent
      last_bits = bits_of_model*min(abs(value), extent) + bits_of_place*abs(value)
   end function last_bits

   !> Half a unit of the last bit.
   pure elemental real(wp) function half_bit(value)
      real(wp), intent(in) :: value
      half_bit = 0.0_wp
      if (abs(value) > 0) half_bit = spacing(value)/2
   end function half_bit

   !> The digits of a number, where there are no more than 14 of them up to the
   !> rounding of a change of units.
   pure elemental type(decimal_t) function decimal(value)
      real(wp), intent(in) :: value
      real(wp) :: mantissa

      decimal%short = .not. abs(value) > 0
      ! No model has other numbers than these, and their powers of ten overflow.
      if (.not. (abs(value) > 1.0e-200_wp .and. abs(value) < 1.0e200_wp)) return
      decimal%place = floor(log10(abs(value))) - most_digits + 1
      if (abs(decimal%place) <= most_exact) then
         mantissa = abs(value)/power_of_ten(decimal%place)
      else
         mantissa = abs(value)/10.0_wp**decimal%place
      end if
      if (abs(mantissa - anint(mantissa)) > 4*epsilon(value)*mantissa) return
      decimal%mantissa = sign(nint(mantissa, int64), merge(-1_int64, 1_int64, value < 0))
      ! Fourteen digits come near to many a number by chance.
      decimal%short = mod(decimal%mantissa, 10_int64) == 0 .or. is_read_as(value, decimal)
      call strip(decimal)
   end function decimal

   !> Whether these digits give the number to the last bit.
   pure elemental logical function is_read_as(value, number)
      real(wp), intent(in) :: value
      type(decimal_t), intent(in) :: number
      if (number%place < 0) then
         is_read_as = abs(value - number%mantissa/10.0_wp**(-number%place)) <= 0
      else
         is_read_as = abs(value - number%mantissa*10.0_wp**number%place) <= 0
      end if
   end function is_read_as

   !> What lies between two numbers, digit by digit. A model that stands far
   !> from the origin has no more digits than one that does not.
   pure elemental type(decimal_t) function difference(from, to)
      type(decimal_t), intent(in) :: from, to

      if (.not. (from%short .and. to%short)) return
      if (from%mantissa == 0 .or. to%mantissa == 0) then
         difference = to
         if (to%mantissa == 0) difference = decimal_t(.true., -from%mantissa, from%place)
         return
      end if
      if (max(digits_of(from) + from%place, digits_of(to) + to%place) &
          - min(from%place, to%place) > most_digits) return
      difference%short = .true.
      difference%place = min(from%place, to%place)
      difference%mantissa = to%mantissa*10_int64**(to%place - difference%place) &
                            - from%mantissa*10_int64**(from%place - difference%place)
      call strip(difference)
   end function difference

   pure subroutine strip(number)
      type(decimal_t), intent(inout) :: number
      do while (number%mantissa /= 0 .and. mod(number%mantissa, 10_int64) == 0)
         number%mantissa = number%mantissa/10
         number%place = number%place + 1
      end do
   end subroutine strip

   !> How many digits there are; zero for the number zero.
   pure elemental integer function digits_of(number) result(digits)
      type(decimal_t), intent(in) :: number
      integer(int64) :: rest

      digits = 0
      rest = abs(number%mantissa)
      do while (rest > 0)
         digits = digits + 1
         rest = rest/10
      end do
   end function digits_of

   !> Whether a number has ten digits or a few more: it was printed, not typed.
   pure elemental logical function looks_printed(number)
      type(decimal_t), intent(in) :: number
      looks_printed = number%short .and. digits_of(number) >= printed_digits
   end function looks_printed

   !> By how much a number that was printed with ten digits or a few more may be
   !> wrong, in its own unit; zero for any other.
   pure elemental real(wp) function last_digit(number)
      type(decimal_t), intent(in) :: number

      last_digit = 0.0_wp
      if (looks_printed(number)) last_digit = units*10.0_wp**number%place
   end function last_digit

   !> A bound of how much a number may be wrong that was rounded to a few digits,
   !> in its own unit; zero for one with more digits or a single one.
   pure elemental real(wp) function coarsest_digit(number)
      type(decimal_t), intent(in) :: number
      coarsest_digit = 0.0_wp
      if (number%short .and. digits_of(number) > 1) coarsest_digit = 10*10.0_wp**number%place
   end function coarsest_digit

   !> Whether a number has the digits of one that was rounded (0.87, 0.866, 0.70711),
   !> and not of one that is meant as it stands (0.5, 12, 0.85, 0.375).
   pure elemental logical function looks_rounded(number)
      type(decimal_t), intent(in) :: number
      integer(int64) :: rest

      rest = abs(number%mantissa)
      looks_rounded = number%short .and. rest > largest_meant .and. .not. (rest < 100 .and. mod(rest, 5_int64) == 0)
      if (mod(rest, 25_int64) /= 0) return
      do while (rest > 0 .and. mod(rest, 5_int64) == 0)
         rest = rest/5
      end do
      looks_rounded = looks_rounded .and. rest > largest_meant
   end function looks_rounded

   !> By how much some numbers may be wrong that were rounded together, to one
   !> last place or to one number of digits: half a unit of the last place where
   !> they look it, zero where they are meant. A zero at the end has left no
   !> trace, so that one with fewer digits is known better than it seems, and one
   !> of a digit less than the others need not be meant.
   pure function half_units(number, rounded) result(half)
      type(decimal_t), intent(in) :: number(:)
      logical, intent(in) :: rounded(:)
      real(wp) :: half(size(number))
      integer :: digits(size(number)), finest, most, i

      half = 0.0_wp
      if (.not. any(rounded)) return
      digits = digits_of(number)
      finest = minval(number%place, rounded)
      most = maxval(digits, rounded)
      do i = 1, size(number)
         if (rounded(i) .or. (number(i)%short .and. digits(i) == most - 1)) &
            half(i) = 0.5_wp*10.0_wp**max(min(finest, number(i)%place), number(i)%place - (most - digits(i)))
      end do
   end function half_units
end module flexact_rounding
