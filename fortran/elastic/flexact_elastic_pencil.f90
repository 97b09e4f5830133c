! SPDX-License-Identifier: BSD-3-Clause
!> A v = value B v for the motions that rigid rows leave, where A may be singular: the operator
!> inv(A) B on the vectors that are B-orthogonal to the null vectors of A.
module flexact_elastic_pencil
   use flexact_block_lanczos, only: self_adjoint_t
   use flexact_eigenpairs, only: symmetric_eigenpairs
   use flexact_elastic_operator, only: operator_t, solved
   use flexact_elastic_space, only: space_t
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_symmetric_factor, only: symmetric_times
   implicit none
   private
   public :: pencil_t, make_pencil

   type, extends(self_adjoint_t) :: pencil_t
      type(space_t), pointer :: space => null()
      type(operator_t), pointer :: a => null()
      !> Lower triangles of B, and of what the inner product is made with.
      type(sparse_t), pointer :: b => null(), weight => null()
      !> Null vectors L of A, and inv(L'B L) L'B where B does something to them.
      real(wp), allocatable :: touched(:, :), without(:, :)
   contains
      procedure :: apply => apply_inverse
      procedure :: weigh => weigh_with
   end type pencil_t

   !> Null vectors of A for which B has less than this part of its most are null vectors of B.
   real(wp), parameter :: nothing = 1.0e-10_wp

contains

   subroutine make_pencil(space, a, b, weight, pencil)
      type(space_t), target, intent(in) :: space
      type(operator_t), target, intent(in) :: a
      type(sparse_t), target, intent(in) :: b, weight
      type(pencil_t), intent(out) :: pencil
      type(error_t), allocatable :: error
      real(wp) :: images(size(a%loose, 1), size(a%loose, 2)), small(size(a%loose, 2), size(a%loose, 2)), most
      real(wp) :: values(size(a%loose, 2))
      integer, allocatable :: kept(:)
      integer :: i

      pencil%space => space
      pencil%a => a
      pencil%b => b
      pencil%weight => weight
      call symmetric_times(b, a%loose, images)
      small = matmul(transpose(a%loose), images)
      call symmetric_eigenpairs(small, values, error)
      most = maxval(abs(b%value))
      kept = pack([(i, i=1, size(values))], abs(values) > nothing*most)
      pencil%touched = matmul(a%loose, small(:, kept))
      pencil%without = transpose(matmul(images, small(:, kept)))
      do i = 1, size(kept)
         pencil%without(i, :) = pencil%without(i, :)/values(kept(i))
      end do
   end subroutine make_pencil

   subroutine apply_inverse(self, x, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)
      real(wp) :: clean(size(x, 1), size(x, 2))

      clean = x
      call take_out(self, clean)
      call symmetric_times(self%b, clean, y)
      call solved(self%space, self%a, y)
      call take_out(self, y)
   end subroutine apply_inverse

   subroutine take_out(self, x)
      class(pencil_t), intent(in) :: self
      real(wp), intent(inout) :: x(:, :)

      if (size(self%touched, 2) > 0) x = x - matmul(self%touched, matmul(self%without, x))
   end subroutine take_out

   subroutine weigh_with(self, x, y)
      class(pencil_t), intent(in) :: self
      real(wp), intent(in), contiguous :: x(:, :)
      real(wp), intent(out), contiguous :: y(:, :)

      call symmetric_times(self%weight, x, y)
   end subroutine weigh_with
end module flexact_elastic_pencil
