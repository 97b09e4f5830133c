! SPDX-License-Identifier: BSD-3-Clause
!> The bound of flexact_backward_error for a supernodal factor, side by side for parts of it:
!> no column of |L| has to wait for another.
module flexact_cholesky_error
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_backward_error, only: unit, extra, rounds
   use flexact_blas, only: blas_share, blas_unshare
   use flexact_cholesky, only: cholesky_t
   use flexact_kinds, only: wp, long
   use flexact_lapack, only: dgemv
   use flexact_supernodal_pattern, only: columns_in, rows_in
   use flexact_threads, only: run_tasks
   implicit none
   private
   public :: error_of_cholesky

   !> Columns whose magnitudes stand in the cache of a processor.
   integer, parameter :: together = 32

   !> Supernodes from(1) to from(2), what they bring forth of the product, and room for one.
   type :: part_t
      integer :: from(2) = 0
      real(wp), allocatable :: z(:), taken(:), given(:), magnitude(:)
   end type part_t

   type :: job_t
      type(cholesky_t), pointer :: factor => null()
      real(wp), allocatable :: x(:)
      type(part_t), allocatable :: part(:)
   end type job_t

contains

   !> Infinite where memory does not suffice. enough: no better bound than this is sought.
   real(wp) function error_of_cholesky(factor, enough) result(bound)
      type(cholesky_t), intent(in), target :: factor
      real(wp), intent(in) :: enough
      type(job_t), target :: job
      real(wp), allocatable :: w(:), z(:)
      integer :: round, info

      bound = huge(bound)
      if (factor%n == 0) bound = 0.0_wp
      if (factor%n == 0) return
      job%factor => factor
      allocate (w(factor%n), z(factor%n), job%x(factor%n), stat=info)
      if (info == 0) call make_parts(job, info)
      if (info /= 0) return
      call count_in_rows(factor, w)
      w = (w + extra)*unit
      w = w/(1 - w)
      job%x = w
      do round = 1, rounds
         call multiply_twice(job, z)
         z = w*z
         bound = min(bound, maxval(z/job%x))
         if (.not. all(z <= huge(bound))) bound = huge(bound)
         if (bound <= enough) exit
         job%x = z
      end do
   end function error_of_cholesky

   !> A part for each thread, with about as many entries.
   subroutine make_parts(job, info)
      type(job_t), intent(inout) :: job
      integer, intent(out) :: info
      real(wp) :: share
      integer :: t, s

      associate (factor => job%factor, pattern => job%factor%pattern)
         allocate (job%part(factor%threads), stat=info)
         if (info /= 0) return
         share = real(pattern%panel(pattern%supernodes + 1) - 1, wp)/factor%threads
         s = 0
         do t = 1, factor%threads
            associate (part => job%part(t))
               part%from(1) = s + 1
               do while (s < pattern%supernodes)
                  if (t < factor%threads .and. pattern%panel(s + 1) - 1 >= t*share) exit
                  s = s + 1
               end do
               part%from(2) = s
               allocate (part%z(factor%n), part%taken(factor%widest), part%given(factor%widest), &
                         part%magnitude(int(factor%widest, long)*together), stat=info)
               if (info /= 0) return
            end associate
         end do
      end associate
   end subroutine make_parts

   !> Entries of L in each of its rows, zeros that pad a supernode with them.
   pure subroutine count_in_rows(factor, count)
      type(cholesky_t), intent(in) :: factor
      real(wp), intent(out) :: count(:)
      integer :: s, i

      count = 0.0_wp
      associate (pattern => factor%pattern)
         do s = 1, pattern%supernodes
            do i = 1, rows_in(pattern, s)
               associate (row => pattern%row(pattern%rows_from(s) + i - 1))
                  count(row) = count(row) + min(i, columns_in(pattern, s))
               end associate
            end do
         end do
      end associate
   end subroutine count_in_rows

   !> z = |L| |L'| x, the parts in their order.
   subroutine multiply_twice(job, z)
      type(job_t), intent(inout), target :: job
      real(wp), intent(out) :: z(:)
      integer :: t

      call blas_share()
      call run_tasks(int(size(job%part), c_int), int(size(job%part), c_int), c_funloc(multiply_part), c_loc(job))
      call blas_unshare()
      z = job%part(1)%z
      do t = 2, size(job%part)
         z = z + job%part(t)%z
      end do
   end subroutine multiply_twice

   recursive subroutine multiply_part(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(job_t), pointer :: job
      integer :: s, i, rows

      call c_f_pointer(data, job)
      associate (pattern => job%factor%pattern, part => job%part(task))
         part%z = 0.0_wp
         do s = part%from(1), part%from(2)
            rows = rows_in(pattern, s)
            associate (row => pattern%row(pattern%rows_from(s):pattern%rows_from(s + 1) - 1))
               do i = 1, rows
                  part%taken(i) = job%x(row(i))
               end do
               call multiply_panel(rows, columns_in(pattern, s), job%factor%value(pattern%panel(s)), part%taken, &
                                   part%magnitude, part%given)
               do i = 1, rows
                  part%z(row(i)) = part%z(row(i)) + part%given(i)
               end do
            end associate
         end do
      end associate
   end subroutine multiply_part

   pure recursive subroutine multiply_panel(rows, columns, panel, from, magnitude, to)
      integer, intent(in) :: rows, columns
      real(wp), intent(in) :: panel(rows, columns), from(rows)
      real(wp), intent(inout) :: magnitude(*)
      real(wp), intent(out) :: to(rows)
      real(wp) :: total(together)
      integer :: first, some, below

      to = 0.0_wp
      do first = 1, columns, together
         some = min(together, columns - first + 1)
         below = rows - first + 1
         call take_magnitudes(rows, columns, panel, first, below, some, magnitude)
         call dgemv('T', below, some, 1.0_wp, magnitude, below, from(first), 1, 0.0_wp, total, 1)
         call dgemv('N', below, some, 1.0_wp, magnitude, below, total, 1, 1.0_wp, to(first), 1)
      end do
   end subroutine multiply_panel

   !> Of some columns, from the diagonal down.
   pure recursive subroutine take_magnitudes(rows, columns, panel, first, below, some, magnitude)
      integer, intent(in) :: rows, columns, first, below, some
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: magnitude(below, some)
      integer :: i, j

      do j = 1, some
         magnitude(:j - 1, j) = 0.0_wp
         do i = j, below
            magnitude(i, j) = abs(panel(first + i - 1, first + j - 1))
         end do
      end do
   end subroutine take_magnitudes
end module flexact_cholesky_error
