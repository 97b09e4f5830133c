! SPDX-License-Identifier: BSD-3-Clause
!> The block of vectors with which the search of the smallest values begins. What inverse(F)
!> makes of it takes little longer where it is applied to others anyway.
module flexact_first_block
   use flexact_kinds, only: wp
   use flexact_orthonormal, only: extend, fill_at_random, take_out
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: first_block_t, make_first_block, large

   !> Of matrices with more columns each step costs more: a factor that does not fit the
   !> caches is read twice, for however many vectors.
   integer, parameter :: large = 20000
   !> The least width of a block.
   integer, parameter :: narrowest = 3, narrowest_large = 6
   !> Parts of what the vectors are to be orthogonal to that may be taken out of them and not out
   !> of what inverse(F) made of them: their squares go into the values.
   real(wp), parameter :: most_left = 1.0e-6_wp

   !> Vectors (columns, k) that inverse(F) was applied to. Where `applied` is allocated they are
   !> orthonormal, and this is what inverse(F) makes of them.
   type :: first_block_t
      real(wp), allocatable :: vectors(:, :), applied(:, :)
   contains
      procedure :: make_orthonormal, follow
   end type first_block_t

contains

   !> Random vectors, for one of `rest` dimensions: as many as a block has for `wanted` values.
   subroutine make_first_block(columns, rest, wanted, careful, vectors)
      integer, intent(in) :: columns, rest, wanted
      logical, intent(in) :: careful
      real(wp), allocatable, intent(out) :: vectors(:, :)

      allocate (vectors(columns, min(rest, max((wanted + 1)/2, merge(narrowest_large, narrowest, careful .and. columns > large)))))
      call fill_at_random(1, vectors)
   end subroutine make_first_block

   !> Orthonormal vectors instead, and orthogonal to what is deflated and to the lowest: none
   !> where nothing is left of them.
   subroutine make_orthonormal(self, deflated, lowest)
      class(first_block_t), intent(inout) :: self
      type(sparse_basis_t), intent(in) :: deflated
      real(wp), intent(in), contiguous :: lowest(:, :)
      real(wp) :: space(size(self%vectors, 1), size(self%vectors, 2))
      integer :: used, fresh

      used = 0
      call extend(deflated, lowest, self%vectors, space, used, fresh)
      self%vectors = space(:, :used)
      if (used == 0) deallocate (self%vectors)
   end subroutine make_orthonormal

   !> Make the vectors orthogonal to others, (columns, k), which have changed a little, and forget
   !> what inverse(F) made of them if it was more than a little.
   subroutine follow(self, others)
      class(first_block_t), intent(inout) :: self
      real(wp), intent(in), contiguous :: others(:, :)
      real(wp) :: part(size(others, 2), size(self%vectors, 2))

      call take_out(others, self%vectors, part)
      if (any(abs(part) > most_left)) deallocate (self%applied)
   end subroutine follow
end module flexact_first_block
