!> Vectors of a null space that live on a few columns, found where they live: the
!> cost of each is that of its neighbourhood, not of the whole matrix.
module flexact_local
   use flexact_kinds, only: wp
   use flexact_basis, only: basis_t, new_basis
   use flexact_decomposition, only: status_fine
   use flexact_pivoting, only: pivoted_t, factorise, take_rank, null_spaces
   use flexact_lapack, only: dgels
   use flexact_modes, only: untangle
   use flexact_null_space, only: operator_t
   implicit none
   private
   public :: find_local_vectors, find_scattered_vectors

   !> Neighbourhoods are tried up to these numbers of columns.
   integer, parameter :: reach(3) = [10, 30, 100]
   !> The same where the null space of the neighbourhood is wanted, and how many
   !> places a vector are tried.
   integer, parameter :: wide(3) = [40, 120, 300]
   integer, parameter :: seeds = 4
   real(wp), parameter :: tiny_value = 1.0e-12_wp
   !> Entries below this part of the largest one are rounding.
   real(wp), parameter :: nothing = 1.0e-11_wp
   !> What A may leave of a vector, relative to its largest entry.
   real(wp), parameter :: residue = 1.0e-13_wp

   !> A column and the columns around it, breadth first, pinned ones left out.
   type :: patch_t
      integer :: columns = 0
      integer :: rows = 0
      !> The first column is the one that it is about.
      integer, allocatable :: column(:), row(:)
      !> Place in the patch of each row of the matrix, 0 outside.
      integer, allocatable :: place_of_row(:)
      logical, allocatable :: has_column(:)
   end type patch_t

