! SPDX-License-Identifier: BSD-3-Clause
!> Which singular values of a matrix count as zero; theory.md (7) to (9).
module flexact_rank
   use flexact_kinds, only: wp
   implicit none
   private
   public :: rank_rule_t, rank_t, decide_rank

   !> Zeros that the typed digits have raised stand this far below the rest. It guards
   !> small values that are none: nearer to the rest they stay what they seem.
   real(wp), parameter :: clear_gap = 100.0_wp

   !> What is known of a matrix beside its numbers.
   type :: rank_rule_t
      !> Its longer side.
      integer :: side = 0
      !> By how much, in the 2-norm, it may differ from the one that was meant: because
      !> of rounding in the last bits, and because of digits that were left out.
      real(wp) :: error_of_bits = 0.0_wp
      real(wp) :: error_of_digits = 0.0_wp
      !> Values up to here count as zero, if allocated, whatever the errors.
      real(wp), allocatable :: tolerance
   end type rank_rule_t

   type :: rank_t
      integer :: rank = 0
      !> What computing and rounding in the last bits may make of a zero.
      real(wp) :: noise = 0.0_wp
      !> Singular values up to here were taken for zero: the noise, or more
      !> where the digits of the data account for it; or as was asked.
      real(wp) :: tolerance = 0.0_wp
      !> Whether that tolerance was asked for.
      logical :: is_given = .false.
   end type rank_t

contains

   !> Values descend. Those within the noise are zero. So are those that the
   !> typed digits can account for, where a clear gap parts them from the rest;
   !> without the gap they are what they seem, since digits that were rounded
   !> would have raised the zeros together. Where a tolerance is given, it alone
   !> decides.
   pure function decide_rank(rule, values) result(decision)
      type(rank_rule_t), intent(in) :: rule
      real(wp), intent(in) :: values(:)
      type(rank_t) :: decision
      real(wp) :: above
      integer :: i

      decision%noise = rule%error_of_bits
      if (size(values) > 0) decision%noise = decision%noise + epsilon(1.0_wp)*rule%side*values(1)
      if (allocated(rule%tolerance)) then
         decision%tolerance = rule%tolerance
         decision%is_given = .true.
         decision%rank = count(values > rule%tolerance)
         return
      end if
      decision%tolerance = decision%noise
      above = 0.0_wp
      do i = 1, size(values)
         if (values(i) <= decision%noise) exit
         if (values(i) <= rule%error_of_digits .and. clear_gap*values(i) < above) then
            decision%tolerance = values(i)
            exit
         end if
         above = values(i)
      end do
      decision%rank = i - 1
   end function decide_rank
end module flexact_rank
