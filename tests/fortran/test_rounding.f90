! SPDX-License-Identifier: BSD-3-Clause
!> How well numbers are known, by their digits and by their bits.
program test_rounding
   use flexact_kinds, only: wp
   use flexact_rounding, only: decimal, decimal_t, difference, digits_of, half_units, last_bits, last_digit, looks_rounded
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally

   call digits_of_numbers()
   call numbers_that_were_printed()
   call numbers_that_look_rounded()
   call what_lies_between_two_numbers()
   call numbers_rounded_together()
   call bits_of_numbers()
   call tally%finish()

contains

   subroutine digits_of_numbers()
      type(decimal_t) :: number

      number = decimal(-0.0125_wp)
      call tally%check(number%short .and. number%mantissa == -125 .and. number%place == -4, 'minus 125 ten-thousandths')
      number = decimal(1200.0_wp)
      call tally%check(number%mantissa == 12 .and. number%place == 2, 'twelve hundred')
      number = decimal(0.0_wp)
      call tally%check(number%short .and. digits_of(number) == 0, 'zero has no digits')
      call tally%check(all(digits_of(decimal([0.866_wp, 8.66e-10_wp, 8.66e8_wp])) == 3), 'of any magnitude')
      call tally%check(digits_of(decimal(1.0e-9_wp*0.866_wp)) == 3, 'after a change of units')
      call tally%check(digits_of(decimal(0.12345678901234_wp)) == 14, 'fourteen digits')
      number = decimal(sqrt(0.75_wp))
      call tally%check(.not. number%short, 'known to the last bit')
      number = decimal(1.0e300_wp)
      call tally%check(.not. number%short, 'beyond any model')
   end subroutine digits_of_numbers

   !> Half a unit in the last place, for six coordinates: 1.25 units.
   subroutine numbers_that_were_printed()
      call tally%near(last_digit(decimal([0.8660254038_wp, 0.866025403784_wp])), [1.25e-10_wp, 1.25e-12_wp], &
                      1.0e-16_wp, 'ten and twelve digits')
      call tally%near(last_digit(decimal([0.0_wp, 12.0_wp, 0.5_wp, 0.8660_wp, 0.86602540378443865_wp])), &
                      spread(0.0_wp, 1, 5), 0.0_wp, 'meant as they stand, or known to the last bit')
   end subroutine numbers_that_were_printed

   subroutine numbers_that_look_rounded()
      call tally%check(all(looks_rounded(decimal([0.87_wp, 0.8660_wp, 0.70711_wp, -0.577_wp, 866.0_wp, 12.25_wp, &
                                                  1.4142135623731_wp]))), 'rounded')
      call tally%check(.not. any(looks_rounded(decimal([0.0_wp, 0.5_wp, 12.0_wp, 0.125_wp, -0.375_wp, 0.85_wp, &
                                                        0.0625_wp, 0.19_wp, 1000.0_wp, 3.0e-9_wp]))), 'meant')
      call tally%check(.not. looks_rounded(decimal(sqrt(0.75_wp))), 'known to the last bit')
   end subroutine numbers_that_look_rounded

   !> A place far from the origin adds no digits to what lies between.
   subroutine what_lies_between_two_numbers()
      type(decimal_t) :: number

      number = difference(decimal(100000000.06_wp), decimal(100000000.0_wp))
      call tally%check(number%short .and. number%mantissa == -6 .and. number%place == -2, 'far from the origin')
      number = difference(decimal(101.0_wp), decimal(102.0_wp))
      call tally%check(digits_of(number) == 1, 'joints of a lattice')
      number = difference(decimal(0.866_wp), decimal(-0.5_wp))
      call tally%check(number%mantissa == -1366 .and. number%place == -3, 'of two signs')
      number = difference(decimal(0.0_wp), decimal(0.866_wp))
      call tally%check(number%mantissa == 866, 'from zero')
      number = difference(decimal(0.866_wp), decimal(0.0_wp))
      call tally%check(number%mantissa == -866, 'to zero')
      number = difference(decimal(1.0e8_wp), decimal(1.0e-8_wp))
      call tally%check(.not. number%short, 'more digits than a number holds')
      number = difference(decimal(0.5_wp), decimal(sqrt(0.75_wp)))
      call tally%check(.not. number%short, 'to a number known to the last bit')
   end subroutine what_lies_between_two_numbers

   subroutine numbers_rounded_together()
      call tally%near(half([0.70711_wp, 0.866_wp, 0.5_wp]), [0.5e-5_wp, 0.5e-5_wp, 0.0_wp], 1.0e-20_wp, &
                      '0.866 lost its zeros, 0.5 is meant')
      call tally%near(half([1.23456_wp, 0.0123456_wp, 0.0_wp]), [0.5e-5_wp, 0.5e-7_wp, 0.0_wp], 1.0e-20_wp, &
                      'to one number of digits')
      call tally%near(half([0.866_wp, 0.35_wp, 1.0_wp]), [0.5e-3_wp, 0.5e-3_wp, 0.0_wp], 1.0e-18_wp, &
                      'one digit less, a zero that left no trace')
      call tally%near(half([0.5_wp, 12.0_wp, 0.0_wp]), [0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'none is rounded')
   end subroutine numbers_rounded_together

   function half(values)
      real(wp), intent(in) :: values(3)
      real(wp) :: half(3)
      half = half_units(decimal(values), looks_rounded(decimal(values)))
   end function half

   !> Storing rounds by half of epsilon; what it made of the model before it was
   !> moved does not grow with the place.
   subroutine bits_of_numbers()
      call tally%check(last_bits(-2.0_wp, 2.0_wp) >= epsilon(1.0_wp), 'a negative number')
      call tally%check(last_bits(1.0e8_wp, 1.0_wp) >= 1.0e8_wp*epsilon(1.0_wp)/2, 'covers what is stored')
      call tally%check(last_bits(1.0e8_wp, 1.0_wp) < last_bits(1.0e8_wp, 1.0e8_wp)/2, &
                       'a small model far away is known better than a large one')
   end subroutine bits_of_numbers
end program test_rounding