contains

   !> For each pinned column the vector with a one there, none at other pins and
   !> no image under A, if it is local; `rest` lists the columns without one.
   subroutine find_local_vectors(a, pin, found, rest)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: pin(:)
      type(basis_t), intent(out) :: found
      integer, allocatable, intent(out) :: rest(:)
      type(patch_t) :: patch
      logical :: is_pinned(a%by_column%columns), is_found(size(pin))
      integer :: k

      call new_basis(found)
      is_pinned = .false.
      is_pinned(pin) = .true.
      call prepare(a, patch)
      do k = 1, size(pin)
         call find_one(a, pin(k), is_pinned, patch, found, is_found(k))
      end do
      rest = pack(pin,.not. is_found)
   end subroutine find_local_vectors

   !> Up to `wanted` independent vectors (columns) without an image under A, each
   !> from a neighbourhood of its own, where there are very many all over.
   subroutine find_scattered_vectors(a, wanted, found)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: wanted
      type(basis_t), intent(out) :: found
      type(patch_t) :: patch
      logical :: is_used(a%by_column%columns), is_found
      integer :: i, k, column

      call new_basis(found)
      call prepare(a, patch)
      is_used = .false.
      do i = 1, seeds*wanted
         column = 1 + int(real(i - 1, wp)/(seeds*wanted)*a%by_column%columns)
         if (is_used(column)) cycle
         do k = 1, size(wide)
            call spread(a, column, is_used, wide(k), patch)
            call take_first(a, patch, found, is_found)
            if (is_found) is_used(patch%column(:patch%columns)) = .true.
            call clear(patch)
            if (is_found) exit
         end do
         if (found%vectors == wanted) exit
      end do
   end subroutine find_scattered_vectors

   !> Keep one vector of the null space of a neighbourhood, the most local of some.
   subroutine take_first(a, patch, found, is_found)
      type(operator_t), intent(in) :: a
      type(patch_t), intent(in) :: patch
      type(basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      type(pivoted_t) :: pivoted
      real(wp), allocatable :: dense(:, :), vectors(:, :), others(:, :)
      real(wp) :: left(patch%rows)
      integer :: status, rank, k, best

      allocate (dense(patch%rows, patch%columns))
      call fill(a, patch, dense)
      call factorise(dense, pivoted, status)
      is_found = .false.
      if (status /= status_fine) return
      rank = count(pivoted%estimates > tiny_value)
      if (rank == patch%columns) return
      call take_rank(pivoted, rank, status)
      if (status /= status_fine) return
      allocate (vectors(patch%columns, patch%columns - rank), others(patch%rows, 0))
      call null_spaces(pivoted, vectors, others, status)
      if (status /= status_fine) return
      call untangle(vectors)
      best = minloc([(count(abs(vectors(:, k)) > 0), k=1, size(vectors, 2))], 1)
      call image(a, patch, vectors(:, best), left)
      is_found = maxval(abs(left)) <= residue*maxval(abs(vectors(:, best)))
      if (is_found) call keep(patch, vectors(:, best), found)
   end subroutine take_first

   subroutine prepare(a, patch)
      type(operator_t), intent(in) :: a
      type(patch_t), intent(out) :: patch

      allocate (patch%column(a%by_column%columns), patch%row(a%by_column%rows))
      allocate (patch%place_of_row(a%by_column%rows), source=0)
      allocate (patch%has_column(a%by_column%columns), source=.false.)
   end subroutine prepare

   pure subroutine clear(patch)
      type(patch_t), intent(inout) :: patch

      patch%place_of_row(patch%row(:patch%rows)) = 0
      patch%has_column(patch%column(:patch%columns)) = .false.
   end subroutine clear

   !> Try wider and wider neighbourhoods of a column.
   subroutine find_one(a, column, is_pinned, patch, found, is_found)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: column
      logical, intent(in) :: is_pinned(:)
      type(patch_t), intent(inout) :: patch
      type(basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      integer :: attempt, before

      is_found = .false.
      before = 0
      do attempt = 1, size(reach)
         call spread(a, column, is_pinned, reach(attempt), patch)
         if (patch%columns > before) call solve_in_patch(a, patch, found, is_found)
         before = patch%columns
         call clear(patch)
         if (is_found .or. patch%columns < reach(attempt)) exit
      end do
   end subroutine find_one

   !> Gather up to `most` columns around one, and all rows that they touch.
   pure subroutine spread(a, column, is_pinned, most, patch)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: column, most
      logical, intent(in) :: is_pinned(:)
      type(patch_t), intent(inout) :: patch
      integer :: head, i, j, entry, other

      patch%column(1) = column
      patch%has_column(column) = .true.
      patch%columns = 1
      patch%rows = 0
      head = 0
      do while (head < patch%columns)
         head = head + 1
         j = patch%column(head)
         do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
            i = a%by_column%place(entry)
            if (patch%place_of_row(i) /= 0) cycle
            patch%rows = patch%rows + 1
            patch%row(patch%rows) = i
            patch%place_of_row(i) = patch%rows
            do other = a%by_row%start(i), a%by_row%start(i + 1) - 1
               associate (k => a%by_row%place(other))
                  if (patch%columns >= most .or. patch%has_column(k) .or. is_pinned(k)) cycle
                  patch%has_column(k) = .true.
                  patch%columns = patch%columns + 1
                  patch%column(patch%columns) = k
               end associate
            end do
         end do
      end do
   end subroutine spread

   !> Solve for what the other columns of the patch must do, and keep the vector if
   !> nothing is left of its image.
   subroutine solve_in_patch(a, patch, found, is_found)
      type(operator_t), intent(in) :: a
      type(patch_t), intent(in) :: patch
      type(basis_t), intent(inout) :: found
      logical, intent(out) :: is_found
      real(wp) :: dense(patch%rows, patch%columns), vector(patch%columns), left(patch%rows)
      real(wp) :: right(max(patch%rows, patch%columns), 1), work(64*(patch%rows + patch%columns))
      integer :: info

      is_found = .false.
      call fill(a, patch, dense)
      vector = 0.0_wp
      vector(1) = 1.0_wp
      if (patch%columns > 1) then
         if (patch%rows < patch%columns - 1) return
         right(:patch%rows, 1) = -dense(:, 1)
         associate (others => patch%columns - 1)
            call least_squares(dense(:, 2:), right, work, info)
            if (info /= 0) return
            vector(2:) = right(:others, 1)
         end associate
      end if
      where (abs(vector) <= nothing*maxval(abs(vector))) vector = 0.0_wp
      call image(a, patch, vector, left)
      is_found = maxval(abs(left)) <= residue*maxval(abs(vector))
      if (is_found) call keep(patch, vector, found)
   end subroutine solve_in_patch

   !> The rows and columns of a patch as a dense matrix.
   pure subroutine fill(a, patch, dense)
      type(operator_t), intent(in) :: a
      type(patch_t), intent(in) :: patch
      real(wp), intent(out) :: dense(:, :)
      integer :: j, entry

      dense = 0.0_wp
      do j = 1, patch%columns
         do entry = a%by_column%start(patch%column(j)), a%by_column%start(patch%column(j) + 1) - 1
            dense(patch%place_of_row(a%by_column%place(entry)), j) = a%by_column%value(entry)
         end do
      end do
   end subroutine fill

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

   pure subroutine image(a, patch, vector, left)
      type(operator_t), intent(in) :: a
      type(patch_t), intent(in) :: patch
      real(wp), intent(in) :: vector(:)
      real(wp), intent(out) :: left(:)
      integer :: j, entry

      left = 0.0_wp
      do j = 1, patch%columns
         do entry = a%by_column%start(patch%column(j)), a%by_column%start(patch%column(j) + 1) - 1
            associate (i => patch%place_of_row(a%by_column%place(entry)))
               left(i) = left(i) + a%by_column%value(entry)*vector(j)
            end associate
         end do
      end do
   end subroutine image

   !> Append a vector, its places ascending.
   pure subroutine keep(patch, vector, found)
      type(patch_t), intent(in) :: patch
      real(wp), intent(in) :: vector(:)
      type(basis_t), intent(inout) :: found
      integer :: place(size(vector)), moving_place, used, i, j
      real(wp) :: value(size(vector)), moving

      used = 0
      do i = 1, size(vector)
         if (.not. abs(vector(i)) > 0) cycle
         moving_place = patch%column(i)
         moving = vector(i)
         do j = used, 1, -1
            if (place(j) < moving_place) exit
            place(j + 1) = place(j)
            value(j + 1) = value(j)
         end do
         place(j + 1) = moving_place
         value(j + 1) = moving
         used = used + 1
      end do
      call found%add(place(:used), value(:used))
   end subroutine keep
end module flexact_local
