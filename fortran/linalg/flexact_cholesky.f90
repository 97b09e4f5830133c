! SPDX-License-Identifier: BSD-3-Clause
!> A sparse Cholesky factor L of a symmetric matrix, by supernodes: what holds it, and what is
!> known of it before the numbers (`flexact_multifrontal`) and after.
!>
!> Matrices are lower triangles, column by column; start and place count from 0.
module flexact_cholesky
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp, long
   use flexact_supernodal_pattern, only: supernodal_t, make_pattern, columns_in, rows_in
   use flexact_supernodal_tasks, only: tasks_t, make_tasks
   implicit none
   private
   public :: cholesky_t, analyse, get_pivots

   !> Operations below which a second thread costs more than it gives.
   real(wp), parameter :: worth_threads = 2.0e7_wp

   type :: cholesky_t
      integer :: n = 0
      !> Entries of the longest column of L, and of all, zeros that pad supernodes with them.
      integer :: widest = 0
      real(wp) :: entries = 0.0_wp
      !> What the factor and the work on it need, and how many work on it.
      real(wp) :: bytes = 0.0_wp
      integer :: threads = 1
      type(supernodal_t) :: pattern
      type(tasks_t) :: tasks
      !> Panels of the supernodes; the diagonal blocks hold anything above their diagonals.
      real(wp), allocatable :: value(:)
   end type cholesky_t

contains

   !> All that does not need the numbers. order: columns as they are to be eliminated, from 0.
   subroutine analyse(start, place, order, threads, factor, error)
      integer, intent(in) :: start(:), place(:), order(:), threads
      type(cholesky_t), intent(out) :: factor
      type(error_t), allocatable, intent(out) :: error
      integer :: info

      factor%n = size(order)
      call make_pattern(start, place, order, factor%pattern, info)
      if (info == 0) call make_tasks(factor%pattern, threads, factor%tasks, info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      if (factor%tasks%work >= worth_threads) factor%threads = max(1, threads)
      factor%widest = factor%pattern%widest
      factor%entries = factor%pattern%entries
      associate (tasks => factor%tasks)
         factor%bytes = 8.0_wp*(real(factor%pattern%panel(factor%pattern%supernodes + 1) + tasks%kept, wp) &
                                + real(maxval(tasks%stack) + maxval(tasks%square), wp) &
                                + (factor%threads - 1)*real(tasks%stack(1) + tasks%square(1), wp))
      end associate
   end subroutine analyse

   !> The squares of the diagonal of L, in the order of the matrix.
   pure subroutine get_pivots(factor, pivot)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(out) :: pivot(:)
      integer :: s, j
      integer(long) :: diagonal

      associate (pattern => factor%pattern)
         do s = 1, pattern%supernodes
            diagonal = pattern%panel(s)
            do j = pattern%first(s), pattern%first(s + 1) - 1
               pivot(pattern%order(j)) = factor%value(diagonal)**2
               diagonal = diagonal + rows_in(pattern, s) + 1
            end do
         end do
      end associate
   end subroutine get_pivots
end module flexact_cholesky
