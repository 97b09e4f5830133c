! SPDX-License-Identifier: BSD-3-Clause
!> Orthonormal vectors: made, extended, and taken out of others.
module flexact_orthonormal
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_dense, only: allocate_work
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqrf, dorgqr
   use flexact_scaled_norm, only: length_of
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: orthonormalise, deflate, extend, fill_at_random

   !> Part of a vector's length below which what is left of it is nothing new: half
   !> the digits are lost then, which a second round restores; of fewer it would not.
   real(wp), parameter :: new = 1.0e-7_wp

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

   !> Append what is new in a block (n, k) to an orthonormal space, of which the
   !> first `used` columns are there, and which stays orthogonal to what is deflated.
   pure subroutine extend(deflated, lowest, block, space, used, fresh)
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in) :: lowest(:, :), block(:, :)
      real(wp), intent(inout) :: space(:, :)
      integer, intent(inout) :: used
      integer, intent(out) :: fresh
      real(wp) :: vector(size(block, 1), 1), length, left
      integer :: k, round

      fresh = 0
      do k = 1, size(block, 2)
         if (used == size(space, 2)) return
         vector(:, 1) = block(:, k)
         length = length_of(vector(:, 1))
         if (.not. length > 0) cycle
         do round = 1, 2
            call deflated%deflate(vector)
            call deflate(lowest, vector)
            call deflate(space(:, :used), vector)
            left = length_of(vector(:, 1))
            if (left <= new*length) exit
            vector = vector/left
            ! Twice where much was taken away, and rounding with it.
            if (left > 0.5_wp*length) exit
            length = 1.0_wp
         end do
         if (left <= new*length) cycle
         used = used + 1
         fresh = fresh + 1
         space(:, used) = vector(:, 1)
      end do
   end subroutine extend

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
