! SPDX-License-Identifier: BSD-3-Clause
!> Z'A Z for sparse Z and symmetric sparse A, whose patterns stay the same from one to the next.
module flexact_elastic_projection
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t, transposed
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   implicit none
   private
   public :: projection_t, prepare, project

   !> basis: Z, by columns and by rows. matrix: lower triangle of Z'A Z; only its pattern counts.
   type :: projection_t
      type(sparse_t) :: basis, by_row
      type(sparse_t) :: matrix
      type(symmetric_pattern_t) :: pattern
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
      call transposed(basis, projection%by_row)
      if (is_same) return
      call find_pattern(a, projection)
      projection%pattern = symmetric_pattern_t()
      call analyse_pattern(projection%matrix, projection%pattern)
   end subroutine prepare

   pure subroutine find_pattern(a, projection)
      type(sparse_t), intent(in) :: a
      type(projection_t), intent(inout) :: projection
      integer :: seen(projection%basis%rows), kept(projection%basis%columns), j, p, q, r, found, round
      integer, allocatable :: place(:)

      associate (z => projection%basis, by_row => projection%by_row, matrix => projection%matrix)
         matrix%rows = z%columns
         matrix%columns = z%columns
         matrix%start = [(1, j=1, z%columns + 1)]
         allocate (place(0))
         do round = 1, 2
            seen = 0
            kept = 0
            found = 0
            do j = 1, z%columns
               matrix%start(j) = found + 1
               do p = z%start(j), z%start(j + 1) - 1
                  do q = a%start(z%place(p)), a%start(z%place(p) + 1) - 1
                     if (seen(a%place(q)) == j) cycle
                     seen(a%place(q)) = j
                     do r = by_row%start(a%place(q)), by_row%start(a%place(q) + 1) - 1
                        if (by_row%place(r) < j .or. kept(by_row%place(r)) == j) cycle
                        kept(by_row%place(r)) = j
                        found = found + 1
                        if (round == 2) place(found) = by_row%place(r)
                     end do
                  end do
               end do
            end do
            matrix%start(z%columns + 1) = found + 1
            if (round == 1) place = [(0, j=1, found)]
         end do
         matrix%place = place
         matrix%value = [(1.0_wp, j=1, found)]
      end associate
   end subroutine find_pattern

   pure subroutine project(projection, a, matrix)
      type(projection_t), intent(in) :: projection
      type(sparse_t), intent(in) :: a
      type(sparse_t), intent(inout) :: matrix
      real(wp) :: image(projection%basis%rows), column(projection%basis%columns)
      integer :: touched(projection%basis%rows), seen(projection%basis%rows), j, p, q, i, many

      matrix = projection%matrix
      image = 0.0_wp
      column = 0.0_wp
      seen = 0
      associate (z => projection%basis, by_row => projection%by_row)
         do j = 1, z%columns
            many = 0
            do p = z%start(j), z%start(j + 1) - 1
               do q = a%start(z%place(p)), a%start(z%place(p) + 1) - 1
                  if (seen(a%place(q)) /= j) then
                     seen(a%place(q)) = j
                     many = many + 1
                     touched(many) = a%place(q)
                  end if
                  image(a%place(q)) = image(a%place(q)) + z%value(p)*a%value(q)
               end do
            end do
            do i = 1, many
               do p = by_row%start(touched(i)), by_row%start(touched(i) + 1) - 1
                  if (by_row%place(p) >= j) column(by_row%place(p)) = column(by_row%place(p)) + by_row%value(p)*image(touched(i))
               end do
               image(touched(i)) = 0.0_wp
            end do
            matrix%value(matrix%start(j):matrix%start(j + 1) - 1) = column(matrix%place(matrix%start(j):matrix%start(j + 1) - 1))
            column(matrix%place(matrix%start(j):matrix%start(j + 1) - 1)) = 0.0_wp
         end do
      end associate
   end subroutine project
end module flexact_elastic_projection
