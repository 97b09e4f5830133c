! SPDX-License-Identifier: BSD-3-Clause
!> Eigenvalues of pairs of sparse symmetric matrices: the lowest omega2 of
!> K x = omega2 M x, K of any signs, M positive semidefinite; and those of K x = -l G x
!> that are nearest to zero, K positive definite, G of any signs.
!>
!> The block Lanczos process finds them, and the inertia of K - t M, or K + t G, tells whether
!> one is missing (Parlett, The Symmetric Eigenvalue Problem, section 3.3): then it is asked
!> again with wider blocks. Rayleigh quotients with the caller's products come last.
module flexact_symmetric_pencil
   use flexact_block_lanczos, only: self_adjoint_t, largest_pairs
   use flexact_eigenpairs, only: pencil_eigenpairs
   use flexact_error, only: error_t, fail, error_not_definite, error_not_found
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: fill_at_random
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise, solve, symmetric_times
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: product_t, lowest_pairs, pairs_next_to_zero

   !> A product with K that loses fewer digits than K itself has lost, as by deformations.
   type, abstract :: product_t
   contains
      procedure(multiply), deferred :: multiply
   end type product_t

   abstract interface
      !> y = K x for x, y (n, k).
      subroutine multiply(self, x, y)
         import :: product_t, wp
         class(product_t), intent(in) :: self
         real(wp), intent(in), contiguous :: x(:, :)
         real(wp), intent(out), contiguous :: y(:, :)
      end subroutine multiply
   end interface

   !> Op = inv(A) B in the inner product of W, which is A or B.
   type, extends(self_adjoint_t) :: pencil_t
      type(symmetric_pattern_t), pointer :: pattern => null()
      type(symmetric_factor_t) :: factor
      type(sparse_t), pointer :: b => null(), w => null()
   contains
      procedure :: apply
      procedure :: weigh
   end type pencil_t

   !> Shifts are this part of the lowest value, where it is not negative, and grow by this
   !> factor until all values lie above them, and no more often than this.
   real(wp), parameter :: first_shift = 0.1_wp, growth = 8.0_wp
   integer, parameter :: most_shifts = 10
   integer, parameter :: narrowest = 8, widest = 64
   !> Relative difference of values that count as one cluster.
   real(wp), parameter :: cluster = 1.0e-6_wp

