! SPDX-License-Identifier: BSD-3-Clause
!> One step from an equilibrium to the next, by Newton's method with the stress as an unknown
!> of its own: second derivatives are taken under the stress that the last iteration predicts
!> to first order, so that a step begins with those of the last equilibrium, and the spurious
!> elongation of a thin sheet that was turned along its tangent does no harm.
module flexact_elastic_newton
   use flexact_elastic_model, only: elastic_model_t, gathered
   use flexact_elastic_operator, only: operator_t, make_operator, solved
   use flexact_elastic_residual, only: left_t, balance
   use flexact_elastic_rows, only: rows_t, make_rows, rows_times, errors_of, keep_multipliers
   use flexact_elastic_space, only: space_t, make_space, reduced, expanded, answer, multipliers_of
   use flexact_elastic_state, only: state_t, waypoint_t, moved, increment_between
   use flexact_elastic_tangent, only: tangent_t, make_tangent, add_hessian, strains, stiffness_times, forces, hessian_times
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: attempt_t, take_step
   public :: step_done, step_diverges, step_inconsistent, step_unheld, step_names

   !> How an attempt ends: in equilibrium; without having converged, or far away; where rigid
   !> parts cannot be where they should; with a load on a motion without stiffness.
   integer, parameter :: step_done = 0, step_diverges = 1, step_inconsistent = 2, step_unheld = 3
   character(len=24), parameter :: step_names(0:3) = [character(len=24) :: 'done', 'diverges', 'inconsistent', 'unheld']

   !> The largest turn of an iteration [rad].
   real(wp), parameter :: most_turn = 0.35_wp
   integer, parameter :: most_iterations = 30
   !> Corrections that are near rounding, and those that may have come to rest at it.
   real(wp), parameter :: tiny_correction = 1.0e-13_wp, small_correction = 1.0e-8_wp
   !> What rigid parts may be off, of the length of elements and of their distance.
   real(wp), parameter :: most_error = 1.0e-11_wp

   type :: attempt_t
      integer :: status = step_done, iterations = 0
      type(left_t) :: left
      !> Where most is left: an entry of a vector, or minus (6 (element - 1) + deformation) of a
      !> rigid deformation.
      integer :: place = 0
      type(state_t) :: state
      type(tangent_t) :: tangent
      type(rows_t) :: rows
      type(space_t) :: space
      type(operator_t) :: op
   end type attempt_t

