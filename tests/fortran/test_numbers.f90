! SPDX-License-Identifier: BSD-3-Clause
!> Numbers of a deck: values to the last bit, and why a word is none.
program test_numbers
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_numbers, only: read_integer, read_real, number_fine, number_malformed, number_not_whole, &
                              number_not_finite, number_too_large
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call integers()
   call reals()
   call last_bits()
   call back_from_seventeen_digits()
   call numbers_of_few_digits()
   call shifted_numbers()
   call tally%finish()

contains

   subroutine integers()
      call expect_integer('7', 7, number_fine)
      call expect_integer('+12', 12, number_fine)
      call expect_integer('-3', -3, number_fine)
      call expect_integer('2147483647', 2147483647, number_fine)
      call expect_integer('2147483648', 0, number_too_large)
      call expect_integer('99999999999999999999999', 0, number_too_large)
      call expect_integer('1.', 0, number_not_whole)
      call expect_integer('1e3', 0, number_not_whole)
      call expect_integer('x', 0, number_malformed)
      call expect_integer('-', 0, number_malformed)
   end subroutine integers

   subroutine reals()
      call expect_real('1.', 1.0_wp, number_fine)
      call expect_real('+0.0000', 0.0_wp, number_fine)
      call expect_real('.1', 0.1_wp, number_fine)
      call expect_real('-.5303', -0.5303_wp, number_fine)
      call expect_real('1e-3', 1.0e-3_wp, number_fine)
      call expect_real('1.0D-3', 1.0e-3_wp, number_fine)
      call expect_real('2d+2', 200.0_wp, number_fine)
      call expect_real('1e-400', 0.0_wp, number_fine)
      call expect_real('0e999', 0.0_wp, number_fine)
      call expect_real('1e400', 0.0_wp, number_too_large)
      call expect_real('nan', 0.0_wp, number_not_finite)
      call expect_real('-Inf', 0.0_wp, number_not_finite)
      call expect_real('infinity', 0.0_wp, number_not_finite)
      call expect_real('1..5', 0.0_wp, number_malformed)
      call expect_real('.', 0.0_wp, number_malformed)
      call expect_real('1e', 0.0_wp, number_malformed)
      call expect_real('1e+', 0.0_wp, number_malformed)
      call expect_real('1,5', 0.0_wp, number_malformed)
      call expect_real('0x1p3', 0.0_wp, number_malformed)
   end subroutine reals

   !> The compiler's own conversion of the same digits is the reference.
   subroutine last_bits()
      call expect_real('0.8660254037844386', 0.8660254037844386_wp, number_fine)
      call expect_real('0.70710678118654757', 0.70710678118654757_wp, number_fine)
      call expect_real('-123456789012345678.9', -123456789012345678.9_wp, number_fine)
      call expect_real('2.2250738585072014e-308', 2.2250738585072014e-308_wp, number_fine)
      call expect_real('1.7976931348623157e308', 1.7976931348623157e308_wp, number_fine)
      call expect_real('9007199254740993', 9007199254740993.0_wp, number_fine)
      call expect_real('4503599627370497.5', 4503599627370497.5_wp, number_fine)
      call expect_real('4503599627370497.50000001', 4503599627370497.50000001_wp, number_fine)
      call expect_real('90071992547409.935', 90071992547409.935_wp, number_fine)
      call expect_real('-0.30000000000000004', -0.30000000000000004_wp, number_fine)
      call expect_real('1e22', 1.0e22_wp, number_fine)
      call expect_real('1e23', 1.0e23_wp, number_fine)
   end subroutine last_bits

   !> Seventeen digits tell every number from its neighbours.
   subroutine back_from_seventeen_digits()
      character(len=24) :: word
      real(wp) :: value
      integer :: i

      call set_random()
      do i = 1, 1000
         call random_number(value)
         value = (2*value - 1)*10.0_wp**modulo(i, 8)
         write (word, '(es24.16)') value
         call expect_real(trim(adjustl(word)), value, number_fine)
      end do
   end subroutine back_from_seventeen_digits

   subroutine expect_integer(word, value, status)
      character(len=*), intent(in) :: word
      integer, intent(in) :: value, status
      integer :: got, got_status

      call read_integer(word, got, got_status)
      call tally%check(got == value .and. got_status == status, 'integer '//word)
   end subroutine expect_integer

   subroutine expect_real(word, value, status)
      character(len=*), intent(in) :: word
      real(wp), intent(in) :: value
      integer, intent(in) :: status
      real(wp) :: got
      integer :: got_status
      logical :: is_short

      call read_real(word, 0, got, got_status, is_short)
      call tally%check(transfer(got, 0_int64) == transfer(value, 0_int64) .and. got_status == status, 'real '//word)
   end subroutine expect_real

   !> A number times a power of ten is the decimal with its point moved, to the last bit.
   subroutine shifted_numbers()
      call expect_shifted('0.3', -3, 0.0003_wp)
      call expect_shifted('25', -3, 0.025_wp)
      call expect_shifted('1.2345678901234567', -3, 0.0012345678901234567_wp)
      call expect_shifted('43.30127018922193', -3, 0.04330127018922193_wp)
      call expect_shifted('-4.5e2', 6, -4.5e8_wp)
      call expect_shifted('1.7d-320', 3, 1.7e-317_wp)
      call expect_shifted('123456789012345678901234567890', -6, 123456789012345678901234.567890_wp)
   end subroutine shifted_numbers

   subroutine expect_shifted(word, power, value)
      character(len=*), intent(in) :: word
      integer, intent(in) :: power
      real(wp), intent(in) :: value
      real(wp) :: got
      integer :: got_status
      logical :: is_short

      call read_real(word, power, got, got_status, is_short)
      call tally%check(transfer(got, 0_int64) == transfer(value, 0_int64) .and. got_status == number_fine, 'shifted '//word)
   end subroutine expect_shifted

   !> Zeros at either end are no digits; what is too small for a number is lost.
   subroutine numbers_of_few_digits()
      call tally%check(is_short('1.50000000000000000000'), 'zeros at the end')
      call tally%check(is_short('-0.00000000000000000000123456789012345e-3'), 'zeros before')
      call tally%check(is_short('12345678901234500000.'), 'zeros before the point')
      call tally%check(is_short('0.0') .and. is_short('0.000000000000000000e9'), 'zero')
      call tally%check(.not. is_short('1.5000000000000001'), 'seventeen digits of 1.5')
      call tally%check(.not. is_short('0.1234567890123451'), 'sixteen digits')
      call tally%check(.not. is_short('1.00000000000000000000000000001'), 'more than are kept')
      call tally%check(.not. is_short('1e-400'), 'smaller than any number')
   end subroutine numbers_of_few_digits

   logical function is_short(word)
      character(len=*), intent(in) :: word
      real(wp) :: value
      integer :: status

      call read_real(word, 0, value, status, is_short)
   end function is_short
end program test_numbers
