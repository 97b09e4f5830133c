! SPDX-License-Identifier: BSD-3-Clause
!> Numbers in one of two arithmetics, so that a formula is written once: modulo a
!> prime, where sums and products are exact, or with more than 30 digits. What they
!> are made from is a number of a model, as it was typed or as it is stored.
module flexact_exact_number
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_modular, only: modular_inverse, modular_product
   use flexact_kinds, only: wp, qp
   use flexact_rounding, only: typed_t, typed
   implicit none
   private
   public :: arithmetic_t, number_t, modular_arithmetic, many_digits
   public :: number_of, whole, operator(+), operator(-), operator(*)

   !> Powers of the base that are kept.
   integer, parameter :: kept = 40

   type :: number_t
      !> 0: `value` is used.
      integer(int64) :: modulus = 0
      integer(int64) :: residue = 0
      real(qp) :: value = 0.0_qp
   end type number_t

   type :: arithmetic_t
      integer(int64) :: modulus = 0
      !> Whether numbers are the decimals that were typed, or the doubles as stored.
      logical :: as_typed = .true.
      !> Of the base 10 or 2, modulo the prime.
      integer(int64) :: power(-kept:kept) = 0
   end type arithmetic_t

   interface operator(+)
      module procedure plus
   end interface
   interface operator(-)
      module procedure minus, negative
   end interface
   interface operator(*)
      module procedure times
   end interface

contains

   pure function many_digits(as_typed) result(arithmetic)
      logical, intent(in) :: as_typed
      type(arithmetic_t) :: arithmetic
      arithmetic%as_typed = as_typed
   end function many_digits

   pure function modular_arithmetic(prime, as_typed) result(arithmetic)
      integer(int64), intent(in) :: prime
      logical, intent(in) :: as_typed
      type(arithmetic_t) :: arithmetic
      integer(int64) :: base
      integer :: i

      arithmetic%modulus = prime
      arithmetic%as_typed = as_typed
      base = merge(10_int64, 2_int64, as_typed)
      arithmetic%power(0) = 1
      arithmetic%power(1) = base
      arithmetic%power(-1) = modular_inverse(base, prime)
      do i = 2, kept
         arithmetic%power(i) = modular_product(arithmetic%power(i - 1), base, prime)
         arithmetic%power(-i) = modular_product(arithmetic%power(1 - i), arithmetic%power(-1), prime)
      end do
   end function modular_arithmetic

   !> A number of the model.
   elemental type(number_t) function number_of(value, arithmetic) result(number)
      real(wp), intent(in) :: value
      type(arithmetic_t), intent(in) :: arithmetic
      type(typed_t) :: parts

      parts = parts_of(value, arithmetic%as_typed)
      if (arithmetic%modulus == 0) then
         number%value = real(value, qp)
         if (arithmetic%as_typed) number%value = scaled_by_ten(parts)
         return
      end if
      number%modulus = arithmetic%modulus
      number%residue = modulo(parts%mantissa, arithmetic%modulus)
      do while (parts%place /= 0 .and. number%residue /= 0)
         associate (step => min(kept, max(-kept, parts%place)))
            number%residue = modular_product(number%residue, arithmetic%power(step), arithmetic%modulus)
            parts%place = parts%place - step
         end associate
      end do
   end function number_of

   !> mantissa * base**place: the decimal as typed, or the double bit by bit.
   pure type(typed_t) function parts_of(value, as_typed) result(parts)
      real(wp), intent(in) :: value
      logical, intent(in) :: as_typed

      if (as_typed) then
         parts = typed(value)
      else if (abs(value) > 0) then
         parts%mantissa = int(scale(fraction(value), digits(value)), int64)
         parts%place = exponent(value) - digits(value)
      end if
   end function parts_of

   pure real(qp) function scaled_by_ten(parts)
      type(typed_t), intent(in) :: parts

      if (parts%place < 0) then
         scaled_by_ten = parts%mantissa/10.0_qp**(-parts%place)
      else
         scaled_by_ten = parts%mantissa*10.0_qp**parts%place
      end if
   end function scaled_by_ten

   !> A small whole number.
   pure type(number_t) function whole(value, arithmetic) result(number)
      integer, intent(in) :: value
      type(arithmetic_t), intent(in) :: arithmetic

      number%modulus = arithmetic%modulus
      if (arithmetic%modulus == 0) then
         number%value = value
      else
         number%residue = modulo(int(value, int64), arithmetic%modulus)
      end if
   end function whole

   elemental type(number_t) function plus(a, b) result(c)
      type(number_t), intent(in) :: a, b

      c%modulus = max(a%modulus, b%modulus)
      if (c%modulus == 0) then
         c%value = a%value + b%value
      else
         c%residue = a%residue - (c%modulus - b%residue)
         if (c%residue < 0) c%residue = c%residue + c%modulus
      end if
   end function plus

   elemental type(number_t) function minus(a, b) result(c)
      type(number_t), intent(in) :: a, b

      c%modulus = max(a%modulus, b%modulus)
      if (c%modulus == 0) then
         c%value = a%value - b%value
      else
         c%residue = a%residue - b%residue
         if (c%residue < 0) c%residue = c%residue + c%modulus
      end if
   end function minus

   elemental type(number_t) function negative(a) result(c)
      type(number_t), intent(in) :: a

      c%modulus = a%modulus
      c%value = -a%value
      if (a%residue > 0) c%residue = a%modulus - a%residue
   end function negative

   elemental type(number_t) function times(a, b) result(c)
      type(number_t), intent(in) :: a, b

      c%modulus = max(a%modulus, b%modulus)
      if (c%modulus == 0) then
         c%value = a%value*b%value
      else if (a%residue > 0 .and. b%residue > 0) then
         c%residue = modular_product(a%residue, b%residue, c%modulus)
      end if
   end function times
end module flexact_exact_number
