!> How well the numbers that describe a scene are known: to the last bit, or to
!> the digits that they were typed with.
module flexact_rounding
   use flexact_kinds, only: wp
   implicit none
   private
   public :: last_bits, last_digit

   !> What arithmetic before us (a turned or moved scene) may have cost.
   real(wp), parameter :: bits = 16*epsilon(1.0_wp)
   !> A number typed with fewer digits is meant as it stands; one with more
   !> cannot be told from a number that is known to the last bit.
   integer, parameter :: fewest_digits = 10
   integer, parameter :: most_digits = 14
   !> The rounding of six coordinates adds up in the direction of an element:
   !> half a unit each, times the root of six.
   real(wp), parameter :: units = 1.25_wp

contains

   !> By how much a number may be wrong in its last bits, in its own unit.
   pure elemental real(wp) function last_bits(value)
      real(wp), intent(in) :: value
      last_bits = bits*abs(value)
   end function last_bits

   !> By how much a number that looks rounded to ten digits or a few more may be
   !> wrong, in its own unit; zero for any other.
   pure elemental real(wp) function last_digit(value)
      real(wp), intent(in) :: value
      real(wp) :: mantissa, unit
      integer :: digits, power

      last_digit = 0.0_wp
      ! No scene has such numbers, and their powers of ten overflow.
      if (abs(value) < 1.0e-200_wp .or. abs(value) > 1.0e200_wp) return
      power = floor(log10(abs(value)))
      do digits = 1, most_digits
         unit = 10.0_wp**(power - digits + 1)
         mantissa = abs(value)/unit
         if (abs(mantissa - anint(mantissa)) > 4*epsilon(value)*mantissa) cycle
         if (digits >= fewest_digits) last_digit = units*unit
         return
      end do
   end function last_digit
end module flexact_rounding
