! SPDX-License-Identifier: BSD-3-Clause
!> Tasks that are worked on side by side: see flexact_threads.c.
module flexact_threads
   use, intrinsic :: iso_c_binding, only: c_int, c_ptr, c_funptr
   implicit none
   private
   public :: run_tasks

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
end module flexact_threads
