! SPDX-License-Identifier: BSD-3-Clause
!> The sparse factorisation L D L': its order, solutions, signs of eigenvalues, null vectors.
program test_symmetric_factor
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise, solve, solve_refined, null_vectors
   use flexact_symmetric_lanes, only: symmetric_times
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   use flexact_test_matrices, only: identity, sparse_of, dense_of, path, grid, random_orthogonal
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally

   call set_random()
   call every_column_once()
   call a_path_has_no_fill()
   call a_grid_has_little()
   call nothing_at_all()
   call definite()
   call indefinite()
   call zero_pivots_of_a_regular_matrix()
   call a_ring_is_singular()
   call free_chains_of_thin_beams()
   call all_zero()
   call widely_spread()
   call what_cancels()
   call tiny_diagonals()
   call tally%finish()

contains

   subroutine factorise_dense(dense, pattern, factor)
      real(wp), intent(in) :: dense(:, :)
      type(symmetric_pattern_t), intent(out) :: pattern
      type(symmetric_factor_t), intent(out) :: factor
      type(error_t), allocatable :: error

      call analyse_pattern(sparse_of(dense), pattern)
      call factorise(pattern, sparse_of(dense), factor, error)
      call tally%check(.not. allocated(error), 'factorised')
   end subroutine factorise_dense

   function gram(a) result(g)
      real(wp), intent(in) :: a(:, :)
      real(wp) :: g(size(a, 2), size(a, 2))

      g = matmul(transpose(a), a)
   end function gram

   function random_pattern(n, share) result(dense)
      integer, intent(in) :: n
      real(wp), intent(in) :: share
      real(wp) :: dense(n, n), chance(n, n)

      call random_number(dense)
      call random_number(chance)
      dense = merge(dense - 0.5_wp, 0.0_wp, chance < share)
      dense = dense + transpose(dense)
   end function random_pattern

   subroutine every_column_once()
      integer, parameter :: n = 60
      type(symmetric_pattern_t) :: pattern
      integer :: round, i

      do round = 1, 5
         call analyse_pattern(sparse_of(random_pattern(n, 0.01_wp*round)), pattern)
         call tally%check(all(pattern%order(pattern%place_of) == [(i, i=1, n)]), 'an order')
         call tally%check(all(pattern%place(pattern%left_entry) == [(spread(i, 1, pattern%left_start(i + 1) &
                                                                            - pattern%left_start(i)), i=1, n)]), 'rows of L')
      end do
   end subroutine every_column_once

   subroutine a_path_has_no_fill()
      integer, parameter :: n = 50
      type(symmetric_pattern_t) :: pattern

      call analyse_pattern(sparse_of(gram(dense_of(path(n, .false.)))), pattern)
      call tally%check(size(pattern%place) == n - 1, 'L of a path')
      call analyse_pattern(sparse_of(gram(dense_of(path(n, .true.)))), pattern)
      call tally%check(size(pattern%place) == 2*n - 3, 'L of a ring')
   end subroutine a_path_has_no_fill

   !> George and Liu: 31/4 n**2 log2 n for nested dissection, to which minimum degree comes close;
   !> a band has n**3.
   subroutine a_grid_has_little()
      integer, parameter :: n = 20
      type(symmetric_pattern_t) :: pattern

      call analyse_pattern(sparse_of(gram(dense_of(grid(n, .false.)))), pattern)
      call tally%check(size(pattern%place) < 0.6_wp*n**3, 'L of a grid')
   end subroutine a_grid_has_little

   subroutine nothing_at_all()
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      real(wp) :: none(0, 0), x(0, 2)

      call factorise_dense(none, pattern, factor)
      call solve(pattern, factor, x)
      call tally%check(factor%negative == 0 .and. factor%zero == 0, 'nothing')
   end subroutine nothing_at_all

   subroutine definite()
      integer, parameter :: n = 80
      real(wp) :: a(n, n), x(n, 7), b(n, 7)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      integer :: k

      a = random_pattern(n, 0.03_wp) + 4*identity(n)
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%negative == 0 .and. factor%zero == 0, 'definite')
      call random_number(x)
      call symmetric_times(sparse_of(a), x, b)
      call tally%near([b], [matmul(a, x)], 1.0e-13_wp, 'products')
      do k = 1, 7, 3
         b(:, :k) = matmul(a, x(:, :k))
         call solve(pattern, factor, b(:, :k))
         call tally%near([b(:, :k)], [x(:, :k)], 1.0e-12_wp, 'solutions')
      end do
   end subroutine definite

   subroutine indefinite()
      integer, parameter :: n = 60
      real(wp) :: a(n, n), copy(n, n), values(n), x(n, 3), b(n, 3)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error
      integer :: round

      do round = 1, 20
         a = random_pattern(n, 0.05_wp) + 0.3_wp*identity(n)
         copy = a
         call symmetric_eigenpairs(copy, values, error)
         call factorise_dense(a, pattern, factor)
         call tally%check(factor%negative == count(values < 0), 'negative ones')
         call random_number(x)
         b = matmul(a, x)
         call solve_refined(pattern, factor, sparse_of(a), b, 3)
         call tally%near([b], [x], 1.0e-9_wp/minval(abs(values)), 'solutions of indefinite ones')
      end do
   end subroutine indefinite

   subroutine zero_pivots_of_a_regular_matrix()
      integer, parameter :: n = 6
      real(wp) :: a(n, n), x(n, 2), b(n, 2)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      integer :: i

      a = 0.0_wp
      do i = 1, n
         a(i, n + 1 - i) = real(min(i, n + 1 - i), wp)
      end do
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%negative == 3 .and. factor%zero == 0, 'a matrix without a diagonal')
      call random_number(x)
      b = matmul(a, x)
      call solve(pattern, factor, b)
      call tally%near([b], [x], 1.0e-14_wp, 'its solution')
   end subroutine zero_pivots_of_a_regular_matrix

   subroutine a_ring_is_singular()
      integer, parameter :: n = 30
      real(wp) :: a(n, n), x(n, 1), b(n, 1)
      real(wp), allocatable :: vectors(:, :)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error

      a = gram(dense_of(path(n, .true.)))
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 1 .and. factor%negative == 0, 'a ring has a zero')
      call null_vectors(pattern, factor, vectors, error)
      call tally%near(abs([vectors]), spread(1/sqrt(real(n, wp)), 1, n), 1.0e-13_wp, 'its null vector')
      call random_number(x)
      b = matmul(a, x)
      call solve(pattern, factor, b)
      call tally%near([matmul(a, b)], [matmul(a, x)], 1.0e-12_wp, 'a load that it balances')
      a(1, 1) = a(1, 1) - 1.0_wp
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 0 .and. factor%negative == 1, 'pushed below zero')
   end subroutine a_ring_is_singular

   !> Chains of plane beams of slenderness 1e4, not held at all: three null vectors each.
   subroutine free_chains_of_thin_beams()
      integer, parameter :: chains = 3, nodes = 9, n = 3*chains*nodes
      real(wp) :: a(n, n), turn(3, 3)
      real(wp), allocatable :: vectors(:, :)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error
      integer :: chain, i, at

      a = 0.0_wp
      do chain = 1, chains
         turn = identity(3)
         turn(:2, 1) = [cos(1.0_wp*chain), -sin(1.0_wp*chain)]
         turn(:2, 2) = [sin(1.0_wp*chain), cos(1.0_wp*chain)]
         do i = 1, nodes - 1
            at = 3*nodes*(chain - 1) + 3*(i - 1)
            a(at + 1:at + 6, at + 1:at + 6) = a(at + 1:at + 6, at + 1:at + 6) + plane_beam(0.01_wp, 1.0e-6_wp, turn)
         end do
      end do
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 3*chains .and. factor%negative == 0, 'free chains')
      call null_vectors(pattern, factor, vectors, error)
      call tally%near([matmul(transpose(vectors), vectors)], [identity(3*chains)], 1.0e-12_wp, 'orthonormal')
      call tally%near([matmul(a, vectors)], spread(0.0_wp, 1, n*3*chains), 1.0e-12_wp*maxval(a), 'moved without stress')
      a(1:3, 1:3) = a(1:3, 1:3) + identity(3)
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 3*chains - 3 .and. factor%negative == 0, 'one of them held')
   end subroutine free_chains_of_thin_beams

   !> Stiffness of a plane beam between two nodes of x, y and angle; EA = 1.
   function plane_beam(length, thickness, turn) result(k)
      real(wp), intent(in) :: length, thickness, turn(3, 3)
      real(wp) :: k(6, 6), d(3, 6), s(3, 3), bending

      d(1, :) = [-1.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp]
      d(2, :) = [0.0_wp, -1.0_wp, -length, 0.0_wp, 1.0_wp, 0.0_wp]
      d(3, :) = [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, -1.0_wp, length]
      d(:, 1:3) = matmul(d(:, 1:3), turn)
      d(:, 4:6) = matmul(d(:, 4:6), turn)
      bending = thickness**2/12/length**3
      s = 0.0_wp
      s(1, 1) = 1/length
      s(2, 2:3) = bending*[4.0_wp, -2.0_wp]
      s(3, 2:3) = bending*[-2.0_wp, 4.0_wp]
      k = matmul(transpose(d), matmul(s, d))
   end function plane_beam

   subroutine all_zero()
      real(wp) :: a(4, 4), x(4, 2)
      real(wp), allocatable :: vectors(:, :)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error

      a = 0.0_wp
      x = 0.0_wp
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 4 .and. factor%negative == 0, 'all zero')
      call null_vectors(pattern, factor, vectors, error)
      call tally%near([gram(vectors)], [identity(4)], 1.0e-15_wp, 'everything is null')
      call solve(pattern, factor, x)
      call tally%near([x], spread(0.0_wp, 1, 8), 0.0_wp, 'nothing under no load')
   end subroutine all_zero

   !> Rows and columns scaled over sixteen decades.
   subroutine widely_spread()
      integer, parameter :: n = 40
      real(wp) :: a(n, n), x(n, 2), b(n, 2), scale(n)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      integer :: i, j

      scale = [(10.0_wp**(modulo(7*i, 17) - 8), i=1, n)]
      a = random_pattern(n, 0.05_wp) + 3*identity(n)
      call random_number(x)
      b = matmul(a, x)
      do j = 1, n
         a(:, j) = a(:, j)*scale*scale(j)
         b(j, :) = b(j, :)*scale(j)
      end do
      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 0 .and. factor%negative == 0, 'spread over sixteen decades')
      call solve(pattern, factor, b)
      call tally%near([b*spread(scale, 2, 2)], [x], 1.0e-12_wp, 'its solution')
   end subroutine widely_spread

   !> What is left of terms that cancel is no stiffness where their size is told.
   subroutine what_cancels()
      real(wp), parameter :: a(2, 2) = reshape([1.0_wp, 0.0_wp, 0.0_wp, 1.0e-15_wp], [2, 2])
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error

      call factorise_dense(a, pattern, factor)
      call tally%check(factor%zero == 0, 'soft')
      call factorise(pattern, sparse_of(a), factor, error, [1.0_wp, 1.0_wp])
      call tally%check(factor%zero == 1, 'a leftover')
   end subroutine what_cancels

   !> A regular matrix is so, however small its diagonal is beside it.
   subroutine tiny_diagonals()
      integer, parameter :: n = 12
      real(wp) :: a(n, n), copy(n, n), values(n), x(n, 1), b(n, 1), two(2, 2), chance(n), worst
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(error_t), allocatable :: error
      integer :: round, i, wrong, singular, tried

      two = reshape([1.0e-14_wp, 1.0_wp, 1.0_wp, 1.0e-14_wp], [2, 2])
      call factorise_dense(two, pattern, factor)
      x(:2, 1) = [2.0_wp, 1.0_wp]
      call solve(pattern, factor, x(:2, :))
      call tally%check(factor%zero == 0 .and. factor%negative == 1, 'nothing but its partner')
      call tally%near(x(:2, 1), [1.0_wp, 2.0_wp], 1.0e-13_wp, 'and its solution')
      singular = 0
      wrong = 0
      tried = 0
      worst = 0.0_wp
      do round = 1, 4000
         a = random_pattern(n, 0.5_wp)
         call random_number(chance)
         do i = 1, n
            a(i, i) = 10.0_wp**(-12*chance(i))
         end do
         copy = a
         call symmetric_eigenpairs(copy, values, error)
         if (minval(abs(values)) < 1.0e-5_wp*maxval(abs(values))) cycle
         tried = tried + 1
         call factorise_dense(a, pattern, factor)
         if (factor%zero > 0) singular = singular + 1
         if (factor%negative /= count(values < 0)) wrong = wrong + 1
         call random_number(x)
         b = matmul(a, x)
         call solve_refined(pattern, factor, sparse_of(a), b, 3)
         worst = max(worst, maxval(abs(b - x)))
      end do
      call tally%check(tried > 3000, 'most random matrices are regular')
      call tally%check(singular == 0, 'none of them is called singular')
      call tally%check(wrong == 0, 'signs of their eigenvalues')
      call tally%near([worst], [0.0_wp], 1.0e-6_wp, 'their solutions')
   end subroutine tiny_diagonals
end program test_symmetric_factor
