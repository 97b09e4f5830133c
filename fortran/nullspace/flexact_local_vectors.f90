! SPDX-License-Identifier: BSD-3-Clause
!> Vectors of a null space that live on a few columns, found where they live: the
!> cost of each is that of its neighbourhood, not of the whole matrix.
module flexact_local_vectors
   use flexact_complete_pivoting, only: eliminate, rounding
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgels
   use flexact_neighbourhood, only: neighbourhood_t, prepare, clear, spread_out, fill, image, keep
   use flexact_pivoted_qr, only: null_space
   use flexact_sparse, only: sparse_t, operator_t, submatrix, transposed
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   implicit none
   private
   public :: find_local_vectors, find_scattered_vectors

   !> Neighbourhoods are tried up to these numbers of columns: a joint, a cell, some
   !> cells of a lattice; a larger one costs more than the vector among the others.
   integer, parameter :: reach(3) = [10, 30, 100]
   !> Where too many are left among the others, for so many of them farther out: some milliseconds each.
   integer, parameter :: far = 300, most_far = 200
   !> The same where the null space of the neighbourhood is wanted, and how many
   !> places are tried for each vector.
   integer, parameter :: wide(4) = [40, 70, 120, 300]
   integer, parameter :: seeds = 4
   !> Columns that are held by few rows are so up to this number; and independent ones are so
   !> clearly, that what is left of each beside the others is above this part.
   integer, parameter :: most_held = 3
   real(wp), parameter :: clearly = 0.1_wp
   !> Pivots that count as zero; the residue decides, whether they were.
   real(wp), parameter :: tiny_value = 1.0e-12_wp
   !> What A may leave of a vector, relative to its largest entry: rounding.
   real(wp), parameter :: residue = 1.0e-13_wp

