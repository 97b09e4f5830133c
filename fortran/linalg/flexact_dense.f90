! SPDX-License-Identifier: BSD-3-Clause
!> What the decompositions of dense matrices share: work arrays, the range of
!> the numbers, and the identity.
module flexact_dense
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use flexact_error, only: error_t, fail, error_convergence
   use flexact_kinds, only: wp
   implicit none
   private
   public :: fits_integer, allocate_work, bring_to_one, set_identity, transpose_in_place

contains

   !> Whether LAPACK can count the work array of any decomposition of an m x n
   !> matrix with default integers.
   pure logical function fits_integer(m, n)
      integer, intent(in) :: m, n
      real(wp) :: short, long

      short = min(m, n)
      long = max(m, n)
      fits_integer = 4*short*short + 7*short + 64*long < huge(1)
   end function fits_integer

   !> The work array of the length that a query has returned.
   pure subroutine allocate_work(work, length, info)
      real(wp), allocatable, intent(out) :: work(:)
      real(wp), intent(in) :: length
      integer, intent(out) :: info

      info = 1
      if (length < real(huge(1), wp)) allocate (work(max(1, int(length))), stat=info)
   end subroutine allocate_work

   !> Multiply A by 2**(-power) such that its largest entry is between 1/2 and
   !> 1, where LAPACK's sums of squares neither overflow nor lose digits.
   pure subroutine bring_to_one(a, power, error)
      real(wp), intent(inout) :: a(:, :)
      integer, intent(out) :: power
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: largest

      power = 0
      if (.not. all(ieee_is_finite(a))) then
         call fail(error_convergence, error)
         return
      end if
      largest = maxval(abs(a))
      if (.not. largest > 0) return
      power = exponent(largest)
      if (power /= 0) a = scale(a, -power)
   end subroutine bring_to_one

   pure subroutine set_identity(a)
      real(wp), intent(inout) :: a(:, :)
      integer :: i

      a = 0.0_wp
      do i = 1, size(a, 1)
         a(i, i) = 1.0_wp
      end do
   end subroutine set_identity

   pure subroutine transpose_in_place(a)
      real(wp), intent(inout) :: a(:, :)
      real(wp) :: upper
      integer :: i, j

      do j = 2, size(a, 2)
         do i = 1, j - 1
            upper = a(i, j)
            a(i, j) = a(j, i)
            a(j, i) = upper
         end do
      end do
   end subroutine transpose_in_place
end module flexact_dense
