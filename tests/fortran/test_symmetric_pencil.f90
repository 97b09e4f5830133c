! SPDX-License-Identifier: BSD-3-Clause
!> Lowest eigenvalues of pairs of sparse symmetric matrices, and those next to zero.
program test_symmetric_pencil
   use flexact_eigenpairs, only: symmetric_eigenpairs, pencil_eigenpairs
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t, compress
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise
   use flexact_symmetric_pencil, only: pairs_t, lowest_pairs, pairs_next_to_zero
   use flexact_test_matrices, only: identity, dense_of, path, grid
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   real(wp), parameter :: pi = acos(-1.0_wp)
   integer :: i

   call set_random()
   call a_chain_of_masses()
   call an_unstable_chain()
   call more_unstable_than_wanted()
   call a_free_ring()
   call many_equal_chains()
   call masses_here_and_there()
   call no_mass_and_no_stiffness()
   call no_mass_at_all()
   call stiff_by_nine_decades()
   call both_signs()
   call a_load_on_few()
   call no_load()
   call loads_on_a_free_ring()
   call tally%finish()

contains

   !> Two matrices with the entries of both.
   subroutine make_pair(first, second, pattern, a, b)
      real(wp), intent(in) :: first(:, :), second(:, :)
      type(symmetric_pattern_t), intent(out) :: pattern
      type(sparse_t), intent(out) :: a, b
      integer :: row(size(first)), column(size(first)), n, i, j, found

      n = size(first, 1)
      found = 0
      row = 0
      column = 0
      do j = 1, n
         do i = 1, n
            found = found + 1
            if (i /= j .and. .not. (abs(first(i, j)) > 0 .or. abs(second(i, j)) > 0)) cycle
            row(found) = i
            column(found) = j
         end do
      end do
      call compress(n, n, row, column, [first], a)
      call compress(n, n, row, column, [second], b)
      call analyse_pattern(a, pattern)
   end subroutine make_pair

   !> Expected: all values but those of null vectors of K that have mass, of which there are `null`.
   subroutine check_lowest(k, m, expected, wanted, tolerance, name, null)
      real(wp), intent(in) :: k(:, :), m(:, :), expected(:), tolerance
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      integer, intent(in), optional :: null
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(sparse_t) :: a, b
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error
      integer :: found, nulls

      found = min(wanted, size(expected))
      nulls = 0
      if (present(null)) nulls = null
      call make_pair(k, m, pattern, a, b)
      call factorise(pattern, a, factor, error)
      call lowest_pairs(pattern, a, factor, b, wanted, pairs, error)
      call tally%check(.not. allocated(error), name//': found')
      if (allocated(error)) return
      call tally%check(pairs%is_complete .and. size(pairs%null, 2) == nulls, name//': complete')
      call tally%near(pairs%values, expected(:found), tolerance*max(1.0_wp, maxval(abs(expected(:found)))), name//': values')
      if (size(pairs%values) /= found) return
      call tally%near([matmul(k, pairs%vectors)], [matmul(m, pairs%vectors)*spread(pairs%values, 1, size(k, 1))], &
                      1.0e-7_wp*maxval(abs(k)), name//': vectors')
      call tally%near([matmul(transpose(pairs%vectors), matmul(m, pairs%vectors))], [identity(found)], 1.0e-9_wp, &
                      name//': norms')
   end subroutine check_lowest

   function gram(a) result(g)
      type(sparse_t), intent(in) :: a
      real(wp) :: g(a%columns, a%columns)

      g = matmul(transpose(dense_of(a)), dense_of(a))
   end function gram

   pure function chain_values(n, count) result(values)
      integer, intent(in) :: n, count
      real(wp) :: values(count)
      integer :: i

      values = [(4*sin(i*pi/(2*(n + 1)))**2, i=1, count)]
   end function chain_values

   subroutine a_chain_of_masses()
      integer, parameter :: n = 150

      call check_lowest(gram(path(n, .false.)), 4*identity(n), chain_values(n, 10)/4, 10, 1.0e-13_wp, 'a chain')
      call check_lowest(gram(path(5, .false.)), identity(5), chain_values(5, 5), 10, 1.0e-13_wp, 'a short chain')
   end subroutine a_chain_of_masses

   subroutine an_unstable_chain()
      integer, parameter :: n = 150
      real(wp) :: push, values(n)

      values = chain_values(n, n)
      push = (values(3) + values(4))/2
      call check_lowest(gram(path(n, .false.)) - push*identity(n), identity(n), values - push, 10, 1.0e-13_wp, 'unstable')
   end subroutine an_unstable_chain

   subroutine more_unstable_than_wanted()
      integer, parameter :: n = 100
      real(wp) :: values(n)

      values = chain_values(n, n)
      call check_lowest(gram(path(n, .false.)) - 1.5_wp*identity(n), identity(n), values - 1.5_wp, 4, 1.0e-13_wp, 'very unstable')
   end subroutine more_unstable_than_wanted

   subroutine a_free_ring()
      integer, parameter :: n = 80
      real(wp) :: values(n - 1), all(7), push

      values = [(4*sin((i/2)*pi/n)**2, i=2, n)]
      call check_lowest(gram(path(n, .true.)), identity(n), values, 9, 1.0e-12_wp, 'a free ring', 1)
      push = (values(2) + values(3))/2
      all = [[0.0_wp, values(:2)] - push, values(:2), values(3:4) - push]
      call check_lowest(free_and_pushed(n, push), identity(2*n), all, 6, 1.0e-12_wp, 'a ring beside an unstable one', 1)
   end subroutine a_free_ring

   function free_and_pushed(n, push) result(k)
      integer, intent(in) :: n
      real(wp), intent(in) :: push
      real(wp) :: k(2*n, 2*n)

      k = 0.0_wp
      k(:n, :n) = gram(path(n, .true.))
      k(n + 1:, n + 1:) = gram(path(n, .true.)) - push*identity(n)
   end function free_and_pushed

   !> Fourteen chains without anything between them.
   subroutine many_equal_chains()
      integer, parameter :: n = 12, chains = 14
      real(wp) :: k(n*chains, n*chains), values(chains*n), one(n)
      integer :: c

      k = 0.0_wp
      one = chain_values(n, n)
      do c = 0, chains - 1
         k(c*n + 1:c*n + n, c*n + 1:c*n + n) = gram(path(n, .false.))
      end do
      values = [(spread(one(c), 1, chains), c=1, n)]
      call check_lowest(k, identity(n*chains), values, 10, 1.0e-13_wp, 'equal chains')
      call check_lowest(k, identity(n*chains), values, 30, 1.0e-13_wp, 'more of equal chains')
   end subroutine many_equal_chains

   !> Only every seventh place has mass: against the condensed problem, dense.
   subroutine masses_here_and_there()
      integer, parameter :: n = 84, masses = n/7
      real(wp) :: k(n, n), m(n, n), inverse(masses, masses), values(masses)
      integer :: i, j

      k = gram(path(n, .false.))
      m = 0.0_wp
      do i = 7, n, 7
         m(i, i) = 2.0_wp
      end do
      ! inv(K) = min(i, j) - i j/(n + 1).
      inverse = reshape([((2*(7*min(i, j) - 49.0_wp*i*j/(n + 1)), i=1, masses), j=1, masses)], [masses, masses])
      block
         type(error_t), allocatable :: error
         call symmetric_eigenpairs(inverse, values, error)
      end block
      values = 1/values(masses:1:-1)
      call check_lowest(k, m, values, 5, 1.0e-12_wp, 'some masses')
      call check_lowest(k, m, values, 20, 1.0e-12_wp, 'all of some masses')
   end subroutine masses_here_and_there

   !> A place that has neither does no harm, nor does a massless one that is unstable.
   subroutine no_mass_and_no_stiffness()
      integer, parameter :: n = 40
      real(wp) :: k(n, n), m(n, n)

      k = 0.0_wp
      m = 0.0_wp
      k(3:, 3:) = gram(path(n - 2, .false.))
      m(3:, 3:) = identity(n - 2)
      call check_lowest(k, m, chain_values(n - 2, n - 2), 6, 1.0e-13_wp, 'neither')
      k(2, 2) = -1.0_wp
      call check_lowest(k, m, chain_values(n - 2, n - 2), 6, 1.0e-13_wp, 'massless and unstable')
   end subroutine no_mass_and_no_stiffness

   subroutine no_mass_at_all()
      integer, parameter :: n = 10

      call check_lowest(gram(path(n, .false.)), 0*identity(n), [real(wp) ::], 3, 0.0_wp, 'no mass')
   end subroutine no_mass_at_all

   !> Unit springs and springs of 1e9 in turn: pairs of places move as one, to 1e-9, and
   !> to 1e-7 as far as rounding of the matrix leaves them.
   subroutine stiff_by_nine_decades()
      integer, parameter :: n = 200
      real(wp) :: k(n, n), stiffness(n + 1), values(n/2)
      integer :: i

      stiffness = [(merge(1.0_wp, 1.0e9_wp, modulo(i, 2) == 1), i=1, n + 1)]
      k = 0.0_wp
      do i = 1, n
         k(i, i) = stiffness(i) + stiffness(i + 1)
         if (i < n) k(i, i + 1) = -stiffness(i + 1)
         if (i < n) k(i + 1, i) = -stiffness(i + 1)
      end do
      values = chain_values(n/2, n/2)/2
      call check_lowest(k, identity(n), values, 10, 1.0e-6_wp, 'stiff')
   end subroutine stiff_by_nine_decades

   !> Against the dense values of inv(K + many N N') G, which are those wanted where G is
   !> orthogonal to the null vectors N of K.
   subroutine check_next_to_zero(k, g, wanted, name, null)
      real(wp), intent(in) :: k(:, :), g(:, :)
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      real(wp), intent(in), optional :: null(:)
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(sparse_t) :: a, b
      real(wp) :: left(size(k, 1), size(k, 1)), right(size(k, 1), size(k, 1)), theta(size(k, 1))
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error
      integer :: i, n

      n = size(k, 1)
      left = g
      right = k
      if (present(null)) right = right + matmul(reshape(null, [n, 1]), reshape(null, [1, n]))
      call pencil_eigenpairs(left, right, theta, error)
      call make_pair(k, g, pattern, a, b)
      call factorise(pattern, a, factor, error)
      call pairs_next_to_zero(pattern, a, factor, b, wanted, pairs, error)
      call tally%check(.not. allocated(error), name//': found')
      if (allocated(error)) return
      call tally%check(size(pairs%values) == min(wanted, count(abs(theta) > 1.0e-12_wp)), name//': as many')
      call tally%check(pairs%is_complete, name//': complete')
      do i = 1, size(pairs%values)
         call tally%near([-minval(abs(theta + 1/pairs%values(i)))], [0.0_wp], 1.0e-12_wp*maxval(abs(theta)), name//': one of them')
      end do
      call tally%check(all(pairs%values(2:) > pairs%values(:size(pairs%values) - 1)), name//': ascending')
      call tally%check(count(abs(theta) > 1/maxval(abs(pairs%values)) - 1.0e-9_wp) == size(pairs%values), name//': none left out')
      call tally%near([matmul(k, pairs%vectors)], [-matmul(g, pairs%vectors)*spread(pairs%values, 1, n)], 1.0e-7_wp, &
                      name//': vectors')
   end subroutine check_next_to_zero

   subroutine both_signs()
      integer, parameter :: n = 10
      real(wp) :: k(n**2, n**2), g(n**2, n**2), x(n**2)
      integer :: i

      k = gram(grid(n, .false.)) + 0.1_wp*identity(n**2)
      call random_number(x)
      g = 0.0_wp
      do i = 1, n**2
         g(i, i) = x(i) - 0.4_wp
      end do
      call check_next_to_zero(k, g, 10, 'both signs')
   end subroutine both_signs

   subroutine a_load_on_few()
      integer, parameter :: n = 60
      real(wp) :: g(n, n)

      g = 0.0_wp
      g(10, 10) = 1.0_wp
      g(20, 21) = 0.5_wp
      g(21, 20) = 0.5_wp
      call check_next_to_zero(gram(path(n, .false.)), g, 10, 'a load on few')
   end subroutine a_load_on_few

   subroutine no_load()
      integer, parameter :: n = 5
      type(symmetric_pattern_t) :: pattern
      type(symmetric_factor_t) :: factor
      type(sparse_t) :: a, b
      type(pairs_t) :: pairs
      type(error_t), allocatable :: error

      call make_pair(identity(n), 0*identity(n), pattern, a, b)
      call factorise(pattern, a, factor, error)
      call pairs_next_to_zero(pattern, a, factor, b, 3, pairs, error)
      call tally%check(.not. allocated(error) .and. size(pairs%values) == 0, 'no load, no values')
   end subroutine no_load

   !> A load that moves all places alike not at all, and one that does.
   subroutine loads_on_a_free_ring()
      integer, parameter :: n = 40
      real(wp) :: k(n, n), g(n, n), one(n), x(n + 1)
      integer :: i, j

      k = gram(path(n, .true.))
      one = 1/sqrt(real(n, wp))
      call random_number(x)
      g = 0.0_wp
      do i = 1, n
         j = modulo(i, n) + 1
         g([i, j], [i, j]) = g([i, j], [i, j]) + (x(i) - 0.6_wp)*reshape([1.0_wp, -1.0_wp, -1.0_wp, 1.0_wp], [2, 2])
      end do
      call check_next_to_zero(k, g, 8, 'a load on a free ring', one)
   end subroutine loads_on_a_free_ring
end program test_symmetric_pencil
