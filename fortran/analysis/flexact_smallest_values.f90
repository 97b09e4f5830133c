! SPDX-License-Identifier: BSD-3-Clause
!> The smallest non-zero singular values with their vectors, and those of equal ones.
module flexact_smallest_values
   use flexact_kinds, only: wp
   use flexact_result, only: result_t, most_pairs
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: offer_pairs, settle_equal

   !> Values that differ by less than this part are equal, and places that move by less.
   real(wp), parameter :: alike = 1.0e-9_wp, tied = 1.0e-6_wp

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

   !> Vectors of equal values, which ascend, in a basis of its own. As symmetry makes them, any turned
   !> pairs are such pairs, and rounding, which differs by machine, decides on them. Here the motions
   !> are turned so that the place that moves most in them all is moved by the first alone, and so on;
   !> the stresses follow. Values whose equals may go on behind the last are left as they are.
   pure subroutine settle_equal(value, motion, stress)
      real(wp), intent(in) :: value(:)
      real(wp), intent(inout) :: motion(:, :), stress(:, :)
      integer :: first, last, k

      last = 0
      do first = 1, size(value)
         if (first <= last) cycle
         last = first
         do while (last < size(value))
            if (value(last + 1) - value(last) > alike*value(last + 1)) exit
            last = last + 1
         end do
         if (last == most_pairs) cycle
         do k = first, last - 1
            call turn(motion(:, k:last), stress(:, k:last))
         end do
      end do
   end subroutine settle_equal

   !> The place that moves most in all the motions is moved by the first alone.
   pure subroutine turn(motion, stress)
      real(wp), intent(inout) :: motion(:, :), stress(:, :)
      real(wp) :: moves(size(motion, 1)), mirror(size(motion, 2))

      moves = norm2(motion, 2)
      associate (place => findloc(moves > (1 - tied)*maxval(moves), .true., 1))
         mirror = motion(place, :)/moves(place)
      end associate
      mirror(1) = mirror(1) - 1
      if (.not. any(abs(mirror) > 0)) return
      mirror = sqrt(2.0_wp)/norm2(mirror)*mirror
      motion = motion - matmul(reshape(matmul(motion, mirror), [size(motion, 1), 1]), reshape(mirror, [1, size(mirror)]))
      stress = stress - matmul(reshape(matmul(stress, mirror), [size(stress, 1), 1]), reshape(mirror, [1, size(mirror)]))
   end subroutine turn

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
