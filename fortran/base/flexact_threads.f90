! SPDX-License-Identifier: BSD-3-Clause
!> Tasks that are worked on side by side: see flexact_threads.c.
module flexact_threads
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_funptr, c_int, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   implicit none
   private
   public :: run_tasks, on_pieces, piece, pieces_of

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

   abstract interface
      !> Does what is wanted with one of the pieces of a vector, from its first to its last row.
      recursive subroutine piece_work(part, first, last, data)
         import :: c_ptr
         integer, intent(in) :: part, first, last
         type(c_ptr), intent(in) :: data
      end subroutine piece_work
   end interface

   type :: pieces_t
      integer :: count = 0
      procedure(piece_work), pointer, nopass :: work => null()
      type(c_ptr) :: data
   end type pieces_t

contains

   !> Have some work done with each of the pieces of vectors of so many rows.
   subroutine on_pieces(count, workers, work, data)
      integer, intent(in) :: count, workers
      procedure(piece_work) :: work
      type(c_ptr), intent(in) :: data
      type(pieces_t), target :: pieces

      pieces%count = count
      pieces%work => work
      pieces%data = data
      call run_tasks(int(pieces_of(count), c_int), int(workers, c_int), c_funloc(work_on_piece), c_loc(pieces))
   end subroutine on_pieces

   recursive subroutine work_on_piece(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(pieces_t), pointer :: pieces
      integer :: ends(2)

      call c_f_pointer(data, pieces)
      ends = piece(pieces%count, int(task), pieces_of(pieces%count))
      call pieces%work(int(task), ends(1), ends(2), pieces%data)
   end subroutine work_on_piece

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
