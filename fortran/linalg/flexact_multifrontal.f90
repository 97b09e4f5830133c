! SPDX-License-Identifier: BSD-3-Clause
!> The numbers of a sparse Cholesky factor L L', supernode by supernode (multifrontal; Liu, SIAM
!> Review 34, 1992, pp. 82-109): each takes its entries of the matrix and what those below it left
!> for it, and leaves the rest for those above. Subtrees are worked on side by side; what stands
!> above them is left to the threads of BLAS.
module flexact_multifrontal
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_blas, only: blas_share, blas_unshare
   use flexact_cholesky, only: cholesky_t
   use flexact_error, only: error_t, fail, error_memory, error_not_definite, error_interrupted
   use flexact_front, only: front_t, take_entries, eliminate, add_to_panel, add_to_square, pack_update
   use flexact_kinds, only: wp, long
   use flexact_progress, only: progress_t
   use flexact_supernodal_pattern, only: supernodal_t, columns_in, rows_in
   use flexact_supernodal_tasks, only: update_size, work_of
   use flexact_threads, only: run_tasks
   implicit none
   private
   public :: factorise

   !> Who does one task after the other: where each row stands in the panel at work, where the rows
   !> of an update do, the square in which an update is made, and those that wait for the supernode
   !> that takes them.
   type :: worker_t
      integer, allocatable :: place_in(:), map(:)
      real(wp), allocatable :: square(:), stack(:)
      integer(long) :: filled = 0
      !> Operations so far.
      real(wp) :: done = 0.0_wp
   end type worker_t

   type :: job_t
      type(cholesky_t), pointer :: factor => null()
      real(wp), pointer, contiguous :: matrix(:) => null()
      type(progress_t) :: progress
      type(worker_t), allocatable :: worker(:)
      !> Updates of whole tasks; and where that of each supernode begins, here or on its stack.
      real(wp), allocatable :: kept(:)
      integer(long), allocatable :: at(:)
      !> The place where each task met a pivot that is not positive, or 0; 0: above the tasks.
      integer, allocatable :: failed(:)
   end type job_t

