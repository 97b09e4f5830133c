! SPDX-License-Identifier: BSD-3-Clause
!> A tally of checks for the unit tests.
module flexact_testing
   use, intrinsic :: iso_fortran_env, only: error_unit
   use flexact_kinds, only: wp
   implicit none
   private
   public :: tally_t, set_random

   type :: tally_t
      integer :: checks = 0
      integer :: failures = 0
   contains
      procedure :: check
      procedure :: near
      procedure :: finish
   end type tally_t

contains

   !> Count a check and name it where it fails.
   subroutine check(self, passed, name)
      class(tally_t), intent(inout) :: self
      logical, intent(in) :: passed
      character(len=*), intent(in) :: name

      self%checks = self%checks + 1
      if (passed) return
      self%failures = self%failures + 1
      write (error_unit, '(2a)') 'failed: ', name
   end subroutine check

   !> Check that every value is within a tolerance of what is expected; a NaN
   !> or another shape is not.
   subroutine near(self, value, expected, tolerance, name)
      class(tally_t), intent(inout) :: self
      real(wp), intent(in) :: value(:), expected(:), tolerance
      character(len=*), intent(in) :: name
      logical :: passed

      passed = size(value) == size(expected)
      if (passed) passed = all(abs(value - expected) <= tolerance)
      call self%check(passed, name)
      if (passed) return
      write (error_unit, '(a, *(es24.16))') '  value:   ', value
      write (error_unit, '(a, *(es24.16))') '  expected:', expected
   end subroutine near

   !> Say how many checks were made; stop with an error where one failed.
   subroutine finish(self)
      class(tally_t), intent(in) :: self

      write (*, '(i0, a, i0, a)') self%checks, ' checks, ', self%failures, ' failed'
      if (self%checks == 0) error stop 'nothing was checked'
      if (self%failures > 0) error stop 1
   end subroutine finish

   !> The same random numbers in every run.
   subroutine set_random()
      integer :: length, i

      call random_seed(size=length)
      call random_seed(put=[(7919*i, i=1, length)])
   end subroutine set_random
end module flexact_testing
