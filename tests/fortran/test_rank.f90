! SPDX-License-Identifier: BSD-3-Clause
!> Which singular values count as zero: noise, typed digits, the gap, and what
!> was asked.
program test_rank
   use flexact_kinds, only: wp
   use flexact_rank, only: rank_rule_t, rank_t, decide_rank
   use flexact_testing, only: tally_t
   implicit none
   type(tally_t) :: tally

   call noise_is_zero()
   call lifted_zeros_need_a_gap()
   call a_tolerance_decides_alone()
   call nothing_to_decide()
   call tally%finish()

contains

   subroutine noise_is_zero()
      type(rank_t) :: decision

      decision = decide_rank(rule_of(1.0e-14_wp, 0.0_wp), [1.0_wp, 1.0e-9_wp, 1.0e-15_wp])
      call tally%check(decision%rank == 2, 'a value within the noise is zero, one above is not')
      call tally%near([decision%tolerance], [decision%noise], 0.0_wp, 'the noise is the limit')
   end subroutine noise_is_zero

   subroutine lifted_zeros_need_a_gap()
      type(rank_rule_t) :: rule
      type(rank_t) :: decision

      rule = rule_of(1.0e-14_wp, 1.0e-3_wp)
      decision = decide_rank(rule, [1.0_wp, 5.0e-4_wp, 1.0e-4_wp, 3.0e-5_wp, 1.0e-16_wp])
      call tally%check(decision%rank == 1, 'all within reach of the digits, below a clear gap')
      decision = decide_rank(rule, [1.0_wp, 0.02_wp, 5.0e-4_wp, 3.0e-4_wp, 1.0e-16_wp])
      call tally%check(decision%rank == 4, 'without a gap they are what they seem')
      decision = decide_rank(rule, [1.0_wp, 5.0e-4_wp, 3.0e-7_wp])
      call tally%check(decision%rank == 1 .and. decision%tolerance >= 5.0e-4_wp, 'the first gap from above counts')
      decision = decide_rank(rule, [1.0_wp, 2.0e-3_wp, 1.0e-4_wp, 1.0e-7_wp])
      call tally%check(decision%rank == 3, 'a value that the gap leaves above is not zero')
   end subroutine lifted_zeros_need_a_gap

   subroutine a_tolerance_decides_alone()
      real(wp), parameter :: values(4) = [1.0_wp, 1.0e-3_wp, 1.0e-15_wp, 0.0_wp]
      type(rank_t) :: decision

      decision = decide_rank(rule_of(1.0e-14_wp, 0.1_wp, 1.0e-3_wp), values)
      call tally%check(decision%rank == 1, 'a value as large as the tolerance is zero')
      call tally%near([decision%tolerance], [1.0e-3_wp], 0.0_wp, 'the tolerance that was asked')
      decision = decide_rank(rule_of(1.0e-14_wp, 0.1_wp, 0.0_wp), values)
      call tally%check(decision%rank == 3, 'noise counts where zero was asked')
      call tally%check(decision%noise > 1.0e-15_wp, 'the noise is reported all the same')
   end subroutine a_tolerance_decides_alone

   subroutine nothing_to_decide()
      type(rank_t) :: decision
      real(wp) :: none(0)

      decision = decide_rank(rule_of(0.0_wp, 0.0_wp), none)
      call tally%check(decision%rank == 0, 'no values')
      decision = decide_rank(rule_of(0.0_wp, 0.0_wp), [0.0_wp, 0.0_wp])
      call tally%check(decision%rank == 0, 'all zero')
   end subroutine nothing_to_decide

   function rule_of(bits, digits, tolerance) result(rule)
      real(wp), intent(in) :: bits, digits
      real(wp), intent(in), optional :: tolerance
      type(rank_rule_t) :: rule

      rule%side = 5
      rule%error_of_bits = bits
      rule%error_of_digits = digits
      if (present(tolerance)) rule%tolerance = tolerance
   end function rule_of
end program test_rank
