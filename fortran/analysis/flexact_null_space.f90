!> The smallest singular values of a matrix A with no fewer rows than columns,
!> and bases of the null spaces of A and A', from its pinned factorisation.
!>
!> Values are those of A itself on a small space (Rayleigh and Ritz), so that they
!> do not suffer from squaring: k orthonormal vectors with small |A v| prove that
!> k singular values are small.
module flexact_null_space
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_basis, only: basis_t, new_basis
   use flexact_sparse, only: sparse_t, times_transposed, norm_bound
   use flexact_decomposition, only: decompose, orthonormalise
   use flexact_lapack, only: dgeqrf
   use flexact_vectors, only: length_of
   use flexact_modes, only: untangle
   use flexact_pinned, only: pinned_t, lift, pin, apply_inverse, pinned_not_definite
   implicit none
   private
   public :: operator_t, seek_pins, repin, pinned_space, next_space, left_null_space

   !> A by columns and by rows, so that both products gather.
   type :: operator_t
      type(sparse_t) :: by_column
      type(sparse_t) :: by_row
   end type operator_t

   integer, parameter :: most_rounds = 8
   integer, parameter :: most_projections = 40
   !> What A' may leave of a unit vector of its null space.
   real(wp), parameter :: small_residual = 1.0e-14_wp, large_residual = 1.0e-9_wp
   !> A value below this part of the norm is as good as zero.
   real(wp), parameter :: practically_zero = 2*epsilon(1.0_wp)
   !> Width of the search for pins, how many vectors more than are low it takes, and
   !> entries that it may have.
   integer, parameter :: least_wide = 32, wider_by = 8
   real(wp), parameter :: most_entries = 2.0e7_wp
   !> Values up to this multiple of t are low.
   real(wp), parameter, public :: low_end = 3.0_wp
   !> Steps of the Lanczos process, and the least width of its blocks.
   integer, parameter :: most_steps = 24, most_steps_large = 12
   integer, parameter :: narrowest = 3
   !> Relative change of a value that ends the process, for matrices of up to so
   !> many columns and for larger ones, where each step costs more.
   real(wp), parameter :: settled = 1.0e-8_wp, settled_large = 1.0e-5_wp
   integer, parameter :: large = 20000
   !> A status beside those of `flexact_pinned`: fewer vectors than there must be.
   integer, parameter, public :: not_found = 4
   !> The same for a value to be given beside the smallest.
   real(wp), parameter :: nearly_settled = 1.0e-7_wp
   !> What is left of a vector that brings nothing new.
   real(wp), parameter :: new = 1.0e-7_wp

