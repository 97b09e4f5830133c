! SPDX-License-Identifier: BSD-3-Clause
!> CHOLMOD behind the names of fortran/linalg/flexact_factor.f90, in whose place it is built.
module flexact_factor
   use, intrinsic :: iso_c_binding, only: c_ptr, c_null_ptr, c_associated
   use flexact_backward_error, only: unit, extra
   use flexact_cholmod, only: cholmod_analyse, cholmod_factor, cholmod_pivots, cholmod_error, cholmod_solve, cholmod_free
   use flexact_error, only: error_t, fail, error_memory, error_not_definite
   use flexact_kinds, only: wp
   use flexact_progress, only: progress_t
   implicit none
   private
   public :: factor_t, analyse, factorise, get_pivots, error_of_factor, solve, release

   type :: factor_t
      integer :: n = 0
      integer :: widest = 0
      real(wp) :: entries = 0.0_wp, bytes = 0.0_wp
      integer, allocatable :: start(:), place(:)
      type(c_ptr) :: handle = c_null_ptr
   end type factor_t

contains

   !> As for our own; CHOLMOD chooses its threads by itself.
   subroutine analyse(start, place, order, threads, factor, error)
      integer, intent(in) :: start(:), place(:), order(:), threads
      type(factor_t), intent(out) :: factor
      type(error_t), allocatable, intent(out) :: error

      factor%n = size(order)
      factor%start = start
      factor%place = place
      if (threads > 0) factor%handle = cholmod_analyse(factor%n, start, place, order, factor%entries, factor%widest)
      if (.not. c_associated(factor%handle)) call fail(error_memory, error)
      factor%bytes = 8*factor%entries
   end subroutine analyse

   subroutine factorise(factor, matrix, progress, failed, error)
      type(factor_t), intent(inout) :: factor
      real(wp), intent(in) :: matrix(:)
      type(progress_t), intent(in) :: progress
      integer, intent(out) :: failed
      type(error_t), allocatable, intent(out) :: error

      failed = 0
      if (progress%is_stopped()) return
      failed = cholmod_factor(factor%handle, factor%n, factor%start, factor%place, matrix)
      if (failed < 0) call fail(error_memory, error)
      if (failed > 0) call fail(error_not_definite, error)
      failed = max(0, failed)
   end subroutine factorise

   subroutine get_pivots(factor, pivot)
      type(factor_t), intent(in) :: factor
      real(wp), intent(out) :: pivot(:)

      call cholmod_pivots(factor%handle, pivot)
   end subroutine get_pivots

   real(wp) function error_of_factor(factor, enough) result(bound)
      type(factor_t), intent(in) :: factor
      real(wp), intent(in) :: enough

      bound = cholmod_error(factor%handle, unit, extra, enough)
   end function error_of_factor

   subroutine solve(factor, x, error)
      type(factor_t), intent(in) :: factor
      real(wp), intent(inout), contiguous :: x(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: b(:, :)

      b = x
      if (cholmod_solve(factor%handle, factor%n, size(x, 2), b, x) /= 0) call fail(error_memory, error)
   end subroutine solve

   subroutine release(factor)
      type(factor_t), intent(inout) :: factor

      if (c_associated(factor%handle)) call cholmod_free(factor%handle)
      factor%handle = c_null_ptr
   end subroutine release
end module flexact_factor
