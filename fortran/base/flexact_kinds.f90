! SPDX-License-Identifier: BSD-3-Clause
!> The kinds of numbers of the core, and how many are taken at a time.
module flexact_kinds
   use, intrinsic :: iso_fortran_env, only: int64, real64
   implicit none
   private
   public :: wp, qp, long, lanes

   integer, parameter :: wp = real64
   !> Of whole numbers that count the entries of a factor.
   integer, parameter :: long = int64
   integer, parameter :: wanted = selected_real_kind(30)
   !> Of more than 30 digits, where the compiler has such a kind.
   integer, parameter :: qp = merge(wanted, wp, wanted > 0)
   !> Small problems that are taken side by side, so that a step of one waits for no other.
   integer, parameter :: lanes = 8
end module flexact_kinds
