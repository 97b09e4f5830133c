! SPDX-License-Identifier: BSD-3-Clause
!> What sparse rows J (m, n) leave free, and what they hold: a sparse orthonormal basis Z of
!> the vectors with J z = 0, vectors x of least norm with J x = c, and multipliers l of least
!> norm with J'l = r. Connected components of J are decomposed one by one, by
!> QR factorisation of their rows, scaled to unit norm, with pivoting (Golub and Van Loan,
!> Matrix Computations, section 5.4): the longest rest comes first, and a rest shorter than
!> the tolerance is of a row that depends on those before.
module flexact_row_space
   use flexact_components, only: components_t, find_components
   use flexact_dense, only: allocate_work
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqp3, dorgqr, dtrtrs
   use flexact_orthonormal, only: orthonormalise
   use flexact_sparse, only: sparse_t, operator_t, operator_of
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   implicit none
   private
   public :: row_space_t, analyse_rows, find_multipliers, follow_rows

   !> A component with rows.
   type :: part_t
      integer :: rank = 0
      !> Its rows, independent ones first, and its columns.
      integer, allocatable :: row(:), column(:)
      !> Norms of the rows.
      real(wp), allocatable :: norm(:)
      !> Scaled independent rows = triangle' range', (rank, rank) and (columns, rank).
      real(wp), allocatable :: triangle(:, :), range(:, :)
      !> Orthonormal combinations of the rows as given that are zero, (rows, rows - rank).
      real(wp), allocatable :: dependence(:, :)
   end type part_t

   type :: row_space_t
      integer :: rows = 0, columns = 0
      !> How many rows depend on others.
      integer :: dependent = 0
      !> The shortest rest, of rows with norm 1, that counted as independent; 1 without rows.
      real(wp) :: shortest = 1.0_wp
      !> Z (columns, columns - rows + dependent); those of a column without rows are its own.
      type(sparse_t) :: basis
      type(part_t), allocatable :: part(:)
   end type row_space_t

   real(wp), parameter :: usual_tolerance = 1.0e-9_wp

