! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values of A on a small space (Rayleigh and Ritz). They are
!> those of A itself, so that they do not suffer from squaring: k orthonormal
!> vectors with small |A v| show that k singular values are small; theory.md (35).
module flexact_rayleigh_ritz
   use flexact_decomposition, only: decompose
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqrf
   use flexact_sparse, only: operator_t, times_transposed
   implicit none
   private
   public :: rayleigh_ritz, take_lowest

contains

   !> Turn orthonormal vectors among themselves so that their images under A are
   !> orthogonal; the lengths of these ascend.
   subroutine rayleigh_ritz(a, vectors, values, error)
      type(operator_t), intent(in) :: a
      real(wp), intent(inout), contiguous :: vectors(:, :)
      real(wp), intent(out), contiguous :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: before(:, :)

      before = vectors
      call take_lowest(a, before, vectors, values, error)
   end subroutine rayleigh_ritz

   !> Of an orthonormal space (columns, k) the vectors with the shortest images, and
   !> the lengths of these, ascending.
   subroutine take_lowest(a, space, vectors, values, error)
      type(operator_t), intent(in) :: a
      real(wp), intent(in), contiguous :: space(:, :)
      real(wp), intent(out) :: vectors(:, :), values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: image(:, :)
      real(wp), dimension(size(space, 2), size(space, 2)) :: r, u, vt
      real(wp) :: lengths(size(space, 2))
      integer :: k, wanted

      k = size(space, 2)
      wanted = size(values)
      allocate (image(a%by_column%rows, k))
      call times_transposed(a%by_row, space, image)
      call triangle_of(image, r)
      call decompose(r, lengths, u, vt, error)
      if (allocated(error)) return
      values = lengths(k:k - wanted + 1:-1)
      vectors = matmul(space, transpose(vt(k:k - wanted + 1:-1, :)))
   end subroutine take_lowest

   !> The triangle R of the QR factorisation of a matrix, which is destroyed; with
   !> zeros below where it has fewer rows than columns.
   subroutine triangle_of(matrix, r)
      real(wp), intent(inout), contiguous :: matrix(:, :)
      real(wp), intent(out) :: r(:, :)
      real(wp) :: tau(size(matrix, 2)), work(64*size(matrix, 2))
      integer :: j, info

      call dgeqrf(size(matrix, 1), size(matrix, 2), matrix, size(matrix, 1), tau, work, size(work), info)
      r = 0.0_wp
      do j = 1, size(matrix, 2)
         r(:min(j, size(matrix, 1)), j) = matrix(:min(j, size(matrix, 1)), j)
      end do
   end subroutine triangle_of
end module flexact_rayleigh_ritz
