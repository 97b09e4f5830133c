! SPDX-License-Identifier: BSD-3-Clause
!> Small dense matrices of full rank: a bound of their values by one factorisation, and their
!> smallest values and ends of the spectrum, against LAPACK's decomposition.
program test_small_matrices
   use flexact_decomposition, only: decompose
   use flexact_error, only: error_t
   use flexact_full_rank, only: make_dense_gram, is_above
   use flexact_gram_lanes, only: gram_pattern_t, make_gram_pattern, make_gram, find_above, spread_gram
   use flexact_kinds, only: wp, lanes
   use flexact_lowest_pairs, only: lowest_spaces, lowest_pairs, find_ends, have_lost_digits, decompose_ends
   use flexact_testing, only: tally_t, set_random
   use flexact_tridiagonal, only: tridiagonal_t, tridiagonalise, lowest_values, lowest_vectors
   implicit none
   !> Vectors that are asked for.
   integer, parameter :: pairs = 6
   type(tally_t) :: tally
   integer :: m, n, kind

   call set_random()
   do n = 1, 14
      do m = n, n + 3
         do kind = 1, 5
            call all_of(sample(m, n, kind))
            call all_of(transpose(sample(m, n, kind)))
         end do
      end do
   end do
   call all_of(sample(40, 37, 1))
   call a_rank_lost_is_seen()
   call many_equal_values()
   call nothing_at_all()
   call tally%finish()

