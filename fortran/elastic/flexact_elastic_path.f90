! SPDX-License-Identifier: BSD-3-Clause
!> From one waypoint to the next in steps that are halved where they do not converge.
module flexact_elastic_path
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_newton, only: attempt_t, take_step, step_done
   use flexact_elastic_state, only: state_t, waypoint_t, between
   use flexact_kinds, only: wp
   implicit none
   private
   public :: path_t, follow

   !> No step is shorter than this part of the way.
   real(wp), parameter :: shortest = 2.0_wp**(-13)
   !> After a step with no more iterations the next one is twice as long.
   integer, parameter :: few_iterations = 8
   integer, parameter :: most_steps = 20000

   !> status: how the last step ended that was tried. reached: part of the way.
   type :: path_t
      integer :: status = step_done, iterations = 0, steps = 0, place = 0
      real(wp) :: reached = 0.0_wp, residual = 0.0_wp
      type(state_t) :: state
   end type path_t

contains

   subroutine follow(elastic, start, begin, end, path)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: start
      type(waypoint_t), intent(in) :: begin, end
      type(path_t), intent(out) :: path
      type(attempt_t) :: attempt
      real(wp) :: length, t

      attempt%state = start
      length = 1.0_wp
      do while (path%reached < 1 .and. path%steps < most_steps)
         t = min(1.0_wp, path%reached + length)
         if (1 - t < shortest/2) t = 1.0_wp
         call take_step(elastic, between(elastic, begin, end, t), attempt)
         path%steps = path%steps + 1
         path%iterations = path%iterations + attempt%iterations
         path%status = attempt%status
         path%place = attempt%place
         path%residual = attempt%left%relative
         if (attempt%status == step_done) then
            path%reached = t
            if (attempt%iterations <= few_iterations) length = 2*length
         else
            length = min(length, t - path%reached)/2
            if (length < shortest) exit
         end if
      end do
      path%state = attempt%state
   end subroutine follow
end module flexact_elastic_path
