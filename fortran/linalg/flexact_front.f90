! SPDX-License-Identifier: BSD-3-Clause
!> One step of the multifrontal Cholesky factorisation (Duff and Reid, ACM Trans. Math. Softw.
!> 9, 1983, pp. 302-325): the panel of a supernode and its update of what comes after, which is
!> made in a square and waits as a lower triangle, column by column. What goes column by column
!> is done side by side where a front is large and threads are at hand.
module flexact_front
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_kinds, only: wp, long
   use flexact_lapack, only: dpotrf, dsyrk, dtrsm
   use flexact_supernodal_pattern, only: supernodal_t
   use flexact_threads, only: run_tasks
   implicit none
   private
   public :: front_t, take_entries, eliminate, add_to_panel, add_to_square, pack_update

   !> Entries from which threads are worth their start; and pieces for each: columns differ in length.
   real(wp), parameter :: worth_threads = 2.0e5_wp
   integer, parameter :: pieces = 4
   !> What is done with columns.
   integer, parameter :: taking = 1, to_panel = 2, to_square = 3, packing = 4

   type :: front_t
      integer :: s = 0, rows = 0, columns = 0, threads = 1
      type(supernodal_t), pointer :: pattern => null()
      !> Entries of the matrix, the panel (rows, columns), and the square of the rows below.
      real(wp), pointer, contiguous :: matrix(:) => null(), panel(:) => null(), square(:) => null()
      !> Where each row of the matrix stands in the panel.
      integer, pointer, contiguous :: place_in(:) => null()
      !> An update of so many rows, and where they stand in the panel or below it.
      integer :: below = 0
      integer, pointer, contiguous :: map(:) => null()
      real(wp), pointer, contiguous :: update(:) => null()
      integer, private :: work = 0, count = 0
   end type front_t

