! SPDX-License-Identifier: BSD-3-Clause
!> Small dense matrices of full rank: a bound of their values by one factorisation, and their
!> smallest values and ends of the spectrum, against LAPACK's decomposition.
program test_small_matrices
   use flexact_decomposition, only: decompose
   use flexact_error, only: error_t
   use flexact_full_rank, only: make_dense_gram, is_above
   use flexact_kinds, only: wp
   use flexact_lowest_pairs, only: lowest_pairs, find_ends
   use flexact_testing, only: tally_t, set_random
   use flexact_tridiagonal, only: tridiagonal_t, tridiagonalise, lowest_values, lowest_vectors, lanes
   implicit none
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

   subroutine all_of(a)
      real(wp), intent(in) :: a(:, :)
      real(wp) :: copy(size(a, 1), size(a, 2)), values(minval(shape(a))), u(size(a, 1), size(a, 1)), &
                  vt(size(a, 2), size(a, 2)), gram(minval(shape(a)), minval(shape(a))), ends(2)
      real(wp) :: found(lanes), left(size(a, 1), lanes), right(size(a, 2), lanes)
      type(error_t), allocatable :: error
      integer :: used, k, side
      logical :: above

      side = size(values)
      copy = a
      call decompose(copy, values, u, vt, error)
      call make_dense_gram(a, gram)
      call is_above(gram, sum(shape(a)), 0.99_wp*values(side), above)
      call tally%check(above .or. values(side) < 3.0e-6_wp*values(1), 'all values are above a little less than the smallest')
      call is_above(gram, sum(shape(a)), 1.01_wp*values(side), above)
      call tally%check(.not. above, 'but not above a little more')
      call lowest_pairs(a, gram, found, left, right, used, error)
      call tally%check(used == min(side, lanes), 'as many pairs as there are')
      call tally%near(found(:used)/values(1), values(side:side - used + 1:-1)/values(1), 1.0e-13_wp, 'the smallest values')
      do k = 1, used
         ! A residual of A'A is divided by the value.
         associate (rounding => 1.0e-12_wp*values(1)**2/found(k))
            call tally%near(matmul(a, right(:, k)), found(k)*left(:, k), rounding, 'and their right vectors')
            call tally%near(matmul(left(:, k), a), found(k)*right(:, k), rounding, 'and their left vectors')
         end associate
      end do
      call find_ends(a, ends(1), ends(2), error)
      call tally%near(ends/values([side, 1]), [1.0_wp, 1.0_wp], 1.0e-8_wp, 'both ends')
   end subroutine all_of

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

   !> Reflections and multiples of the identity have one value many times.
   subroutine many_equal_values()
      real(wp) :: a(12, 12), v(12), basis(12, lanes), value(lanes)
      type(tridiagonal_t) :: t
      logical :: is_found
      integer :: i

      call random_number(v)
      a = -2*spread(v, 2, 12)*spread(v, 1, 12)/sum(v**2)
      do i = 1, 12
         a(i, i) = a(i, i) + 3
      end do
      call tridiagonalise(a, t)
      call lowest_values(t, 1.0e-12_wp, value)
      call tally%near(value, [1.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 3.0_wp, 3.0_wp], 1.0e-10_wp, 'one and three')
      call lowest_vectors(t, value, basis, is_found)
      call tally%check(is_found, 'a space for them')
      call tally%near([abs(dot_product(v, basis(:, 1)))/norm2(v)], [1.0_wp], 1.0e-10_wp, 'the first is v')
   end subroutine many_equal_values

   subroutine nothing_at_all()
      real(wp) :: a(3, 0), gram(0, 0), smallest, largest
      type(error_t), allocatable :: error
      logical :: above

      call make_dense_gram(a, gram)
      call is_above(gram, 3, 0.0_wp, above)
      call tally%check(.not. above, 'without a column nothing is shown')
      call find_ends(a, smallest, largest, error)
      call tally%near([smallest, largest], [0.0_wp, 0.0_wp], 0.0_wp, 'nor is there a value')
   end subroutine nothing_at_all
end program test_small_matrices
