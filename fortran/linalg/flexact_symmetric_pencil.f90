! SPDX-License-Identifier: BSD-3-Clause
!> Eigenvalues of pairs of sparse symmetric matrices: the lowest ones of K x = value M x,
!> K of any signs, M positive semidefinite; and those of K x = -value G x that are nearest to
!> zero, K positive semidefinite, G of any signs.
!>
!> The block Lanczos process finds them. Null vectors of K are known and taken out. The inertia
!> of K - t M, or K + t G, tells whether a value is missing, as where more are equal than a
!> block has vectors (Parlett, The Symmetric Eigenvalue Problem, section 3.3): then wider
!> blocks are taken.
module flexact_symmetric_pencil
   use flexact_block_lanczos, only: self_adjoint_t, largest_pairs, end_pairs
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: fill_at_random
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_factor_t, factorise, solve, null_vectors, reduce, reduced_times, to_reduced, &
                                       from_reduced
   use flexact_symmetric_lanes, only: symmetric_times
   use flexact_symmetric_pattern, only: symmetric_pattern_t
   implicit none
   private
   public :: pairs_t, lowest_pairs, pairs_next_to_zero, end_pairs_of

   !> Values, ascending, and vectors (n, :). null (n, :): null vectors of K to which the other
   !> matrix does something: their values are 0, and they are not among the others.
   !> is_complete: inertia has confirmed that none is missing.
   type :: pairs_t
      real(wp), allocatable :: values(:), vectors(:, :), null(:, :)
      logical :: is_complete = .false.
   end type pairs_t

   !> Op = inv(A) B, A = K + shift M or K, in the inner product of W, on vectors that are
   !> B-orthogonal to null vectors of K.
   type, extends(self_adjoint_t) :: pencil_t
      type(symmetric_pattern_t), pointer :: pattern => null()
      type(symmetric_factor_t) :: factor
      type(sparse_t), pointer :: b => null(), w => null()
      !> Orthonormal null vectors N of K; T of those that B does something to, eigenvectors of
      !> N'B N, these eigenvalues, and inv(T'B T) T'B.
      real(wp), allocatable :: null(:, :), touched(:, :), strength(:), without(:, :)
   contains
      procedure :: apply
      procedure :: weigh
   end type pencil_t

   !> inv(R') B inv(R) for a definite A = R'R.
   type, extends(self_adjoint_t) :: reduced_t
      type(symmetric_pattern_t), pointer :: pattern => null()
      type(symmetric_factor_t), pointer :: factor => null()
      real(wp), allocatable :: b(:)
   contains
      procedure :: apply => apply_reduced
      procedure :: weigh => weigh_reduced
   end type reduced_t

   !> Shifts start at this part of the lowest magnitude, grow by this factor until no value
   !> lies below, and no more often than this.
   real(wp), parameter :: first_shift = 2.0_wp, growth = 8.0_wp
   integer, parameter :: most_shifts = 10
   integer, parameter :: narrowest = 8, widest = 32
   !> Relative difference of values that count as one cluster.
   real(wp), parameter :: cluster = 1.0e-6_wp
   !> Of a semidefinite matrix values below this part of the largest are as good as none.
   real(wp), parameter :: none_below = 1.0e-2_wp
   !> Part of the largest entry of B up to which B does nothing to a null vector of K.
   real(wp), parameter :: nothing = 1.0e-10_wp

contains

   subroutine apply(self, x, weighed, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :), weighed(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      real(wp), allocatable :: clean(:, :)

      if (size(self%touched, 2) > 0) then
         ! Else what rounding leaves along null vectors would come back as something else.
         clean = x
         call take_out(self%touched, self%without, clean)
         call symmetric_times(self%b, clean, y)
      else if (associated(self%b, self%w)) then
         y = weighed
      else
         call symmetric_times(self%b, x, y)
      end if
      call take_out(self%null, self%null, y)
      call solve(self%pattern, self%factor, y)
      call take_out(self%null, self%null, y)
      call take_out(self%touched, self%without, y)
   end subroutine apply

   subroutine weigh(self, x, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%w, x, y)
   end subroutine weigh

   subroutine apply_reduced(self, x, weighed, y)
      class(reduced_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :), weighed(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      integer :: k

      do k = 1, size(weighed, 2)
         call reduced_times(self%pattern, self%factor, self%b, x(:, k), y(:, k))
      end do
   end subroutine apply_reduced

   subroutine weigh_reduced(self, x, y)
      class(reduced_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      associate (unused => self)
      end associate
      y = x
   end subroutine weigh_reduced

   !> The two least and the two largest eigenvalues, ascending, of B x = value A x, A definite, with
   !> x'A x = 1; see `end_pairs`. is_there: never where the factor of A has pins.
   subroutine end_pairs_of(pattern, factor, b, none, values, vectors, is_there, error, start)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(symmetric_factor_t), intent(in), target :: factor
      type(sparse_t), intent(in) :: b
      real(wp), intent(in) :: none
      real(wp), allocatable, intent(out) :: values(:), vectors(:, :)
      logical, intent(out) :: is_there
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable, intent(in), optional :: start(:)
      type(reduced_t) :: operator
      real(wp), allocatable :: expected(:)
      integer :: k

      is_there = factor%negative == 0 .and. size(factor%pinned) == 0
      if (.not. is_there) return
      operator%pattern => pattern
      operator%factor => factor
      operator%b = reduce(pattern, factor, b)
      if (present(start)) then
         if (allocated(start)) expected = to_reduced(pattern, factor, start)
      end if
      ! Not allocated, it is as if it were not there.
      call end_pairs(operator, pattern%n, none, values, vectors, is_there, error, expected)
      if (allocated(error)) return
      do k = 1, size(values)
         vectors(:, k) = from_reduced(pattern, factor, vectors(:, k))
      end do
   end subroutine end_pairs_of

   pure subroutine take_out(vectors, products, x)
      real(wp), intent(in) :: vectors(:, :), products(:, :)
      real(wp), intent(inout) :: x(:, :)

      if (size(vectors, 2) > 0) x = x - matmul(vectors, matmul(transpose(products), x))
   end subroutine take_out

   !> Up to `wanted` lowest values of K x = value M x, with x'M x = 1: fewer where the rank of M
   !> is lower. K, whose factor is given, and M have their values in the same entries, of the
   !> pattern; least as for `factorise`.
   subroutine lowest_pairs(pattern, k, factor, m, wanted, pairs, error, least)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(sparse_t), intent(in), target :: k, m
      type(symmetric_factor_t), intent(in) :: factor
      integer, intent(in) :: wanted
      type(pairs_t), intent(out) :: pairs
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: least(:)
      type(pencil_t) :: pencil
      real(wp) :: shift
      integer :: width, missing

      if (wanted == 1) then
         call find_lowest(pattern, factor, m, pairs, error)
         if (allocated(error) .or. pairs%is_complete) return
      end if
      call make_pencil(pattern, factor, m, m, pencil, error)
      if (.not. allocated(error)) call find_shift(pencil, k, m, shift, error, least)
      pairs%null = pencil%touched
      width = narrowest
      do while (width <= widest .and. .not. (allocated(error) .or. pairs%is_complete))
         call largest_pairs(pencil, pattern%n, wanted, pairs%values, pairs%vectors, error, width)
         if (allocated(error)) return
         call purify(pencil, pairs)
         pairs%values = 1/pairs%values - shift
         call sort(pairs)
         call count_missing(pencil, k, m, -1.0_wp, with_zeros(pairs%values, size(pencil%strength)), &
                            pencil%factor%negative, missing, error, least)
         pairs%is_complete = missing == 0
         width = 2*width
      end do
   end subroutine lowest_pairs

   !> The lowest value alone, of a definite K; not complete where it was not found.
   subroutine find_lowest(pattern, factor, m, pairs, error)
      type(symmetric_pattern_t), intent(in) :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      type(sparse_t), intent(in) :: m
      type(pairs_t), intent(out) :: pairs
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: values(:), vectors(:, :)
      integer :: last

      call end_pairs_of(pattern, factor, m, none_below, values, vectors, pairs%is_complete, error)
      last = 0
      if (pairs%is_complete) last = size(values)
      pairs%is_complete = last > 0
      if (pairs%is_complete) pairs%is_complete = values(last) > 0
      if (allocated(error) .or. .not. pairs%is_complete) return
      pairs%values = 1/values(last:)
      pairs%vectors = vectors(:, last:)/sqrt(values(last))
      allocate (pairs%null(pattern%n, 0))
   end subroutine find_lowest

   !> Up to `wanted` values of K x = -value G x nearest to zero, with x'K x = 1: fewer where the
   !> rank of G is lower. Null vectors of K are left out. accuracy: of the vectors, as for
   !> `largest_pairs`; values have the square of it. The rest as above.
   subroutine pairs_next_to_zero(pattern, k, factor, g, wanted, pairs, error, least, accuracy)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(sparse_t), intent(in), target :: k, g
      type(symmetric_factor_t), intent(in) :: factor
      integer, intent(in) :: wanted
      type(pairs_t), intent(out) :: pairs
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: least(:), accuracy
      type(pencil_t) :: pencil
      integer :: width, missing(2), above

      call make_pencil(pattern, factor, g, k, pencil, error)
      pairs%null = pencil%touched
      width = narrowest
      do while (width <= widest .and. .not. (allocated(error) .or. pairs%is_complete))
         call largest_pairs(pencil, pattern%n, wanted, pairs%values, pairs%vectors, error, width, accuracy)
         if (allocated(error)) return
         call purify(pencil, pairs)
         pairs%values = -1/pairs%values
         call sort(pairs)
         above = count(.not. pairs%values > 0) + 1
         call count_missing(pencil, k, g, 1.0_wp, pairs%values(above:), count(pencil%strength < 0), missing(1), error, least)
         if (.not. allocated(error)) &
            call count_missing(pencil, k, g, -1.0_wp, -pairs%values(above - 1:1:-1), count(pencil%strength > 0), &
                               missing(2), error, least)
         pairs%is_complete = all(missing == 0)
         width = 2*width
      end do
   end subroutine pairs_next_to_zero

   !> Find the null vectors of A, and what B does to them.
   subroutine make_pencil(pattern, factor, b, w, pencil, error)
      type(symmetric_pattern_t), intent(in), target :: pattern
      type(symmetric_factor_t), intent(in) :: factor
      type(sparse_t), intent(in), target :: b, w
      type(pencil_t), intent(out) :: pencil
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: images(pattern%n, factor%zero), small(factor%zero, factor%zero), strength(factor%zero), most
      integer, allocatable :: kept(:)
      integer :: i

      pencil%pattern => pattern
      pencil%factor = factor
      pencil%b => b
      pencil%w => w
      call null_vectors(pattern, factor, pencil%null, error)
      if (allocated(error)) return
      call symmetric_times(b, pencil%null, images)
      small = matmul(transpose(pencil%null), images)
      call symmetric_eigenpairs(small, strength, error)
      most = maxval(abs(b%value))
      kept = pack([(i, i=1, size(strength))], abs(strength) > nothing*most)
      pencil%strength = strength(kept)
      pencil%touched = matmul(pencil%null, small(:, kept))
      pencil%without = matmul(images, small(:, kept))
      do i = 1, size(kept)
         pencil%without(:, i) = pencil%without(:, i)/strength(kept(i))
      end do
   end subroutine make_pencil

   !> Factorise A = K + shift M such that all finite values lie above -shift: K itself, where
   !> none is negative.
   subroutine find_shift(pencil, k, m, shift, error, least)
      type(pencil_t), intent(inout) :: pencil
      type(sparse_t), intent(in) :: k, m
      real(wp), intent(out) :: shift
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: least(:)
      type(symmetric_factor_t) :: best
      real(wp) :: at
      integer :: round

      shift = 0.0_wp
      best = pencil%factor
      if (best%negative == 0) return
      at = first_shift*lowest_magnitude(pencil)
      do round = 1, most_shifts
         call factorise(pencil%pattern, combined(k, m, at), pencil%factor, error, least)
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
      real(wp), dimension(pencil%pattern%n, 2) :: x, y, weighed
      real(wp) :: square
      integer :: round

      lowest = 1.0_wp
      call fill_at_random(1, x)
      do round = 1, 4
         call pencil%weigh(x, weighed)
         call pencil%apply(x, weighed, y)
         call pencil%weigh(y, weighed)
         square = sum(weighed*y)
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
   !> Values are those of the operator.
   subroutine purify(pencil, pairs)
      type(pencil_t), intent(in) :: pencil
      type(pairs_t), intent(inout) :: pairs
      real(wp), dimension(size(pairs%vectors, 1), size(pairs%vectors, 2)) :: images, weighed
      integer :: i

      call pencil%weigh(pairs%vectors, weighed)
      call pencil%apply(pairs%vectors, weighed, images)
      do i = 1, size(pairs%values)
         pairs%vectors(:, i) = images(:, i)/pairs%values(i)
      end do
   end subroutine purify

   pure subroutine sort(pairs)
      type(pairs_t), intent(inout) :: pairs
      integer :: order(size(pairs%values))

      order = ascending(pairs%values)
      pairs%values = pairs%values(order)
      pairs%vectors = pairs%vectors(:, order)
   end subroutine sort

   !> The same values and some zeros, ascending.
   pure function with_zeros(values, zeros) result(all)
      real(wp), intent(in) :: values(:)
      integer, intent(in) :: zeros
      real(wp) :: all(size(values) + zeros)

      all = [values, spread(0.0_wp, 1, zeros)]
      all = all(ascending(all))
   end function with_zeros

   !> How many values below the last cluster were not found: K + sign t M has as many negative
   !> eigenvalues as there are values below t, and those that it has for all t.
   subroutine count_missing(pencil, k, m, sign, values, always, missing, error, least)
      type(pencil_t), intent(in) :: pencil
      type(sparse_t), intent(in) :: k, m
      real(wp), intent(in) :: sign, values(:)
      integer, intent(in) :: always
      integer, intent(out) :: missing
      type(error_t), allocatable, intent(out) :: error
      real(wp), intent(in), optional :: least(:)
      type(symmetric_factor_t) :: factor
      integer :: below

      missing = 0
      do below = size(values) - 1, 1, -1
         if (values(below + 1) - values(below) > cluster*maxval(abs(values(below:below + 1)))) exit
      end do
      if (below < 1) return
      call factorise(pencil%pattern, combined(k, m, sign*(values(below) + values(below + 1))/2), factor, error, least)
      if (.not. allocated(error)) missing = max(0, factor%negative - always - below)
   end subroutine count_missing
end module flexact_symmetric_pencil