contains

   !> Tolerance: rests of rows with norm 1 that are shorter are zero (usually 1e-9).
   subroutine analyse_rows(rows, space, error, tolerance)
      type(sparse_t), intent(in) :: rows
      type(row_space_t), intent(out) :: space
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: tolerance
      type(operator_t) :: a
      type(components_t) :: components
      type(sparse_basis_t) :: basis
      real(wp) :: least
      integer :: i, found

      least = usual_tolerance
      if (present(tolerance)) least = tolerance
      space%rows = rows%rows
      space%columns = rows%columns
      a = operator_of(rows)
      call find_components(a, components)
      call new_sparse_basis(basis)
      allocate (space%part(components%count))
      found = 0
      do i = 1, components%count
         associate (row => components%row(components%row_start(i):components%row_start(i + 1) - 1), &
                    column => components%column(components%column_start(i):components%column_start(i + 1) - 1))
            if (size(row) == 0) then
               call basis%add(column, [1.0_wp])
            else
               found = found + 1
               call decompose_part(a, row, column, least, space%part(found), basis, space%shortest, error)
               if (allocated(error)) return
               space%dependent = space%dependent + size(row) - space%part(found)%rank
            end if
         end associate
      end do
      space%part = space%part(:found)
      space%basis = basis%as_matrix(rows%columns)
   end subroutine analyse_rows

   !> Decompose the rows of a component; what they leave free joins the basis.
   subroutine decompose_part(a, row, column, least, part, basis, shortest, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: row(:), column(:)
      real(wp), intent(in) :: least
      type(part_t), intent(out) :: part
      type(sparse_basis_t), intent(inout) :: basis
      real(wp), intent(inout) :: shortest
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: q(:, :), triangle(:, :)
      integer :: order(size(row)), k, length

      allocate (part%norm(size(row)))
      call fill_part(a, row, column, part%norm, q)
      length = min(size(row), size(column))
      call pivoted_qr(q, size(row), order, triangle, error)
      if (allocated(error)) return
      part%rank = count([(abs(triangle(k, k)) > least, k=1, length)])
      if (part%rank > 0) shortest = min(shortest, abs(triangle(part%rank, part%rank)))
      part%row = row(order)
      part%norm = part%norm(order)
      part%column = column
      part%range = q(:, :part%rank)
      part%triangle = triangle(:part%rank, :part%rank)
      call find_dependence(triangle, part, error)
      do k = part%rank + 1, size(column)
         call basis%add(column, q(:, k))
      end do
   end subroutine decompose_part

   !> The scaled rows as columns of a matrix (columns, max(rows, columns)), and their norms;
   !> those of zero rows are 1.
   subroutine fill_part(a, row, column, norm, dense)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: row(:), column(:)
      real(wp), intent(out) :: norm(:)
      real(wp), allocatable, intent(out) :: dense(:, :)
      integer :: i, first, last, entry, j

      allocate (dense(size(column), max(size(row), size(column))), source=0.0_wp)
      do i = 1, size(row)
         first = a%by_row%start(row(i))
         last = a%by_row%start(row(i) + 1) - 1
         norm(i) = norm2(a%by_row%value(first:last))
         if (.not. norm(i) > 0) norm(i) = 1.0_wp
         do entry = first, last
            j = place_in(column, a%by_row%place(entry))
            dense(j, i) = dense(j, i) + a%by_row%value(entry)/norm(i)
         end do
      end do
   end subroutine fill_part

   !> Where a number stands in an ascending list that has it.
   pure integer function place_in(list, number) result(first)
      integer, intent(in) :: list(:), number
      integer :: last, middle

      first = 1
      last = size(list)
      do while (first < last)
         middle = (first + last)/2
         if (list(middle) < number) then
            first = middle + 1
         else
            last = middle
         end if
      end do
   end function place_in

   !> The first `count` columns (n, count) in an order as Q R: Q (n, n) takes their place.
   subroutine pivoted_qr(a, count, order, triangle, error)
      real(wp), allocatable, intent(inout) :: a(:, :)
      integer, intent(in) :: count
      integer, intent(out) :: order(:)
      real(wp), allocatable, intent(out) :: triangle(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: tau(size(a, 1)), length(2)
      real(wp), allocatable :: work(:)
      integer :: n, k, info

      n = size(a, 1)
      order = [(k, k=1, count)]
      triangle = a(:, :count)
      if (n == 0 .or. count == 0) return
      order = 0
      call dgeqp3(n, count, a, n, order, tau, length(1:1), -1, info)
      if (info == 0) call dorgqr(n, n, min(n, count), a, n, tau, length(2:2), -1, info)
      if (info == 0) call allocate_work(work, maxval(length), info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dgeqp3(n, count, a, n, order, tau, work, size(work), info)
      triangle = a(:, :count)
      call dorgqr(n, n, min(n, count), a, n, tau, work, size(work), info)
   end subroutine pivoted_qr

   !> The combinations of the rows that are zero.
   subroutine find_dependence(triangle, part, error)
      real(wp), intent(in) :: triangle(:, :)
      type(part_t), intent(inout) :: part
      type(error_t), allocatable, intent(out) :: error
      integer :: dependent, k

      dependent = size(part%row) - part%rank
      allocate (part%dependence(size(part%row), dependent), source=0.0_wp)
      if (dependent == 0) return
      part%dependence(:part%rank, :) = -triangle(:part%rank, part%rank + 1:)
      call solve_triangle('N', part%triangle, part%dependence(:part%rank, :))
      do k = 1, dependent
         part%dependence(part%rank + k, k) = 1.0_wp
         part%dependence(:, k) = part%dependence(:, k)/part%norm
      end do
      call orthonormalise(part%dependence, error)
   end subroutine find_dependence

   !> Solve R x = b or R'x = b in place.
   subroutine solve_triangle(transpose, triangle, x)
      character, intent(in) :: transpose
      real(wp), intent(in), contiguous :: triangle(:, :)
      real(wp), intent(inout) :: x(:, :)
      integer :: info

      if (size(x) == 0) return
      call dtrtrs('U', transpose, 'N', size(x, 1), size(x, 2), triangle, size(triangle, 1), x, size(x, 1), info)
   end subroutine solve_triangle

   !> Multipliers l (rows, k) with J'l = r for r (columns, k): of all those the ones of least
   !> norm, in units of the rows as given. Of r only what the rows can balance counts.
   subroutine find_multipliers(space, r, l)
      type(row_space_t), intent(in) :: space
      real(wp), intent(in) :: r(:, :)
      real(wp), intent(out) :: l(:, :)
      real(wp), allocatable :: part(:, :)
      integer :: i, k

      l = 0.0_wp
      do i = 1, size(space%part)
         associate (p => space%part(i))
            part = matmul(transpose(p%range), r(p%column, :))
            call solve_triangle('N', p%triangle, part)
            do k = 1, size(r, 2)
               l(p%row(:p%rank), k) = part(:, k)/p%norm(:p%rank)
            end do
            if (size(p%dependence, 2) > 0) &
               l(p%row, :) = l(p%row, :) - matmul(p%dependence, matmul(transpose(p%dependence), l(p%row, :)))
         end associate
      end do
   end subroutine find_multipliers

   !> Vectors x (columns, k) of least norm with J x = c for c (rows, k). Of c is left out what
   !> contradicts itself in dependent rows; mismatch (k) is its part of the norm of c.
   subroutine follow_rows(space, c, x, mismatch)
      type(row_space_t), intent(in) :: space
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(out) :: x(:, :), mismatch(:)
      real(wp), allocatable :: part(:, :), left(:, :)
      integer :: i, k

      x = 0.0_wp
      mismatch = 0.0_wp
      do i = 1, size(space%part)
         associate (p => space%part(i))
            part = c(p%row, :)
            if (size(p%dependence, 2) > 0) then
               left = matmul(transpose(p%dependence), part)
               mismatch = hypot(mismatch, norm2(left, 1))
               part = part - matmul(p%dependence, left)
            end if
            do k = 1, size(c, 2)
               part(:, k) = part(:, k)/p%norm
            end do
            part = part(:p%rank, :)
            call solve_triangle('T', p%triangle, part)
            x(p%column, :) = matmul(p%range, part)
         end associate
      end do
      where (mismatch > 0) mismatch = mismatch/norm2(c, 1)
   end subroutine follow_rows
end module flexact_row_space
