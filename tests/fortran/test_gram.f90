! SPDX-License-Identifier: BSD-3-Clause
!> A'A, its graph, and its envelope.
program test_gram
   use flexact_components, only: breadth_first_order
   use flexact_error, only: error_t
   use flexact_gram, only: gram_t, make_gram, group_graph
   use flexact_kinds, only: wp
   use flexact_nested_order, only: elimination_order, envelope
   use flexact_sparse, only: operator_t, operator_of
   use flexact_test_matrices, only: identity, sparse_of
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call a_shuffled_path_comes_in_order()
   call a_broad_matrix_is_ordered_otherwise()
   call the_lower_triangle()
   call groups_that_share_rows()
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

   !> Every row of a path joins neighbours, so that its envelope has 2 n - 1 entries.
   subroutine a_shuffled_path_comes_in_order()
      integer, parameter :: n = 53
      real(wp) :: dense(n - 1, n)
      integer :: order(n), place_of(n), i
      integer, allocatable :: taken(:)
      type(operator_t) :: a
      type(error_t), allocatable :: error
      logical :: is_there

      dense = 0.0_wp
      do i = 1, n - 1
         dense(i, modulo(20*[i, i + 1], n) + 1) = 1.0_wp
      end do
      a = operator_of(sparse_of(dense))
      call breadth_first_order(a, order, 2.0_wp*n, is_there)
      call tally%check(is_there, 'an order along the band')
      place_of = 0
      place_of(order) = [(i, i=1, n)]
      call tally%check(all(place_of > 0), 'every column once')
      call tally%near([envelope(a%by_row, order)], [2.0_wp*n - 1], 0.0_wp, 'neighbours stand side by side')
      call tally%check(envelope(a%by_row, [(i, i=1, n)]) > 4*n, 'not so in the order as given')
      call elimination_order(a, [(i, i=1, n)], taken, error)
      call tally%check(.not. allocated(error) .and. all(taken == order - 1), 'along the path')
   end subroutine a_shuffled_path_comes_in_order

   !> Where every row joins all columns no band is narrow.
   subroutine a_broad_matrix_is_ordered_otherwise()
      integer, parameter :: n = 90
      real(wp) :: dense(2, n)
      integer :: place_of(n), order(n), i
      integer, allocatable :: taken(:)
      type(error_t), allocatable :: error
      type(operator_t) :: a
      logical :: is_there

      dense = 1.0_wp
      a = operator_of(sparse_of(dense))
      call tally%near([envelope(a%by_row, [(i, i=1, n)])], [0.5_wp*n*(n + 1)], 0.0_wp, 'all of a triangle')
      call breadth_first_order(a, order, 0.5_wp*n*(n + 1) - 1, is_there)
      call tally%check(.not. is_there, 'the search finds it out itself')
      call elimination_order(a, [(i, i=1, n)], taken, error)
      place_of = 0
      place_of(taken + 1) = [(i, i=1, n)]
      call tally%check(.not. allocated(error) .and. all(place_of > 0), 'broad: every column once')
   end subroutine a_broad_matrix_is_ordered_otherwise

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
end program test_gram
