! SPDX-License-Identifier: BSD-3-Clause
!> The smallest non-zero singular values with their vectors.
module flexact_smallest_values
   use flexact_kinds, only: wp
   use flexact_result, only: result_t, most_pairs
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: offer_pairs

contains

   !> Keep of some values, with their vectors, those that are among the smallest so far.
   !> Places are those of the entries of motions and stresses in columns and rows; which: the
   !> values that are offered, and the columns with their vectors.
   pure subroutine offer_pairs(result, which, value, motion_place, motion, stress_place, stress)
      type(result_t), intent(inout) :: result
      integer, intent(in) :: which(:), motion_place(:), stress_place(:)
      real(wp), intent(in) :: value(:), motion(:, :), stress(:, :)
      integer :: order(size(result%pair_value) + size(which)), kept
      real(wp) :: known(size(order))

      if (size(which) == 0) return
      if (count(result%pair_value <= minval(value(which))) >= most_pairs) return
      known = [result%pair_value, value(which)]
      order = ascending(known)
      kept = min(size(order), most_pairs)
      result%pair_value = known(order(:kept))
      call take(result%pair_motion, motion_place, motion, which, order(:kept))
      call take(result%pair_stress, stress_place, stress, which, order(:kept))
   end subroutine offer_pairs

   !> Keep columns in this order, in which those that are offered stand behind the others.
   pure subroutine take(columns, place, offered, which, order)
      real(wp), allocatable, intent(inout) :: columns(:, :)
      integer, intent(in) :: place(:), which(:), order(:)
      real(wp), intent(in) :: offered(:, :)
      real(wp), allocatable :: kept(:, :)
      integer :: k

      allocate (kept(size(columns, 1), size(order)))
      do k = 1, size(order)
         if (order(k) <= size(columns, 2)) then
            kept(:, k) = columns(:, order(k))
         else
            if (size(place) < size(kept, 1)) kept(:, k) = 0.0_wp
            kept(place, k) = offered(:, which(order(k) - size(columns, 2)))
         end if
      end do
      call move_alloc(kept, columns)
   end subroutine take
end module flexact_smallest_values
