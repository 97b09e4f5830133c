! SPDX-License-Identifier: BSD-3-Clause
!> Orthonormal vectors: made, extended, and taken out of others.
module flexact_orthonormal
   use, intrinsic :: iso_c_binding, only: c_f_pointer, c_loc, c_ptr
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_blas, only: blas_share, blas_threads, blas_unshare
   use flexact_dense, only: allocate_work
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgemm, dgeqrf, dorgqr
   use flexact_scaled_norm, only: length_of
   use flexact_sparse_basis, only: sparse_basis_t
   use flexact_threads, only: on_pieces, pieces_of
   implicit none
   private
   public :: orthonormalise, deflate, extend, take_out, fill_at_random

   !> Part of a vector's length below which what is left of it is nothing new: half
   !> the digits are lost then, which a second round restores; of fewer it would not.
   real(wp), parameter :: new = 1.0e-7_wp

   !> Vectors that are made orthogonal to a space together: more gain nothing, and the work
   !> among themselves grows with their square.
   integer, parameter :: at_once = 8

   !> Orthonormal vectors (n, m), what is taken out of them (n, k), and how much of it each piece of
   !> the rows brings forth, (m, k, pieces), until all of it is known.
   type :: taking_t
      real(wp), pointer, contiguous :: orthonormal(:, :) => null(), block(:, :) => null()
      real(wp), allocatable :: part(:, :, :)
      logical :: is_known = .false.
   end type taking_t

