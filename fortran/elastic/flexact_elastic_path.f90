! SPDX-License-Identifier: BSD-3-Clause
!> From one waypoint to the next in steps that are halved where they do not converge, or where
!> they lead elsewhere than the tangents at both of their ends say: then a limit of the load or
!> a snap lies between.
module flexact_elastic_path
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_newton, only: newton_t, find_increment, advance, settle, extent, step_done, step_diverges
   use flexact_elastic_state, only: state_t, waypoint_t, between, increment_between
   use flexact_kinds, only: wp
   implicit none
   private
   public :: path_t, follow

   !> No step is shorter than this part of the way, and there are no more.
   real(wp), parameter :: shortest = 2.0_wp**(-14)
   integer, parameter :: most_steps = 20000
   !> In longer steps the number of negative stiffnesses stays, and they take no more iterations:
   !> else there may be another branch in between.
   real(wp), parameter :: short = 2.0_wp**(-6)
   integer, parameter :: most_plain_iterations = 9
   !> After a step with no more iterations the next one is twice as long.
   integer, parameter :: few_iterations = 10
   integer, parameter :: most_iterations = 25
   !> What the next correction may be expected to be where it is rounding; corrections that may
   !> have come to rest there; beyond which nothing is expected any more.
   real(wp), parameter :: tiny_correction = 1.0e-14_wp, small_correction = 1.0e-8_wp, wild_correction = 1.0e3_wp
   !> How much of a step may differ from what the tangent says at either end, and what is too
   !> small to be judged.
   real(wp), parameter :: most_difference = 0.5_wp, least_step = 1.0e-6_wp

   !> status, residual and place are those of the last step that was tried.
   type :: path_t
      integer :: status = step_done, iterations = 0, steps = 0, place = 1
      real(wp) :: reached = 0.0_wp, residual = 0.0_wp
      type(state_t) :: state
   end type path_t

contains

   subroutine follow(elastic, start, begin, end, path)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: start
      type(waypoint_t), intent(in) :: begin, end
      type(path_t), intent(out) :: path
      type(newton_t) :: newton
      type(waypoint_t) :: last, goal
      real(wp) :: length, t
      integer :: iterations

      path%state = start
      where (.not. reshape(elastic%is_held .or. elastic%is_component, shape(start%reaction))) path%state%reaction = 0.0_wp
      last = begin
      length = 1.0_wp
      do while (path%reached < 1 .and. path%steps < most_steps)
         t = min(1.0_wp, path%reached + length)
         if (1 - t < shortest/2) t = 1.0_wp
         goal = between(elastic, begin, end, t)
         newton%state = path%state
         call take_step(elastic, last, goal, t - path%reached <= short, newton, iterations)
         path%steps = path%steps + 1
         path%iterations = path%iterations + iterations
         path%status = newton%status
         path%place = newton%place
         path%residual = newton%left%relative
         if (newton%status == step_done) then
            path%state = newton%state
            path%reached = t
            last = goal
            if (iterations <= few_iterations) length = 2*length
         else
            length = (t - path%reached)/2
            if (length < shortest) exit
         end if
      end do
   end subroutine follow

   !> From a state in equilibrium at one place to that at another. is_short: whether the number of
   !> negative stiffnesses may change.
   subroutine take_step(elastic, from, goal, is_short, newton, iterations)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: from, goal
      logical, intent(in) :: is_short
      type(newton_t), intent(inout) :: newton
      integer, intent(out) :: iterations
      real(wp), dimension(size(elastic%scale)) :: increment, first, last, whole
      real(wp) :: far, before
      real(wp), allocatable :: start(:, :)
      logical :: failed, at_rest, is_other
      integer :: negative

      start = newton%state%configuration
      newton%status = step_diverges
      before = wild_correction
      do iterations = 1, most_iterations
         call find_increment(elastic, goal, .true., newton, increment, failed)
         if (failed) return
         far = extent(elastic, increment)
         if (.not. far < wild_correction) return
         if (iterations == 1) then
            first = increment
            negative = newton%op%negative
         end if
         call advance(elastic, goal, increment, newton)
         at_rest = far <= small_correction .and. far > before/4
         if (far*min(1.0_wp, far/before) <= tiny_correction .or. at_rest) then
            call find_increment(elastic, from, .false., newton, last, failed)
            call settle(elastic, goal, newton)
            if (newton%status /= step_diverges .or. far > 0.9_wp*before) exit
         end if
         before = far
      end do
      whole = increment_between(elastic, start, newton%state%configuration)
      if (newton%status /= step_done .or. extent(elastic, whole) < least_step) return
      is_other = differ(elastic, whole, first) .or. differ(elastic, whole, -last)
      if (.not. is_short) is_other = is_other .or. newton%op%negative /= negative .or. iterations > most_plain_iterations
      if (is_other) newton%status = step_diverges
   end subroutine take_step

   pure logical function differ(elastic, whole, predicted)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: whole(:), predicted(:)

      differ = extent(elastic, whole - predicted) > most_difference*extent(elastic, whole)
   end function differ
end module flexact_elastic_path
