! SPDX-License-Identifier: BSD-3-Clause
!> Sparse matrices, their connected components, sparse vectors side by side, sorting.
program test_sparse
   use flexact_components, only: components_t, find_components
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t, compress, transposed, times, times_transposed, submatrix, norm_bound, operator_of
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   use flexact_test_matrices, only: sparse_of, dense_of, random_orthogonal
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   integer :: m, n

   call set_random()
   do m = 0, 6
      do n = 0, 6
         call products_are_those_of_dense_matrices(m, n)
      end do
   end do
   call a_list_is_compressed()
   call a_submatrix_is_cut_out()
   call the_norm_is_not_above_its_bound()
   call blocks_are_components()
   call a_long_path_is_one_component()
   call no_components_of_nothing()
   call keys_ascend()
   call a_basis_grows()
   call removal_leaves_the_rest()
   call tally%finish()

contains

   !> Small whole numbers, so that sums are exact, and many zeros.
   function random_sparse(m, n) result(dense)
      integer, intent(in) :: m, n
      real(wp) :: dense(m, n)

      call random_number(dense)
      dense = merge(anint(20*dense) - 5.0_wp, 0.0_wp, dense < 0.5_wp)
   end function random_sparse

   subroutine products_are_those_of_dense_matrices(m, n)
      integer, intent(in) :: m, n
      real(wp) :: dense(m, n), x(n, 3), y(m, 3), image(m, 3), back(n, 3)
      type(sparse_t) :: matrix, transpose_of

      dense = random_sparse(m, n)
      matrix = sparse_of(dense)
      call tally%near([dense_of(matrix)], [dense], 0.0_wp, 'compressed')
      call tally%check(matrix%start(n + 1) - 1 == count(abs(dense) > 0), 'zeros are not kept')
      call transposed(matrix, transpose_of)
      call tally%check(transpose_of%rows == n .and. transpose_of%columns == m, 'sides change places')
      call tally%near([dense_of(transpose_of)], [transpose(dense)], 0.0_wp, 'transposed')
      call tally%check(ascend(transpose_of), 'rows ascend in the columns of a transpose')
      x = random_sparse(n, 3)
      y = random_sparse(m, 3)
      call times(matrix, x, image)
      call tally%near([image], [matmul(dense, x)], 0.0_wp, 'A x')
      call times_transposed(transpose_of, x, image)
      call tally%near([image], [matmul(dense, x)], 0.0_wp, 'A x by the transpose')
      call times_transposed(matrix, y, back)
      call tally%near([back], [matmul(transpose(dense), y)], 0.0_wp, 'A'' y')
   end subroutine products_are_those_of_dense_matrices

   logical function ascend(matrix)
      type(sparse_t), intent(in) :: matrix
      integer :: j

      ascend = .true.
      do j = 1, matrix%columns
         associate (from => matrix%start(j), to => matrix%start(j + 1) - 1)
            ascend = ascend .and. all(matrix%place(from + 1:to) > matrix%place(from:to - 1))
         end associate
      end do
   end function ascend

   !> Places with a 0 are left out, and columns keep the order of the list.
   subroutine a_list_is_compressed()
      type(sparse_t) :: matrix

      call compress(3, 4, [3, 1, 0, 2, 1, 2], [1, 1, 2, 0, 4, 4], [5.0_wp, 6.0_wp, 7.0_wp, 8.0_wp, 9.0_wp, 1.0_wp], matrix)
      call tally%check(all(matrix%start == [1, 3, 3, 3, 5]), 'where columns start')
      call tally%check(all(matrix%place == [3, 1, 1, 2]), 'their rows')
      call tally%near(matrix%value, [5.0_wp, 6.0_wp, 9.0_wp, 1.0_wp], 0.0_wp, 'their values')
   end subroutine a_list_is_compressed

   subroutine a_submatrix_is_cut_out()
      real(wp) :: dense(6, 5)
      type(sparse_t) :: part

      dense = 0.0_wp
      dense([2, 5, 6], [1, 3, 4]) = reshape([1.0_wp, 2.0_wp, 0.0_wp, 3.0_wp, 0.0_wp, 4.0_wp, 0.0_wp, 0.0_wp, 5.0_wp], [3, 3])
      dense([1, 3], [2, 5]) = 9.0_wp
      call submatrix(sparse_of(dense), 3, [1, 3, 4], [0, 1, 0, 0, 2, 3], part)
      call tally%near([dense_of(part)], [dense([2, 5, 6], [1, 3, 4])], 0.0_wp, 'some rows and columns')
      call submatrix(sparse_of(dense), 3, [integer ::], [0, 1, 0, 0, 2, 3], part)
      call tally%check(part%rows == 3 .and. part%columns == 0 .and. size(part%value) == 0, 'no columns')
   end subroutine a_submatrix_is_cut_out

   !> Of an orthogonal matrix the norm is 1, of one of equal entries it is the bound.
   subroutine the_norm_is_not_above_its_bound()
      real(wp) :: ones(3, 4), none(0, 4)
      integer :: k

      do k = 2, 8
         call tally%check(norm_bound(sparse_of(7*random_orthogonal(k))) >= 7*(1 - 1.0e-12_wp), 'not below the norm')
      end do
      ones = -1.0_wp
      call tally%near([norm_bound(sparse_of(ones))], [sqrt(12.0_wp)], 1.0e-15_wp, 'the norm where all entries are equal')
      call tally%near([norm_bound(sparse_of(none)), norm_bound(sparse_of(0*ones))], [0.0_wp, 0.0_wp], 0.0_wp, 'of nothing')
      call tally%near([norm_bound(sparse_of(1.0e200_wp*ones))/1.0e200_wp], [sqrt(12.0_wp)], 1.0e-15_wp, 'no overflow')
   end subroutine the_norm_is_not_above_its_bound

   !> Rows 2 and 5 with columns 3 and 6, row 3 with column 1; columns 2 and 5 and
   !> row 4 with nothing; row 1 joins columns 4 and 7.
   subroutine blocks_are_components()
      real(wp) :: dense(5, 7)
      type(sparse_t) :: matrix
      type(components_t) :: components

      dense = 0.0_wp
      dense(2, 3) = 1.0_wp
      dense(5, [3, 6]) = 1.0_wp
      dense(3, 1) = -2.0_wp
      dense(1, [4, 7]) = 1.0e-300_wp
      matrix = sparse_of(dense)
      call find_components(operator_of(matrix), components)
      call tally%check(components%count == 6, 'six components')
      call tally%check(all(components%column_start == [1, 2, 3, 5, 7, 8, 8]), 'how many columns each has')
      call tally%check(all(components%column == [1, 2, 3, 6, 4, 7, 5]), 'in the order of first columns')
      call tally%check(all(components%row_start == [1, 2, 2, 4, 5, 5, 6]), 'how many rows each has')
      call tally%check(all(components%row == [3, 2, 5, 1, 4]), 'a row without columns comes last')
   end subroutine blocks_are_components

   !> Each row joins two columns, shuffled; without one of them there are two components.
   subroutine a_long_path_is_one_component()
      integer, parameter :: n = 71
      real(wp) :: dense(n - 1, n)
      type(sparse_t) :: matrix
      type(components_t) :: components
      integer :: i

      dense = 0.0_wp
      do i = 1, n - 1
         dense(modulo(37*i, n - 1) + 1, modulo(17*[i, i + 1], n) + 1) = [1.0_wp, -1.0_wp]
      end do
      matrix = sparse_of(dense)
      call find_components(operator_of(matrix), components)
      call tally%check(components%count == 1, 'a path is one component')
      call tally%check(all(components%column == [(i, i=1, n)]) .and. all(components%row == [(i, i=1, n - 1)]), 'with all in it')
      dense(modulo(37*30, n - 1) + 1, :) = 0.0_wp
      matrix = sparse_of(dense)
      call find_components(operator_of(matrix), components)
      call tally%check(components%count == 3, 'cut, it is two, and the row that cut it')
      call tally%check(all(sizes(components%column_start) == [41, 30, 0] .or. sizes(components%column_start) == [30, 41, 0]), &
                       'cut where it was cut')
   end subroutine a_long_path_is_one_component

   pure function sizes(start)
      integer, intent(in) :: start(:)
      integer :: sizes(size(start) - 1)
      sizes = start(2:) - start(:size(start) - 1)
   end function sizes

   subroutine no_components_of_nothing()
      real(wp) :: none(0, 0), narrow(3, 0), flat(0, 2)
      type(components_t) :: components

      call find_components(operator_of(sparse_of(none)), components)
      call tally%check(components%count == 0 .and. size(components%row) == 0 .and. size(components%column) == 0, 'nothing')
      call find_components(operator_of(sparse_of(narrow)), components)
      call tally%check(components%count == 3 .and. all(components%row == [1, 2, 3]), 'no columns')
      call tally%check(all(components%column_start == 1), 'none in any of them')
      call find_components(operator_of(sparse_of(flat)), components)
      call tally%check(components%count == 2 .and. all(components%column == [1, 2]), 'no rows')
      call tally%check(all(components%row_start == 1), 'nor in any of these')
   end subroutine no_components_of_nothing

   subroutine keys_ascend()
      real(wp), allocatable :: keys(:)
      integer, allocatable :: order(:)
      integer :: n, i

      do n = 0, 40
         allocate (keys(n))
         call random_number(keys)
         keys = anint(10*keys) - 5
         order = ascending(keys)
         call tally%check(all([(count(order == i) == 1, i=1, n)]), 'a permutation')
         associate (a => order(:n - 1), b => order(2:))
            call tally%check(all(keys(a) < keys(b) .or. (keys(a) <= keys(b) .and. a < b)), 'ascending, equal ones in their order')
         end associate
         deallocate (keys)
      end do
      keys = [(real(i, wp), i=1000, 1, -1)]
      call tally%check(all(ascending(keys) == [(i, i=1000, 1, -1)]), 'descending ones are reversed')
      call tally%check(all(ascending(-keys) == [(i, i=1, 1000)]), 'ascending ones stay')
   end subroutine keys_ascend

   !> Beyond the room that it starts with; one vector in ten is empty.
   subroutine a_basis_grows()
      type(sparse_basis_t) :: basis
      integer :: k, i, count
      logical :: is_kept

      call new_sparse_basis(basis)
      call tally%check(basis%vectors == 0 .and. basis%entries() == 0, 'empty at first')
      count = 0
      do k = 1, 100
         call basis%add([(i, i=k, k + modulo(k, 10) - 1)], [(real(i*k, wp), i=1, modulo(k, 10))])
         count = count + modulo(k, 10)
      end do
      call tally%check(basis%vectors == 100 .and. basis%entries() == count, 'all entries are there')
      is_kept = .true.
      do k = 1, 100
         associate (from => basis%start(k), to => basis%start(k + 1) - 1)
            is_kept = is_kept .and. to - from + 1 == modulo(k, 10)
            is_kept = is_kept .and. all(basis%place(from:to) == [(i, i=k, k + modulo(k, 10) - 1)])
            is_kept = is_kept .and. all(basis%value(from:to) == [(real(i*k, wp), i=1, modulo(k, 10))])
         end associate
      end do
      call tally%check(is_kept, 'each vector is what it was')
      call new_sparse_basis(basis)
      call basis%add([(i, i=1, 1000)], [(real(i, wp), i=1, 1000)])
      call tally%check(basis%entries() == 1000 .and. basis%place(1000) == 1000, 'one long vector')
   end subroutine a_basis_grows

   !> Of [1 2 3 4 5] without its parts along e2 and (e1 - e4)/sqrt(2) the rest is
   !> [5/2 0 3 5/2 5].
   subroutine removal_leaves_the_rest()
      real(wp), parameter :: h = sqrt(0.5_wp)
      real(wp) :: vectors(5, 2), none(5, 0)
      type(sparse_basis_t) :: basis

      vectors(:, 1) = [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp]
      vectors(:, 2) = [0.0_wp, 7.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      call new_sparse_basis(basis)
      call basis%deflate(vectors)
      call tally%near(vectors(:, 1), [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp], 0.0_wp, 'an empty basis removes nothing')
      call basis%add([2], [1.0_wp])
      call basis%add([1, 4], [h, -h])
      call basis%deflate(vectors)
      call tally%near(vectors(:, 1), [2.5_wp, 0.0_wp, 3.0_wp, 2.5_wp, 5.0_wp], 1.0e-15_wp, 'what is left')
      call tally%near(vectors(:, 2), spread(0.0_wp, 1, 5), 0.0_wp, 'nothing is left of what is in it')
      call basis%deflate(none)
   end subroutine removal_leaves_the_rest
end program test_sparse
