! SPDX-License-Identifier: BSD-3-Clause
!> Vectors that A' sends to zero, by projection; theory.md (37).
module flexact_left_null_space
   use flexact_error, only: error_t, fail, error_not_found
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise, deflate, fill_at_random
   use flexact_pinned, only: pinned_t, apply_inverse
   use flexact_sparse, only: operator_t, times_transposed, norm_bound
   implicit none
   private
   public :: left_null_space

   !> A guard: each projection takes about t**2 over the next value squared of what is
   !> left, and the loop ends where it brings less than half.
   integer, parameter :: most_projections = 40
   !> What A' may leave of a unit vector of its null space: rounding, where the
   !> projections end; and what is no such vector any more.
   real(wp), parameter :: small_residual = 1.0e-14_wp, large_residual = 1.0e-9_wp

contains

   !> Orthonormal vectors (rows, wanted) that A' sends to zero: random ones less
   !> their projections on the range of A, A inverse(F) A'. `known` (rows, k): directions in
   !> the range that the pins hide, or of which the projections take the least.
   subroutine left_null_space(a, pinned, known, wanted, vectors, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in), contiguous :: known(:, :)
      integer, intent(in) :: wanted
      real(wp), allocatable, intent(out) :: vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: image(:, :), step(:, :)
      real(wp) :: left, before
      integer :: round

      allocate (vectors(a%by_column%rows, wanted))
      if (wanted == 0) return
      allocate (image(a%by_column%columns, wanted), step(a%by_column%rows, wanted))
      call fill_at_random(1, vectors)
      do round = 1, most_projections
         call times_transposed(a%by_column, vectors, image)
         ! The first projections take most of random vectors; then each brings less.
         left = maxval(abs(image))
         if (round > 2 .and. (left <= small_residual .or. left > 0.5_wp*before)) exit
         before = left
         call apply_inverse(pinned, image, error)
         if (allocated(error)) return
         call times_transposed(a%by_row, image, step)
         vectors = vectors - step
         call deflate(known, vectors)
         if (round == 1) call orthonormalise(vectors, error)
         if (allocated(error)) return
      end do
      call orthonormalise(vectors, error)
      if (allocated(error)) return
      call times_transposed(a%by_column, vectors, image)
      if (maxval(abs(image)) > large_residual*norm_bound(a%by_column)) call fail(error_not_found, error)
   end subroutine left_null_space
end module flexact_left_null_space
