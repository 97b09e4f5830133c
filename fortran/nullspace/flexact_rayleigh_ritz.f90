! SPDX-License-Identifier: BSD-3-Clause
!> The smallest singular values of A on a small space (Rayleigh and Ritz). They are
!> those of A itself, so that they do not suffer from squaring: k orthonormal
!> vectors with small |A v| show that k singular values are small; theory.md (35).
module flexact_rayleigh_ritz
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_ptr
   use flexact_blas, only: blas_share, blas_threads, blas_unshare
   use flexact_decomposition, only: decompose
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm, dgeqrf
   use flexact_sparse, only: operator_t, sparse_t
   use flexact_threads, only: on_pieces, pieces_of
   implicit none
   private
   public :: rayleigh_ritz, take_lowest

   !> So many fit the cache of a processor beside each other.
   integer, parameter :: rows_at_once = 256

   !> A space (columns, k) and the triangles of pieces of its image, one above the other (k*pieces, k).
   type :: image_t
      type(sparse_t), pointer :: by_row => null()
      real(wp), pointer, contiguous :: space(:, :) => null()
      integer :: pieces = 1
      real(wp), allocatable :: triangles(:, :)
   end type image_t

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
      real(wp), intent(out), contiguous :: vectors(:, :)
      real(wp), intent(out) :: values(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), dimension(size(space, 2), size(space, 2)) :: r, u, vt
      real(wp) :: lengths(size(space, 2)), turned(size(space, 2), size(values))
      integer :: k, n, wanted

      k = size(space, 2)
      wanted = size(values)
      call triangle_of_image(a%by_row, space, r)
      call decompose(r, lengths, u, vt, error)
      if (allocated(error)) return
      values = lengths(k:k - wanted + 1:-1)
      turned = transpose(vt(k:k - wanted + 1:-1, :))
      n = max(1, size(space, 1))
      call dgemm('N', 'N', size(space, 1), wanted, k, 1.0_wp, space, n, turned, max(1, k), 0.0_wp, vectors, n)
   end subroutine take_lowest

   !> The triangle R of the QR factorisation of the image of a space (columns, k): that of the
   !> triangles of its pieces. by_row: the rows of A.
   subroutine triangle_of_image(by_row, space, r)
      type(sparse_t), intent(in), target :: by_row
      real(wp), intent(in), target, contiguous :: space(:, :)
      real(wp), intent(out) :: r(:, :)
      type(image_t), target :: image
      real(wp) :: tau(size(r, 1)), work(64*size(r, 1))
      integer :: workers, info

      image%by_row => by_row
      image%space => space
      image%pieces = pieces_of(by_row%columns)
      workers = blas_threads()
      associate (k => size(r, 1), pieces => image%pieces)
         allocate (image%triangles(k*pieces, k))
         call blas_share()
         call on_pieces(by_row%columns, workers, make_triangle, c_loc(image))
         call blas_unshare()
         if (pieces > 1) call dgeqrf(k*pieces, k, image%triangles, k*pieces, tau, work, size(work), info)
      end associate
      call keep_triangle(image%triangles, r)
   end subroutine triangle_of_image

   recursive subroutine make_triangle(part, first, last, data)
      integer, intent(in) :: part, first, last
      type(c_ptr), intent(in) :: data
      type(image_t), pointer :: image

      call c_f_pointer(data, image)
      associate (k => size(image%space, 2))
         call triangle_of_rows(image%by_row, image%space, first, last, image%triangles((part - 1)*k + 1:part*k, :))
      end associate
   end subroutine make_triangle

   !> The same of some rows of the image, of which some are made at a time.
   recursive subroutine triangle_of_rows(by_row, space, from, to, r)
      type(sparse_t), intent(in) :: by_row
      real(wp), intent(in), contiguous :: space(:, :)
      integer, intent(in) :: from, to
      real(wp), intent(out) :: r(:, :)
      real(wp) :: block(size(r, 1) + rows_at_once, size(r, 1)), tau(size(r, 1)), work(64*size(r, 1))
      integer :: j, k, first, last, info

      k = size(r, 1)
      block = 0.0_wp
      do first = from, to, rows_at_once
         last = min(first + rows_at_once - 1, to)
         do j = 1, k
            call multiply_rows(by_row, first, last, space(:, j), block(k + 1:k + last - first + 1, j))
            block(j + 1:k, j) = 0.0_wp
         end do
         call dgeqrf(k + last - first + 1, k, block, size(block, 1), tau, work, size(work), info)
      end do
      call keep_triangle(block, r)
   end subroutine triangle_of_rows

   pure recursive subroutine keep_triangle(block, r)
      real(wp), intent(in) :: block(:, :)
      real(wp), intent(out) :: r(:, :)
      integer :: j

      r = 0.0_wp
      do j = 1, size(r, 2)
         r(:j, j) = block(:j, j)
      end do
   end subroutine keep_triangle

   !> Some entries of A x.
   pure recursive subroutine multiply_rows(by_row, first, last, x, y)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: first, last
      real(wp), intent(in) :: x(:)
      real(wp), intent(out) :: y(first:)
      real(wp) :: total
      integer :: i, entry

      do i = first, last
         total = 0.0_wp
         do entry = by_row%start(i), by_row%start(i + 1) - 1
            total = total + by_row%value(entry)*x(by_row%place(entry))
         end do
         y(i) = total
      end do
   end subroutine multiply_rows
end module flexact_rayleigh_ritz