contains

   !> From a state in equilibrium to what is given; the state stays where this fails.
   subroutine take_step(elastic, goal, attempt)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(attempt_t), intent(inout) :: attempt
      type(state_t) :: before
      real(wp) :: size_now, size_before, first, total
      integer :: i

      before = attempt%state
      attempt%status = step_diverges
      size_before = huge(1.0_wp)
      first = -1.0_wp
      do i = 1, most_iterations
         attempt%iterations = i
         call iterate(elastic, goal, attempt, size_now)
         if (.not. size_now < 1.0e3_wp) exit
         if (first < 0) first = size_now
         if (size_now <= tiny_correction .or. (size_now <= small_correction .and. size_now > size_before/4)) then
            attempt%status = step_done
            exit
         end if
         size_before = size_now
      end do
      if (attempt%status == step_done) call settle(elastic, goal, attempt)
      if (attempt%status == step_done) then
         total = extent(elastic, increment_between(elastic, before%configuration, attempt%state%configuration))
         if (total > 3*min(first, most_turn) + 0.02_wp) attempt%status = step_diverges
      end if
      if (attempt%status /= step_done) attempt%state = before
   end subroutine take_step

   !> One iteration; extent: how far it wanted to go.
   subroutine iterate(elastic, goal, attempt, far)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(attempt_t), intent(inout) :: attempt
      real(wp), intent(out) :: far
      real(wp), allocatable :: step(:), stress(:, :), left(:), c(:), y(:, :)
      real(wp) :: part, wrong, follow(size(elastic%scale))
      type(state_t) :: next
      integer :: i

      associate (tangent => attempt%tangent, space => attempt%space, rows => attempt%rows, state => attempt%state)
         call make_tangent(elastic, state%configuration, goal%gravity, tangent)
         call add_hessian(elastic, state, goal%gravity, tangent)
         call make_rows(elastic, state%configuration, tangent, rows)
         step = increment_between(elastic, state%configuration, goal%target)
         where (.not. elastic%is_held) step = 0.0_wp
         c = errors_of(rows, tangent, state%configuration, goal%misfit, goal%target) + rows_times(rows, step)
         call make_space(elastic, rows, space)
         call make_operator(elastic, tangent, space, .true., attempt%op)
         far = huge(far)
         if (space%failed .or. attempt%op%failed) return
         call answer(space, elastic, c, follow, wrong)
         step = step - follow
         allocate (y(space%motions, 1))
         do i = 1, 2
            stress = stiffness_times(elastic, tangent%deformation - goal%misfit + strains(elastic, tangent, step))
            left = goal%force + tangent%weight - forces(elastic, tangent, stress) - hessian_times(elastic, tangent, step)
            y(:, 1) = reduced(space, elastic, left)
            call solved(space, attempt%op, y)
            step = step + expanded(space, elastic, y(:, 1))
         end do
         far = extent(elastic, step)
         if (.not. far < huge(far)) return
         part = min(1.0_wp, most_turn/max(far, tiny(far)))
         next = state
         next%stress = stiffness_times(elastic, tangent%deformation - goal%misfit + strains(elastic, tangent, step))
         left = goal%force + tangent%weight - forces(elastic, tangent, next%stress) - hessian_times(elastic, tangent, step)
         call keep_multipliers(rows, multipliers_of(space, elastic, left), next%stress, next%reaction)
         call moved(elastic, part*step, state%configuration)
         if (part >= 1) call put_supports(elastic, goal%target, state%configuration)
         state%stress = state%stress + part*(next%stress - state%stress)
         state%reaction = state%reaction + part*(next%reaction - state%reaction)
      end associate
   end subroutine iterate

   !> Stresses and reactions where iterations have ended, and whether all is in equilibrium.
   subroutine settle(elastic, goal, attempt)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(attempt_t), intent(inout) :: attempt
      real(wp), allocatable :: c(:)
      real(wp) :: most
      integer :: r

      associate (tangent => attempt%tangent, space => attempt%space, rows => attempt%rows, state => attempt%state)
         call make_tangent(elastic, state%configuration, goal%gravity, tangent)
         call make_rows(elastic, state%configuration, tangent, rows)
         call make_space(elastic, rows, space)
         state%stress = stiffness_times(elastic, tangent%deformation - goal%misfit)
         call balance(elastic, tangent, rows, space, goal%force + tangent%weight, state, attempt%left)
         attempt%place = attempt%left%place
         if (.not. attempt%left%is_balanced) then
            attempt%status = merge(step_unheld, step_diverges, size(attempt%op%loose, 2) > 0)
            return
         end if
         c = errors_of(rows, tangent, state%configuration, goal%misfit, goal%target)
         most = most_error*(elastic%length + maxval(abs(state%configuration)))
         if (all(abs(c) <= most)) return
         r = maxloc(abs(c), 1)
         attempt%status = step_inconsistent
         attempt%place = rows%owner(2, r)
         if (rows%owner(1, r) > 0) attempt%place = -(6*(rows%owner(1, r) - 1) + rows%owner(2, r))
      end associate
   end subroutine settle

   !> Where an increment has come to its end, supports are exactly at their targets.
   pure subroutine put_supports(elastic, target, configuration)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: target(:, :)
      real(wp), intent(inout) :: configuration(:, :)
      integer :: node, axis

      do node = 1, elastic%model%nodes
         if (elastic%is_turn(axes*node)) then
            if (elastic%is_held(axes*node)) configuration(:, node) = target(:, node)
            cycle
         end if
         do axis = 1, axes
            if (elastic%is_held(axes*(node - 1) + axis)) configuration(axis, node) = target(axis, node)
         end do
      end do
   end subroutine put_supports

   !> The largest turn of a node or, relative to its length, of an element.
   pure real(wp) function extent(elastic, v) result(most)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: v(:)
      real(wp) :: part(12)
      integer :: k

      most = 0.0_wp
      do k = 1, elastic%model%elements
         part = gathered(elastic%entry(:, k), v)
         most = max(most, maxval(abs(part([4, 5, 6, 10, 11, 12]))))
         if (elastic%reference(k)%length > 0) &
            most = max(most, norm2(part(7:9) - part(1:3))/elastic%reference(k)%length)
         if (.not. all(abs(part) <= huge(most))) most = huge(most)
      end do
   end function extent
end module flexact_elastic_newton
