!> The smallest non-zero singular values with their vectors.
module flexact_pairs
   use flexact_kinds, only: wp
   use flexact_answer, only: answer_t, most_pairs
   implicit none
   private
   public :: offer_pair

contains

   !> Keep a value with its vectors if it is among the smallest so far. Places
   !> are those of the entries of motion and stress in columns and rows.
   pure subroutine offer_pair(answer, value, motion_place, motion, stress_place, stress)
      type(answer_t), intent(inout) :: answer
      real(wp), intent(in) :: value
      integer, intent(in) :: motion_place(:), stress_place(:)
      real(wp), intent(in) :: motion(:), stress(:)
      integer :: at, kept

      at = count(answer%pair_value <= value) + 1
      if (at > most_pairs) return
      kept = min(size(answer%pair_value), most_pairs - 1)
      answer%pair_value = [answer%pair_value(:at - 1), value, answer%pair_value(at:kept)]
      call insert(answer%pair_motion, at, kept, motion_place, motion)
      call insert(answer%pair_stress, at, kept, stress_place, stress)
   end subroutine offer_pair

   !> Insert a column at a place, so that there are kept + 1 of them.
   pure subroutine insert(columns, at, kept, place, entries)
      real(wp), allocatable, intent(inout) :: columns(:, :)
      integer, intent(in) :: at, kept, place(:)
      real(wp), intent(in) :: entries(:)
      real(wp), allocatable :: wider(:, :)

      allocate (wider(size(columns, 1), kept + 1), source=0.0_wp)
      wider(:, :at - 1) = columns(:, :at - 1)
      wider(:, at + 1:) = columns(:, at:kept)
      wider(place, at) = entries
      call move_alloc(wider, columns)
   end subroutine insert
end module flexact_pairs
