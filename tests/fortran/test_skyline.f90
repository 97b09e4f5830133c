! SPDX-License-Identifier: BSD-3-Clause
!> A'A, its skyline, its graph, and the Cholesky factorisation in the skyline.
program test_skyline
   use flexact_components, only: breadth_first_order
   use flexact_gram, only: gram_t, make_gram, group_graph
   use flexact_kinds, only: wp
   use flexact_skyline, only: skyline_t, skyline_size, fill_skyline, factorise, solve
   use flexact_sparse, only: sparse_t, operator_t, operator_of, transposed
   use flexact_test_matrices, only: identity, sparse_of, path
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call a_shuffled_path_comes_in_order()
   call the_skyline_holds_the_matrix()
   call the_lower_triangle()
   call groups_that_share_rows()
   call a_definite_matrix()
   call dependent_columns_are_pinned()
   call all_zero()
   call a_long_path()
   call tally%finish()

contains

   !> A matrix (m, n) some of whose entries are zero.
   function random_sparse(m, n, share) result(dense)
      integer, intent(in) :: m, n
      real(wp), intent(in) :: share
      real(wp) :: dense(m, n), chance(m, n)

      call random_number(dense)
      call random_number(chance)
      dense = merge(dense - 0.5_wp, 0.0_wp, chance < share)
   end function random_sparse

   subroutine make_skyline(by_row, place_of, shift, matrix, first, entries)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: place_of(:)
      real(wp), intent(in) :: shift
      type(skyline_t), intent(out) :: matrix
      integer, intent(out) :: first(:)
      real(wp), intent(out) :: entries

      call skyline_size(by_row, place_of, first, entries)
      call fill_skyline(by_row, place_of, first, shift, matrix)
   end subroutine make_skyline

   !> Every row of a path joins neighbours, so that its skyline has 2 n - 1 entries.
   subroutine a_shuffled_path_comes_in_order()
      integer, parameter :: n = 53
      real(wp) :: dense(n - 1, n), entries
      integer :: order(n), place_of(n), first(n), i
      type(sparse_t) :: by_column, by_row

      dense = 0.0_wp
      do i = 1, n - 1
         dense(i, modulo(20*[i, i + 1], n) + 1) = 1.0_wp
      end do
      by_column = sparse_of(dense)
      by_row = sparse_of(transpose(dense))
      call breadth_first_order(operator_t(by_column, by_row), order)
      place_of = 0
      place_of(order) = [(i, i=1, n)]
      call tally%check(all(place_of > 0), 'every column once')
      call skyline_size(by_row, place_of, first, entries)
      call tally%near([entries], [2.0_wp*n - 1], 0.0_wp, 'neighbours stand side by side')
      call tally%check(first(1) == 1 .and. all(first(2:) == [(i, i=1, n - 1)]), 'each row from its neighbour on')
      call skyline_size(by_row, [(i, i=1, n)], first, entries)
      call tally%check(entries > 4*n, 'not so in the order as given')
   end subroutine a_shuffled_path_comes_in_order

   !> In a random order of the columns.
   subroutine the_skyline_holds_the_matrix()
      integer, parameter :: m = 30, n = 20
      integer :: place_of(n), first(n), i
      real(wp) :: dense(m, n), expected(n, n), entries
      type(skyline_t) :: matrix

      dense = random_sparse(m, n, 0.1_wp)
      place_of = [(modulo(7*i, n) + 1, i=1, n)]
      expected(place_of, place_of) = matmul(transpose(dense), dense) - 0.25_wp*identity(n)
      call make_skyline(sparse_of(transpose(dense)), place_of, 0.25_wp, matrix, first, entries)
      call tally%near([real(size(matrix%value), wp)], [entries], 0.0_wp, 'as many entries as were counted')
      call tally%near([symmetric(lower(matrix))], [expected], 1.0e-15_wp, 'A''A - shift I')
      call tally%check(all([(first(i) == i .or. abs(expected(i, first(i))) > 0, i=1, n)]), 'no wider than need be')
   end subroutine the_skyline_holds_the_matrix

   function lower(matrix) result(dense)
      type(skyline_t), intent(in) :: matrix
      real(wp) :: dense(matrix%n, matrix%n)
      integer :: i, j

      dense = 0.0_wp
      do i = 1, matrix%n
         do j = matrix%first(i), i
            dense(i, j) = matrix%value(matrix%base(i) + j)
         end do
      end do
   end function lower

   function symmetric(lower) result(dense)
      real(wp), intent(in) :: lower(:, :)
      real(wp) :: dense(size(lower, 1), size(lower, 1))

      dense = lower + transpose(lower) - lower*identity(size(lower, 1))
   end function symmetric

   subroutine the_lower_triangle()
      integer, parameter :: m = 25, n = 18
      real(wp) :: dense(m, n), expected(n, n), found(n, n)
      type(gram_t) :: gram
      real(wp) :: bytes
      integer :: i, j, entry

      dense = random_sparse(m, n, 0.1_wp)
      dense(:, 5) = 0.0_wp
      call make_gram(operator_of(sparse_of(dense)), huge(1.0_wp), gram, bytes)
      found = 0.0_wp
      do j = 1, n
         do entry = gram%start(j) + 1, gram%start(j + 1)
            call tally%check(gram%place(entry) >= j - 1, 'below the diagonal')
            found(gram%place(entry) + 1, j) = found(gram%place(entry) + 1, j) + gram%value(entry)
         end do
      end do
      expected = matmul(transpose(dense), dense)
      call tally%near([symmetric(found)], [expected], 1.0e-15_wp, 'A''A')
      call tally%near(gram%value(gram%diagonal), [(expected(i, i), i=1, n)], 1.0e-15_wp, 'its diagonal')
      call tally%check(size(gram%value) == count([((i >= j .and. (abs(expected(i, j)) > 0 .or. i == j), i=1, n), j=1, n)]), &
                       'no entry twice, none that is zero but on the diagonal')
   end subroutine the_lower_triangle

   !> Rows join columns of the groups 1 and 2, 2 and 4; group 3 stands alone.
   subroutine groups_that_share_rows()
      real(wp) :: dense(4, 7)
      type(gram_t) :: graph

      dense = 0.0_wp
      dense(1, [2, 3]) = 1.0_wp
      dense(2, [1, 4]) = 1.0_wp
      dense(3, [3, 7]) = 1.0_wp
      dense(4, [5, 6]) = 1.0_wp
      call group_graph(operator_of(sparse_of(dense)), [1, 1, 2, 2, 3, 3, 4], 4, graph)
      call tally%check(all(graph%start == [0, 1, 2, 2, 2]), 'how many groups each is joined with')
      call tally%check(all(graph%place(:2) == [1, 3]), 'which ones')
   end subroutine groups_that_share_rows

   !> Whole numbers with the factor [2; 1 3; 0 5 1; 4 0 2 7].
   subroutine a_definite_matrix()
      real(wp), parameter :: l(4, 4) = reshape([2.0_wp, 1.0_wp, 0.0_wp, 4.0_wp, 0.0_wp, 3.0_wp, 5.0_wp, 0.0_wp, &
                                                0.0_wp, 0.0_wp, 1.0_wp, 2.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 7.0_wp], [4, 4])
      real(wp) :: a(4, 4), x(4, 3)
      type(skyline_t) :: matrix
      integer :: pinned(4), pins, i, j

      a = matmul(l, transpose(l))
      matrix%n = 4
      matrix%first = [1, 1, 2, 1]
      matrix%base = [0, 1, 2, 5]
      matrix%value = [a(1, 1), a(2, 1:2), a(3, 2:3), a(4, :)]
      pinned = 0
      call factorise(matrix, 0.5_wp, pinned, pins)
      call tally%check(pins == 0 .and. all(pinned == 0), 'nothing is pinned')
      call tally%near([lower(matrix)], [l], 1.0e-14_wp, 'the factor')
      x = reshape([(real(modulo(5*i, 7), wp), i=1, 12)], [4, 3])
      call solve(matrix, x)
      call tally%near([matmul(a, x)], [(real(modulo(5*j, 7), wp), j=1, 12)], 1.0e-12_wp, 'solutions')
   end subroutine a_definite_matrix

   !> Columns 4 and 7 are sums of columns before them: one is added there, and only
   !> there.
   subroutine dependent_columns_are_pinned()
      integer, parameter :: n = 9
      real(wp) :: dense(20, n), expected(n, n), entries, x(n, 1), b(n, 1)
      integer :: i, first(n), pinned(n), pins
      type(skyline_t) :: matrix

      dense = random_sparse(20, n, 1.0_wp)
      dense(:, 4) = dense(:, 1) - 2*dense(:, 3)
      dense(:, 7) = dense(:, 5) + dense(:, 4)
      expected = matmul(transpose(dense), dense)
      call make_skyline(sparse_of(transpose(dense)), [(i, i=1, n)], 0.0_wp, matrix, first, entries)
      call factorise(matrix, 1.0e-10_wp, pinned, pins)
      call tally%check(pins == 2, 'two pins')
      call tally%check(all(pinned(:2) == [4, 7]), 'where a column depends on others')
      expected(4, 4) = expected(4, 4) + 1
      expected(7, 7) = expected(7, 7) + 1
      call tally%near([matmul(lower(matrix), transpose(lower(matrix)))], [expected], 1.0e-13_wp, 'L L'' = A''A + E E''')
      call random_number(b)
      x = b
      call solve(matrix, x)
      call tally%near([matmul(expected, x)], [b], 1.0e-10_wp, 'solutions')
   end subroutine dependent_columns_are_pinned

   subroutine all_zero()
      real(wp) :: zero(2, 3)
      integer :: first(3), pinned(3), pins
      real(wp) :: entries
      type(skyline_t) :: matrix

      zero = 0.0_wp
      call make_skyline(sparse_of(transpose(zero)), [3, 1, 2], 0.0_wp, matrix, first, entries)
      call tally%near([entries], [3.0_wp], 0.0_wp, 'only the diagonal')
      call factorise(matrix, 1.0e-12_wp, pinned, pins)
      call tally%check(pins == 3 .and. all(pinned == [1, 2, 3]), 'all are pinned')
      call tally%near([lower(matrix)], [identity(3)], 0.0_wp, 'which gives I')
   end subroutine all_zero

   !> Of the path A'A = [2 -1; -1 2 -1; ..] and the inverse sends ones to
   !> i (n + 1 - i)/2.
   subroutine a_long_path()
      integer, parameter :: n = 1000
      real(wp) :: x(n, 1), entries
      integer :: first(n), pinned(n), pins, i
      type(sparse_t) :: by_row
      type(skyline_t) :: matrix

      call transposed(path(n, .false.), by_row)
      call make_skyline(by_row, [(i, i=1, n)], 0.0_wp, matrix, first, entries)
      call factorise(matrix, 1.0e-12_wp, pinned, pins)
      call tally%check(pins == 0, 'the path is stiff')
      x = 1.0_wp
      call solve(matrix, x)
      call tally%near(x(:, 1)/[(0.5_wp*i*(n + 1 - i), i=1, n)], spread(1.0_wp, 1, n), 1.0e-10_wp, 'a parabola')
   end subroutine a_long_path
end program test_skyline
