! SPDX-License-Identifier: BSD-3-Clause
!> The motions that rigid rows leave, and least-norm answers to the rows.
module flexact_elastic_space
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_rows, only: rows_t
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgesdd
   implicit none
   private
   public :: space_t, make_space, reduced, expanded, answer, multipliers_of

   !> Rows are J; all with rotations times a length, and rows about angles over it.
   type :: space_t
      integer :: motions = 0
      integer :: rank = 0
      !> (3 nodes, motions).
      real(wp), allocatable :: basis(:, :)
      !> Rows times their lengths: left (rows, rank), values, right (3 nodes, rank).
      real(wp), allocatable :: left(:, :), singular(:), right(:, :)
      logical, allocatable :: is_free(:)
   end type space_t

contains

   !> tolerance: singular values up to this part of the largest count as zero.
   subroutine make_space(elastic, rows, tolerance, space)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      real(wp), intent(in) :: tolerance
      type(space_t), intent(inout) :: space
      real(wp), allocatable :: j(:, :), u(:, :), vt(:, :), s(:), work(:), weight(:)
      integer, allocatable :: iwork(:), column(:), free(:)
      integer :: n, i, r, info, m

      space%is_free = elastic%is_free
      n = count(elastic%is_free)
      m = rows%count
      free = pack([(i, i=1, size(elastic%is_free))], elastic%is_free)
      allocate (column(size(elastic%is_free)), source=0)
      column(free) = [(i, i=1, n)]
      weight = row_weights(elastic, rows)
      allocate (j(m, n), source=0.0_wp)
      do r = 1, m
         do i = 1, 12
            if (rows%entry(i, r) == 0) cycle
            associate (e => rows%entry(i, r))
               if (column(e) > 0) j(r, column(e)) = j(r, column(e)) + weight(r)*rows%value(i, r)/elastic%scale(e)
            end associate
         end do
      end do
      allocate (u(m, m), vt(n, n), s(max(1, min(m, n))), iwork(8*max(1, min(m, n))), work(1))
      s = 0.0_wp
      if (m > 0 .and. n > 0) then
         call dgesdd('A', m, n, j, m, s, u, m, vt, n, work, -1, iwork, info)
         i = int(work(1))
         deallocate (work)
         allocate (work(i))
         call dgesdd('A', m, n, j, m, s, u, m, vt, n, work, i, iwork, info)
      else
         vt = 0.0_wp
         do i = 1, n
            vt(i, i) = 1.0_wp
         end do
      end if
      space%rank = count(s > tolerance*max(1.0_wp, maxval(s)))
      space%motions = n - space%rank
      if (allocated(space%basis)) deallocate (space%basis, space%left, space%right)
      allocate (space%basis(size(column), space%motions), space%right(size(column), space%rank), source=0.0_wp)
      space%left = u(:, :space%rank)
      do i = 1, space%rank
         space%left(:, i) = space%left(:, i)*weight
      end do
      space%singular = s(:space%rank)
      do i = 1, n
         space%right(free(i), :) = vt(:space%rank, i)/elastic%scale(free(i))
         space%basis(free(i), :) = vt(space%rank + 1:, i)/elastic%scale(free(i))
      end do
   end subroutine make_space

   !> Rows of lengths have about unit norm; those of angles are multiplied by the length.
   pure function row_weights(elastic, rows) result(weight)
      type(elastic_model_t), intent(in) :: elastic
      type(rows_t), intent(in) :: rows
      real(wp) :: weight(rows%count)
      integer :: r, i

      do r = 1, rows%count
         weight(r) = elastic%length
         do i = 1, size(rows%entry, 1)
            if (rows%entry(i, r) == 0) cycle
            if (abs(rows%value(i, r)) > 0 .and. elastic%scale(rows%entry(i, r)) == 1.0_wp) weight(r) = 1.0_wp
         end do
      end do
   end function row_weights

   !> Z' f.
   pure function reduced(space, f) result(y)
      type(space_t), intent(in) :: space
      real(wp), intent(in) :: f(:)
      real(wp) :: y(space%motions)
      y = matmul(f, space%basis)
   end function reduced

   !> Z y.
   pure function expanded(space, y) result(v)
      type(space_t), intent(in) :: space
      real(wp), intent(in) :: y(:)
      real(wp) :: v(size(space%basis, 1))
      v = matmul(space%basis, y)
   end function expanded

   !> The least motion of free coordinates with J v = c, as far as there is one.
   pure function answer(space, c) result(v)
      type(space_t), intent(in) :: space
      real(wp), intent(in) :: c(:)
      real(wp) :: v(size(space%basis, 1))
      v = matmul(space%right, matmul(c, space%left)/space%singular)
   end function answer

   !> The least multipliers with J' m = f on free coordinates, as far as there are any.
   pure function multipliers_of(space, elastic, f) result(m)
      type(space_t), intent(in) :: space
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: f(:)
      real(wp) :: m(size(space%left, 1))
      m = matmul(space%left, matmul(f, space%right)/space%singular)
   end function multipliers_of
end module flexact_elastic_space
