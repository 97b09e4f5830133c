! SPDX-License-Identifier: BSD-3-Clause
!> Z'A Z for sparse Z and symmetric sparse A, block by block.
module flexact_projection
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm
   use flexact_projection_pattern, only: projection_t, rows_of
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: project

   !> Products from which on a block is left to BLAS.
   integer, parameter :: many = 10000

contains

   !> The lower triangle, of the pattern that was prepared. A: both triangles.
   pure subroutine project(projection, a, matrix)
      type(projection_t), intent(in) :: projection
      type(sparse_t), intent(in) :: a
      type(sparse_t), intent(inout) :: matrix
      real(wp), allocatable :: image(:, :)
      integer :: touched(a%columns), many, g, widest

      matrix = projection%matrix
      widest = 0
      do g = 1, projection%groups
         widest = max(widest, projection%first(g + 1) - projection%first(g))
      end do
      allocate (image(widest, a%columns), source=0.0_wp)
      do g = 1, projection%groups
         call make_image(projection, a, g, image, touched, many)
         call add_blocks(projection, g, image, matrix)
         image(:, touched(:many)) = 0.0_wp
      end do
   end subroutine project

   !> The transpose of A times the columns of a group, and the rows that it has.
   pure subroutine make_image(projection, a, g, image, touched, many)
      type(projection_t), intent(in) :: projection
      type(sparse_t), intent(in) :: a
      integer, intent(in) :: g
      real(wp), intent(inout) :: image(:, :)
      integer, intent(out) :: touched(:), many
      logical :: seen(a%columns)
      real(wp) :: row(projection%first(g + 1) - projection%first(g))
      integer, allocatable :: rows(:)
      integer :: i, q, r

      rows = rows_of(projection, g)
      many = 0
      if (size(rows) > 1) seen = .false.
      do i = 1, size(rows)
         row = projection%basis%value(projection%basis%start(projection%first(g):projection%first(g + 1) - 1) + i - 1)
         do q = a%start(rows(i)), a%start(rows(i) + 1) - 1
            r = a%place(q)
            image(:size(row), r) = image(:size(row), r) + a%value(q)*row
            if (size(rows) > 1) then
               if (seen(r)) cycle
               seen(r) = .true.
            end if
            many = many + 1
            touched(many) = r
         end do
      end do
   end subroutine make_image

   !> The blocks of a group and those that it is joined with.
   pure subroutine add_blocks(projection, g, image, matrix)
      type(projection_t), intent(in) :: projection
      integer, intent(in) :: g
      real(wp), intent(in) :: image(:, :)
      type(sparse_t), intent(inout) :: matrix
      integer :: next(projection%first(g + 1) - projection%first(g)), p, j, h, width, row
      real(wp), allocatable :: block(:, :)

      associate (first => projection%first, z => projection%basis)
         next = matrix%start(first(g):first(g + 1) - 1)
         do p = projection%start(g), projection%start(g + 1) - 1
            h = projection%joined(p)
            width = first(h + 1) - first(h)
            if (z%start(first(h) + 1) == z%start(first(h)) + 1) then
               row = z%place(z%start(first(h)))
               matrix%value(next) = z%value(z%start(first(h)))*image(:size(next), row)
               next = next + 1
               cycle
            end if
            block = block_with(projection, h, image(:size(next), :))
            do j = 1, size(next)
               if (h == g) then
                  matrix%value(next(j):next(j) + width - j) = block(j:, j)
                  next(j) = next(j) + width - j + 1
               else
                  matrix%value(next(j):next(j) + width - 1) = block(:, j)
                  next(j) = next(j) + width
               end if
            end do
         end do
      end associate
   end subroutine add_blocks

   !> The columns of a group, transposed, times an image.
   pure function block_with(projection, h, image) result(block)
      type(projection_t), intent(in) :: projection
      integer, intent(in) :: h
      real(wp), intent(in) :: image(:, :)
      real(wp), allocatable :: block(:, :)
      real(wp), allocatable :: columns(:, :), there(:, :)
      integer, allocatable :: rows(:)

      rows = rows_of(projection, h)
      associate (z => projection%basis, first => projection%first)
         columns = reshape(z%value(z%start(first(h)):z%start(first(h + 1)) - 1), [size(rows), first(h + 1) - first(h)])
      end associate
      if (size(columns)*size(image, 1) < many) then
         block = matmul(transpose(columns), transpose(image(:, rows)))
         return
      end if
      there = image(:, rows)
      allocate (block(size(columns, 2), size(image, 1)))
      call dgemm('T', 'T', size(block, 1), size(block, 2), size(rows), 1.0_wp, columns, size(rows), there, size(there, 1), 0.0_wp, &
                 block, size(block, 1))
   end function block_with
end module flexact_projection
