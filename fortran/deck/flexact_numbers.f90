! SPDX-License-Identifier: BSD-3-Clause
!> Numbers of a deck, read to the last bit, with a reason where they cannot be.
module flexact_numbers
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_lexer, only: upper_case
   implicit none
   private
   public :: read_integer, read_real, leading_integer
   public :: number_fine, number_malformed, number_not_whole, number_not_finite, number_too_large

   integer, parameter :: number_fine = 0
   integer, parameter :: number_malformed = 1
   integer, parameter :: number_not_whole = 2
   integer, parameter :: number_not_finite = 3
   integer, parameter :: number_too_large = 4

   !> A mantissa below 2**53 times or over an exact power of ten rounds once,
   !> hence correctly (Clinger 1990).
   integer(int64), parameter :: exact_mantissa = 2_int64**53
   !> A mantissa up to here takes one more digit.
   integer(int64), parameter :: roomy_mantissa = 10_int64**17
   integer, parameter :: exact_power = 22
   integer :: k
   real(wp), parameter :: power_of_ten(0:exact_power) = [(10.0_wp**k, k=0, exact_power)]

   !> Any decimal of so many digits comes back from the number that is read of it.
   integer, parameter :: short_digits = 15

   !> Any integer of so many digits fits.
   integer, parameter :: few_digits = 9

   !> A number taken apart: mantissa times ten to the exponent.
   type :: decimal_t
      integer(int64) :: mantissa = 0
      integer :: exponent = 0
      integer :: digits = 0
      !> Digits from the first that is not zero, and up to the last such one.
      integer :: behind_zeros = 0, significant = 0
      logical :: negative = .false.
      logical :: whole = .true.
      !> More digits than the mantissa holds.
      logical :: long = .false.
   end type decimal_t

