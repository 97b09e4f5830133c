! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values beyond those that pins hold, by the block Lanczos
!> process for the inverse of A'A; theory.md (35).
module flexact_lanczos
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_error, only: error_t, fail, error_not_found
   use flexact_first_block, only: first_block_t, make_first_block, large
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm
   use flexact_orthonormal, only: extend, orthonormalise, fill_at_random
   use flexact_pinned, only: pinned_t, apply_inverse
   use flexact_rayleigh_ritz, only: take_lowest
   use flexact_sparse, only: operator_t
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: next_space

   !> Steps of the process: guards against values so close together that they do not converge.
   integer, parameter :: most_steps = 24, most_steps_large = 12
   !> Relative error of the smallest value that ends the process, and of a value to be given
   !> beside it: estimates, before the last step makes both much smaller. Of large matrices
   !> each step saved is a twentieth of the analysis, and six digits of the value are left.
   real(wp), parameter :: converged = 1.0e-11_wp, converged_large = 1.0e-4_wp
   !> Vectors beside those that are wanted, of which the lowest are taken.
   integer, parameter :: spare = 2

   !> The space (columns, room) and what inverse(F) makes of its first `known` vectors: the
   !> space times products, but for what is deflated.
   type :: process_t
      real(wp), allocatable :: space(:, :), products(:, :)
      integer :: used = 0, known = 0, fresh = 0
   end type process_t

