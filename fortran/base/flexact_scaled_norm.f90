! SPDX-License-Identifier: BSD-3-Clause
!> The Euclidean norm of a vector of any magnitude.
module flexact_scaled_norm
   use flexact_kinds, only: wp
   implicit none
   private
   public :: length_of, tiny_entry, huge_entry

   !> Of entries up to between these, squares neither vanish nor overflow, nor does their sum.
   real(wp), parameter :: tiny_entry = 1.0e-100_wp, huge_entry = 1.0e100_wp

contains

   !> Intrinsic norm2 of gfortran 12 gives zero where the squares underflow.
   pure real(wp) function length_of(vector) result(length)
      real(wp), intent(in) :: vector(:)
      real(wp) :: largest

      largest = maxval(abs(vector))
      if (largest > tiny_entry .and. largest < huge_entry) then
         length = sqrt(dot_product(vector, vector))
      else
         length = scale(norm2(scale(vector, -exponent(largest))), exponent(largest))
      end if
   end function length_of
end module flexact_scaled_norm