contains

   !> Replace independent columns (m, k), k <= m, by orthonormal ones that span
   !> the same space. One column is only divided by its length, which is as
   !> exact as can be.
   pure subroutine orthonormalise(basis, error)
      real(wp), intent(inout), contiguous :: basis(:, :)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: tau(:), work(:)
      real(wp) :: length(1)
      integer :: m, k, info

      m = size(basis, 1)
      k = size(basis, 2)
      if (k == 1) basis = basis/length_of(basis(:, 1))
      if (m == 0 .or. k < 2) return
      allocate (tau(k), stat=info)
      if (info == 0) call dorgqr(m, k, k, basis, m, tau, length, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      call dgeqrf(m, k, basis, m, tau, work, size(work), info)
      call dorgqr(m, k, k, basis, m, tau, work, size(work), info)
   end subroutine orthonormalise

   !> Make vectors orthogonal to orthonormal ones.
   pure subroutine deflate(orthonormal, vectors)
      real(wp), intent(in) :: orthonormal(:, :)
      real(wp), intent(inout) :: vectors(:, :)
      integer :: j, k

      do k = 1, size(vectors, 2)
         do j = 1, size(orthonormal, 2)
            vectors(:, k) = vectors(:, k) - dot_product(orthonormal(:, j), vectors(:, k))*orthonormal(:, j)
         end do
      end do
   end subroutine deflate

   !> Append what is new in a block (n, k), which is lost, to an orthonormal space, of which
   !> the first `used` columns are there, and which stays orthogonal to what is deflated. The
   !> block was the space times `products` (columns of the space, k), but for what was
   !> deflated and what was nothing new.
   subroutine extend(deflated, lowest, block, space, used, fresh, products)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      real(wp), intent(inout), contiguous :: block(:, :), space(:, :)
      integer, intent(inout) :: used
      integer, intent(out) :: fresh
      real(wp), intent(out), optional :: products(:, :)
      real(wp) :: whole(size(space, 2), size(block, 2))
      integer :: first, last, some

      fresh = 0
      do first = 1, size(block, 2), at_once
         last = min(first + at_once - 1, size(block, 2))
         call extend_at_once(deflated, lowest, block(:, first:last), space, used, some, whole(:, first:last))
         fresh = fresh + some
      end do
      if (present(products)) products = whole
   end subroutine extend

   !> The same for a few vectors.
   subroutine extend_at_once(deflated, lowest, block, space, used, fresh, whole)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      real(wp), intent(inout), contiguous :: block(:, :), space(:, :)
      integer, intent(inout) :: used
      integer, intent(out) :: fresh
      real(wp), intent(out) :: whole(:, :)
      real(wp) :: taken(used, size(block, 2)), factor(size(block, 2)), length, left
      real(wp) :: lengths(size(block, 2))
      integer :: k, round, before

      before = used
      whole = 0.0_wp
      lengths = [(length_of(block(:, k)), k=1, size(block, 2))]
      factor = lengths
      ! Twice, as much may be taken away, and rounding with it.
      do round = 1, 2
         do k = 1, size(block, 2)
            if (factor(k) > 0) block(:, k) = block(:, k)/lengths(k)
         end do
         call deflated%deflate(block)
         call take_out(lowest, block)
         call take_out(space(:, :before), block, taken)
         do k = 1, size(block, 2)
            if (.not. factor(k) > 0) cycle
            whole(:before, k) = whole(:before, k) + factor(k)*taken(:, k)
            lengths(k) = length_of(block(:, k))
            factor(k) = merge(factor(k)*lengths(k), 0.0_wp, lengths(k) > new)
         end do
      end do
      do k = 1, size(block, 2)
         if (.not. factor(k) > 0 .or. used == size(space, 2)) cycle
         length = lengths(k)
         call take_out_twice(space(:, before + 1:used), block(:, k), whole(before + 1:used, k))
         left = length_of(block(:, k))
         whole(before + 1:used, k) = whole(before + 1:used, k)*(factor(k)/length)
         if (left <= new*length) cycle
         used = used + 1
         space(:, used) = block(:, k)/left
         whole(used, k) = factor(k)*(left/length)
      end do
      fresh = used - before
   end subroutine extend_at_once

   !> Make a block (n, k) orthogonal to orthonormal vectors (n, m), all at once; `taken`: of
   !> each how much it had.
   subroutine take_out(orthonormal, block, taken)
      real(wp), intent(in), target, contiguous :: orthonormal(:, :)
      real(wp), intent(inout), target, contiguous :: block(:, :)
      real(wp), intent(out), optional :: taken(:, :)
      type(taking_t), target :: taking
      integer :: pieces, workers, p, round

      if (present(taken)) taken = 0.0_wp
      if (size(block) == 0 .or. size(orthonormal) == 0) return
      taking%orthonormal => orthonormal
      taking%block => block
      pieces = pieces_of(size(block, 1))
      allocate (taking%part(size(orthonormal, 2), size(block, 2), pieces))
      workers = blas_threads()
      call blas_share()
      do round = 1, 2
         call on_pieces(size(block, 1), workers, take_out_piece, c_loc(taking))
         if (taking%is_known) exit
         do p = 2, pieces
            taking%part(:, :, 1) = taking%part(:, :, 1) + taking%part(:, :, p)
         end do
         taking%is_known = .true.
      end do
      call blas_unshare()
      if (present(taken)) taken = taking%part(:, :, 1)
   end subroutine take_out

   recursive subroutine take_out_piece(part, first, last, data)
      integer, intent(in) :: part, first, last
      type(c_ptr), intent(in) :: data
      type(taking_t), pointer :: taking

      call c_f_pointer(data, taking)
      associate (v => taking%orthonormal, b => taking%block, n => size(taking%block, 1), some => last - first + 1, &
                 m => size(taking%orthonormal, 2), k => size(taking%block, 2))
         if (taking%is_known) then
            call dgemm('N', 'N', some, k, m, -1.0_wp, v(first, 1), n, taking%part, m, 1.0_wp, b(first, 1), n)
         else
            call dgemm('T', 'N', m, k, some, 1.0_wp, v(first, 1), n, b(first, 1), n, 0.0_wp, taking%part(1, 1, part), m)
         end if
      end associate
   end subroutine take_out_piece

   pure subroutine take_out_twice(orthonormal, vector, taken)
      real(wp), intent(in) :: orthonormal(:, :)
      real(wp), intent(inout) :: vector(:)
      real(wp), intent(out) :: taken(:)
      real(wp) :: part
      integer :: j, round

      taken = 0.0_wp
      do round = 1, 2
         do j = 1, size(orthonormal, 2)
            part = dot_product(orthonormal(:, j), vector)
            vector = vector - part*orthonormal(:, j)
            taken(j) = taken(j) + part
         end do
      end do
   end subroutine take_out_twice

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
end module flexact_orthonormal
