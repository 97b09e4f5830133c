! SPDX-License-Identifier: BSD-3-Clause
!> Pins by inverse iteration, where pivots do not show them.
module flexact_pin_search
   use flexact_complete_pivoting, only: eliminate
   use flexact_error, only: error_t, fail, is_kind, error_not_definite, error_not_found
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise, fill_at_random
   use flexact_pinned, only: pinned_t, shift, pin, apply_inverse
   use flexact_rayleigh_ritz, only: rayleigh_ritz
   use flexact_sparse, only: operator_t
   implicit none
   private
   public :: seek_pins, repin, low_end

   !> Values up to this multiple of t are low: t is known up to the rounding of the
   !> factorisation, and one pin too many does no harm.
   real(wp), parameter :: low_end = 3.0_wp
   !> Columns at which a factorisation may fail in spite of its pins: a guard.
   integer, parameter :: most_rounds = 8
   !> Width of the search at first, how many vectors more than are low it takes, so
   !> that those have converged, and columns times its width squared, a guard of time: some
   !> seconds.
   integer, parameter :: least_wide = 32, wider_by = 8
   real(wp), parameter :: most_work = 2.5e8_wp
   !> Each brings the low vectors out by the square of t over the next value.
   integer, parameter :: iterations = 3

contains

   !> Pin columns that hold what inverse iteration finds to be low: the largest
   !> entries, one for each vector.
   subroutine seek_pins(a, pinned, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: vectors(:, :), values(:)
      integer :: width, low

      call shift(pinned, error)
      if (allocated(error)) return
      width = min(least_wide, pinned%n)
      do
         call inverse_iteration(a, pinned, width, vectors, values, error)
         if (allocated(error)) return
         low = count(values <= low_end*pinned%least)
         if (low + wider_by <= width .or. width == pinned%n) exit
         width = min(2*width, pinned%n)
         if (real(width, wp)**2*pinned%n > most_work) then
            call fail(error_not_found, error)
            return
         end if
      end do
      call repin(vectors(:, :low), [integer ::], pinned, error)
   end subroutine seek_pins

   !> Pin one large entry of each of these vectors (columns, k), beside `others`,
   !> and columns at which the factorisation fails even so.
   subroutine repin(vectors, others, pinned, error)
      real(wp), intent(in) :: vectors(:, :)
      integer, intent(in) :: others(:)
      type(pinned_t), intent(inout) :: pinned
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: left(size(vectors, 1), size(vectors, 2))
      logical :: is_pinned(size(vectors, 1))
      integer :: entry(size(vectors, 2)), attempt

      left = vectors
      left(others, :) = 0.0_wp
      is_pinned = .false.
      is_pinned(others) = .true.
      call eliminate(left, entry)
      is_pinned(pack(entry, entry > 0)) = .true.
      do attempt = 1, most_rounds
         call pin(is_pinned, pinned, error)
         if (.not. is_kind(error, error_not_definite)) return
         is_pinned(pinned%failed) = .true.
      end do
   end subroutine repin

   subroutine inverse_iteration(a, pinned, width, vectors, values, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: width
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      type(error_t), allocatable, intent(out) :: error
      integer :: round

      allocate (vectors(pinned%n, width), values(width))
      call fill_at_random(1, vectors)
      do round = 1, iterations
         call apply_inverse(pinned, vectors, error)
         if (allocated(error)) return
         call orthonormalise(vectors, error)
         if (allocated(error)) return
      end do
      call rayleigh_ritz(a, vectors, values, error)
   end subroutine inverse_iteration
end module flexact_pin_search
