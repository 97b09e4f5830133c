! SPDX-License-Identifier: BSD-3-Clause
!> The smallest non-zero singular values with their vectors.
module flexact_smallest_values
   use flexact_kinds, only: wp
   use flexact_result, only: result_t, most_pairs
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: offer_pair

contains

   !> Keep a value with its vectors if it is among the smallest so far. Places
   !> are those of the entries of motion and stress in columns and rows.
   pure subroutine offer_pair(result, value, motion_place, motion, stress_place, stress)
      type(result_t), intent(inout) :: result
      real(wp), intent(in) :: value
      integer, intent(in) :: motion_place(:), stress_place(:)
      real(wp), intent(in) :: motion(:), stress(:)
      integer :: order(size(result%pair_value) + 1), kept

      if (count(result%pair_value <= value) >= most_pairs) return
      result%pair_value = [result%pair_value, value]
      order = ascending(result%pair_value)
      kept = min(size(order), most_pairs)
      result%pair_value = result%pair_value(order(:kept))
      call append(result%pair_motion, motion_place, motion, order(:kept))
      call append(result%pair_stress, stress_place, stress, order(:kept))
   end subroutine offer_pair

   !> Append a column, and keep some in this order.
   pure subroutine append(columns, place, entries, order)
      real(wp), allocatable, intent(inout) :: columns(:, :)
      integer, intent(in) :: place(:), order(:)
      real(wp), intent(in) :: entries(:)
      real(wp), allocatable :: kept(:, :)
      integer :: k

      allocate (kept(size(columns, 1), size(order)))
      do k = 1, size(order)
         if (order(k) <= size(columns, 2)) then
            kept(:, k) = columns(:, order(k))
         else
            kept(:, k) = 0.0_wp
            kept(place, k) = entries
         end if
      end do
      call move_alloc(kept, columns)
   end subroutine append
end module flexact_smallest_values
