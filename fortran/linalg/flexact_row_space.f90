! SPDX-License-Identifier: BSD-3-Clause
!> What sparse rows J (m, n) leave free, and what they hold: a sparse orthonormal basis Z of
!> the vectors with J z = 0, vectors x of least norm with J x = c, and multipliers l of least
!> norm with J'l = r. Connected components of J are decomposed one by one, by
!> QR factorisation of their rows, scaled to unit norm, with pivoting (Golub and Van Loan,
!> Matrix Computations, section 5.4): the longest rest comes first, and a rest shorter than
!> the tolerance is of a row that depends on those before.
!>
!> Of a large component the columns are first gathered in clusters. Rows within a cluster are
!> decomposed there; of what they leave, all that no other row touches joins the basis, and the
!> others of its vectors, orthonormal too, are the columns of what is left to decompose.
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

   !> Columns and the rows that have no others; of the other rows those that it crosses. Rows are
   !> counted as in the component.
   type :: cluster_t
      integer, allocatable :: column(:), row(:), crossing(:)
      !> Before which column of what is left to decompose those of `joined` stand.
      integer :: before = 0
      !> As of a component, of its rows alone.
      real(wp), allocatable :: triangle(:, :), range(:, :)
      !> Of its dependent rows, which come last, what takes them away, (rank, :).
      real(wp), allocatable :: dependent(:, :)
      !> The crossing rows, scaled, (columns, crossing); the vectors that they touch, (columns, :).
      real(wp), allocatable :: across(:, :), joined(:, :)
   end type cluster_t

   !> A component with rows.
   type :: part_t
      integer :: rank = 0
      !> Its rows, independent ones first, and its columns; those of clusters stand behind.
      integer, allocatable :: row(:), column(:)
      type(cluster_t), allocatable :: cluster(:)
      !> Norms of the rows.
      real(wp), allocatable :: norm(:)
      !> Scaled independent rows = triangle' range', (rank, rank) and (columns, rank); of clusters
      !> the columns that are left.
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
   !> Columns of a component beyond which it has clusters, and of a cluster, about.
   integer, parameter :: large = 240, about = 64
   !> Entries of scaled rows up to this do not touch a vector.
   real(wp), parameter :: rounding = 1.0e-14_wp

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
               space%dependent = space%dependent + size(space%part(found)%dependence, 2)
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
      integer, allocatable :: order(:), crossing(:)
      integer :: k

      part%row = row
      part%column = column
      allocate (part%norm(size(row)))
      if (size(column) > large) then
         call split(a, least, part, crossing, q, basis, shortest, error)
         if (allocated(error)) return
      else
         allocate (part%cluster(0))
         call fill_part(a, row, column, part%norm, q)
         crossing = [(k, k=1, size(row))]
      end if
      allocate (order(size(crossing)))
      call pivoted_qr(q, size(crossing), order, triangle, error)
      if (allocated(error)) return
      call cut(q, triangle, least, part%rank, part%triangle, part%range, shortest)
      call put_first(part, crossing(order))
      call find_dependence(triangle, part, error)
      do k = part%rank + 1, size(q, 1)
         call basis%add(column, expanded(part, q(:, k)))
      end do
   end subroutine decompose_part

   !> How many of the rows are independent, and what is kept of them.
   pure subroutine cut(q, triangle, least, rank, kept, range, shortest)
      real(wp), intent(in) :: q(:, :), triangle(:, :), least
      integer, intent(out) :: rank
      real(wp), allocatable, intent(out) :: kept(:, :), range(:, :)
      real(wp), intent(inout) :: shortest
      integer :: k

      rank = count([(abs(triangle(k, k)) > least, k=1, minval(shape(triangle)))])
      if (rank > 0) shortest = min(shortest, abs(triangle(rank, rank)))
      range = q(:, :rank)
      kept = triangle(:rank, :rank)
   end subroutine cut

   !> A vector of the columns of a component, of what is left to decompose.
   pure function expanded(part, y) result(x)
      type(part_t), intent(in) :: part
      real(wp), intent(in) :: y(:)
      real(wp), allocatable :: x(:)
      integer :: g

      if (size(part%cluster) == 0) then
         x = y
         return
      end if
      allocate (x(size(part%column)))
      do g = 1, size(part%cluster)
         associate (c => part%cluster(g))
            x(c%column) = matmul(c%joined, y(c%before + 1:c%before + size(c%joined, 2)))
         end associate
      end do
   end function expanded

   !> Make these rows the first ones.
   pure subroutine put_first(part, first)
      type(part_t), intent(inout) :: part
      integer, intent(in) :: first(:)
      integer :: order(size(part%row)), place(size(part%row)), k, g
      logical :: is_first(size(part%row))

      is_first = .false.
      is_first(first) = .true.
      order(:size(first)) = first
      order(size(first) + 1:) = pack([(k, k=1, size(part%row))], mask=.not. is_first)
      place(order) = [(k, k=1, size(order))]
      part%row = part%row(order)
      part%norm = part%norm(order)
      do g = 1, size(part%cluster)
         part%cluster(g)%row = place(part%cluster(g)%row)
         part%cluster(g)%crossing = place(part%cluster(g)%crossing)
      end do
   end subroutine put_first

   !> Decompose clusters; what is left: the crossing rows as columns of a dense matrix.
   subroutine split(a, least, part, crossing, left, basis, shortest, error)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: least
      type(part_t), intent(inout) :: part
      integer, allocatable, intent(out) :: crossing(:)
      real(wp), allocatable, intent(out) :: left(:, :)
      type(sparse_basis_t), intent(inout) :: basis
      real(wp), intent(inout) :: shortest
      type(error_t), allocatable, intent(out) :: error
      integer :: of_column(size(part%column)), of_row(size(part%row)), place(size(part%row)), g, k, i, columns

      call gather(a, part, of_column, of_row)
      allocate (part%cluster(maxval(of_column)))
      crossing = pack([(k, k=1, size(of_row))], of_row == 0)
      place(crossing) = [(k, k=1, size(crossing))]
      columns = 0
      do g = 1, size(part%cluster)
         part%cluster(g)%before = columns
         call decompose_cluster(a, pack([(k, k=1, size(of_column))], of_column == g), &
                                pack([(k, k=1, size(of_row))], of_row == g), least, part, part%cluster(g), basis, shortest, error)
         if (allocated(error)) return
         columns = columns + size(part%cluster(g)%joined, 2)
      end do
      allocate (left(columns, max(columns, size(crossing))), source=0.0_wp)
      do g = 1, size(part%cluster)
         associate (c => part%cluster(g))
            do i = 1, size(c%crossing)
               left(c%before + 1:c%before + size(c%joined, 2), place(c%crossing(i))) = matmul(c%across(:, i), c%joined)
            end do
         end associate
      end do
   end subroutine split

   !> The cluster of each column, and of each row, 0 where its columns are of several; and the norms
   !> of the rows.
   pure subroutine gather(a, part, of_column, of_row)
      type(operator_t), intent(in) :: a
      type(part_t), intent(inout) :: part
      integer, intent(out) :: of_column(:), of_row(:)
      integer :: seed, g, i, k, entry, found, row, column, listed(size(of_column))

      of_column = 0
      g = 0
      do seed = 1, size(of_column)
         if (of_column(seed) > 0) cycle
         g = g + 1
         found = 1
         listed(1) = seed
         of_column(seed) = g
         k = 0
         do while (k < found .and. found < about)
            k = k + 1
            do i = a%by_column%start(part%column(listed(k))), a%by_column%start(part%column(listed(k)) + 1) - 1
               row = a%by_column%place(i)
               do entry = a%by_row%start(row), a%by_row%start(row + 1) - 1
                  column = place_in(part%column, a%by_row%place(entry))
                  if (of_column(column) > 0) cycle
                  of_column(column) = g
                  found = found + 1
                  listed(found) = column
               end do
            end do
         end do
      end do
      do i = 1, size(of_row)
         associate (first => a%by_row%start(part%row(i)), last => a%by_row%start(part%row(i) + 1) - 1)
            part%norm(i) = norm2(a%by_row%value(first:last))
            if (.not. part%norm(i) > 0) part%norm(i) = 1.0_wp
            of_row(i) = 1
            do entry = first, last
               column = of_column(place_in(part%column, a%by_row%place(entry)))
               if (entry == first) of_row(i) = column
               if (column /= of_row(i)) of_row(i) = 0
               if (of_row(i) == 0) exit
            end do
         end associate
      end do
   end subroutine gather

   !> Decompose the rows within a cluster, by columns and rows of the component.
   subroutine decompose_cluster(a, column, row, least, part, cluster, basis, shortest, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: column(:), row(:)
      real(wp), intent(in) :: least
      type(part_t), intent(in) :: part
      type(cluster_t), intent(inout) :: cluster
      type(sparse_basis_t), intent(inout) :: basis
      real(wp), intent(inout) :: shortest
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: q(:, :), z(:, :), triangle(:, :)
      integer, allocatable :: order(:)
      integer :: at(size(part%row)), i, k, entry, rank, touched

      at = 0
      at(row) = [(i, i=1, size(row))]
      allocate (cluster%crossing(0))
      do k = 1, size(column)
         do entry = a%by_column%start(part%column(column(k))), a%by_column%start(part%column(column(k)) + 1) - 1
            i = place_in(part%row, a%by_column%place(entry))
            if (at(i) > 0) cycle
            cluster%crossing = [cluster%crossing, i]
            at(i) = size(cluster%crossing) + size(row)
         end do
      end do
      allocate (cluster%across(size(column), size(cluster%crossing)), source=0.0_wp)
      allocate (q(size(column), max(size(row), size(column))), source=0.0_wp)
      do k = 1, size(column)
         do entry = a%by_column%start(part%column(column(k))), a%by_column%start(part%column(column(k)) + 1) - 1
            i = place_in(part%row, a%by_column%place(entry))
            associate (value => a%by_column%value(entry)/part%norm(i))
               if (at(i) <= size(row)) then
                  q(k, at(i)) = q(k, at(i)) + value
               else
                  cluster%across(k, at(i) - size(row)) = cluster%across(k, at(i) - size(row)) + value
               end if
            end associate
         end do
      end do
      allocate (order(size(row)))
      call pivoted_qr(q, size(row), order, triangle, error)
      if (allocated(error)) return
      call cut(q, triangle, least, rank, cluster%triangle, cluster%range, shortest)
      cluster%column = column
      cluster%row = row(order)
      cluster%dependent = -triangle(:rank, rank + 1:)
      call solve_triangle('N', cluster%triangle, cluster%dependent)
      z = q(:, rank + 1:size(column))
      touched = size(cluster%crossing)
      deallocate (q, order)
      allocate (q(size(z, 2), max(size(z, 2), touched)), order(touched))
      q(:, :touched) = matmul(transpose(z), cluster%across)
      call pivoted_qr(q, touched, order, triangle, error)
      if (allocated(error)) return
      touched = count([(abs(triangle(k, k)) > rounding, k=1, minval(shape(triangle)))])
      z = matmul(z, q(:, :size(z, 2)))
      cluster%joined = z(:, :touched)
      do k = touched + 1, size(z, 2)
         call basis%add(part%column(column), z(:, k))
      end do
   end subroutine decompose_cluster

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
      if (count == 0) then
         a = 0.0_wp
         do k = 1, n
            a(k, k) = 1.0_wp
         end do
      end if
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
      integer :: dependent, g, k, rank

      dependent = size(triangle, 2) - part%rank
      k = dependent + sum([(size(part%cluster(g)%dependent, 2), g=1, size(part%cluster))])
      allocate (part%dependence(size(part%row), k), source=0.0_wp)
      if (k == 0) return
      part%dependence(:part%rank, :dependent) = -triangle(:part%rank, part%rank + 1:)
      call solve_triangle('N', part%triangle, part%dependence(:part%rank, :dependent))
      do k = 1, dependent
         part%dependence(part%rank + k, k) = 1.0_wp
      end do
      do g = 1, size(part%cluster)
         associate (c => part%cluster(g))
            rank = size(c%triangle, 1)
            part%dependence(c%row(:rank), :dependent) = -balanced(c, matmul(c%across, part%dependence(c%crossing, :dependent)))
            do k = 1, size(c%dependent, 2)
               part%dependence(c%row(:rank), dependent + k) = c%dependent(:, k)
               part%dependence(c%row(rank + k), dependent + k) = 1.0_wp
            end do
            dependent = dependent + size(c%dependent, 2)
         end associate
      end do
      do k = 1, size(part%dependence, 2)
         part%dependence(:, k) = part%dependence(:, k)/part%norm
      end do
      call orthonormalise(part%dependence, error)
   end subroutine find_dependence

   !> Multipliers of the scaled independent rows of a cluster that balance r (columns, k).
   function balanced(cluster, r) result(l)
      type(cluster_t), intent(in) :: cluster
      real(wp), intent(in) :: r(:, :)
      real(wp), allocatable :: l(:, :)

      l = matmul(transpose(cluster%range), r)
      call solve_triangle('N', cluster%triangle, l)
   end function balanced

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
      real(wp), allocatable :: part(:, :), left(:, :), own(:, :)
      integer :: i, k, g

      l = 0.0_wp
      do i = 1, size(space%part)
         associate (p => space%part(i))
            left = r(p%column, :)
            part = matmul(transpose(p%range), gathered(p, left))
            call solve_triangle('N', p%triangle, part)
            allocate (own(size(p%row), size(r, 2)), source=0.0_wp)
            own(:p%rank, :) = part
            do g = 1, size(p%cluster)
               associate (c => p%cluster(g))
                  own(c%row(:size(c%triangle, 1)), :) = balanced(c, left(c%column, :) - matmul(c%across, own(c%crossing, :)))
               end associate
            end do
            do k = 1, size(r, 2)
               l(p%row, k) = own(:, k)/p%norm
            end do
            deallocate (own)
            if (size(p%dependence, 2) > 0) &
               l(p%row, :) = l(p%row, :) - matmul(p%dependence, matmul(transpose(p%dependence), l(p%row, :)))
         end associate
      end do
   end subroutine find_multipliers

   !> Of what stands in the columns of a component what is left to decompose has: the transpose of
   !> `expanded`.
   pure function gathered(part, x) result(y)
      type(part_t), intent(in) :: part
      real(wp), intent(in) :: x(:, :)
      real(wp), allocatable :: y(:, :)
      integer :: g

      if (size(part%cluster) == 0) then
         y = x
         return
      end if
      allocate (y(size(part%range, 1), size(x, 2)))
      do g = 1, size(part%cluster)
         associate (c => part%cluster(g))
            y(c%before + 1:c%before + size(c%joined, 2), :) = matmul(transpose(c%joined), x(c%column, :))
         end associate
      end do
   end function gathered

   !> Vectors x (columns, k) of least norm with J x = c for c (rows, k). Of c is left out what
   !> contradicts itself in dependent rows; mismatch (k) is its part of the norm of c.
   subroutine follow_rows(space, c, x, mismatch)
      type(row_space_t), intent(in) :: space
      real(wp), intent(in) :: c(:, :)
      real(wp), intent(out) :: x(:, :), mismatch(:)
      real(wp), allocatable :: part(:, :), left(:, :), own(:, :)
      integer :: i, k, g

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
            do g = 1, size(p%cluster)
               associate (of => p%cluster(g))
                  own = part(of%row(:size(of%triangle, 1)), :)
                  call solve_triangle('T', of%triangle, own)
                  own = matmul(of%range, own)
                  x(p%column(of%column), :) = own
                  part(of%crossing, :) = part(of%crossing, :) - matmul(transpose(of%across), own)
               end associate
            end do
            part = part(:p%rank, :)
            call solve_triangle('T', p%triangle, part)
            part = matmul(p%range, part)
            do k = 1, size(c, 2)
               x(p%column, k) = x(p%column, k) + expanded(p, part(:, k))
            end do
         end associate
      end do
      where (mismatch > 0) mismatch = mismatch/norm2(c, 1)
   end subroutine follow_rows
end module flexact_row_space