contains

   !> Pin columns that hold what inverse iteration finds to be low, where pivots do
   !> not tell them: the largest entries, one for each vector.
   subroutine seek_pins(a, pinned, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      real(wp), allocatable :: vectors(:, :), values(:)
      integer :: width, low

      call lift(pinned, status)
      if (status /= 0) return
      width = min(least_wide, pinned%n)
      do
         call inverse_iteration(a, pinned, width, vectors, values, status)
         if (status /= 0) return
         low = count(values <= low_end*pinned%least)
         if (low + wider_by <= width .or. width == pinned%n) exit
         width = min(2*width, pinned%n)
         status = not_found
         if (real(width, wp)*pinned%n > most_entries) return
      end do
      call repin(a, vectors(:, :low), [integer ::], pinned, status)
   end subroutine seek_pins

   !> Pin one large entry of each of these vectors (columns, k), beside `others`,
   !> and columns at which the factorisation fails even so.
   subroutine repin(a, vectors, others, pinned, status)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: vectors(:, :)
      integer, intent(in) :: others(:)
      type(pinned_t), intent(inout) :: pinned
      integer, intent(out) :: status
      real(wp) :: left(size(vectors, 1), size(vectors, 2))
      logical :: is_pinned(size(vectors, 1))
      integer :: entry(size(vectors, 2)), attempt

      left = vectors
      left(others, :) = 0.0_wp
      is_pinned = .false.
      is_pinned(others) = .true.
      call untangle(left, entry)
      is_pinned(pack(entry, entry > 0)) = .true.
      do attempt = 1, most_rounds
         call pin(a%by_row, is_pinned, pinned, status)
         if (status /= pinned_not_definite) return
         is_pinned(pinned%failed) = .true.
      end do
   end subroutine repin

   subroutine inverse_iteration(a, pinned, width, vectors, values, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: width
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      integer, intent(out) :: status
      integer :: round

      allocate (vectors(pinned%n, width), values(width))
      call fill_at_random(1, vectors)
      do round = 1, 3
         call apply_inverse(pinned, vectors, status)
         if (status /= 0) return
         call orthonormalise(vectors, status)
         if (status /= 0) return
      end do
      call settle(a, vectors, values, status)
   end subroutine inverse_iteration

   !> Orthonormal vectors (columns, k) whose span, with that of `apart`, holds the
   !> null space, for k of the pins, and their values, ascending.
   subroutine pinned_space(a, pinned, pin, apart, vectors, values, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: pin(:)
      type(basis_t), intent(in) :: apart
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: before(:)
      real(wp) :: zero
      integer :: k, round

      allocate (vectors(a%by_column%columns, size(pin)), source=0.0_wp)
      allocate (values(size(pin)))
      status = 0
      if (size(pin) == 0) return
      do k = 1, size(pin)
         vectors(pin(k), k) = 1.0_wp
      end do
      call apply_inverse(pinned, vectors, status)
      do round = 1, 2
         call apart%remove(vectors)
         if (status == 0) call orthonormalise(vectors, status)
      end do
      if (status == 0) call settle(a, vectors, values, status)
      zero = practically_zero*norm_bound(a%by_column)
      do round = 1, most_rounds
         if (status /= 0 .or. all(values <= zero)) return
         before = values
         call improve(a, pinned, apart, vectors, values, status)
         if (all(abs(before - values) <= settled*values)) return
      end do
   end subroutine pinned_space

   !> The lowest in the space of all vectors and of inverse(F) times their residuals:
   !> the vectors are off by rounding, and, where their values are not zero, because
   !> the pins hold them.
   subroutine improve(a, pinned, apart, vectors, values, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(basis_t), intent(in) :: apart
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp), intent(inout) :: values(:)
      integer, intent(out) :: status
      real(wp) :: image(a%by_column%rows, size(values)), residual(size(vectors, 1), size(values))
      real(wp) :: space(size(vectors, 1), min(2*size(values), size(vectors, 1) - apart%vectors)), none(size(vectors, 1), 0)
      integer :: k, used, fresh

      call times_transposed(a%by_row, vectors, image)
      call times_transposed(a%by_column, image, residual)
      do k = 1, size(values)
         residual(:, k) = residual(:, k) - values(k)**2*vectors(:, k)
      end do
      call apply_inverse(pinned, residual, status)
      if (status /= 0) return
      used = size(values)
      space(:, :used) = vectors
      call extend(apart, none, residual, new, space, used, fresh)
      call take_lowest(a, space(:, :used), vectors, values, status)
   end subroutine improve

   !> Turn orthonormal vectors among themselves so that their images under A are
   !> orthogonal; the lengths of these ascend.
   subroutine settle(a, vectors, values, status)
      type(operator_t), intent(in) :: a
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp), intent(out), contiguous :: values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: before(:, :)

      before = vectors
      call take_lowest(a, before, vectors, values, status)
   end subroutine settle

   !> Of an orthonormal space (columns, k) the vectors with the shortest images, and
   !> the lengths of these, ascending.
   subroutine take_lowest(a, space, vectors, values, status)
      type(operator_t), intent(in) :: a
      real(wp), intent(in), contiguous :: space(:, :)
      real(wp), intent(out) :: vectors(:, :), values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: image(:, :)
      real(wp), dimension(size(space, 2), size(space, 2)) :: r, u, vt
      real(wp) :: lengths(size(space, 2))
      integer :: k, wanted

      k = size(space, 2)
      wanted = size(values)
      allocate (image(a%by_column%rows, k))
      call times_transposed(a%by_row, space, image)
      call triangle_of(image, r, status)
      if (status == 0) call decompose(r, lengths, u, vt, status)
      if (status /= 0) return
      values = lengths(k:k - wanted + 1:-1)
      vectors = matmul(space, transpose(vt(k:k - wanted + 1:-1, :)))
   end subroutine take_lowest

   !> The triangle R of the QR factorisation of a matrix, which is destroyed; with
   !> zeros below where it has fewer rows than columns.
   subroutine triangle_of(matrix, r, status)
      real(wp), intent(inout), contiguous :: matrix(:, :)
      real(wp), intent(out) :: r(:, :)
      integer, intent(out) :: status
      real(wp) :: tau(size(matrix, 2)), work(64*size(matrix, 2))
      integer :: j

      call dgeqrf(size(matrix, 1), size(matrix, 2), matrix, size(matrix, 1), tau, work, size(work), status)
      r = 0.0_wp
      do j = 1, size(matrix, 2)
         r(:min(j, size(matrix, 1)), j) = matrix(:min(j, size(matrix, 1)), j)
      end do
   end subroutine triangle_of

   !> Up to `wanted` of the smallest values beyond those of `apart` and of `lowest`,
   !> orthonormal vectors (columns, k), and their vectors, by the block Lanczos
   !> process for the inverse of A'A: those that have settled when the smallest
   !> has, or mere estimates from above.
   subroutine next_space(a, pinned, apart, lowest, wanted, careful, vectors, values, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(basis_t), intent(in) :: apart
      real(wp), intent(in), contiguous :: lowest(:, :)
      integer, intent(in) :: wanted
      logical, intent(in) :: careful
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      integer, intent(out) :: status
      real(wp), allocatable :: space(:, :), block(:, :)
      real(wp) :: before(wanted)
      integer :: step, used, fresh, rest, width, steps, kept

      allocate (vectors(a%by_column%columns, wanted), values(wanted))
      status = 0
      if (wanted == 0) return
      rest = a%by_column%columns - apart%vectors - size(lowest, 2)
      width = min(rest, max((wanted + 1)/2, narrowest))
      steps = 2
      if (careful) steps = merge(most_steps, most_steps_large, a%by_column%columns <= large)
      kept = 1
      allocate (space(a%by_column%columns, min(rest, width*steps)), block(a%by_column%columns, width))
      call fill_at_random(1, block)
      used = 0
      before = huge(before)
      do step = 1, steps
         call apply_inverse(pinned, block, status)
         if (status /= 0) return
         call extend(apart, lowest, block, new, space, used, fresh)
         if (fresh == 0 .and. used < wanted) then
            ! The inverse has drowned the rest in what is there already.
            call fill_at_random(step + 1, block)
            call extend(apart, lowest, block, new, space, used, fresh)
         end if
         block = space(:, used - fresh + 1:used)
         if (used < wanted .or. .not. (is_due(step, steps) .or. fresh == 0 .or. used == size(space, 2))) cycle
         call take_lowest(a, space(:, :used), vectors, values, status)
         if (status /= 0 .or. fresh == 0 .or. used == rest) exit
         kept = max(1, settled_first(before, values))
         if (abs(before(1) - values(1)) <= merge(settled, settled_large, size(space, 1) <= large)*values(1)) exit
         before = values
      end do
      if (used < wanted) status = not_found
      if (.not. careful .or. used == rest .or. fresh == 0) return
      vectors = vectors(:, :kept)
      values = values(:kept)
   end subroutine next_space

   !> How many of the first values have settled.
   pure integer function settled_first(before, values) result(kept)
      real(wp), intent(in) :: before(:), values(:)

      do kept = 0, size(values) - 1
         if (abs(before(kept + 1) - values(kept + 1)) > nearly_settled*values(kept + 1)) return
      end do
      kept = size(values)
   end function settled_first

   !> Whether the values are looked at after this step.
   pure logical function is_due(step, steps)
      integer, intent(in) :: step, steps
      is_due = modulo(step, 3) == 0 .or. step == steps
   end function is_due

   !> Append what is new in a block (n, k) to an orthonormal space, of which the
   !> first `used` columns are there; less than the part `least` of a vector is not.
   pure subroutine extend(apart, lowest, block, least, space, used, fresh)
      type(basis_t), intent(in) :: apart
      real(wp), intent(in) :: lowest(:, :), block(:, :), least
      real(wp), intent(inout) :: space(:, :)
      integer, intent(inout) :: used
      integer, intent(out) :: fresh
      real(wp) :: vector(size(block, 1), 1), length, left
      integer :: k, round

      fresh = 0
      do k = 1, size(block, 2)
         if (used == size(space, 2)) return
         vector(:, 1) = block(:, k)
         length = length_of(vector(:, 1))
         if (.not. length > 0) cycle
         do round = 1, 2
            call apart%remove(vector)
            call remove(lowest, vector)
            call remove(space(:, :used), vector)
            left = length_of(vector(:, 1))
            if (left <= least*length) exit
            vector = vector/left
            ! Twice where much was taken away, and rounding with it.
            if (left > 0.5_wp*length) exit
            length = 1.0_wp
         end do
         if (left <= least*length) cycle
         used = used + 1
         fresh = fresh + 1
         space(:, used) = vector(:, 1)
      end do
   end subroutine extend

   !> Make vectors orthogonal to orthonormal ones.
   pure subroutine remove(orthonormal, vectors)
      real(wp), intent(in) :: orthonormal(:, :)
      real(wp), intent(inout) :: vectors(:, :)
      integer :: j, k

      do k = 1, size(vectors, 2)
         do j = 1, size(orthonormal, 2)
            vectors(:, k) = vectors(:, k) - dot_product(orthonormal(:, j), vectors(:, k))*orthonormal(:, j)
         end do
      end do
   end subroutine remove

   !> The same numbers between -1 and 1 every time (Park and Miller's generator).
   pure subroutine fill_at_random(run, x)
      integer, intent(in) :: run
      real(wp), intent(out) :: x(:, :)
      integer(int64), parameter :: modulus = 2147483647_int64
      integer(int64) :: seed
      integer :: i, k

      seed = 20111_int64*run
      do k = 1, size(x, 2)
         do i = 1, size(x, 1)
            seed = mod(16807_int64*seed, modulus)
            x(i, k) = 2*real(seed, wp)/modulus - 1
         end do
      end do
   end subroutine fill_at_random

   !> Orthonormal vectors (rows, wanted) that A' sends to zero: random ones less
   !> their projections on the range of A, A inverse(F) A'. `known` (rows, k):
   !> orthonormal directions in the range that the pins hide.
   subroutine left_null_space(a, pinned, known, wanted, vectors, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in), contiguous :: known(:, :)
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: vectors(:, :)
      integer, intent(out) :: status
      real(wp), allocatable :: image(:, :), step(:, :)
      real(wp) :: left, before
      integer :: round

      allocate (vectors(a%by_column%rows, wanted))
      status = 0
      if (wanted == 0) return
      allocate (image(a%by_column%columns, wanted), step(a%by_column%rows, wanted))
      call fill_at_random(1, vectors)
      do round = 1, most_projections
         call times_transposed(a%by_column, vectors, image)
         ! The first projections turn random vectors; then each brings less.
         left = maxval(abs(image))
         if (round > 2 .and. (left <= small_residual .or. left > 0.5_wp*before)) exit
         before = left
         call apply_inverse(pinned, image, status)
         if (status /= 0) return
         call times_transposed(a%by_row, image, step)
         vectors = vectors - step
         call remove(known, vectors)
         if (round == 1) call orthonormalise(vectors, status)
         if (status /= 0) return
      end do
      call orthonormalise(vectors, status)
      if (status /= 0) return
      call times_transposed(a%by_column, vectors, image)
      if (maxval(abs(image)) > large_residual*norm_bound(a%by_column)) status = not_found
   end subroutine left_null_space
end module flexact_null_space