contains

   !> For each pinned column the vector with a one there, none at other pins and
   !> no image under A, if it is local; `rest` lists the columns without one, of which
   !> no more than `most` are wanted.
   subroutine find_local_vectors(a, pin, most, found, rest)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: pin(:), most
      type(sparse_basis_t), intent(out) :: found
      integer, allocatable, intent(out) :: rest(:)
      type(neighbourhood_t) :: near
      logical :: is_pinned(a%by_column%columns), is_found(size(pin))
      integer :: k

      call new_sparse_basis(found)
      is_pinned = .false.
      is_pinned(pin) = .true.
      call prepare(a, near)
      do k = 1, size(pin)
         call find_one(a, pin(k), is_pinned, reach, near, found, is_found(k))
      end do
      rest = pack(pin,.not. is_found)
      if (size(rest) <= most) return
      do k = 1, min(size(rest), most_far)
         call find_one(a, rest(k), is_pinned, [far], near, found, is_found(k))
      end do
      rest = [pack(rest(:k - 1),.not. is_found(:k - 1)), rest(k:)]
   end subroutine find_local_vectors

   !> Up to `wanted` independent vectors (columns) without an image under A, each
   !> from a neighbourhood of its own, where there are very many all over.
   subroutine find_scattered_vectors(a, wanted, found)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: wanted
      type(sparse_basis_t), intent(out) :: found
      type(neighbourhood_t) :: near
      logical :: is_used(a%by_column%columns), is_found
      integer :: i, k, column

      call new_sparse_basis(found)
      call prepare(a, near)
      is_used = .false.
      do i = 1, seeds*wanted
         column = 1 + int(real(i - 1, wp)/(seeds*wanted)*a%by_column%columns)
         if (is_used(column)) cycle
         do k = 1, size(wide)
            call spread_out(a, column, is_used, wide(k), near)
            call take_first(a, near, found, is_found)
            if (is_found) is_used(near%column(:near%columns)) = .true.
            call clear(near)
            if (is_found) exit
         end do
         if (found%vectors == wanted) exit
      end do
   end subroutine find_scattered_vectors

   !> Keep one vector of the null space of a neighbourhood, the most local of some.
   subroutine take_first(a, near, found, is_found)
      type(operator_t), intent(in) :: a
      type(neighbourhood_t), intent(in) :: near
      type(sparse_basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      type(error_t), allocatable :: error
      real(wp), allocatable :: dense(:, :), vectors(:, :)
      real(wp) :: left(near%rows), vector(near%columns)
      integer, allocatable :: row(:), column(:)
      type(operator_t) :: part
      integer :: k, best

      call submatrix(a%by_column, near%rows, near%column(:near%columns), near%place_of_row, part%by_column)
      call transposed(part%by_column, part%by_row)
      call leave_out_held(part, row, column)
      call make_dense(part%by_row, row, column, dense)
      call null_space(dense, tiny_value, vectors, error)
      is_found = .false.
      if (allocated(error)) return
      if (size(vectors, 2) == 0) return
      call eliminate(vectors)
      best = minloc([(count(abs(vectors(:, k)) > 0), k=1, size(vectors, 2))], 1)
      vector = 0.0_wp
      vector(column) = vectors(:, best)
      call image(a, near, vector, left)
      is_found = maxval(abs(left)) <= residue*maxval(abs(vector))
      if (is_found) call keep(near, vector, found)
   end subroutine take_first

   !> The columns of a matrix that may take part in a vector of its null space, and the rows with
   !> entries there. Left out is, again and again, what rows hold that meet few columns, as
   !> at the rim of a neighbourhood: that is most of it, and costs far less than a factorisation.
   pure subroutine leave_out_held(a, row, column)
      type(operator_t), intent(in) :: a
      integer, allocatable, intent(out) :: row(:), column(:)
      integer :: left(a%by_column%rows), met(a%by_column%rows), i, j, before
      logical :: is_free(a%by_column%columns)

      met = 0
      left = a%by_row%start(2:) - a%by_row%start(:size(left))
      is_free = .true.
      do
         before = count(is_free)
         do i = 1, size(left)
            if (left(i) > 0 .and. left(i) <= most_held) call leave_out_at(a, i, left, met, is_free)
         end do
         if (count(is_free) == before) exit
      end do
      row = pack([(i, i=1, size(left))], left > 0)
      column = pack([(j, j=1, size(is_free))], is_free)
   end subroutine leave_out_held

   !> Leave out the free columns that row i meets, if the rows that meet no others hold them.
   !> left (rows): how many free columns each row meets. met (rows): zeros, to work with.
   pure subroutine leave_out_at(a, i, left, met, is_free)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: i
      integer, intent(inout) :: left(:), met(:)
      logical, intent(inout) :: is_free(:)
      integer :: held(most_held), count, j, k, r, entry, other
      real(wp) :: products(most_held, most_held), row(most_held)

      count = 0
      do entry = a%by_row%start(i), a%by_row%start(i + 1) - 1
         if (.not. is_free(a%by_row%place(entry))) cycle
         count = count + 1
         held(count) = a%by_row%place(entry)
      end do
      products = 0.0_wp
      do k = 1, count
         do entry = a%by_column%start(held(k)), a%by_column%start(held(k) + 1) - 1
            r = a%by_column%place(entry)
            met(r) = met(r) + 1
            if (met(r) < left(r)) cycle
            row = 0.0_wp
            do other = a%by_row%start(r), a%by_row%start(r + 1) - 1
               do j = 1, count
                  if (held(j) == a%by_row%place(other)) row(j) = a%by_row%value(other)
               end do
            end do
            do j = 1, count
               products(:, j) = products(:, j) + row*row(j)
            end do
         end do
      end do
      do k = 1, count
         met(a%by_column%place(a%by_column%start(held(k)):a%by_column%start(held(k) + 1) - 1)) = 0
      end do
      if (.not. is_clearly_regular(products, count)) return
      do k = 1, count
         is_free(held(k)) = .false.
         do entry = a%by_column%start(held(k)), a%by_column%start(held(k) + 1) - 1
            left(a%by_column%place(entry)) = left(a%by_column%place(entry)) - 1
         end do
      end do
   end subroutine leave_out_at

   !> Of the products of a few columns with each other: whether no combination of the first is
   !> small.
   pure logical function is_clearly_regular(products, count)
      real(wp), intent(in) :: products(most_held, most_held)
      integer, intent(in) :: count
      real(wp) :: rest(most_held, most_held), least
      integer :: j, k

      rest = products
      least = clearly**2*maxval(products)
      is_clearly_regular = .false.
      do k = 1, count
         if (.not. rest(k, k) > least) return
         do j = k + 1, count
            rest(:, j) = rest(:, j) - rest(:, k)*(rest(k, j)/rest(k, k))
         end do
      end do
      is_clearly_regular = .true.
   end function is_clearly_regular

   !> Some rows and columns of a matrix.
   pure subroutine make_dense(by_row, row, column, dense)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: row(:), column(:)
      real(wp), allocatable, intent(out) :: dense(:, :)
      integer :: number(by_row%rows), i, entry

      allocate (dense(size(row), size(column)), source=0.0_wp)
      number = 0
      number(column) = [(i, i=1, size(column))]
      do i = 1, size(row)
         do entry = by_row%start(row(i)), by_row%start(row(i) + 1) - 1
            associate (j => number(by_row%place(entry)))
               if (j > 0) dense(i, j) = by_row%value(entry)
            end associate
         end do
      end do
   end subroutine make_dense

   !> Try wider and wider neighbourhoods of a column.
   subroutine find_one(a, column, is_pinned, reach, near, found, is_found)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: column, reach(:)
      logical, intent(in) :: is_pinned(:)
      type(neighbourhood_t), intent(inout) :: near
      type(sparse_basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      integer :: attempt, before

      is_found = .false.
      before = 0
      do attempt = 1, size(reach)
         call spread_out(a, column, is_pinned, reach(attempt), near)
         if (near%columns > before) call solve_nearby(a, near, found, is_found)
         before = near%columns
         call clear(near)
         if (is_found .or. near%columns < reach(attempt)) exit
      end do
   end subroutine find_one

   !> Solve for what the other columns of the neighbourhood must do, and keep the vector if
   !> nothing is left of its image.
   subroutine solve_nearby(a, near, found, is_found)
      type(operator_t), intent(in) :: a
      type(neighbourhood_t), intent(in) :: near
      type(sparse_basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      real(wp) :: dense(near%rows, near%columns), vector(near%columns), left(near%rows)
      real(wp) :: right(max(near%rows, near%columns), 1), work(64*(near%rows + near%columns))
      integer :: info

      is_found = .false.
      call fill(a, near, dense)
      vector = 0.0_wp
      vector(1) = 1.0_wp
      if (near%columns > 1) then
         if (near%rows < near%columns - 1) return
         right(:near%rows, 1) = -dense(:, 1)
         associate (others => near%columns - 1)
            call least_squares(dense(:, 2:), right, work, info)
            if (info /= 0) return
            vector(2:) = right(:others, 1)
         end associate
      end if
      where (abs(vector) <= rounding*maxval(abs(vector))) vector = 0.0_wp
      call image(a, near, vector, left)
      ! Its one at the pin sets it apart from all others.
      is_found = abs(vector(1)) > 0 .and. maxval(abs(left)) <= residue*maxval(abs(vector))
      if (is_found) call keep(near, vector, found)
   end subroutine solve_nearby

   !> Overdetermined least squares.
   subroutine least_squares(matrix, right, work, info)
      real(wp), intent(in) :: matrix(:, :)
      real(wp), intent(inout), contiguous :: right(:, :), work(:)
      integer, intent(out) :: info
      real(wp) :: factor(size(matrix, 1), size(matrix, 2))

      factor = matrix
      call dgels('N', size(factor, 1), size(factor, 2), 1, factor, size(factor, 1), right, size(right, 1), &
                 work, size(work), info)
   end subroutine least_squares
end module flexact_local_vectors
