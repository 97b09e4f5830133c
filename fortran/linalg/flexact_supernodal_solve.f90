! SPDX-License-Identifier: BSD-3-Clause
!> Solutions with a sparse Cholesky factor, several right-hand sides side by side. Subtrees are
!> worked on side by side; what stands above them panel by panel, large ones by all threads.
module flexact_supernodal_solve
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_blas, only: blas_share, blas_unshare
   use flexact_cholesky, only: cholesky_t
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp, long
   use flexact_panel_solve, only: panel_t, divide
   use flexact_supernodal_pattern, only: supernodal_t, columns_in, rows_in
   use flexact_threads, only: run_tasks
   implicit none
   private
   public :: solve

   !> Right-hand sides that are taken together, and multiplications in a supernode from which BLAS
   !> is quicker than plain loops.
   integer, parameter :: together = 16
   integer, parameter :: worth_blas = 2000
   !> Right-hand sides that plain loops take at a time.
   integer, parameter :: lanes = 4

   !> The rows of one supernode (rows, k); and where the rows above a task stand among those that
   !> it leaves something for.
   type :: worker_t
      real(wp), allocatable :: some(:)
      integer, allocatable :: place(:)
   end type worker_t

   !> What a task takes from rows above it (k, rows).
   type :: left_t
      real(wp), allocatable :: value(:, :)
   end type left_t

   type :: job_t
      type(cholesky_t), pointer :: factor => null()
      !> Right-hand sides (n, k), and the same side by side (padded(k), n), in the order of elimination.
      real(wp), pointer, contiguous :: x(:, :) => null()
      integer :: k = together
      real(wp), allocatable :: all(:)
      type(worker_t), allocatable :: worker(:)
      type(left_t), allocatable :: left(:)
   end type job_t

