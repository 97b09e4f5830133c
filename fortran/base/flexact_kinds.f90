! SPDX-License-Identifier: BSD-3-Clause
!> The kinds of numbers of the core.
module flexact_kinds
   use, intrinsic :: iso_fortran_env, only: int64, real64
   implicit none
   private
   public :: wp, qp, long

   integer, parameter :: wp = real64
   !> Of whole numbers that count the entries of a factor.
   integer, parameter :: long = int64
   integer, parameter :: wanted = selected_real_kind(30)
   !> Of more than 30 digits, where the compiler has such a kind.
   integer, parameter :: qp = merge(wanted, wp, wanted > 0)
end module flexact_kinds