contains

   !> A whole number such as an element, a node or a component.
   pure subroutine read_integer(word, value, status)
      character(len=*), intent(in) :: word
      integer, intent(out) :: value, status
      type(decimal_t) :: decimal

      value = 0
      call read_few_digits(word, value, status)
      if (status == number_fine) return
      call take_apart(word, decimal, status)
      if (status /= number_fine) return
      if (.not. decimal%whole) then
         status = number_not_whole
      else if (decimal%long .or. decimal%mantissa > huge(value)) then
         status = number_too_large
      else
         value = int(decimal%mantissa)
         if (decimal%negative) value = -value
      end if
   end subroutine read_integer

   !> What nearly all integers of a deck are, without the general way.
   pure subroutine read_few_digits(word, value, status)
      character(len=*), intent(in) :: word
      integer, intent(out) :: value, status
      integer :: i, digit

      value = 0
      status = number_malformed
      if (len(word) > few_digits) return
      do i = 1, len(word)
         digit = iachar(word(i:i)) - iachar('0')
         if (digit < 0 .or. digit > 9) then
            value = 0
            return
         end if
         value = 10*value + digit
      end do
      status = number_fine
   end subroutine read_few_digits

   !> What a faulty word may have meant: the integer that it starts with, or 0.
   pure integer function leading_integer(word) result(value)
      character(len=*), intent(in) :: word
      integer :: last, status

      do last = 1, len(word)
         if (word(last:last) < '0' .or. word(last:last) > '9') exit
      end do
      value = 0
      if (last > 1) call read_integer(word(:last - 1), value, status)
   end function leading_integer

   !> A real number times a power of ten, rounded once: 1 1. .1 +1.5 -.5303 1e-3 1.0D-3.
   !> is_short: whether it has so few digits that they can be known again.
   subroutine read_real(word, power, value, status, is_short)
      character(len=*), intent(in) :: word
      integer, intent(in) :: power
      real(wp), intent(out) :: value
      integer, intent(out) :: status
      logical, intent(out) :: is_short
      type(decimal_t) :: decimal
      logical :: settled
      integer :: io

      value = 0.0_wp
      call take_apart(word, decimal, status)
      is_short = decimal%significant <= short_digits
      if (status /= number_fine) return
      decimal%exponent = decimal%exponent + power
      settled = .false.
      if (abs(decimal%exponent) <= exact_power .and. .not. decimal%long) call convert(decimal, value, settled)
      if (settled) return
      call read_slowly(word, power, value, io)
      if (io /= 0 .or. .not. ieee_is_finite(value)) then
         value = 0.0_wp
         ! A vanishing mantissa or exponent reads as zero; only the other end fails.
         if (decimal%exponent > 0) status = number_too_large
      end if
      if (decimal%significant > 0 .and. .not. abs(value) > 0) is_short = .false.
   end subroutine read_real

   !> As the run time reads it, with another exponent.
   subroutine read_slowly(word, power, value, io)
      character(len=*), intent(in) :: word
      integer, intent(in) :: power
      real(wp), intent(out) :: value
      integer, intent(out) :: io
      type(decimal_t) :: tail
      character(len=16) :: exponent
      character(len=:), allocatable :: shifted
      integer :: last, status

      last = scan(word, 'eEdD') - 1
      if (power == 0) then
         read (word, *, iostat=io) value
         return
      end if
      if (last < 0) last = len(word)
      if (last < len(word)) call take_exponent(word(last + 1:), tail, status)
      write (exponent, '("e", i0)') tail%exponent + power
      shifted = word(:last)//trim(exponent)
      read (shifted, *, iostat=io) value
   end subroutine read_slowly

   !> Mantissa times or over an exact power of ten, where that surely rounds as
   !> the number itself does.
   pure subroutine convert(decimal, value, settled)
      type(decimal_t), intent(in) :: decimal
      real(wp), intent(out) :: value
      logical, intent(out) :: settled

      value = real(decimal%mantissa, wp)
      settled = decimal%mantissa < exact_mantissa
      if (settled .and. decimal%exponent >= 0) then
         value = value*power_of_ten(decimal%exponent)
      else if (settled) then
         value = value/power_of_ten(-decimal%exponent)
      else if (decimal%exponent <= 0) then
         call divide(decimal%mantissa, power_of_ten(-decimal%exponent), value, settled)
      end if
      if (decimal%negative) value = -value
   end subroutine convert

   !> A long mantissa over an exact power of ten: a quotient and, from its exact
   !> remainder (Dekker 1971), how far it is off. Settled unless a little more or
   !> less of that rounds differently.
   pure subroutine divide(mantissa, power, value, settled)
      integer(int64), intent(in) :: mantissa
      real(wp), intent(in) :: power
      real(wp), intent(out) :: value
      logical, intent(out) :: settled
      real(wp) :: whole, quotient, upper, lower, power_upper, power_lower, remainder, correction, slack

      whole = real(mantissa, wp)
      quotient = whole/power
      upper = upper_half(quotient)
      lower = quotient - upper
      power_upper = upper_half(power)
      power_lower = power - power_upper
      remainder = (((whole - upper*power_upper) - upper*power_lower) - lower*power_upper) - lower*power_lower
      correction = (remainder + real(mantissa - int(whole, int64), wp))/power
      ! A millionth of the last bit is far more than the correction is wrong.
      slack = 1.0e-6_wp*epsilon(quotient)*quotient
      value = quotient + (correction - slack)
      settled = .not. value < quotient + (correction + slack)
   end subroutine divide

   !> The upper 26 bits of a number, so that products of halves are exact.
   pure real(wp) function upper_half(number)
      real(wp), intent(in) :: number
      integer(int64), parameter :: lower_bits = 2_int64**27 - 1
      upper_half = transfer(iand(transfer(number, lower_bits), not(lower_bits)), number)
   end function upper_half

   pure subroutine take_apart(word, decimal, status)
      character(len=*), intent(in) :: word
      type(decimal_t), intent(out) :: decimal
      integer, intent(out) :: status
      integer :: i, digit
      logical :: behind_point

      behind_point = .false.
      status = number_malformed
      i = 1
      if (word(1:1) == '-' .or. word(1:1) == '+') i = 2
      decimal%negative = word(1:1) == '-'
      do i = i, len(word)
         digit = iachar(word(i:i)) - iachar('0')
         if (digit >= 0 .and. digit <= 9) then
            call add_digit(decimal, digit, behind_point)
         else if (word(i:i) == '.' .and. .not. behind_point) then
            behind_point = .true.
            decimal%whole = .false.
         else
            exit
         end if
      end do
      if (decimal%digits == 0) then
         if (is_infinite_or_nan(word(i:))) status = number_not_finite
         return
      end if
      if (i <= len(word)) then
         decimal%whole = .false.
         call take_exponent(word(i:), decimal, status)
      else
         status = number_fine
      end if
   end subroutine take_apart

   pure subroutine add_digit(decimal, digit, behind_point)
      type(decimal_t), intent(inout) :: decimal
      integer, intent(in) :: digit
      logical, intent(in) :: behind_point

      decimal%digits = decimal%digits + 1
      if (digit > 0 .or. decimal%behind_zeros > 0) decimal%behind_zeros = decimal%behind_zeros + 1
      if (digit > 0) decimal%significant = decimal%behind_zeros
      if (decimal%mantissa > roomy_mantissa) then
         decimal%long = .true.
         if (.not. behind_point) decimal%exponent = decimal%exponent + 1
      else
         decimal%mantissa = 10*decimal%mantissa + digit
         if (behind_point) decimal%exponent = decimal%exponent - 1
      end if
   end subroutine add_digit

   pure subroutine take_exponent(tail, decimal, status)
      character(len=*), intent(in) :: tail
      type(decimal_t), intent(inout) :: decimal
      integer, intent(out) :: status
      integer :: i, start, digit, exponent

      status = number_malformed
      if (scan(tail(1:1), 'eEdD') == 0) return
      start = 2
      if (len(tail) >= 2) then
         if (scan(tail(2:2), '+-') > 0) start = 3
      end if
      if (start > len(tail)) return
      exponent = 0
      do i = start, len(tail)
         digit = iachar(tail(i:i)) - iachar('0')
         if (digit < 0 .or. digit > 9) return
         ! Far beyond any real number, and short of overflow.
         exponent = min(10*exponent + digit, 100000)
      end do
      if (tail(2:2) == '-') exponent = -exponent
      decimal%exponent = decimal%exponent + exponent
      status = number_fine
   end subroutine take_exponent

   pure logical function is_infinite_or_nan(word)
      character(len=*), intent(in) :: word
      select case (upper_case(word))
      case ('NAN', 'INF', 'INFINITY')
         is_infinite_or_nan = .true.
      case default
         is_infinite_or_nan = .false.
      end select
   end function is_infinite_or_nan
end module flexact_numbers
