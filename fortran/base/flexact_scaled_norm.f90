! SPDX-License-Identifier: BSD-3-Clause
!> The Euclidean norm of a vector of any magnitude.
module flexact_scaled_norm
   use flexact_kinds, only: wp
   implicit none
   private
   public :: length_of

contains

   !> Intrinsic norm2 of gfortran 12 gives zero where the squares underflow.
   pure real(wp) function length_of(vector) result(length)
      real(wp), intent(in) :: vector(:)
      integer :: power

      power = exponent(maxval(abs(vector)))
      length = scale(norm2(scale(vector, -power)), power)
   end function length_of
end module flexact_scaled_norm
