!> How well the numbers that describe a scene are known: to the last bit, or to
!> the digits that they were typed with.
module flexact_rounding
   use flexact_kinds, only: wp
   implicit none
   private
   public :: uncertainty

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

   !> By how much a number may be wrong, in its own unit.
   pure elemental real(wp) function uncertainty(value)
      real(wp), intent(in) :: value
      real(wp) :: mantissa, unit
      integer :: digits, power

      uncertainty = bits*abs(value)
      ! No scene has such numbers, and their powers of ten overflow.
      if (abs(value) < 1.0e-200_wp .or. abs(value) > 1.0e200_wp) return
      power = floor(log10(abs(value)))
      do digits = 1, most_digits
         unit = 10.0_wp**(power - digits + 1)
         mantissa = abs(value)/unit
         if (abs(mantissa - anint(mantissa)) > 4*epsilon(value)*mantissa) cycle
         if (digits >= fewest_digits) uncertainty = max(uncertainty, units*unit)
         return
      end do
   end function uncertainty
end module flexact_rounding