contains

   !> The entries of the matrix in the columns of the panel, and zeros.
   recursive subroutine take_entries(front)
      type(front_t), intent(inout), target :: front
      call on_columns(front, taking, front%columns, front%rows)
   end subroutine take_entries

   !> Add what the update says of the columns of the panel.
   recursive subroutine add_to_panel(front)
      type(front_t), intent(inout), target :: front
      call on_columns(front, to_panel, front%below, front%below)
   end subroutine add_to_panel

   !> The same of what lies below the panel: add it to the square of those rows.
   recursive subroutine add_to_square(front)
      type(front_t), intent(inout), target :: front
      call on_columns(front, to_square, front%below, front%below)
   end subroutine add_to_square

   !> Keep the lower triangle of the square as the update.
   recursive subroutine pack_update(front)
      type(front_t), intent(inout), target :: front
      front%below = front%rows - front%columns
      call on_columns(front, packing, front%below, front%below)
   end subroutine pack_update

   !> Factorise the columns of the panel, and make what follows of them for the rows below:
   !> square = -L L', its lower triangle. failed: the first column whose pivot is not positive and finite, or 0.
   recursive subroutine eliminate(rows, columns, panel, square, failed)
      integer, intent(in) :: rows, columns
      real(wp), intent(inout) :: panel(rows, columns), square(rows - columns, rows - columns)
      integer, intent(out) :: failed
      integer :: j, below

      below = rows - columns
      call dpotrf('L', columns, panel, rows, failed)
      if (failed /= 0) return
      do j = 1, columns
         if (panel(j, j) > 0 .and. panel(j, j) <= huge(1.0_wp)) cycle
         failed = j
         return
      end do
      if (below == 0) return
      call dtrsm('R', 'L', 'T', 'N', below, columns, 1.0_wp, panel, rows, panel(columns + 1, 1), rows)
      call dsyrk('L', 'N', below, columns, -1.0_wp, panel(columns + 1, 1), rows, 0.0_wp, square, below)
   end subroutine eliminate

   recursive subroutine on_columns(front, work, count, length)
      type(front_t), intent(inout), target :: front
      integer, intent(in) :: work, count, length

      front%work = work
      front%count = count
      if (front%threads > 1 .and. real(count, wp)*length > worth_threads) then
         call run_tasks(int(pieces*front%threads, c_int), int(front%threads, c_int), c_funloc(on_piece), c_loc(front))
      else
         call on_some(front, 1, count)
      end if
   end subroutine on_columns

   recursive subroutine on_piece(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(front_t), pointer :: front
      integer(long) :: all

      call c_f_pointer(data, front)
      all = pieces*front%threads
      ! No worker has anything of its own.
      if (worker > 0) call on_some(front, int((task - 1)*front%count/all) + 1, int(task*front%count/all))
   end subroutine on_piece

   recursive subroutine on_some(f, first, last)
      type(front_t), intent(in) :: f
      integer, intent(in) :: first, last

      select case (f%work)
      case (taking)
         call take(f%pattern, f%s, f%matrix, f%place_in, f%rows, f%panel, first, last)
      case (to_panel)
         call add_columns_of_panel(f%below, f%update, f%map, f%rows, f%columns, f%panel, first, last)
      case (to_square)
         call add_columns_below(f%below, f%update, f%map, f%columns, f%rows - f%columns, f%square, first, last)
      case (packing)
         call pack_columns(f%below, f%square, f%update, first, last)
      end select
   end subroutine on_some

   pure recursive subroutine take(pattern, s, matrix, place_in, rows, panel, first, last)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s, place_in(:), rows, first, last
      real(wp), intent(in) :: matrix(:)
      real(wp), intent(inout) :: panel(rows, *)
      integer :: j, e

      do j = first, last
         panel(j:rows, j) = 0.0_wp
         do e = pattern%entry_from(pattern%first(s) + j - 1), pattern%entry_from(pattern%first(s) + j) - 1
            panel(place_in(pattern%entry_row(e)), j) = matrix(pattern%entry(e))
         end do
      end do
   end subroutine take

   !> What stands before column j of a packed triangle, so that row i of it is at that + i.
   pure recursive integer(long) function before(side, j)
      integer, intent(in) :: side, j
      before = (j - 1)*int(side, long) - (j - 1)*int(j, long)/2
   end function before

   pure recursive subroutine add_columns_of_panel(below, update, map, rows, columns, panel, first, last)
      integer, intent(in) :: below, map(below), rows, columns, first, last
      real(wp), intent(in), contiguous :: update(:)
      real(wp), intent(inout) :: panel(rows, columns)
      integer(long) :: at
      integer :: i, j

      do j = first, last
         if (map(j) > columns) return
         at = before(below, j)
         do i = j, below
            panel(map(i), map(j)) = panel(map(i), map(j)) + update(at + i)
         end do
      end do
   end subroutine add_columns_of_panel

   pure recursive subroutine add_columns_below(below, update, map, columns, side, square, first, last)
      integer, intent(in) :: below, map(below), columns, side, first, last
      real(wp), intent(in), contiguous :: update(:)
      real(wp), intent(inout) :: square(side, side)
      integer(long) :: at
      integer :: i, j, tail, from

      ! Rows from `tail` on stand side by side there too.
      tail = below
      do while (tail > 1)
         if (map(tail - 1) /= map(tail) - 1) exit
         tail = tail - 1
      end do
      do j = first, last
         if (map(j) <= columns) cycle
         at = before(below, j)
         do i = j, tail - 1
            square(map(i) - columns, map(j) - columns) = square(map(i) - columns, map(j) - columns) + update(at + i)
         end do
         from = max(j, tail)
         do i = 0, below - from
            square(map(from) - columns + i, map(j) - columns) = square(map(from) - columns + i, map(j) - columns) &
                                                                + update(at + from + i)
         end do
      end do
   end subroutine add_columns_below

   pure recursive subroutine pack_columns(side, square, triangle, first, last)
      integer, intent(in) :: side, first, last
      real(wp), intent(in) :: square(side, side)
      real(wp), intent(inout), contiguous :: triangle(:)
      integer(long) :: at
      integer :: i, j

      do j = first, last
         at = before(side, j)
         do i = j, side
            triangle(at + i) = square(i, j)
         end do
      end do
   end subroutine pack_columns
end module flexact_front
