! SPDX-License-Identifier: BSD-3-Clause
!> The Euclidean norm of a vector of any magnitude, and products of vectors.
module flexact_scaled_norm
   use flexact_kinds, only: wp
   implicit none
   private
   public :: length_of, inner_product

   !> Sums of squares between these have lost nothing to underflow or overflow.
   real(wp), parameter :: tiny_square = 1.0e-200_wp, huge_square = 1.0e200_wp
   !> Sums that are made side by side, as a sum waits for the one before.
   integer, parameter :: lanes = 8

contains

   !> Intrinsic norm2 of gfortran 12 gives zero where the squares underflow.
   pure real(wp) function length_of(vector) result(length)
      real(wp), intent(in), contiguous :: vector(:)
      real(wp) :: largest

      length = inner_product(vector, vector)
      if (length > tiny_square .and. length < huge_square) then
         length = sqrt(length)
      else
         largest = maxval(abs(vector))
         length = scale(norm2(scale(vector, -exponent(largest))), exponent(largest))
      end if
   end function length_of

   !> The same as the intrinsic one but for rounding.
   pure real(wp) function inner_product(a, b) result(total)
      real(wp), intent(in), contiguous :: a(:), b(:)
      real(wp) :: sums(lanes)
      integer :: i, last

      last = size(a) - mod(size(a), lanes)
      sums = 0.0_wp
      do i = 1, last, lanes
         sums = sums + a(i:i + lanes - 1)*b(i:i + lanes - 1)
      end do
      total = sum(sums) + dot_product(a(last + 1:), b(last + 1:))
   end function inner_product
end module flexact_scaled_norm
