! SPDX-License-Identifier: BSD-3-Clause
!> The space that pins hold: the null space, and what is nearly in it; theory.md (35)
!> and (36).
module flexact_pinned_space
   use flexact_error, only: error_t
   use flexact_first_block, only: first_block_t
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise, extend
   use flexact_pinned, only: pinned_t, apply_inverse
   use flexact_rayleigh_ritz, only: rayleigh_ritz, take_lowest
   use flexact_scaled_norm, only: length_of
   use flexact_sparse, only: operator_t, times_transposed, norm_bound
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: pinned_space, show_values

   !> A value below so many roundings of the norm is as good as zero, or as half the root of
   !> the number of columns: so many add up at random in the length of an image.
   real(wp), parameter :: least_zero = 2.0_wp
   !> Relative change of the values that ends the improvement, and a guard.
   real(wp), parameter :: converged = 1.0e-8_wp
   integer, parameter :: most_rounds = 8
   !> The same where nothing is shown anyway.
   integer, parameter :: few_rounds = 2
   !> Rounds in which rounding is taken from the image of a vector.
   integer, parameter :: most_corrections = 4

contains

   !> Orthonormal vectors (columns, k) whose span, with that of `deflated`, holds the
   !> null space, for k of the pins, and their values, ascending. beside: random vectors, for
   !> which the first steps of another search are taken.
   subroutine pinned_space(a, pinned, pin, deflated, vectors, values, error, beside)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: pin(:)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      type(error_t), allocatable, intent(out) :: error
      type(first_block_t), intent(inout), optional :: beside
      real(wp), allocatable :: before(:)
      real(wp) :: zero
      integer :: round

      allocate (vectors(a%by_column%columns, size(pin)), values(size(pin)))
      call solve_for_pins(pinned, pin, vectors, error, beside)
      if (allocated(error) .or. size(pin) == 0) return
      do round = 1, merge(2, 1, deflated%vectors > 0)
         call deflated%deflate(vectors)
         call orthonormalise(vectors, error)
         if (allocated(error)) return
      end do
      call rayleigh_ritz(a, vectors, values, error)
      zero = epsilon(1.0_wp)*max(least_zero, sqrt(real(pinned%n, wp))/2)*norm_bound(a%by_column)
      do round = 1, merge(few_rounds, most_rounds, pinned%is_shifted)
         if (allocated(error) .or. all(values <= zero)) return
         before = values
         call improve(a, pinned, deflated, vectors, values, error, beside)
         if (all(abs(before - values) <= converged*values)) return
      end do
   end subroutine pinned_space

   !> Columns of inverse(F), and what it makes of what is beside.
   subroutine solve_for_pins(pinned, pin, vectors, error, beside)
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: pin(:)
      real(wp), intent(out), contiguous :: vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      type(first_block_t), intent(inout), optional :: beside
      integer :: k

      vectors = 0.0_wp
      do k = 1, size(pin)
         vectors(pin(k), k) = 1.0_wp
      end do
      if (present(beside)) then
         call apply_to_both(pinned, vectors, beside%vectors, error)
      else
         call apply_inverse(pinned, vectors, error)
      end if
   end subroutine solve_for_pins

   subroutine apply_to_both(pinned, x, y, error)
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(inout) :: x(:, :), y(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: both(size(x, 1), size(x, 2) + size(y, 2))

      both(:, :size(x, 2)) = x
      both(:, size(x, 2) + 1:) = y
      call apply_inverse(pinned, both, error)
      x = both(:, :size(x, 2))
      y = both(:, size(x, 2) + 1:)
   end subroutine apply_to_both

   !> The lowest in the space of all vectors and of inverse(F) times their residuals:
   !> the vectors are off by rounding, and, where their values are not zero, because
   !> the pins hold them. beside: taken a step further, the first time.
   subroutine improve(a, pinned, deflated, vectors, values, error, beside)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp), intent(inout) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      type(first_block_t), intent(inout), optional :: beside
      real(wp) :: image(a%by_column%rows, 1), none(size(vectors, 1), 0)
      real(wp) :: space(size(vectors, 1), min(2*size(values), size(vectors, 1) - deflated%vectors))
      real(wp), allocatable :: residual(:, :)
      integer :: k, used, fresh
      logical :: takes_beside

      takes_beside = present(beside)
      if (takes_beside) takes_beside = allocated(beside%vectors) .and. .not. allocated(beside%applied)
      allocate (residual(size(vectors, 1), size(values)))
      do k = 1, size(values)
         call times_transposed(a%by_row, vectors(:, k:k), image)
         call times_transposed(a%by_column, image, residual(:, k:k))
         residual(:, k) = residual(:, k) - values(k)**2*vectors(:, k)
      end do
      if (takes_beside) call beside%make_orthonormal(deflated, vectors)
      if (takes_beside) takes_beside = allocated(beside%vectors)
      if (takes_beside) then
         beside%applied = beside%vectors
         call apply_to_both(pinned, residual, beside%applied, error)
      else
         call apply_inverse(pinned, residual, error)
      end if
      if (allocated(error)) return
      used = size(values)
      space(:, :used) = vectors
      call extend(deflated, none, residual, space, used, fresh)
      deallocate (residual)
      call take_lowest(a, space(:, :used), vectors, values, error)
   end subroutine improve

   !> Whether the values (k) of what pins hold are shown, those above the tolerance:
   !> the count of zeros there depends on them, and the residual of each must be well
   !> below it.
   subroutine show_values(a, pinned, values, vectors, tolerance, is_shown, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in) :: values(:), tolerance
      real(wp), intent(in), contiguous :: vectors(:, :)
      logical, intent(out) :: is_shown
      type(error_t), allocatable, intent(out) :: error
      real(wp), dimension(a%by_column%rows, 1) :: image, step
      real(wp) :: residual(size(vectors, 1), 1)
      integer :: k, round

      is_shown = .false.
      do k = 1, size(values)
         if (values(k) <= tolerance) cycle
         call times_transposed(a%by_row, vectors(:, k:k), image)
         do round = 1, most_corrections
            image = image/length_of(image(:, 1))
            call times_transposed(a%by_column, image, residual)
            residual = residual - values(k)*vectors(:, k:k)
            if (length_of(residual(:, 1)) <= values(k)/2) exit
            if (round == most_corrections) return
            ! A tiny image is rounding in good part, which is taken from it.
            call apply_inverse(pinned, residual, error)
            if (allocated(error)) return
            call times_transposed(a%by_row, residual, step)
            image = image - step
         end do
      end do
      is_shown = .true.
   end subroutine show_values
end module flexact_pinned_space