contains

   !> matrix: entries of the lower triangle. failed: the column (from 1) at which it is not positive
   !> definite, the first in the order of elimination, or 0.
   subroutine factorise(factor, matrix, progress, failed, error)
      type(cholesky_t), intent(inout), target :: factor
      real(wp), intent(in), target, contiguous :: matrix(:)
      type(progress_t), intent(in) :: progress
      integer, intent(out) :: failed
      type(error_t), allocatable, intent(out) :: error
      type(job_t), target :: job
      integer :: info

      failed = 0
      job%factor => factor
      job%matrix => matrix
      job%progress = progress
      call make_room(factor, job, info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call work_on_tasks(job)
      call work_above(job)
      if (progress%is_stopped()) then
         call fail(error_interrupted, error)
      else if (any(job%failed > 0)) then
         failed = factor%pattern%order(minval(job%failed, job%failed > 0))
         call fail(error_not_definite, error)
      end if
   end subroutine factorise

   subroutine make_room(factor, job, info)
      type(cholesky_t), intent(inout) :: factor
      type(job_t), intent(inout) :: job
      integer, intent(out) :: info
      integer :: i, t

      info = 0
      associate (pattern => factor%pattern, tasks => factor%tasks)
         if (.not. allocated(factor%value)) &
            allocate (factor%value(pattern%panel(pattern%supernodes + 1) - 1), stat=info)
         if (info == 0) allocate (job%worker(factor%threads), job%kept(tasks%kept), job%at(pattern%supernodes), &
                                  job%failed(0:tasks%count), stat=info)
         if (info /= 0) return
         job%failed = 0
         do i = 1, factor%threads
            if (info == 0) allocate (job%worker(i)%place_in(factor%n), job%worker(i)%map(factor%widest), stat=info)
            if (info == 0) allocate (job%worker(i)%square(most(tasks%square, i)), &
                                     job%worker(i)%stack(most(tasks%stack, i)), stat=info)
         end do
         if (tasks%count > 0) job%at(tasks%root(1)) = 1
         do t = 2, tasks%count
            job%at(tasks%root(t)) = job%at(tasks%root(t - 1)) + update_size(pattern, tasks%root(t - 1))
         end do
      end associate
   contains
      !> The first worker is also at work above the tasks.
      pure integer(long) function most(room, worker)
         integer(long), intent(in) :: room(0:1)
         integer, intent(in) :: worker

         most = room(1)
         if (worker == 1) most = maxval(room)
      end function most
   end subroutine make_room

   subroutine work_on_tasks(job)
      type(job_t), intent(inout), target :: job

      call blas_share()
      call run_tasks(int(job%factor%tasks%count, c_int), int(job%factor%threads, c_int), c_funloc(work_on_task), c_loc(job))
      call blas_unshare()
   end subroutine work_on_tasks

   recursive subroutine work_on_task(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(job_t), pointer :: job
      integer :: s

      call c_f_pointer(data, job)
      do s = job%factor%tasks%from(task), job%factor%tasks%root(task)
         call work_on(s, int(task), job, job%worker(worker))
         if (job%failed(task) /= 0 .or. job%progress%is_stopped()) exit
         if (worker == 1) call tell(job)
      end do
      job%worker(worker)%filled = 0
   end subroutine work_on_task

   !> Where a task has failed, only what stands before: so that it is always the first that fails
   !> which is told, whoever worked on what.
   subroutine work_above(job)
      type(job_t), intent(inout), target :: job
      integer :: s, least

      least = job%factor%n + 1
      if (any(job%failed > 0)) least = minval(job%failed, job%failed > 0)
      do s = 1, job%factor%pattern%supernodes
         if (job%factor%tasks%of_supernode(s) /= 0) cycle
         if (job%factor%pattern%first(s) > least .or. job%progress%is_stopped()) return
         call work_on(s, 0, job, job%worker(1))
         if (job%failed(0) /= 0) return
         call tell(job)
      end do
   end subroutine work_above

   !> How much is done, as far as the first worker knows: others have done about as much as it has.
   recursive subroutine tell(job)
      type(job_t), intent(in) :: job

      call job%progress%advance(min(1.0_wp, job%worker(1)%done*size(job%worker)/job%factor%tasks%work))
   end subroutine tell

   !> Make the panel of a supernode and its update, and drop the updates it has taken.
   recursive subroutine work_on(s, task, job, worker)
      integer, intent(in) :: s, task
      type(job_t), intent(inout), target :: job
      type(worker_t), intent(inout), target :: worker
      type(front_t) :: front
      integer :: failed

      call begin_front(s, task, job, worker, front)
      call take_entries(front)
      call take_updates(task, job, worker, front)
      associate (rows => front%rows, columns => front%columns)
         call eliminate(rows, columns, front%panel, worker%square, failed)
         if (failed /= 0) then
            job%failed(task) = front%pattern%first(s) + failed - 1
            return
         end if
         call pass_updates(task, job, worker, front)
         worker%done = worker%done + work_of(rows, columns)
         if (rows == columns) return
      end associate
      if (.not. is_kept(s, task, job)) then
         job%at(s) = worker%filled + 1
         worker%filled = worker%filled + update_size(front%pattern, s)
      end if
      front%update => update_of(s, task, job, worker)
      call pack_update(front)
   end subroutine work_on

   recursive subroutine begin_front(s, task, job, worker, front)
      integer, intent(in) :: s, task
      type(job_t), intent(inout), target :: job
      type(worker_t), intent(inout), target :: worker
      type(front_t), intent(out) :: front
      integer :: i

      front%s = s
      front%pattern => job%factor%pattern
      front%matrix => job%matrix
      if (task == 0) front%threads = size(job%worker)
      associate (pattern => front%pattern)
         front%rows = rows_in(pattern, s)
         front%columns = columns_in(pattern, s)
         front%panel => job%factor%value(pattern%panel(s):pattern%panel(s + 1) - 1)
         front%square => worker%square
         front%place_in => worker%place_in
         front%map => worker%map
         do i = 1, front%rows
            worker%place_in(pattern%row(pattern%rows_from(s) + i - 1)) = i
         end do
      end associate
   end subroutine begin_front

   !> Add what the supernodes below left for the columns of a front.
   recursive subroutine take_updates(task, job, worker, front)
      integer, intent(in) :: task
      type(job_t), intent(inout), target :: job
      type(worker_t), intent(inout), target :: worker
      type(front_t), intent(inout) :: front
      integer :: c

      c = job%factor%tasks%child(front%s)
      do while (c /= 0)
         call find_map(job%factor%pattern, c, worker, front%below)
         front%update => update_of(c, task, job, worker)
         call add_to_panel(front)
         c = job%factor%tasks%sibling(c)
      end do
   end subroutine take_updates

   !> Add what they left for rows below the front to its own update, and drop them.
   recursive subroutine pass_updates(task, job, worker, front)
      integer, intent(in) :: task
      type(job_t), intent(inout), target :: job
      type(worker_t), intent(inout), target :: worker
      type(front_t), intent(inout) :: front
      integer :: c

      c = job%factor%tasks%child(front%s)
      do while (c /= 0)
         call find_map(job%factor%pattern, c, worker, front%below)
         front%update => update_of(c, task, job, worker)
         call add_to_square(front)
         if (.not. is_kept(c, task, job)) worker%filled = worker%filled - update_size(job%factor%pattern, c)
         c = job%factor%tasks%sibling(c)
      end do
   end subroutine pass_updates

   !> Where the rows of the update of c stand in the panel at work.
   pure recursive subroutine find_map(pattern, c, worker, below)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: c
      type(worker_t), intent(inout) :: worker
      integer, intent(out) :: below
      integer(long) :: from
      integer :: i

      below = rows_in(pattern, c) - columns_in(pattern, c)
      from = pattern%rows_from(c) + columns_in(pattern, c) - 1
      do i = 1, below
         worker%map(i) = worker%place_in(pattern%row(from + i))
      end do
   end subroutine find_map

   !> Whether supernode s, met at work on a task, is the last of a task, whose update is kept.
   pure recursive logical function is_kept(s, task, job)
      integer, intent(in) :: s, task
      type(job_t), intent(in) :: job

      associate (tasks => job%factor%tasks)
         is_kept = tasks%of_supernode(s) /= task
         if (task /= 0 .and. .not. is_kept) is_kept = tasks%root(task) == s
      end associate
   end function is_kept

   recursive function update_of(s, task, job, worker) result(update)
      integer, intent(in) :: s, task
      type(job_t), intent(in), target :: job
      type(worker_t), intent(in), target :: worker
      real(wp), pointer, contiguous :: update(:)
      integer(long) :: to

      to = job%at(s) + update_size(job%factor%pattern, s) - 1
      if (is_kept(s, task, job)) then
         update => job%kept(job%at(s):to)
      else
         update => worker%stack(job%at(s):to)
      end if
   end function update_of
end module flexact_multifrontal
