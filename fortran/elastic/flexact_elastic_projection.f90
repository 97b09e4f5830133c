! SPDX-License-Identifier: BSD-3-Clause
!> Z'A Z for sparse Z and symmetric sparse A, whose patterns stay the same from one to the next.
!>
!> Columns of Z fall into groups: those of a group have the same rows, and no other group has
!> them. So Z'A Z consists of full blocks, one for each two groups that an entry of A joins.
module flexact_elastic_projection
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   implicit none
   private
   public :: projection_t, prepare, project

   !> basis: Z. matrix: lower triangle of Z'A Z; only its pattern counts.
   type :: projection_t
      type(sparse_t) :: basis, matrix
      type(symmetric_pattern_t) :: pattern
      integer, private :: groups = 0
      !> First column of each group; the group of each row, 0 for none.
      integer, allocatable, private :: first(:), group(:)
      !> The groups that each is joined with: itself, and then those behind it.
      integer, allocatable, private :: start(:), joined(:)
   end type projection_t

contains

   !> Take another basis; what is known of the patterns stays where they are the same.
   subroutine prepare(basis, a, projection)
      type(sparse_t), intent(in) :: basis, a
      type(projection_t), intent(inout) :: projection
      logical :: is_same

      is_same = allocated(projection%basis%start)
      if (is_same) is_same = projection%basis%columns == basis%columns .and. size(projection%basis%place) == size(basis%place)
      if (is_same) is_same = all(projection%basis%start == basis%start) .and. all(projection%basis%place == basis%place)
      projection%basis = basis
      if (is_same) return
      call find_groups(projection)
      call join_groups(a, projection)
      call fill_pattern(projection)
      projection%pattern = symmetric_pattern_t()
      call analyse_pattern(projection%matrix, projection%pattern)
   end subroutine prepare

   !> A column with rows of its own begins a group.
   pure subroutine find_groups(projection)
      type(projection_t), intent(inout) :: projection
      integer :: j

      associate (z => projection%basis)
         projection%group = spread(0, 1, z%rows)
         projection%first = spread(0, 1, z%columns + 1)
         projection%groups = 0
         do j = 1, z%columns
            if (projection%group(z%place(z%start(j))) > 0) cycle
            projection%groups = projection%groups + 1
            projection%first(projection%groups) = j
            projection%group(z%place(z%start(j):z%start(j + 1) - 1)) = projection%groups
         end do
         projection%first = [projection%first(:projection%groups), z%columns + 1]
      end associate
   end subroutine find_groups

   !> The rows of a group.
   pure function rows_of(projection, g) result(rows)
      type(projection_t), intent(in) :: projection
      integer, intent(in) :: g
      integer, allocatable :: rows(:)

      associate (j => projection%first(g), z => projection%basis)
         rows = z%place(z%start(j):z%start(j + 1) - 1)
      end associate
   end function rows_of

   pure subroutine join_groups(a, projection)
      type(sparse_t), intent(in) :: a
      type(projection_t), intent(inout) :: projection
      integer :: seen(projection%groups), g, h, i, q, found, round
      integer, allocatable :: rows(:)

      projection%start = spread(1, 1, projection%groups + 1)
      do round = 1, 2
         seen = 0
         found = 0
         do g = 1, projection%groups
            found = found + 1
            projection%start(g) = found
            if (round == 2) projection%joined(found) = g
            seen(g) = g
            rows = rows_of(projection, g)
            do i = 1, size(rows)
               do q = a%start(rows(i)), a%start(rows(i) + 1) - 1
                  h = projection%group(a%place(q))
                  if (h <= g) cycle
                  if (seen(h) == g) cycle
                  seen(h) = g
                  found = found + 1
                  if (round == 2) projection%joined(found) = h
               end do
            end do
         end do
         projection%start(projection%groups + 1) = found + 1
         if (round == 1) projection%joined = spread(0, 1, found)
      end do
   end subroutine join_groups

   !> Column by column: the rest of its own group, and all columns of those joined.
   pure subroutine fill_pattern(projection)
      type(projection_t), intent(inout) :: projection
      integer :: g, j, p, k, found, entries

      associate (matrix => projection%matrix, first => projection%first)
         matrix%rows = projection%basis%columns
         matrix%columns = projection%basis%columns
         matrix%start = spread(1, 1, matrix%columns + 1)
         entries = 0
         do g = 1, projection%groups
            do p = projection%start(g), projection%start(g + 1) - 1
               entries = entries + (first(g + 1) - first(g))*(first(projection%joined(p) + 1) - first(projection%joined(p)))
            end do
         end do
         matrix%place = spread(0, 1, entries)
         found = 0
         do g = 1, projection%groups
            do j = first(g), first(g + 1) - 1
               matrix%start(j) = found + 1
               do p = projection%start(g), projection%start(g + 1) - 1
                  do k = max(j, first(projection%joined(p))), first(projection%joined(p) + 1) - 1
                     found = found + 1
                     matrix%place(found) = k
                  end do
               end do
            end do
         end do
         matrix%start(matrix%columns + 1) = found + 1
         matrix%place = matrix%place(:found)
         matrix%value = spread(1.0_wp, 1, found)
      end associate
   end subroutine fill_pattern

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
      real(wp), allocatable :: columns(:, :)
      integer, allocatable :: rows(:)

      rows = rows_of(projection, h)
      associate (z => projection%basis, first => projection%first)
         columns = reshape(z%value(z%start(first(h)):z%start(first(h + 1)) - 1), [size(rows), first(h + 1) - first(h)])
      end associate
      block = matmul(transpose(columns), transpose(image(:, rows)))
   end function block_with
end module flexact_elastic_projection