contains

   !> Plain, with zeros, in blocks, with equal columns nearly, and badly scaled columns.
   function sample(m, n, kind) result(a)
      integer, intent(in) :: m, n, kind
      real(wp) :: a(m, n), other(m)
      integer :: i

      call random_number(a)
      a = a - 0.5_wp
      do i = 1, n
         a(i, i) = a(i, i) + 1
      end do
      select case (kind)
      case (2)
         where (abs(a) < 0.25_wp) a = 0.0_wp
      case (3)
         a(:n/2, n/2 + 1:) = 0.0_wp
         a(n/2 + 1:, :n/2) = 0.0_wp
      case (4)
         call random_number(other)
         if (n > 1) a(:, n) = a(:, 1) + 1.0e-4_wp*other
      case (5)
         a(:, :n:3) = 1.0e-3_wp*a(:, :n:3)
      end select
   end function sample

   !> In each lane a matrix that is a little larger than in the last, in the first one A.
   subroutine all_of(a)
      real(wp), intent(in) :: a(:, :)
      real(wp) :: copy(size(a, 1), size(a, 2)), values(minval(shape(a))), u(size(a, 1), size(a, 1)), &
                  vt(size(a, 2), size(a, 2)), gram(minval(shape(a)), minval(shape(a))), ends(2)
      real(wp) :: basis(lanes, minval(shape(a)), min(pairs, size(a, 1), size(a, 2)))
      real(wp) :: found(size(basis, 3)), left(size(a, 1), size(basis, 3)), right(size(a, 2), size(basis, 3)), squares(lanes, 2)
      real(wp), allocatable :: grams(:, :, :), again(:, :, :)
      logical :: above, is_found(lanes)
      type(error_t), allocatable :: error
      integer :: k, side, lane

      side = size(values)
      copy = a
      call decompose(copy, values, u, vt, error)
      call make_dense_gram(a, gram)
      call is_above(gram, sum(shape(a)), 0.99_wp*values(side), above)
      call tally%check(above .or. values(side) < 3.0e-6_wp*values(1), 'all values are above a little less than the smallest')
      call is_above(gram, sum(shape(a)), 1.01_wp*values(side), above)
      call tally%check(.not. above, 'but not above a little more')
      call in_lanes(a, values, gram, grams)
      again = grams
      call lowest_spaces(grams, basis, is_found)
      call find_ends(again, squares)
      do lane = 1, lanes, lanes - 1
         call lowest_pairs(lane*a, basis(lane, :, :), is_found(lane), found, left, right, error)
         call tally%near(found/values(1), lane*values(side:side - size(found) + 1:-1)/values(1), 1.0e-12_wp, 'the smallest values')
         do k = 1, size(found)
            ! A residual of A'A is divided by the value.
            associate (rounding => 1.0e-11_wp*values(1)**2/found(k))
               call tally%near(matmul(lane*a, right(:, k)), found(k)*left(:, k), rounding, 'and their right vectors')
               call tally%near(matmul(left(:, k), lane*a), found(k)*right(:, k), rounding, 'and their left vectors')
            end associate
         end do
         ends = sqrt(squares(lane, :))
         if (have_lost_digits(squares(lane, :))) call decompose_ends(lane*a, ends(1), ends(2), error)
         call tally%near(ends/values([side, 1]), [lane, lane]*1.0_wp, 1.0e-7_wp, 'both ends')
      end do
   end subroutine all_of

   !> The same bound, and A'A, of a times 1, 2, ... by the pattern.
   subroutine in_lanes(a, values, gram, dense)
      real(wp), intent(in) :: a(:, :), values(:), gram(:, :)
      real(wp), allocatable, intent(out) :: dense(:, :, :)
      type(gram_pattern_t) :: pattern
      integer :: row(size(a) + 1), column(size(a) + 1), used, i, j, lane
      real(wp) :: entry(lanes, size(a) + 1)
      real(wp), allocatable :: sparse(:, :)
      logical :: above(lanes)

      used = 1
      ! An entry that is none of the matrix.
      row(1) = 1
      column(1) = 0
      entry(:, 1) = 9.0_wp
      do j = 1, size(a, 2)
         do i = 1, size(a, 1)
            if (.not. abs(a(i, j)) > 0) cycle
            used = used + 1
            row(used) = i
            column(used) = j
            entry(:, used) = [(lane*a(i, j), lane=1, lanes)]
         end do
      end do
      call make_gram_pattern(size(a, 1), size(a, 2), row(:used), column(:used), pattern)
      allocate (sparse(lanes, size(pattern%place, 2)), dense(lanes, size(gram, 1), size(gram, 1)))
      call make_gram(pattern, entry(:, :used), sparse)
      dense = 0.0_wp
      call spread_gram(pattern, sparse, dense)
      do j = 1, size(gram, 1)
         call tally%near(dense(lanes, j:, j), lanes**2*gram(j:, j), 1.0e-12_wp*values(1)**2, 'products in lanes')
      end do
      call find_above(pattern, sparse, [(0.99_wp*lane*minval(values), lane=1, lanes)], above)
      call tally%check(all(above) .or. minval(values) < 3.0e-6_wp*values(1), 'all values are above in lanes')
      call find_above(pattern, sparse, [(merge(1.01_wp, 0.9_wp, lane == 3)*lane*minval(values), lane=1, lanes)], above)
      call tally%check(.not. above(3) .and. (above(1) .or. minval(values) < 3.0e-6_wp*values(1)), 'but for one lane')
   end subroutine in_lanes

   !> A value far below rounding is not above anything that can be shown.
   subroutine a_rank_lost_is_seen()
      real(wp) :: a(9, 9), gram(9, 9)
      logical :: above

      a = sample(9, 9, 1)
      a(:, 5) = a(:, 2) - 2*a(:, 7)
      call make_dense_gram(a, gram)
      call is_above(gram, 18, 1.0e-12_wp, above)
      call tally%check(.not. above, 'a dependent column')
   end subroutine a_rank_lost_is_seen

   !> Reflections and multiples of the identity have one value many times; beside it is a matrix that
   !> has none twice.
   subroutine many_equal_values()
      real(wp) :: a(12, 12), v(12), basis(lanes, 12, pairs), value(lanes, pairs), squares(lanes, 2)
      real(wp), allocatable :: both(:, :, :)
      type(tridiagonal_t) :: t
      logical :: is_found(lanes)
      integer :: i, k

      call random_number(v)
      a = -2*spread(v, 2, 12)*spread(v, 1, 12)/sum(v**2)
      do i = 1, 12
         a(i, i) = a(i, i) + 3
      end do
      do k = 1, 2
         allocate (both(lanes, 12, 12), source=spread(a, 1, lanes))
         both(2, :, :) = 0.0_wp
         do i = 1, 12
            both(2, i, i) = real(i, wp)
         end do
         if (k == 1) then
            call tridiagonalise(both, t)
         else
            call find_ends(both, squares)
         end if
      end do
      call tally%near(squares(1, :), [1.0_wp, 3.0_wp], 1.0e-14_wp, 'ends of one and three')
      call tally%near(squares(2, :), [1.0_wp, 12.0_wp], 1.0e-14_wp, 'ends of one to twelve')
      call lowest_values(t, 1.0e-12_wp, value)
      call tally%near(value(1, :), [1.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 3.0_wp], 1.0e-10_wp, 'one and three')
      call tally%near(value(2, :), [1.0_wp, 2.0_wp, 3.0_wp, 4.0_wp, 5.0_wp, 6.0_wp], 1.0e-10_wp, 'one to six')
      call lowest_vectors(t, value, basis, is_found)
      call tally%check(all(is_found), 'spaces for them')
      call tally%near([abs(dot_product(v, basis(1, :, 1)))/norm2(v)], [1.0_wp], 1.0e-10_wp, 'the first is v')
      call tally%near([(abs(basis(2, i, i)), i=1, pairs)], [(1.0_wp, i=1, pairs)], 1.0e-10_wp, 'the others are unit vectors')
   end subroutine many_equal_values

   subroutine nothing_at_all()
      real(wp) :: a(3, 0), gram(0, 0)
      logical :: above

      call make_dense_gram(a, gram)
      call is_above(gram, 3, 0.0_wp, above)
      call tally%check(.not. above, 'without a column nothing is shown')
   end subroutine nothing_at_all
end program test_small_matrices
