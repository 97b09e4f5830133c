! SPDX-License-Identifier: BSD-3-Clause
!> Before and after a piece of work with BLAS: see flexact_blas.c.
module flexact_blas
   use, intrinsic :: iso_c_binding, only: c_int, c_double
   implicit none
   private
   public :: blas_work_t, blas_begin, blas_end, blas_threads, blas_share, blas_unshare, blas_bytes, is_small

   !> What OpenBLAS takes when it is first used.
   integer, parameter :: blas_bytes = 129*2**20
   !> Where the shorter side of a matrix is below, two threads were never quicker than one.
   integer, parameter :: small_side = 300

   !> What blas_begin leaves for blas_end: see there.
   type, bind(c) :: blas_work_t
      integer(c_int) :: limited, alone, threads, levels
   end type blas_work_t

   interface
      !> 0, or -1 where there is no room for BLAS and for so many bytes.
      function blas_begin(small, bytes, work) bind(c, name='flexact_blas_begin') result(status)
         import :: c_int, c_double, blas_work_t
         integer(c_int), value :: small
         real(c_double), value :: bytes
         type(blas_work_t), intent(out) :: work
         integer(c_int) :: status
      end function blas_begin

      subroutine blas_end(work) bind(c, name='flexact_blas_end')
         import :: blas_work_t
         type(blas_work_t), intent(in) :: work
      end subroutine blas_end

      !> With how many threads BLAS works now, or did before it was shared: so many may others take.
      function blas_threads() bind(c, name='flexact_blas_threads') result(threads)
         import :: c_int
         integer(c_int) :: threads
      end function blas_threads

      !> From here on, within a piece of work, several threads call BLAS at once: it works with one
      !> for each, until blas_unshare.
      subroutine blas_share() bind(c, name='flexact_blas_share')
      end subroutine blas_share

      subroutine blas_unshare() bind(c, name='flexact_blas_unshare')
      end subroutine blas_unshare
   end interface

contains

   !> 1 for a matrix of such sides that gains nothing by threads, else 0.
   pure integer(c_int) function is_small(rows, columns)
      integer, intent(in) :: rows, columns

      is_small = merge(1_c_int, 0_c_int, min(rows, columns) < small_side)
   end function is_small
end module flexact_blas
