! SPDX-License-Identifier: BSD-3-Clause
!> Tasks that are worked on side by side: see flexact_threads.c.
module flexact_threads
   use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_funptr
   use, intrinsic :: iso_fortran_env, only: int64
   implicit none
   private
   public :: run_tasks, piece, pieces_of

   !> Rows of a vector that are worth a task of their own.
   integer, parameter :: worth_task = 20000

   interface
      !> Call work(task, worker, data), bind(c), tasks and workers counted from 1, of which a worker
      !> does one after the other; threads end with the call.
      subroutine run_tasks(tasks, workers, work, data) bind(c, name='flexact_run_tasks')
         import :: c_int, c_ptr, c_funptr
         integer(c_int), value :: tasks, workers
         type(c_funptr), value :: work
         type(c_ptr), value :: data
      end subroutine run_tasks
   end interface

contains

   !> The first and the last of one of so many pieces.
   pure recursive function piece(count, part, parts) result(ends)
      integer, intent(in) :: count, part, parts
      integer :: ends(2)
      ends = int([(part - 1)*int(count, int64)/parts + 1, part*int(count, int64)/parts])
   end function piece

   !> In how many pieces such vectors are dealt with, whoever does it: sums come out the same then.
   pure recursive integer function pieces_of(count)
      integer, intent(in) :: count
      pieces_of = max(1, count/worth_task)
   end function pieces_of
end module flexact_threads
