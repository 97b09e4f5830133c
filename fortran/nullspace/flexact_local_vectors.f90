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
   use flexact_sparse, only: operator_t
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
      real(wp) :: left(near%rows)
      integer :: k, best

      allocate (dense(near%rows, near%columns))
      call fill(a, near, dense)
      call null_space(dense, tiny_value, vectors, error)
      is_found = .false.
      if (allocated(error)) return
      if (size(vectors, 2) == 0) return
      call eliminate(vectors)
      best = minloc([(count(abs(vectors(:, k)) > 0), k=1, size(vectors, 2))], 1)
      call image(a, near, vectors(:, best), left)
      is_found = maxval(abs(left)) <= residue*maxval(abs(vectors(:, best)))
      if (is_found) call keep(near, vectors(:, best), found)
   end subroutine take_first

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
