! SPDX-License-Identifier: BSD-3-Clause
!> Largest eigenvalues of operators that are self-adjoint in an inner product.
module flexact_test_operator
   use flexact_kinds, only: wp
   use flexact_block_lanczos, only: self_adjoint_t
   implicit none
   private
   public :: dense_operator_t

   !> Op = matrix, W = weight.
   type, extends(self_adjoint_t) :: dense_operator_t
      real(wp), allocatable :: matrix(:, :), weight(:, :)
   contains
      procedure :: apply
      procedure :: weigh
   end type dense_operator_t

contains

   subroutine apply(self, x, weighed, y)
      class(dense_operator_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :), weighed(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      y = matmul(self%matrix, x(:, :size(weighed, 2)))
   end subroutine apply

   subroutine weigh(self, x, y)
      class(dense_operator_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      y = matmul(self%weight, x)
   end subroutine weigh
end module flexact_test_operator

program test_block_lanczos
   use flexact_block_lanczos, only: largest_pairs, end_pairs
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_test_matrices, only: identity, random_orthogonal
   use flexact_test_operator, only: dense_operator_t
   use flexact_testing, only: tally_t, set_random
   implicit none
   type(tally_t) :: tally
   integer :: i

   call set_random()
   call known([(1.0_wp/i, i=1, 200)], 10, 'all different')
   call known([(1/real(i, wp)**4, i=1, 300)], 10, 'fast falling')
   call known([(1.0_wp - i/1.0e4_wp, i=1, 400)], 12, 'close together')
   call known([(1.0_wp/(1 + (i - 1)/12), i=1, 120)], 30, 'twelve times each')
   call known([((-1.0_wp)**i/i, i=1, 150)], 10, 'of both signs')
   call known([((-1.0_wp)**i/((i + 1)/2), i=1, 150)], 10, 'in pairs of both signs')
   call known([spread(1.0_wp, 1, 20), spread(0.0_wp, 1, 50)], 30, 'one value')
   call known([3.0_wp, -2.0_wp, spread(0.0_wp, 1, 50)], 10, 'of rank two')
   call known([real(wp) :: 0, 0, 0], 2, 'none')
   call known([2.0_wp], 4, 'a single one')
   call massless()
   call ends([((-1.0_wp)**i/i, i=1, 150)], 'of both signs')
   call ends([1.0_wp, -2.0e-3_wp, spread(0.0_wp, 1, 60)], 'far apart')
   call ends([1.0_wp, 1 - 1.0e-7_wp, (1.0_wp/i, i=2, 150)], 'of one sign, two close together')
   call ends([2.0_wp], 'a single one')
   call tally%finish()

contains

   !> An operator with these eigenvalues, whose magnitudes descend, in a definite inner product.
   subroutine known(values, wanted, name)
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      type(dense_operator_t) :: operator
      real(wp) :: q(size(values), size(values)), grow(size(values))
      integer :: n, i

      n = size(values)
      q = random_orthogonal(n)
      grow = [(1 + 9.0_wp*i/n, i=1, n)]
      ! W = diag(grow)**2, and Op = inv(diag(grow)) Q values Q' diag(grow).
      operator%weight = identity(n)
      operator%matrix = matmul(q*spread(values, 1, n), transpose(q))
      do i = 1, n
         operator%weight(i, i) = grow(i)**2
         operator%matrix(:, i) = operator%matrix(:, i)*grow(i)
      end do
      do i = 1, n
         operator%matrix(i, :) = operator%matrix(i, :)/grow(i)
      end do
      call compare(operator, pack(values, abs(values) > 0), wanted, name)
   end subroutine known

   subroutine compare(operator, expected, wanted, name)
      type(dense_operator_t), intent(in) :: operator
      real(wp), intent(in) :: expected(:)
      integer, intent(in) :: wanted
      character(len=*), intent(in) :: name
      real(wp), allocatable :: values(:), vectors(:, :)
      type(error_t), allocatable :: error
      integer :: found

      found = min(wanted, size(expected))
      call largest_pairs(operator, size(operator%matrix, 1), wanted, values, vectors, error)
      call tally%check(.not. allocated(error), name//': converged')
      call tally%near(abs(values), abs(expected(:found)), 1.0e-12_wp, name//': values')
      call tally%near([sum(values)], [sum(expected(:found))], merge(1.0e-11_wp, 3.0_wp, index(name, 'in pa') /= 1), name//': signs')
      if (size(values) /= found) return
      call tally%near([matmul(operator%matrix, vectors)], [vectors*spread(values, 1, size(vectors, 1))], 1.0e-9_wp, &
                      name//': vectors')
      call tally%near([matmul(transpose(vectors), matmul(operator%weight, vectors))], [identity(found)], 1.0e-12_wp, &
                      name//': orthonormal')
   end subroutine compare

   !> The ends of a spectrum whose magnitudes descend.
   subroutine ends(values, name)
      real(wp), intent(in) :: values(:)
      character(len=*), intent(in) :: name
      type(dense_operator_t) :: operator
      real(wp) :: q(size(values), size(values))
      real(wp), allocatable :: found(:), vectors(:, :)
      type(error_t), allocatable :: error
      logical :: is_there

      q = random_orthogonal(size(values))
      operator%weight = identity(size(values))
      operator%matrix = matmul(q*spread(values, 1, size(values)), transpose(q))
      call end_pairs(operator, size(values), 1.0e-2_wp, found, vectors, is_there, error)
      call tally%check(is_there .and. .not. allocated(error), name//': the ends are there')
      call tally%near(found(size(found):), [maxval(values)], 1.0e-7_wp, name//': the largest')
      if (minval(values) < -1.0e-2_wp) call tally%near(found(:1), [minval(values)], 1.0e-11_wp, name//': the least')
      call tally%near(norm2(vectors, 1), spread(1.0_wp, 1, size(found)), 1.0e-12_wp, name//': vectors of norm 1')
   end subroutine ends

   !> Op = inv(K) M with masses on some places of a chain alone: the values are those of the
   !> condensed problem.
   subroutine massless()
      integer, parameter :: n = 90, masses = 5
      type(dense_operator_t) :: operator
      real(wp) :: inverse(n, n), condensed(masses, masses), values(masses)
      integer :: i, j

      ! A chain of unit springs, held at its start: inv(K) = min(i, j).
      inverse = reshape([((real(min(i, j), wp), i=1, n), j=1, n)], [n, n])
      allocate (operator%matrix(n, n), operator%weight(n, n), source=0.0_wp)
      do i = 1, masses
         operator%weight(18*i, 18*i) = 1.0_wp
         operator%matrix(:, 18*i) = inverse(:, 18*i)
      end do
      ! inv(condensed K) = 18 min(i, j), whose eigenvalues are 18/(2 sin(..))**2.
      condensed = 0.0_wp
      values = [(18/(2*sin((2*i - 1)*acos(-1.0_wp)/(2*(2*masses + 1))))**2, i=1, masses)]
      operator%matrix = operator%matrix/values(1)
      call compare(operator, values/values(1), 10, 'massless')
   end subroutine massless
end program test_block_lanczos
