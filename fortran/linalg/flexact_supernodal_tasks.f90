! SPDX-License-Identifier: BSD-3-Clause
!> How the supernodes of a factor are shared out: subtrees of the elimination tree know nothing
!> of each other, and what stands above them comes after.
module flexact_supernodal_tasks
   use flexact_kinds, only: wp, long
   use flexact_supernodal_pattern, only: supernodal_t, columns_in, rows_in
   implicit none
   private
   public :: tasks_t, make_tasks, update_size, work_of

   !> By how much one worker may have more to do than the mean, and tasks at most.
   real(wp), parameter :: uneven = 1.03_wp
   integer, parameter :: most_tasks = 128

   type :: tasks_t
      integer :: count = 0
      !> Supernodes from(t) to root(t), those with the most work first.
      integer, allocatable :: from(:), root(:)
      !> The task of each supernode, 0 above them all.
      integer, allocatable :: of_supernode(:)
      !> Those that a supernode is the first to be changed by, as a list.
      integer, allocatable :: child(:), sibling(:)
      !> Entries of the stack on which updates wait, and of the largest square in which one is
      !> made, for any of the tasks (1) and for what stands above them (0).
      integer(long) :: stack(0:1) = 0, square(0:1) = 0
      !> Entries of all updates of tasks, which wait for what stands above.
      integer(long) :: kept = 0
      !> Operations, about, of all.
      real(wp) :: work = 0.0_wp
   end type tasks_t

contains

   !> Entries of the update of supernode s, a lower triangle.
   pure recursive integer(long) function update_size(pattern, s)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s
      integer(long) :: below

      below = rows_in(pattern, s) - columns_in(pattern, s)
      update_size = below*(below + 1)/2
   end function update_size

   !> For so many workers. info: not 0 where memory does not suffice.
   subroutine make_tasks(pattern, workers, tasks, info)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: workers
      type(tasks_t), intent(out) :: tasks
      integer, intent(out) :: info
      real(wp), allocatable :: work(:)
      integer :: s, t, n

      n = pattern%supernodes
      allocate (tasks%from(most_tasks), tasks%root(most_tasks), tasks%of_supernode(n), tasks%child(0:n), &
                tasks%sibling(n), work(0:n), stat=info)
      if (info /= 0) return
      tasks%child = 0
      work = 0.0_wp
      do s = n, 1, -1
         tasks%sibling(s) = tasks%child(pattern%parent(s))
         tasks%child(pattern%parent(s)) = s
      end do
      do s = 1, n
         work(s) = work(s) + work_of(rows_in(pattern, s), columns_in(pattern, s))
         work(pattern%parent(s)) = work(pattern%parent(s)) + work(s)
      end do
      tasks%work = work(0)
      call cut(pattern, work, workers, tasks)
      tasks%of_supernode = 0
      do t = 1, tasks%count
         tasks%of_supernode(tasks%from(t):tasks%root(t)) = t
         tasks%kept = tasks%kept + update_size(pattern, tasks%root(t))
         call measure(pattern, tasks%from(t), tasks%root(t), t, tasks)
      end do
      call measure(pattern, 1, n, 0, tasks)
   end subroutine make_tasks

   !> Operations, about: what the numbers need, and what it costs to handle a supernode.
   pure recursive real(wp) function work_of(rows, columns)
      integer, intent(in) :: rows, columns
      real(wp) :: m, k

      m = rows
      k = columns
      work_of = k*m*m - k*k*m + k**3/3 + 10*m*m + 1000
   end function work_of

   !> Split the largest subtrees until the workers are evenly loaded.
   subroutine cut(pattern, work, workers, tasks)
      type(supernodal_t), intent(in) :: pattern
      real(wp), intent(in) :: work(0:)
      integer, intent(in) :: workers
      type(tasks_t), intent(inout) :: tasks
      integer :: s

      s = tasks%child(0)
      do while (s /= 0)
         call insert(s)
         s = tasks%sibling(s)
      end do
      if (workers > 1) then
         do while (.not. is_even())
            s = tasks%root(1)
            if (tasks%child(s) == 0) exit
            call remove_first()
            s = tasks%child(s)
            do while (s /= 0)
               call insert(s)
               s = tasks%sibling(s)
            end do
         end do
      end if
      do s = 1, tasks%count
         tasks%from(s) = first_below(tasks%root(s))
      end do
   contains
      !> Descending work; of more than there may be those with the least stay above.
      subroutine insert(s)
         integer, intent(in) :: s
         integer :: t

         if (tasks%count == most_tasks) then
            if (work(tasks%root(most_tasks)) >= work(s)) return
            tasks%count = most_tasks - 1
         end if
         t = tasks%count
         do while (t > 0)
            if (work(tasks%root(t)) >= work(s)) exit
            tasks%root(t + 1) = tasks%root(t)
            t = t - 1
         end do
         tasks%root(t + 1) = s
         tasks%count = tasks%count + 1
      end subroutine insert

      subroutine remove_first()
         integer :: t

         do t = 2, tasks%count
            tasks%root(t - 1) = tasks%root(t)
         end do
         tasks%count = tasks%count - 1
      end subroutine remove_first

      !> Each task goes to the worker who has the least to do so far.
      logical function is_even()
         real(wp) :: load(most_tasks)
         integer :: t, least, loaded

         loaded = min(workers, most_tasks)
         load(:loaded) = 0.0_wp
         do t = 1, tasks%count
            least = minloc(load(:loaded), 1)
            load(least) = load(least) + work(tasks%root(t))
         end do
         is_even = maxval(load(:loaded)) <= uneven*sum(load(:loaded))/loaded .or. tasks%count > most_tasks/2
      end function is_even

      integer function first_below(s)
         integer, intent(in) :: s

         first_below = s
         do while (tasks%child(first_below) /= 0)
            first_below = tasks%child(first_below)
         end do
      end function first_below
   end subroutine cut

   !> The room that the supernodes of task t need.
   subroutine measure(pattern, from, to, t, tasks)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: from, to, t
      type(tasks_t), intent(inout) :: tasks
      integer(long) :: filled
      integer :: s, c

      filled = 0
      associate (stack => tasks%stack(min(t, 1)), square => tasks%square(min(t, 1)))
         do s = from, to
            if (tasks%of_supernode(s) /= t) cycle
            square = max(square, int(rows_in(pattern, s) - columns_in(pattern, s), long)**2)
            c = tasks%child(s)
            do while (c /= 0)
               if (tasks%of_supernode(c) == t) filled = filled - update_size(pattern, c)
               c = tasks%sibling(c)
            end do
            if (s /= to .or. t == 0) filled = filled + update_size(pattern, s)
            stack = max(stack, filled)
         end do
      end associate
   end subroutine measure
end module flexact_supernodal_tasks
