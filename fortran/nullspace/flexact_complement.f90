! SPDX-License-Identifier: BSD-3-Clause
!> The null space of the longer side of a matrix that is many times as long as wide.
!> An orthonormal basis of it would have the square of that length; sparse vectors
!> that span it have no more entries than the matrix.
module flexact_complement
   use flexact_dense, only: fits_integer, allocate_work
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_lapack, only: dgeqp3, dtrtrs
   use flexact_sorting, only: ascending
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: add_complement

   !> Entries up to this part of one are what rounding has left of zeros.
   real(wp), parameter :: rounding = 100*epsilon(1.0_wp)

contains

   !> Append m - r vectors that span what is orthogonal to r orthonormal columns U (m, r)
   !> to a basis: each has a one of its own and, besides, entries at r places that
   !> all share, where pivoting finds U to be well-conditioned.
   subroutine add_complement(u, basis, error)
      real(wp), intent(in) :: u(:, :)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      real(wp) :: across(size(u, 2), size(u, 1)), value(size(u, 2) + 1)
      integer :: pivot(size(u, 1)), place(size(u, 2) + 1), i, r
      integer, allocatable :: order(:), kept(:)

      r = size(u, 2)
      across = transpose(u)
      pivot = [(i, i=1, size(u, 1))]
      if (r > 0) call eliminate(across, pivot, error)
      if (allocated(error)) return
      place(:r) = pivot(:r)
      value(r + 1) = 1.0_wp
      order = r + ascending(real(pivot(r + 1:), wp))
      do i = 1, size(order)
         place(r + 1) = pivot(order(i))
         value(:r) = -across(:, order(i))
         kept = ascending(real(place, wp))
         kept = pack(kept, abs(value(kept)) > rounding)
         call basis%add(place(kept), value(kept))
      end do
   end subroutine add_complement

   !> Bring well-conditioned columns of A (r, m) to the front, r < m, and write the others
   !> as combinations of them.
   subroutine eliminate(a, pivot, error)
      real(wp), intent(inout), contiguous :: a(:, :)
      integer, intent(out) :: pivot(:)
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: work(:)
      real(wp) :: tau(size(a, 1)), length(1), triangle(size(a, 1), size(a, 1))
      integer :: r, m, info

      r = size(a, 1)
      m = size(a, 2)
      pivot = 0
      info = 1
      if (fits_integer(r, m)) call dgeqp3(r, m, a, r, pivot, tau, length, -1, info)
      if (info == 0) call allocate_work(work, length(1), info)
      if (info == 0) then
         call dgeqp3(r, m, a, r, pivot, tau, work, size(work), info)
         triangle = a(:, :r)
         call dtrtrs('U', 'N', 'N', r, m - r, triangle, r, a(:, r + 1:), r, info)
      end if
      if (info /= 0) call fail(error_memory, error)
   end subroutine eliminate
end module flexact_complement
