! SPDX-License-Identifier: BSD-3-Clause
!> The one real kind of the core.
module flexact_kinds
   use, intrinsic :: iso_fortran_env, only: real64
   implicit none
   private
   public :: wp

   integer, parameter :: wp = real64
end module flexact_kinds
