! SPDX-License-Identifier: BSD-3-Clause
!> A few columns of a large matrix with all rows that they touch, as a matrix of
!> its own: what is found there costs as much as the neighbourhood, not as the whole.
module flexact_neighbourhood
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   use flexact_sparse, only: operator_t
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: neighbourhood_t, prepare, clear, spread_out, fill, image, keep

   !> A column that meets more rows than these is far from local, and would have all of
   !> them looked at from each place around it.
   integer, parameter :: most_rows = 1000

   !> A column and the columns around it, breadth first, pinned ones and those of very
   !> many rows left out.
   type :: neighbourhood_t
      integer :: columns = 0
      integer :: rows = 0
      !> The first column is the one that it is about.
      integer, allocatable :: column(:), row(:)
      !> Place in the neighbourhood of each row of the matrix, 0 outside.
      integer, allocatable :: place_of_row(:)
      logical, allocatable :: has_column(:)
   end type neighbourhood_t

contains

   !> Work space for any neighbourhood in A.
   subroutine prepare(a, near)
      type(operator_t), intent(in) :: a
      type(neighbourhood_t), intent(out) :: near

      allocate (near%column(a%by_column%columns), near%row(a%by_column%rows))
      allocate (near%place_of_row(a%by_column%rows), source=0)
      allocate (near%has_column(a%by_column%columns), source=.false.)
   end subroutine prepare

   pure subroutine clear(near)
      type(neighbourhood_t), intent(inout) :: near

      near%place_of_row(near%row(:near%rows)) = 0
      near%has_column(near%column(:near%columns)) = .false.
   end subroutine clear

   !> Gather up to `most` columns around one, and all rows that they touch.
   pure subroutine spread_out(a, column, is_pinned, most, near)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: column, most
      logical, intent(in) :: is_pinned(:)
      type(neighbourhood_t), intent(inout) :: near
      integer :: head, i, j, entry, other

      near%column(1) = column
      near%has_column(column) = .true.
      near%columns = 1
      near%rows = 0
      head = 0
      do while (head < near%columns)
         head = head + 1
         j = near%column(head)
         do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
            i = a%by_column%place(entry)
            if (near%place_of_row(i) /= 0) cycle
            near%rows = near%rows + 1
            near%row(near%rows) = i
            near%place_of_row(i) = near%rows
            do other = a%by_row%start(i), a%by_row%start(i + 1) - 1
               associate (k => a%by_row%place(other))
                  if (near%columns >= most .or. near%has_column(k) .or. is_pinned(k)) cycle
                  if (a%by_column%start(k + 1) - a%by_column%start(k) > most_rows) cycle
                  near%has_column(k) = .true.
                  near%columns = near%columns + 1
                  near%column(near%columns) = k
               end associate
            end do
         end do
      end do
   end subroutine spread_out

   !> The rows and columns of a neighbourhood as a dense matrix.
   pure subroutine fill(a, near, dense)
      type(operator_t), intent(in) :: a
      type(neighbourhood_t), intent(in) :: near
      real(wp), intent(out) :: dense(:, :)
      integer :: j, entry

      dense = 0.0_wp
      do j = 1, near%columns
         do entry = a%by_column%start(near%column(j)), a%by_column%start(near%column(j) + 1) - 1
            dense(near%place_of_row(a%by_column%place(entry)), j) = a%by_column%value(entry)
         end do
      end do
   end subroutine fill

   pure subroutine image(a, near, vector, left)
      type(operator_t), intent(in) :: a
      type(neighbourhood_t), intent(in) :: near
      real(wp), intent(in) :: vector(:)
      real(wp), intent(out) :: left(:)
      integer :: j, entry

      left = 0.0_wp
      do j = 1, near%columns
         do entry = a%by_column%start(near%column(j)), a%by_column%start(near%column(j) + 1) - 1
            associate (i => near%place_of_row(a%by_column%place(entry)))
               left(i) = left(i) + a%by_column%value(entry)*vector(j)
            end associate
         end do
      end do
   end subroutine image

   !> Append a vector, its places ascending.
   pure subroutine keep(near, vector, found)
      type(neighbourhood_t), intent(in) :: near
      real(wp), intent(in) :: vector(:)
      type(sparse_basis_t), intent(inout) :: found
      integer, allocatable :: order(:)

      order = ascending(real(near%column(:near%columns), wp))
      order = pack(order, abs(vector(order)) > 0)
      call found%add(near%column(order), vector(order))
   end subroutine keep
end module flexact_neighbourhood
