! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values beyond those that pins hold, by the block Lanczos
!> process for the inverse of A'A.
module flexact_lanczos
   use flexact_error, only: error_t, fail, error_not_found
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: extend, fill_at_random
   use flexact_pinned, only: pinned_t, apply_inverse
   use flexact_rayleigh_ritz, only: take_lowest
   use flexact_sparse, only: operator_t
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: next_space

   !> Steps of the process, and the least width of its blocks. The limits guard
   !> against values so close together that they do not converge.
   integer, parameter :: most_steps = 24, most_steps_large = 12
   integer, parameter :: narrowest = 3
   !> Relative change of the smallest value that ends the process, for matrices with
   !> up to `large` columns and for larger ones, where each step costs more.
   real(wp), parameter :: converged = 1.0e-8_wp, converged_large = 1.0e-5_wp
   integer, parameter :: large = 20000
   !> The same for a value to be given beside the smallest.
   real(wp), parameter :: nearly_converged = 1.0e-7_wp

contains

   !> Up to `wanted` of the smallest values beyond those of `deflated` and of `lowest`,
   !> orthonormal vectors (columns, k), and their vectors, by the block Lanczos
   !> process for the inverse of A'A: those that have converged when the smallest
   !> has, or mere estimates from above.
   subroutine next_space(a, pinned, deflated, lowest, wanted, careful, vectors, values, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      integer, intent(in) :: wanted
      logical, intent(in) :: careful
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: space(:, :), block(:, :)
      real(wp) :: before(wanted)
      integer :: step, used, fresh, rest, width, steps, kept

      allocate (vectors(a%by_column%columns, wanted), values(wanted))
      if (wanted == 0) return
      rest = a%by_column%columns - deflated%vectors - size(lowest, 2)
      width = min(rest, max((wanted + 1)/2, narrowest))
      steps = 2
      if (careful) steps = merge(most_steps, most_steps_large, a%by_column%columns <= large)
      kept = 1
      allocate (space(a%by_column%columns, min(rest, width*steps)), block(a%by_column%columns, width))
      call fill_at_random(1, block)
      used = 0
      before = huge(before)
      do step = 1, steps
         call grow(pinned, deflated, lowest, step, wanted, block, space, used, fresh, error)
         if (allocated(error)) return
         if (used < wanted .or. .not. (is_due(step, steps) .or. fresh == 0 .or. used == size(space, 2))) cycle
         call take_lowest(a, space(:, :used), vectors, values, error)
         if (allocated(error) .or. fresh == 0 .or. used == rest) exit
         kept = max(1, converged_first(before, values))
         if (abs(before(1) - values(1)) <= merge(converged, converged_large, size(space, 1) <= large)*values(1)) exit
         before = values
      end do
      if (used < wanted) call fail(error_not_found, error)
      if (.not. careful .or. used == rest .or. fresh == 0) return
      vectors = vectors(:, :kept)
      values = values(:kept)
   end subroutine next_space

   !> Extend the space by inverse(F) times a block, which becomes what is new.
   subroutine grow(pinned, deflated, lowest, step, wanted, block, space, used, fresh, error)
      type(pinned_t), intent(in) :: pinned
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in) :: lowest(:, :)
      integer, intent(in) :: step, wanted
      real(wp), allocatable, intent(inout) :: block(:, :)
      real(wp), intent(inout) :: space(:, :)
      integer, intent(inout) :: used
      integer, intent(out) :: fresh
      type(error_t), allocatable, intent(out) :: error

      call apply_inverse(pinned, block, error)
      if (allocated(error)) return
      call extend(deflated, lowest, block, space, used, fresh)
      if (fresh == 0 .and. used < wanted) then
         ! The inverse has drowned the rest in what is there already.
         call fill_at_random(step + 1, block)
         call extend(deflated, lowest, block, space, used, fresh)
      end if
      block = space(:, used - fresh + 1:used)
   end subroutine grow

   !> How many of the first values have converged.
   pure integer function converged_first(before, values) result(kept)
      real(wp), intent(in) :: before(:), values(:)

      do kept = 0, size(values) - 1
         if (abs(before(kept + 1) - values(kept + 1)) > nearly_converged*values(kept + 1)) return
      end do
      kept = size(values)
   end function converged_first

   !> Whether the values are looked at after this step.
   pure logical function is_due(step, steps)
      integer, intent(in) :: step, steps
      is_due = modulo(step, 3) == 0 .or. step == steps
   end function is_due
end module flexact_lanczos