contains

   !> Up to `wanted` of the smallest values beyond those of `deflated` and of `lowest`,
   !> orthonormal vectors (columns, k), and their vectors, by the block Lanczos
   !> process for the inverse of A'A: those that have converged when the smallest
   !> has, or mere estimates from above. start: the first block, if it is there already.
   subroutine next_space(a, pinned, deflated, lowest, wanted, careful, start, vectors, values, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      integer, intent(in) :: wanted
      logical, intent(in) :: careful
      type(first_block_t), intent(inout) :: start
      real(wp), allocatable, intent(out) :: vectors(:, :), values(:)
      type(error_t), allocatable, intent(out) :: error
      type(process_t) :: process
      real(wp), allocatable :: block(:, :), turned(:, :), errors(:)
      integer :: step, rest, steps, room

      allocate (vectors(a%by_column%columns, wanted), values(wanted))
      if (wanted == 0) return
      rest = a%by_column%columns - deflated%vectors - size(lowest, 2)
      if (.not. allocated(start%vectors)) then
         call make_first_block(a%by_column%columns, rest, wanted, careful, start%vectors)
         call apply_inverse(pinned, start%vectors, error)
         if (allocated(error)) return
      end if
      steps = 2
      if (careful) steps = merge(most_steps, most_steps_large, a%by_column%columns <= large)
      room = min(rest, size(start%vectors, 2)*steps)
      allocate (process%space(a%by_column%columns, room), process%products(room, room), errors(0))
      call begin(deflated, lowest, wanted, start, process)
      do step = 2, steps
         call take_applied(pinned, process, start, block, error)
         if (allocated(error)) return
         call grow(deflated, lowest, wanted, block, process)
         if (process%used == rest .or. process%fresh == 0) exit
         if (.not. careful .or. process%known < wanted) cycle
         call turn(process, wanted, turned, errors, error)
         if (allocated(error)) return
         if (errors(1) <= merge(converged, converged_large, size(vectors, 1) <= large)) exit
      end do
      if (process%used < wanted) then
         call fail(error_not_found, error)
      else if (size(errors) == 0 .or. process%used == rest .or. process%fresh == 0) then
         call take_lowest(a, process%space(:, :process%used), vectors, values, error)
      else
         call combine(process%space(:, :process%used), turned, block)
         deallocate (process%space)
         call take_lowest(a, block, vectors, values, error)
         steps = max(1, findloc([errors(:wanted) <= converged, .false.], .false., 1) - 1)
         vectors = vectors(:, :steps)
         values = values(:steps)
      end if
   end subroutine next_space

   !> The first vectors of the space; those of `start` are lost.
   subroutine begin(deflated, lowest, wanted, start, process)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      integer, intent(in) :: wanted
      type(first_block_t), intent(inout) :: start
      type(process_t), intent(inout) :: process
      real(wp), allocatable :: block(:, :)

      if (allocated(start%applied)) call start%follow(lowest)
      call move_alloc(start%vectors, block)
      if (allocated(start%applied)) then
         process%used = size(block, 2)
         process%fresh = process%used
         process%space(:, :process%used) = block
      else
         call grow(deflated, lowest, wanted, block, process)
      end if
   end subroutine begin

   !> inverse(F) times the latest vectors, which may be there already.
   subroutine take_applied(pinned, process, start, block, error)
      type(pinned_t), intent(in) :: pinned
      type(process_t), intent(in) :: process
      type(first_block_t), intent(inout) :: start
      real(wp), allocatable, intent(out) :: block(:, :)
      type(error_t), allocatable, intent(out) :: error

      if (allocated(start%applied)) then
         call move_alloc(start%applied, block)
      else
         block = process%space(:, process%used - process%fresh + 1:process%used)
         call apply_inverse(pinned, block, error)
      end if
   end subroutine take_applied

   !> Extend the space by what inverse(F) has made of the latest vectors.
   subroutine grow(deflated, lowest, wanted, block, process)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(inout) :: block(:, :)
      type(process_t), intent(inout) :: process
      real(wp) :: products(size(process%space, 2), size(block, 2))

      call extend(deflated, lowest, block, process%space, process%used, process%fresh, products)
      if (process%known > 0 .or. process%used > process%fresh) then
         process%products(:, process%known + 1:process%known + size(block, 2)) = products
         process%known = process%known + size(block, 2)
      end if
      if (process%fresh > 0 .or. process%used >= wanted) return
      ! The inverse has drowned the rest in what is there already.
      call fill_at_random(process%used + 2, block)
      call extend(deflated, lowest, block, process%space, process%used, process%fresh)
   end subroutine grow

   !> Ritz vectors of inverse(F), times inverse(F) once more, as combinations of the space
   !> (orthonormal columns), the smallest values first, and relative errors of these values:
   !> the square of what is left of a vector over the distance of the next value.
   subroutine turn(process, wanted, turned, errors, error)
      type(process_t), intent(in) :: process
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: turned(:, :), errors(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: projected(process%known, process%known), value(process%known), left(process%known), gap
      integer :: k

      associate (known => process%known, used => process%used, products => process%products)
         projected = (products(:known, :known) + transpose(products(:known, :known)))/2
         call symmetric_eigenpairs(projected, value, error)
         if (allocated(error)) return
         value = value(known:1:-1)
         projected = projected(:, known:1:-1)
         left = norm2(matmul(products(known + 1:used, :known), projected), 1)
         allocate (errors(known))
         do k = 1, known
            gap = minval(abs(value - value(k)), abs(value - value(k)) > left(k))
            errors(k) = min(left(k), left(k)**2/min(gap, abs(value(k))))/abs(value(k))
         end do
         turned = matmul(products(:used, :known), projected(:, :min(known, wanted + spare)))
         call orthonormalise(turned, error)
      end associate
   end subroutine turn

   !> Combinations of vectors.
   pure subroutine combine(space, turned, combined)
      real(wp), intent(in), contiguous :: space(:, :), turned(:, :)
      real(wp), allocatable, intent(out) :: combined(:, :)

      allocate (combined(size(space, 1), size(turned, 2)))
      call dgemm('N', 'N', size(space, 1), size(turned, 2), size(space, 2), 1.0_wp, space, size(space, 1), &
                 turned, size(turned, 1), 0.0_wp, combined, size(space, 1))
   end subroutine combine
end module flexact_lanczos
