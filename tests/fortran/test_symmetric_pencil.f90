! SPDX-License-Identifier: BSD-3-Clause
!> Lowest eigenvalues of pairs of sparse symmetric matrices, and those next to zero.
module flexact_test_springs
   use flexact_kinds, only: wp
   use flexact_symmetric_pencil, only: product_t
   implicit none
   private
   public :: springs_t

   !> A chain of springs between two fixed ends.
   type, extends(product_t) :: springs_t
      real(wp), allocatable :: stiffness(:)
   contains
      procedure :: multiply
   end type springs_t

contains

   !> From elongations, which lose no digits where stiff springs hardly stretch.
   subroutine multiply(self, x, y)
      class(springs_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      real(wp) :: force(size(x, 1) + 1)
      integer :: k

      do k = 1, size(x, 2)
         force = self%stiffness*([x(:, k), 0.0_wp] - [0.0_wp, x(:, k)])
         y(:, k) = force(:size(x, 1)) - force(2:)
      end do
   end subroutine multiply
end module flexact_test_springs

program test_symmetric_pencil
   use flexact_eigenpairs, only: symmetric_eigenpairs, pencil_eigenpairs
   use flexact_error, only: error_t, is_kind, error_not_definite
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t, compress
   use flexact_symmetric_pattern, only: symmetric_pattern_t, analyse_pattern
   use flexact_symmetric_pencil, only: lowest_pairs, pairs_next_to_zero
   use flexact_test_matrices, only: identity, dense_of, path, grid
   use flexact_testing, only: tally_t, set_random
   use flexact_test_springs, only: springs_t
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
   call not_definite()
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

   subroutine check_lowest(k, m, expected, wanted, tolerance, name)
      real(wp), intent(in) :: k(:, :), m(:, :), expected(:), tolerance
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      type(symmetric_pattern_t) :: pattern
      type(sparse_t) :: a, b
      real(wp), allocatable :: values(:), vectors(:, :)
      type(error_t), allocatable :: error
      integer :: found

      found = min(wanted, size(expected))
      call make_pair(k, m, pattern, a, b)
      call lowest_pairs(pattern, a, b, wanted, values, vectors, error)
      call tally%check(.not. allocated(error), name//': found')
      if (allocated(error)) return
      call tally%near(values, expected(:found), tolerance*max(1.0_wp, maxval(abs(expected(:found)))), name//': values')
      if (size(values) /= found) return
      call tally%near([matmul(k, vectors)], [matmul(m, vectors)*spread(values, 1, size(k, 1))], &
                      1.0e-7_wp*maxval(abs(k)), name//': vectors')
      call tally%near([matmul(transpose(vectors), matmul(m, vectors))], [identity(found)], 1.0e-10_wp, name//': norms')
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

      call check_lowest(gram(path(n, .true.)), identity(n), [(4*sin((i/2)*pi/n)**2, i=1, n)], 9, 1.0e-12_wp, 'a free ring')
   end subroutine a_free_ring

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

   !> Unit springs and springs of 1e9 in turn: pairs of places move as one, to 1e-9.
   subroutine stiff_by_nine_decades()
      integer, parameter :: n = 200
      real(wp) :: k(n, n), expected(n/2)
      real(wp), allocatable :: values(:), vectors(:, :)
      type(symmetric_pattern_t) :: pattern
      type(sparse_t) :: a, b
      type(springs_t) :: springs
      type(error_t), allocatable :: error
      integer :: i

      springs%stiffness = [(merge(1.0_wp, 1.0e9_wp, modulo(i, 2) == 1), i=1, n + 1)]
      k = 0.0_wp
      do i = 1, n
         k(i, i) = springs%stiffness(i) + springs%stiffness(i + 1)
         if (i < n) k(i, i + 1) = -springs%stiffness(i + 1)
         if (i < n) k(i + 1, i) = -springs%stiffness(i + 1)
      end do
      expected = chain_values(n/2, n/2)/2
      call make_pair(k, identity(n), pattern, a, b)
      call lowest_pairs(pattern, a, b, 10, values, vectors, error, springs)
      call tally%check(.not. allocated(error), 'stiff: found')
      call tally%near(values/expected(:10), spread(1.0_wp, 1, 10), 2.0e-9_wp, 'stiff: values')
   end subroutine stiff_by_nine_decades

   subroutine check_next_to_zero(k, g, wanted, name)
      real(wp), intent(in) :: k(:, :), g(:, :)
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      type(symmetric_pattern_t) :: pattern
      type(sparse_t) :: a, b
      real(wp) :: left(size(k, 1), size(k, 1)), right(size(k, 1), size(k, 1)), theta(size(k, 1))
      real(wp), allocatable :: values(:), vectors(:, :)
      type(error_t), allocatable :: error
      integer :: i

      left = g
      right = k
      call pencil_eigenpairs(left, right, theta, error)
      call make_pair(k, g, pattern, a, b)
      call pairs_next_to_zero(pattern, a, b, wanted, values, vectors, error)
      call tally%check(.not. allocated(error), name//': found')
      if (allocated(error)) return
      call tally%check(size(values) == min(wanted, count(abs(theta) > 1.0e-12_wp)), name//': as many')
      do i = 1, size(values)
         call tally%near([-minval(abs(theta + 1/values(i)))], [0.0_wp], 1.0e-12_wp*maxval(abs(theta)), name//': one of them')
      end do
      call tally%check(all(values(2:) > values(:size(values) - 1)), name//': ascending')
      call tally%check(count(abs(theta) > 1/maxval(abs(values)) - 1.0e-9_wp) == size(values), name//': none left out')
      call tally%near([matmul(k, vectors)], [-matmul(g, vectors)*spread(values, 1, size(k, 1))], 1.0e-8_wp, name//': vectors')
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
      type(sparse_t) :: a, b
      real(wp), allocatable :: values(:), vectors(:, :)
      type(error_t), allocatable :: error

      call make_pair(identity(n), 0*identity(n), pattern, a, b)
      call pairs_next_to_zero(pattern, a, b, 3, values, vectors, error)
      call tally%check(.not. allocated(error) .and. size(values) == 0, 'no load, no values')
   end subroutine no_load

   subroutine not_definite()
      integer, parameter :: n = 5
      type(symmetric_pattern_t) :: pattern
      type(sparse_t) :: a, b
      real(wp), allocatable :: values(:), vectors(:, :)
      type(error_t), allocatable :: error

      call make_pair(gram(path(n, .true.)), identity(n), pattern, a, b)
      call pairs_next_to_zero(pattern, a, b, 3, values, vectors, error)
      call tally%check(is_kind(error, error_not_definite), 'singular: refused')
   end subroutine not_definite
end program test_symmetric_pencil
