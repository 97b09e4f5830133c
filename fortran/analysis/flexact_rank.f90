!> Which singular values of the scaled matrix count as zero.
module flexact_rank
   use flexact_kinds, only: wp
   use flexact_scaling, only: scaling_t
   implicit none
   private
   public :: rank_t, decide_rank

   !> Zeros that the typed digits have lifted stand this far below the rest.
   real(wp), parameter :: clear_gap = 100.0_wp

   type :: rank_t
      integer :: rank = 0
      !> What computing and rounding in the last bits may make of a zero.
      real(wp) :: noise = 0.0_wp
      !> Singular values up to here were taken for zero: the noise, or more
      !> where the digits of the coordinates account for it; or as was asked.
      real(wp) :: tolerance = 0.0_wp
   end type rank_t

contains

   !> Values descend. Those within the noise are zero. So are those that the
   !> typed digits can account for, where a clear gap parts them from the rest;
   !> without the gap they are what they seem, since digits that were rounded
   !> would have lifted the zeros together. Where a tolerance is given, it alone
   !> decides.
   pure function decide_rank(scaling, values, tolerance) result(decision)
      type(scaling_t), intent(in) :: scaling
      real(wp), intent(in) :: values(:)
      real(wp), intent(in), optional :: tolerance
      type(rank_t) :: decision
      real(wp) :: above
      integer :: i

      decision%noise = scaling%error_of_bits
      if (size(values) > 0) then
         decision%noise = decision%noise + &
                          epsilon(1.0_wp)*max(size(scaling%row), size(scaling%column))*values(1)
      end if
      if (present(tolerance)) then
         decision%tolerance = tolerance
         decision%rank = count(values > tolerance)
         return
      end if
      decision%tolerance = decision%noise
      above = 0.0_wp
      do i = 1, size(values)
         if (values(i) <= decision%noise) exit
         if (values(i) <= scaling%error_of_digits .and. clear_gap*values(i) < above) then
            decision%tolerance = values(i)
            exit
         end if
         above = values(i)
      end do
      decision%rank = i - 1
   end function decide_rank
end module flexact_rank
