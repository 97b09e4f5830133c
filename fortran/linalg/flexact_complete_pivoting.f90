! SPDX-License-Identifier: BSD-3-Clause
!> Elimination with complete pivoting among a few vectors.
module flexact_complete_pivoting
   use flexact_kinds, only: wp
   implicit none
   private
   public :: eliminate, rounding

   !> Entries below this part of the largest one of a vector are rounding: 1e-16,
   !> and as many times that as vectors of a null space may be ill-conditioned.
   real(wp), parameter :: rounding = 1.0e-11_wp

contains

   !> Combine vectors (n, k) so that each has an entry, its largest, where the
   !> others have none: those that live on different places come apart. entry (k):
   !> the places of these, 0 for what is left where vectors depend on others.
   pure subroutine eliminate(vectors, entry)
      real(wp), intent(inout) :: vectors(:, :)
      integer, intent(out), optional :: entry(:)
      real(wp) :: weight(size(vectors, 1))
      integer :: place(2), step, j

      if (present(entry)) entry = 0
      do step = 1, size(vectors, 2)
         place = maxloc(abs(vectors(:, step:)))
         j = step + place(2) - 1
         if (.not. abs(vectors(place(1), j)) > 0) return
         if (present(entry)) entry(step) = place(1)
         weight = vectors(:, j)/vectors(place(1), j)
         vectors(:, j) = vectors(:, step)
         vectors(:, step) = weight
         do j = 1, size(vectors, 2)
            if (j /= step) vectors(:, j) = vectors(:, j) - vectors(place(1), j)*weight
         end do
      end do
      do j = 1, size(vectors, 2)
         where (abs(vectors(:, j)) <= rounding*maxval(abs(vectors(:, j)))) vectors(:, j) = 0.0_wp
      end do
   end subroutine eliminate
end module flexact_complete_pivoting