contains

   subroutine apply(self, x, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%b, x, y)
      call solve(self%pattern, self%factor, y)
   end subroutine apply

   subroutine weigh(self, x, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%w, x, y)
   end subroutine weigh

   !> Up to `wanted` lowest values of K x = value M x, ascending, with x'M x = 1: fewer where
   !> the rank of M is lower. K and M have the pattern's entries, in one order. Accurate: a
   !> product with K to be used for Rayleigh quotients.
   subroutine lowest_pairs(pattern, k, m, wanted, values, vectors, error, accurate)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(sparse_t), intent(in), target :: k, m
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: values(:), vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      class(product_t), intent(in), optional :: accurate
      type(pencil_t) :: pencil
      real(wp) :: shift
      integer :: width, missing

      pencil%pattern => pattern
      pencil%b => m
      pencil%w => m
      call find_shift(pencil, k, m, shift, error)
      if (allocated(error)) return
      width = narrowest
      do
         call largest_pairs(pencil, pattern%n, wanted, values, vectors, error, width)
         if (allocated(error)) return
         call purify(pencil, values, vectors)
         call refine(k, m, vectors, values, error, accurate)
         if (allocated(error)) return
         call count_missing(pencil, k, m, -1.0_wp, values, pencil%factor%negative, missing, error)
         if (allocated(error) .or. missing == 0) return
         width = 2*width
         if (width > widest) exit
      end do
      call fail(error_not_found, error)
   end subroutine lowest_pairs

   !> Factorise A = K + shift M such that all finite values lie above -shift.
   subroutine find_shift(pencil, k, m, shift, error)
      type(pencil_t), intent(inout) :: pencil
      type(sparse_t), intent(in) :: k, m
      real(wp), intent(out) :: shift
      type(error_t), allocatable, intent(out) :: error
      type(symmetric_factor_t) :: best
      real(wp) :: at
      integer :: round

      shift = 0.0_wp
      call factorise(pencil%pattern, k, pencil%factor, error)
      if (allocated(error)) return
      if (pencil%factor%negative == 0 .and. pencil%factor%zero == 0) return
      at = first_shift*lowest_magnitude(pencil)
      best = pencil%factor
      do round = 1, most_shifts
         call factorise(pencil%pattern, combined(k, m, at), pencil%factor, error)
         if (allocated(error)) return
         if (round == 1 .or. pencil%factor%negative < best%negative) then
            best = pencil%factor
            shift = at
         end if
         if (best%negative == 0) exit
         at = growth*at
      end do
      pencil%factor = best
   end subroutine find_shift

   !> About the least magnitude of a value that is not zero, 1 where there is none.
   real(wp) function lowest_magnitude(pencil) result(lowest)
      type(pencil_t), intent(in) :: pencil
      real(wp) :: x(pencil%pattern%n, 2), y(pencil%pattern%n, 2), square
      integer :: round

      lowest = 1.0_wp
      call fill_at_random(1, x)
      do round = 1, 4
         call pencil%apply(x, y)
         call pencil%weigh(y, x)
         square = sum(x*y)
         if (.not. square > 0) return
         x = y/sqrt(square)
      end do
      lowest = 1/sqrt(square)
   end function lowest_magnitude

   !> a + factor b, of the same entries.
   pure function combined(a, b, factor) result(c)
      type(sparse_t), intent(in) :: a, b
      real(wp), intent(in) :: factor
      type(sparse_t) :: c

      c = a
      c%value = c%value + factor*b%value
   end function combined

   !> Take out of vectors what the inner product does not see: they are images of themselves.
   subroutine purify(pencil, theta, vectors)
      type(pencil_t), intent(in) :: pencil
      real(wp), intent(in) :: theta(:)
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp) :: images(size(vectors, 1), size(vectors, 2))

      call pencil%apply(vectors, images)
      vectors = images/spread(theta, 1, size(vectors, 1))
   end subroutine purify

   !> Values and vectors, x'M x = 1, by the Rayleigh-Ritz procedure in the space of the vectors.
   subroutine refine(k, m, vectors, values, error, accurate)
      type(sparse_t), intent(in) :: k, m
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp), intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      class(product_t), intent(in), optional :: accurate
      real(wp) :: images(size(vectors, 1), size(vectors, 2)), a(size(values), size(values)), b(size(values), size(values))

      call symmetric_times(m, vectors, images)
      b = matmul(transpose(vectors), images)
      if (present(accurate)) then
         call accurate%multiply(vectors, images)
      else
         call symmetric_times(k, vectors, images)
      end if
      a = matmul(transpose(vectors), images)
      a = (a + transpose(a))/2
      call pencil_eigenpairs(a, b, values, error)
      if (.not. allocated(error)) vectors = matmul(vectors, a)
   end subroutine refine

   !> How many values below the last cluster were not found: K + sign t M has as many negative
   !> eigenvalues as there are values below t, and those that it has for all t.
   subroutine count_missing(pencil, k, m, sign, values, always, missing, error)
      type(pencil_t), intent(in) :: pencil
      type(sparse_t), intent(in) :: k, m
      real(wp), intent(in) :: sign, values(:)
      integer, intent(in) :: always
      integer, intent(out) :: missing
      type(error_t), allocatable, intent(out) :: error
      type(symmetric_factor_t) :: factor
      integer :: below

      missing = 0
      do below = size(values) - 1, 1, -1
         if (values(below + 1) - values(below) > cluster*maxval(abs(values(below:below + 1)))) exit
      end do
      if (below < 1) return
      call factorise(pencil%pattern, combined(k, m, sign*(values(below) + values(below + 1))/2), factor, error)
      if (.not. allocated(error)) missing = max(0, factor%negative - always - below)
   end subroutine count_missing

   !> Up to `wanted` values l of K x = -l G x nearest to zero, ascending, with x'K x = 1: fewer
   !> where the rank of G is lower. K must be positive definite.
   subroutine pairs_next_to_zero(pattern, k, g, wanted, values, vectors, error)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(sparse_t), intent(in), target :: k, g
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: values(:), vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      type(pencil_t) :: pencil
      integer :: width, missing(2)

      pencil%pattern => pattern
      pencil%b => g
      pencil%w => k
      call factorise(pattern, k, pencil%factor, error)
      if (allocated(error)) return
      if (pencil%factor%negative + pencil%factor%zero > 0) call fail(error_not_definite, error)
      if (allocated(error)) return
      width = narrowest
      do
         call largest_pairs(pencil, pattern%n, wanted, values, vectors, error, width)
         if (allocated(error)) return
         call refine(g, k, vectors, values, error)
         if (allocated(error)) return
         values = -1/values
         vectors = vectors(:, ascending(values))
         values = values(ascending(values))
         call count_missing(pencil, k, g, 1.0_wp, pack(values, values > 0), 0, missing(1), error)
         if (allocated(error)) return
         call count_missing(pencil, k, g, -1.0_wp, -pack(values(size(values):1:-1), values(size(values):1:-1) < 0), &
                            0, missing(2), error)
         if (allocated(error) .or. all(missing == 0)) return
         width = 2*width
         if (width > widest) exit
      end do
      call fail(error_not_found, error)
   end subroutine pairs_next_to_zero
end module flexact_symmetric_pencil
