!> Vectors of a null space where there are very many of them, block by block.
module flexact_many
   use flexact_kinds, only: wp
   use flexact_answer, only: options_t, stage_stresses
   use flexact_basis, only: basis_t, new_basis
   use flexact_null_space, only: operator_t, correct
   use flexact_pinned, only: pinned_t, make_pinned, apply_inverse, release, pinned_fine
   use flexact_sparse, only: times_transposed
   implicit none
   private
   public :: find_many

   integer, parameter :: width = 64
   !> Entries below this part of the largest one are rounding.
   real(wp), parameter :: nothing = 1.0e-11_wp
   !> What may be left of the image of a vector of largest entry one.
   real(wp), parameter :: residue = 1.0e-12_wp

contains

   !> Vectors (columns, k) that A, of any shape, sends to zero, each with an entry
   !> where the others have none. group: as for `make_pinned`.
   subroutine find_many(a, group, options, found, status)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      type(options_t), intent(in) :: options
      type(basis_t), intent(out) :: found
      integer, intent(out) :: status
      type(pinned_t) :: pinned
      integer :: first

      call new_basis(found)
      call make_pinned(a%by_column, a%by_row, group, options, pinned, status)
      if (status == pinned_fine) then
         do first = 1, pinned%pins, width
            call options%tell(stage_stresses, first, pinned%pins)
            call take_block(a, pinned, first, min(first + width - 1, pinned%pins), found, status)
            if (status /= pinned_fine) exit
         end do
      end if
      call release(pinned)
   end subroutine find_many

   subroutine take_block(a, pinned, first, last, found, status)
      type(operator_t), intent(in) :: a
      type(pinned_t), intent(in) :: pinned
      integer, intent(in) :: first, last
      type(basis_t), intent(inout) :: found
      integer, intent(out) :: status
      real(wp) :: vectors(pinned%n, last - first + 1), image(a%by_column%rows, last - first + 1)
      integer :: k, i

      vectors = 0.0_wp
      do k = 1, size(vectors, 2)
         vectors(pinned%pin(first + k - 1), k) = 1.0_wp
      end do
      call apply_inverse(pinned, vectors, status)
      do i = 1, 2
         if (status == pinned_fine) call correct(a, pinned, vectors, status)
      end do
      if (status /= pinned_fine) return
      do k = 1, size(vectors, 2)
         where (abs(vectors(:, k)) <= nothing*maxval(abs(vectors(:, k)))) vectors(:, k) = 0.0_wp
      end do
      call times_transposed(a%by_row, vectors, image)
      do k = 1, size(vectors, 2)
         if (maxval(abs(image(:, k))) > residue*maxval(abs(vectors(:, k)))) cycle
         call found%add(pack([(i, i=1, pinned%n)], abs(vectors(:, k)) > 0), pack(vectors(:, k), abs(vectors(:, k)) > 0))
      end do
   end subroutine take_block
end module flexact_many
