! SPDX-License-Identifier: BSD-3-Clause
!> Solutions with one panel of a supernodal Cholesky factor, several right-hand sides side by side.
!> Half the time goes into reading the panel; so a large one is read by all threads, where they are
!> at hand, and is not copied first, as BLAS does with large matrices.
module flexact_panel_solve
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_funloc, c_int, c_loc, c_ptr
   use flexact_blas, only: blas_share, blas_unshare
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm, dtrsm
   use flexact_threads, only: run_tasks, piece
   implicit none
   private
   public :: panel_t, divide

   !> Columns of a panel that are taken together; and multiplications up to which some BLAS do not
   !> copy matrices before they multiply them.
   integer, parameter :: abreast = 16, narrowest = 8, at_once = 900000
   !> Entries from which threads are worth their start.
   real(wp), parameter :: worth_threads = 5.0e5_wp

   !> A panel (rows, columns), and the right-hand sides of its rows: (rows, k), or for a division by
   !> the transpose (k, rows).
   type :: panel_t
      integer :: rows = 0, columns = 0, k = 0, threads = 1
      logical :: by_transpose = .false.
      real(wp), pointer, contiguous :: value(:) => null(), some(:) => null()
   end type panel_t

contains

   !> Divide the first rows by the diagonal block, and take their part from the others; by the
   !> transpose: take the part of the others from the first, and divide those.
   recursive subroutine divide(panel)
      type(panel_t), intent(in), target :: panel

      if (.not. panel%by_transpose) call divide_first(panel%rows, panel%columns, panel%k, panel%value, panel%some)
      if (panel%threads > 1 .and. real(panel%rows - panel%columns, wp)*panel%columns > worth_threads) then
         call blas_share()
         call run_tasks(int(panel%threads, c_int), int(panel%threads, c_int), c_funloc(take_piece), c_loc(panel))
         call blas_unshare()
      else
         call take_part(panel, 1, 1)
      end if
      if (panel%by_transpose) call divide_last(panel%rows, panel%columns, panel%k, panel%value, panel%some)
   end subroutine divide

   recursive subroutine take_piece(task, worker, data) bind(c)
      integer(c_int), value :: task, worker
      type(c_ptr), value :: data
      type(panel_t), pointer :: panel

      call c_f_pointer(data, panel)
      if (worker >= 1) call take_part(panel, int(task), panel%threads)
   end subroutine take_piece

   !> One of so many parts of what is taken.
   recursive subroutine take_part(panel, part, parts)
      type(panel_t), intent(in) :: panel
      integer, intent(in) :: part, parts
      integer :: ends(2)

      associate (rows => panel%rows, columns => panel%columns)
         if (panel%by_transpose) then
            ends = piece(columns, part, parts)
            call take_from_below(rows, columns, panel%k, panel%value, panel%some, ends(1), ends(2))
         else
            ends = columns + piece(rows - columns, part, parts)
            call take_below(rows, columns, panel%k, panel%value, panel%some, ends(1), ends(2))
         end if
      end associate
   end subroutine take_part

   pure recursive subroutine divide_first(rows, columns, k, panel, some)
      integer, intent(in) :: rows, columns, k
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(rows, k)
      integer :: j, c, next

      do j = 1, columns, abreast
         c = min(abreast, columns - j + 1)
         next = j + c
         call dtrsm('L', 'L', 'N', 'N', c, k, 1.0_wp, panel(j, j), rows, some(j, 1), rows)
         if (next <= columns) call dgemm('N', 'N', columns - next + 1, k, c, -1.0_wp, panel(next, j), rows, some(j, 1), rows, &
                                         1.0_wp, some(next, 1), rows)
      end do
   end subroutine divide_first

   !> Of rows first to last.
   pure recursive subroutine take_below(rows, columns, k, panel, some, first, last)
      integer, intent(in) :: rows, columns, k, first, last
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(rows, k)
      integer :: i, j, c, step

      do j = 1, columns, abreast
         c = min(abreast, columns - j + 1)
         step = at_once/(k*c)
         do i = first, last, step
            call dgemm('N', 'N', min(step, last - i + 1), k, c, -1.0_wp, panel(i, j), rows, some(j, 1), rows, &
                       1.0_wp, some(i, 1), rows)
         end do
      end do
   end subroutine take_below

   !> From columns first to last.
   pure recursive subroutine take_from_below(rows, columns, k, panel, some, first, last)
      integer, intent(in) :: rows, columns, k, first, last
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(k, rows)
      integer :: j, c, below

      below = rows - columns
      if (below == 0) return
      c = max(narrowest, min(2*abreast, at_once/(k*below)))
      do j = first, last, c
         call dgemm('N', 'N', k, min(c, last - j + 1), below, -1.0_wp, some(1, columns + 1), k, panel(columns + 1, j), rows, &
                    1.0_wp, some(1, j), k)
      end do
   end subroutine take_from_below

   pure recursive subroutine divide_last(rows, columns, k, panel, some)
      integer, intent(in) :: rows, columns, k
      real(wp), intent(in) :: panel(rows, columns)
      real(wp), intent(inout) :: some(k, rows)
      integer :: j, c, last

      last = columns
      do while (last > 0)
         c = min(last, max(narrowest, min(2*abreast, at_once/(k*(columns - last + 1)))))
         j = last - c + 1
         if (last < columns) call dgemm('N', 'N', k, c, columns - last, -1.0_wp, some(1, last + 1), k, panel(last + 1, j), &
                                        rows, 1.0_wp, some(1, j), k)
         call dtrsm('R', 'L', 'N', 'N', k, c, 1.0_wp, panel(j, j), rows, some(1, j), k)
         last = j - 1
      end do
   end subroutine divide_last
end module flexact_panel_solve
