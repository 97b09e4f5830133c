! SPDX-License-Identifier: BSD-3-Clause
!> Scales of a sparse symmetric matrix: entries over those of their row and column are at most
!> about 1, and 1 on the diagonal of a definite matrix.
module flexact_equilibration
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: find_scale

contains

   !> The root of the diagonal; where entries beside it stay above 1, more.
   pure subroutine find_scale(matrix, scale, least)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(out) :: scale(:)
      real(wp), intent(in), optional :: least(:)
      real(wp) :: largest(size(scale)), unit(size(scale))
      integer :: i, j, entry, round

      scale = 0.0_wp
      largest = 0.0_wp
      if (present(least)) scale = least
      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            i = matrix%place(entry)
            if (i == j) scale(j) = max(scale(j), abs(matrix%value(entry)))
         end do
      end do
      scale = sqrt(scale)
      do round = 1, 2
         unit = 1/merge(scale, 1.0_wp, scale > 0)
         largest = 0.0_wp
         do j = 1, matrix%columns
            do entry = matrix%start(j), matrix%start(j + 1) - 1
               i = matrix%place(entry)
               if (i <= j) cycle
               largest(i) = max(largest(i), abs(matrix%value(entry)*unit(j)))
               largest(j) = max(largest(j), abs(matrix%value(entry)*unit(i)))
            end do
         end do
         if (all(largest <= scale)) exit
         scale = max(scale, largest)
      end do
      where (.not. scale > 0) scale = 1.0_wp
   end subroutine find_scale
end module flexact_equilibration