contains

   !> Solve L L' x = b in place, column by column.
   subroutine solve(factor, x, error)
      type(cholesky_t), intent(in), target :: factor
      real(wp), intent(inout), target, contiguous :: x(:, :)
      type(error_t), allocatable, intent(out) :: error
      type(job_t), target :: job
      integer :: first, last, info

      if (size(x) == 0) return
      job%factor => factor
      do first = 1, size(x, 2), together
         last = min(first + together - 1, size(x, 2))
         call make_room(job, last - first + 1, info)
         if (info /= 0) then
            call fail(error_memory, error)
            return
         end if
         job%x => x(:, first:last)
         call on_all_tasks(job, forward_in)
         call work_above(job)
         call on_all_tasks(job, backward_in)
      end do
   end subroutine solve

   !> For k right-hand sides.
   subroutine make_room(job, k, info)
      type(job_t), intent(inout) :: job
      integer, intent(in) :: k
      integer, intent(out) :: info
      integer :: i, t, root

      info = 0
      if (allocated(job%all) .and. k == job%k) return
      if (allocated(job%all)) deallocate (job%all, job%worker, job%left)
      job%k = k
      associate (factor => job%factor)
         allocate (job%all(int(factor%n, long)*padded(k)), job%worker(factor%threads), job%left(factor%tasks%count), stat=info)
         do i = 1, factor%threads
            if (info == 0) allocate (job%worker(i)%some(int(factor%widest, long)*together), &
                                     job%worker(i)%place(factor%n), stat=info)
         end do
         do t = 1, factor%tasks%count
            root = factor%tasks%root(t)
            associate (left => rows_in(factor%pattern, root) - columns_in(factor%pattern, root))
               if (info == 0) allocate (job%left(t)%value(padded(k), left), stat=info)
            end associate
         end do
      end associate
   end subroutine make_room

   subroutine on_all_tasks(job, work)
      type(job_t), intent(inout), target :: job
      interface
         recursive subroutine work(task, worker, data) bind(c)
            import :: c_int, c_ptr
            integer(c_int), value :: task, worker
            type(c_ptr), value :: data
         end subroutine work
      end interface

      call blas_share()
      call run_tasks(int(job%factor%tasks%count, c_int), int(job%factor%threads, c_int), c_funloc(work), c_loc(job))
      call blas_unshare()
   end subroutine on_all_tasks

   recursive subroutine forward_in(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(job_t), pointer :: job
      integer :: i, s, root, last

      call c_f_pointer(data, job)
      associate (pattern => job%factor%pattern, own => job%worker(worker), left => job%left(task)%value)
         root = job%factor%tasks%root(task)
         last = pattern%first(root + 1) - 1
         left = 0.0_wp
         call take(job%factor, job%factor%tasks%from(task), root, job%x, job%all)
         do i = 1, size(left, 2)
            own%place(pattern%row(pattern%rows_from(root + 1) - size(left, 2) + i - 1)) = i
         end do
         do s = job%factor%tasks%from(task), root
            call forward(pattern, s, last, job%k, 1, job%factor%value, own%place, own%some, job%all, left)
         end do
      end associate
   end subroutine forward_in

   recursive subroutine backward_in(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(job_t), pointer :: job
      integer :: s

      call c_f_pointer(data, job)
      associate (pattern => job%factor%pattern)
         do s = job%factor%tasks%root(task), job%factor%tasks%from(task), -1
            call backward(pattern, s, job%k, 1, job%factor%value, job%worker(worker)%some, job%all)
         end do
      end associate
      call give(job%factor, job%factor%tasks%from(task), job%factor%tasks%root(task), job%all, job%x)
   end subroutine backward_in

   !> What stands above the tasks, after what they have left for it, in their order.
   subroutine work_above(job)
      type(job_t), intent(inout) :: job
      integer :: s, t

      associate (pattern => job%factor%pattern, tasks => job%factor%tasks, own => job%worker(1))
         do s = 1, pattern%supernodes
            if (tasks%of_supernode(s) == 0) call take(job%factor, s, s, job%x, job%all)
         end do
         do t = 1, tasks%count
            call add_left(pattern, tasks%root(t), job%k, job%left(t)%value, job%all)
         end do
         do s = 1, pattern%supernodes
            if (tasks%of_supernode(s) == 0) &
               call forward(pattern, s, job%factor%n, job%k, job%factor%threads, job%factor%value, &
                            own%place, own%some, job%all, job%left(1)%value)
         end do
         do s = pattern%supernodes, 1, -1
            if (tasks%of_supernode(s) /= 0) cycle
            call backward(pattern, s, job%k, job%factor%threads, job%factor%value, own%some, job%all)
            call give(job%factor, s, s, job%all, job%x)
         end do
      end associate
   end subroutine work_above

   pure subroutine add_left(pattern, root, k, left, all)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: root, k
      real(wp), intent(in) :: left(:, :)
      real(wp), intent(inout) :: all(padded(k), *)
      integer :: i

      do i = 1, size(left, 2)
         associate (row => pattern%row(pattern%rows_from(root + 1) - size(left, 2) + i - 1))
            all(:, row) = all(:, row) + left(:, i)
         end associate
      end do
   end subroutine add_left

   !> So many with those that fill up the lanes, which are zero.
   pure recursive integer function padded(k)
      integer, intent(in) :: k
      padded = lanes*((k + lanes - 1)/lanes)
   end function padded

   !> The right-hand sides of supernodes from to root, side by side.
   pure recursive subroutine take(factor, from, root, x, all)
      type(cholesky_t), intent(in) :: factor
      integer, intent(in) :: from, root
      real(wp), intent(in) :: x(:, :)
      real(wp), intent(inout) :: all(padded(size(x, 2)), *)
      integer :: i

      do i = factor%pattern%first(from), factor%pattern%first(root + 1) - 1
         all(:size(x, 2), i) = x(factor%pattern%order(i), :)
         all(size(x, 2) + 1:, i) = 0.0_wp
      end do
   end subroutine take

   !> What has become of them.
   pure recursive subroutine give(factor, from, root, all, x)
      type(cholesky_t), intent(in) :: factor
      integer, intent(in) :: from, root
      real(wp), intent(inout) :: x(:, :)
      real(wp), intent(in) :: all(padded(size(x, 2)), *)
      integer :: i

      do i = factor%pattern%first(from), factor%pattern%first(root + 1) - 1
         x(factor%pattern%order(i), :) = all(:size(x, 2), i)
      end do
   end subroutine give

   !> Divide the places of supernode s by its diagonal block, and take its part from the rows below,
   !> those after `last` among what is left for them.
   recursive subroutine forward(pattern, s, last, k, threads, value, place, some, all, left)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, last, k, threads, place(:)
      real(wp), intent(in), target, contiguous :: value(:)
      real(wp), intent(inout), target, contiguous :: some(:)
      real(wp), intent(inout) :: all(padded(k), *), left(padded(k), *)

      associate (rows => rows_in(pattern, s), columns => columns_in(pattern, s))
         if (is_worth_blas(rows, columns, k)) then
            call take_some(pattern, s, rows, columns, k, all, some)
            call divide(panel_t(rows, columns, k, threads, .false., panel_of(pattern, s, value), some))
            call give_some(pattern, s, last, rows, columns, k, place, some, all, left)
         else
            call forward_by_loops(pattern, s, last, rows, columns, k, place, panel_of(pattern, s, value), some, all, left)
         end if
      end associate
   end subroutine forward

   recursive function panel_of(pattern, s, value) result(panel)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s
      real(wp), intent(in), target, contiguous :: value(:)
      real(wp), pointer, contiguous :: panel(:)
      panel => value(pattern%panel(s):pattern%panel(s + 1) - 1)
   end function panel_of

   pure recursive subroutine take_some(pattern, s, rows, columns, k, all, some)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, rows, columns, k
      real(wp), intent(in) :: all(padded(k), *)
      real(wp), intent(inout) :: some(rows, k)
      integer :: i

      do i = 1, columns
         some(i, :) = all(:k, pattern%first(s) + i - 1)
      end do
      some(columns + 1:, :) = 0.0_wp
   end subroutine take_some

   pure recursive subroutine give_some(pattern, s, last, rows, columns, k, place, some, all, left)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, last, rows, columns, k, place(:)
      real(wp), intent(in) :: some(rows, k)
      real(wp), intent(inout) :: all(padded(k), *), left(padded(k), *)
      integer :: i, row

      do i = 1, columns
         all(:k, pattern%first(s) + i - 1) = some(i, :)
      end do
      do i = columns + 1, rows
         row = pattern%row(pattern%rows_from(s) + i - 1)
         if (row <= last) then
            all(:k, row) = all(:k, row) + some(i, :)
         else
            left(:k, place(row)) = left(:k, place(row)) + some(i, :)
         end if
      end do
   end subroutine give_some

   !> A few right-hand sides at a time, so that as many sums are made side by side.
   pure recursive subroutine forward_by_loops(pattern, s, last, rows, columns, k, place, panel, some, all, left)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, last, rows, columns, k, place(:)
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(lanes, rows), all(padded(k), *), left(padded(k), *)
      real(wp) :: x(lanes)
      integer :: i, j, r, row

      do r = 1, k, lanes
         do i = 1, columns
            some(:, i) = all(r:r + lanes - 1, pattern%first(s) + i - 1)
         end do
         do i = columns + 1, rows
            some(:, i) = 0.0_wp
         end do
         do j = 1, columns
            x = some(:, j)/panel(j, j)
            some(:, j) = x
            do i = j + 1, rows
               some(:, i) = some(:, i) - x*panel(i, j)
            end do
         end do
         do i = 1, columns
            all(r:r + lanes - 1, pattern%first(s) + i - 1) = some(:, i)
         end do
         do i = columns + 1, rows
            row = pattern%row(pattern%rows_from(s) + i - 1)
            if (row <= last) then
               all(r:r + lanes - 1, row) = all(r:r + lanes - 1, row) + some(:, i)
            else
               left(r:r + lanes - 1, place(row)) = left(r:r + lanes - 1, place(row)) + some(:, i)
            end if
         end do
      end do
   end subroutine forward_by_loops

   !> Take the part of the rows below from the places of supernode s, and divide by the transpose.
   recursive subroutine backward(pattern, s, k, threads, value, some, all)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, k, threads
      real(wp), intent(in), target, contiguous :: value(:)
      real(wp), intent(inout), target, contiguous :: some(:)
      real(wp), intent(inout) :: all(padded(k), *)
      integer :: filled

      associate (rows => rows_in(pattern, s), columns => columns_in(pattern, s))
         if (is_worth_blas(rows, columns, k)) then
            ! BLAS is quicker with zeros that fill up than without.
            filled = merge(together, k, k > together/2)
            call take_all(pattern, s, rows, k, filled, all, some)
            call divide(panel_t(rows, columns, filled, threads, .true., panel_of(pattern, s, value), some))
            call give_first(pattern, s, columns, k, filled, some, all)
         else
            call backward_by_loops(pattern, s, rows, columns, k, panel_of(pattern, s, value), some, all)
         end if
      end associate
   end subroutine backward

   pure recursive subroutine take_all(pattern, s, rows, k, filled, all, some)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, rows, k, filled
      real(wp), intent(in) :: all(padded(k), *)
      real(wp), intent(inout) :: some(filled, rows)
      integer :: i

      do i = 1, rows
         some(:k, i) = all(:k, pattern%row(pattern%rows_from(s) + i - 1))
         some(k + 1:, i) = 0.0_wp
      end do
   end subroutine take_all

   pure recursive subroutine give_first(pattern, s, columns, k, filled, some, all)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, columns, k, filled
      real(wp), intent(in) :: some(filled, *)
      real(wp), intent(inout) :: all(padded(k), *)
      integer :: i

      do i = 1, columns
         all(:k, pattern%first(s) + i - 1) = some(:k, i)
      end do
   end subroutine give_first

   pure recursive subroutine backward_by_loops(pattern, s, rows, columns, k, panel, some, all)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, rows, columns, k
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(lanes, rows), all(padded(k), *)
      real(wp) :: x(lanes)
      integer :: i, j, r

      do r = 1, k, lanes
         do i = 1, rows
            some(:, i) = all(r:r + lanes - 1, pattern%row(pattern%rows_from(s) + i - 1))
         end do
         do j = columns, 1, -1
            x = 0.0_wp
            do i = j + 1, rows
               x = x + some(:, i)*panel(i, j)
            end do
            some(:, j) = (some(:, j) - x)/panel(j, j)
         end do
         do i = 1, columns
            all(r:r + lanes - 1, pattern%first(s) + i - 1) = some(:, i)
         end do
      end do
   end subroutine backward_by_loops

   pure recursive logical function is_worth_blas(rows, columns, k)
      integer, intent(in) :: rows, columns, k
      is_worth_blas = real(rows, wp)*columns*k >= worth_blas
   end function is_worth_blas
end module flexact_supernodal_solve
