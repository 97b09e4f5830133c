! SPDX-License-Identifier: BSD-3-Clause
!> Vectors that A' sends to zero, by projection; theory.md (37). What one projection leaves, others
!> take by conjugate gradients: few values are so low that they take more than one.
module flexact_left_null_space
   use flexact_error, only: error_t, fail, error_not_found
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: orthonormalise, deflate, fill_at_random
   use flexact_pinned, only: pinned_t, apply_inverse
   use flexact_scaled_norm, only: length_of
   use flexact_sparse, only: operator_t, times_transposed, norm_bound
   implicit none
   private
   public :: left_null_space

   !> Of vectors u: A'u, its projection, inverse(F) A'u, and the way that is gone (columns, k), by
   !> how much that changes u (rows, k), and the product of the first two a step before, or 0.
   type :: descent_t
      real(wp), allocatable :: image(:, :), projection(:, :), way(:, :), change(:, :)
      real(wp), allocatable :: before(:)
   end type descent_t

   !> A guard: a projection takes all but about t**2 over the next value squared of what is left,
   !> and the loop ends where two in turn bring less than half of the least so far.
   integer, parameter :: most_projections = 40, most_in_vain = 2
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
      type(descent_t) :: descent
      integer :: again

      allocate (vectors(a%by_column%rows, wanted))
      if (wanted == 0) return
      call begin(a, wanted, descent)
      call fill_at_random(1, vectors)
      call deflate(known, vectors)
      call make_long(descent, vectors)
      ! Vectors that are nearly parallel lose digits when they are made orthonormal.
      do again = 1, 2
         call project(a, pinned, known, descent, vectors, error)
         if (.not. allocated(error)) call orthonormalise(vectors, error)
         if (allocated(error)) return
      end do
      call times_transposed(a%by_column, vectors, descent%image)
      if (maxval(abs(descent%image)) > large_residual*norm_bound(a%by_column)) call fail(error_not_found, error)
   end subroutine left_null_space

   !> Until A' leaves nothing of vectors of unit length, or no less.
   subroutine project(a, pinned, known, descent, vectors, error)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      real(wp), intent(in), contiguous :: known(:, :)
      type(descent_t), intent(inout) :: descent
      real(wp), intent(inout), contiguous :: vectors(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: left, least
      integer :: round, in_vain

      descent%before = 0.0_wp
      in_vain = 0
      least = huge(least)
      do round = 1, most_projections
         call times_transposed(a%by_column, vectors, descent%image)
         left = maxval(abs(descent%image))
         in_vain = merge(in_vain + 1, 0, left > 0.5_wp*least)
         if (left <= small_residual .or. in_vain == most_in_vain) exit
         least = min(least, left)
         descent%projection = descent%image
         call apply_inverse(pinned, descent%projection, error)
         if (allocated(error)) return
         call descend(a, known, in_vain > 0, descent, vectors)
         if (round == 1) call make_long(descent, vectors)
      end do
   end subroutine project

   pure subroutine begin(a, wanted, descent)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: wanted
      type(descent_t), intent(out) :: descent

      associate (m => a%by_column%rows, n => a%by_column%columns)
         allocate (descent%image(n, wanted), descent%projection(n, wanted), descent%way(n, wanted), &
                   descent%change(m, wanted))
         allocate (descent%before(wanted), source=0.0_wp)
         descent%way = 0.0_wp
      end associate
   end subroutine begin

   !> Vectors of unit length, and what belongs to them: of random ones little is in the null space.
   pure subroutine make_long(descent, vectors)
      type(descent_t), intent(inout) :: descent
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp) :: length
      integer :: k

      do k = 1, size(vectors, 2)
         length = length_of(vectors(:, k))
         if (.not. length > 0) cycle
         vectors(:, k) = vectors(:, k)/length
         descent%way(:, k) = descent%way(:, k)/length
         descent%before(k) = descent%before(k)/length**2
      end do
   end subroutine make_long

   !> A step of the conjugate gradients of least squares, with F as the preconditioner (Bjorck,
   !> Numerical Methods for Least Squares Problems, 1996, section 7.4), for each vector alone.
   !> is_plain: the projection itself, which never makes what is left larger, as rounding may.
   subroutine descend(a, known, is_plain, descent, vectors)
      type(operator_t), intent(in) :: a
      real(wp), intent(in), contiguous :: known(:, :)
      logical, intent(in) :: is_plain
      type(descent_t), intent(inout) :: descent
      real(wp), intent(inout) :: vectors(:, :)
      real(wp) :: product(size(vectors, 2)), length
      integer :: k

      do k = 1, size(vectors, 2)
         associate (way => descent%way(:, k), projection => descent%projection(:, k), before => descent%before(k))
            product(k) = dot_product(descent%image(:, k), projection)
            if (is_plain .or. .not. before > 0) then
               way = projection
            else
               way = projection + product(k)/before*way
            end if
            before = merge(0.0_wp, product(k), is_plain)
         end associate
      end do
      call times_transposed(a%by_row, descent%way, descent%change)
      call deflate(known, descent%change)
      do k = 1, size(vectors, 2)
         length = dot_product(descent%change(:, k), descent%change(:, k))
         if (is_plain) length = product(k)
         if (length > 0) vectors(:, k) = vectors(:, k) - product(k)/length*descent%change(:, k)
      end do
   end subroutine descend
end module flexact_left_null_space
