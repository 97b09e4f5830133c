! SPDX-License-Identifier: BSD-3-Clause
!> Scales of a sparse symmetric matrix: entries over those of their row and column are at most
!> about 1, the largest of each row is, and the diagonal of a definite matrix.
module flexact_equilibration
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: find_scale

   !> Each halves, in powers of ten, how far the largest entries are from 1.
   integer, parameter :: rounds = 10
   real(wp), parameter :: about_one = 1.5_wp

contains

   !> The root of the diagonal, or of `least` where that is larger; then, until the largest
   !> scaled entry of each row is about 1, times the root of that entry, both ways (Ruiz,
   !> Rutherford Appleton Laboratory RAL-TR-2001-034), but not below the root of `least`.
   pure subroutine find_scale(matrix, scale, least)
      type(sparse_t), intent(in) :: matrix
      real(wp), intent(out) :: scale(:)
      real(wp), intent(in), optional :: least(:)
      real(wp) :: largest(size(scale)), low(size(scale)), entry
      integer :: i, j, at, round

      low = 0.0_wp
      if (present(least)) low = sqrt(least)
      scale = low
      do j = 1, matrix%columns
         do at = matrix%start(j), matrix%start(j + 1) - 1
            if (matrix%place(at) == j) scale(j) = max(scale(j), sqrt(abs(matrix%value(at))))
         end do
      end do
      where (.not. scale > 0) scale = 1.0_wp
      do round = 1, rounds
         largest = 0.0_wp
         do j = 1, matrix%columns
            do at = matrix%start(j), matrix%start(j + 1) - 1
               i = matrix%place(at)
               if (i < j) cycle
               entry = abs(matrix%value(at)/scale(i)/scale(j))
               largest(i) = max(largest(i), entry)
               largest(j) = max(largest(j), entry)
            end do
         end do
         where (.not. largest > 0) largest = 1.0_wp
         if (all(largest <= about_one .and. (largest >= 1/about_one .or. scale <= low))) exit
         scale = max(scale*sqrt(largest), low)
      end do
   end subroutine find_scale
end module flexact_equilibration
