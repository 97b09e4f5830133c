! SPDX-License-Identifier: BSD-3-Clause
!> Numbers of stiffness and mass that need not be given.
module flexact_given
   use, intrinsic :: ieee_arithmetic, only: ieee_is_nan
   use flexact_kinds, only: wp
   implicit none
   private
   public :: given

contains

   !> Zero where a number was not given (NaN).
   elemental real(wp) function given(number)
      real(wp), intent(in) :: number

      given = 0.0_wp
      if (.not. ieee_is_nan(number)) given = number
   end function given
end module flexact_given
