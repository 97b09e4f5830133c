! SPDX-License-Identifier: BSD-3-Clause
!> One step of the multifrontal Cholesky factorisation (Duff and Reid, ACM Trans. Math. Softw.
!> 9, 1983, pp. 302-325): the panel of a supernode and its update of what comes after, which is
!> made in a square and waits as a lower triangle, column by column.
module flexact_front
   use flexact_kinds, only: wp, long
   use flexact_lapack, only: dpotrf, dsyrk, dtrsm
   implicit none
   private
   public :: eliminate, add_to_panel, add_to_square, pack_triangle

contains

   !> Factorise the columns of a panel (rows, columns), and make what follows of them for the rows
   !> below: square = -L L', its lower triangle. failed: the first column whose pivot is not positive and finite, or 0.
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

   !> Add what an update says of the columns of a panel (rows, columns). map: where its rows stand.
   pure recursive subroutine add_to_panel(below, update, map, rows, columns, panel)
      integer, intent(in) :: below, map(below), rows, columns
      real(wp), intent(in), contiguous :: update(:)
      real(wp), intent(inout) :: panel(rows, columns)
      integer(long) :: at
      integer :: i, j

      at = 0
      do j = 1, below
         if (map(j) > columns) return
         do i = j, below
            panel(map(i), map(j)) = panel(map(i), map(j)) + update(at + i)
         end do
         at = at + below - j
      end do
   end subroutine add_to_panel

   !> The same of what lies below the panel: add it to the square (side, side) of those rows.
   pure recursive subroutine add_to_square(below, update, map, columns, side, square)
      integer, intent(in) :: below, map(below), columns, side
      real(wp), intent(in), contiguous :: update(:)
      real(wp), intent(inout) :: square(side, side)
      integer(long) :: at
      integer :: i, j, tail, first

      ! Rows from `tail` on stand side by side there too.
      tail = below
      do while (tail > 1)
         if (map(tail - 1) /= map(tail) - 1) exit
         tail = tail - 1
      end do
      at = 0
      do j = 1, below
         if (map(j) > columns) then
            do i = j, tail - 1
               square(map(i) - columns, map(j) - columns) = square(map(i) - columns, map(j) - columns) + update(at + i)
            end do
            first = max(j, tail)
            do i = 0, below - first
               square(map(first) - columns + i, map(j) - columns) = square(map(first) - columns + i, map(j) - columns) &
                                                                    + update(at + first + i)
            end do
         end if
         at = at + below - j
      end do
   end subroutine add_to_square

   !> The lower triangle of a square, column by column.
   pure recursive subroutine pack_triangle(side, square, triangle)
      integer, intent(in) :: side
      real(wp), intent(in) :: square(side, side)
      real(wp), intent(inout), contiguous :: triangle(:)
      integer(long) :: at
      integer :: i, j

      at = 0
      do j = 1, side
         do i = j, side
            triangle(at + i) = square(i, j)
         end do
         at = at + side - j
      end do
   end subroutine pack_triangle
end module flexact_front
