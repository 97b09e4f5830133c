! SPDX-License-Identifier: BSD-3-Clause
!> Newton's method with the stress as an unknown of its own: second derivatives are taken under
!> the stress that the last iteration predicts to first order, so that a step begins with those
!> of the last equilibrium, and the spurious elongation of a thin sheet that was turned along its
!> tangent does no harm.
module flexact_elastic_newton
   use flexact_elastic_model, only: elastic_model_t, gathered
   use flexact_elastic_operator, only: operator_t, make_operator, solved
   use flexact_elastic_products, only: strains, stiffness_times, forces, hessian_times
   use flexact_elastic_residual, only: left_t, balance
   use flexact_elastic_rows, only: rows_t, make_rows, rows_times, errors_of, keep_multipliers
   use flexact_elastic_space, only: space_t, make_space, reduced, expanded, answer, multipliers_of
   use flexact_elastic_state, only: state_t, waypoint_t, moved, put_supports, increment_between
   use flexact_elastic_tangent, only: tangent_t, make_tangent, add_hessian
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   use flexact_vectors, only: cross
   implicit none
   private
   public :: newton_t, find_increment, advance, settle, extent
   public :: step_done, step_diverges, step_inconsistent, step_unheld, step_names

   !> How iterations end: in equilibrium; without having converged, or far away; where rigid parts
   !> cannot be where they should; with a load on a motion without stiffness.
   integer, parameter :: step_done = 0, step_diverges = 1, step_inconsistent = 2, step_unheld = 3
   character(len=24), parameter :: step_names(0:3) = [character(len=24) :: 'done', 'diverges', 'inconsistent', 'unheld']

   !> The largest turn of an iteration [rad].
   real(wp), parameter :: most_turn = 0.35_wp
   !> What rigid parts may be off, of the length of elements and of their distance.
   real(wp), parameter :: most_error = 1.0e-11_wp
   !> Solutions for moments that turn, until they change by no more than this part.
   integer, parameter :: most_rounds = 40
   real(wp), parameter :: enough = 1.0e-8_wp

   !> A state on its way to equilibrium, with all that is at hand there.
   type :: newton_t
      integer :: status = step_done
      type(left_t) :: left
      !> Where most is left: an entry of a vector, or minus (6 (element - 1) + deformation) of a
      !> rigid deformation.
      integer :: place = 1
      type(state_t) :: state
      type(tangent_t) :: tangent
      type(rows_t) :: rows
      type(space_t) :: space
      type(operator_t) :: op
   end type newton_t

contains

   !> What leads to a goal by the tangent of the state. is_new: whether the tangent is to be
   !> factorised, or that of the last call will do, which was at the same place but for rounding. failed: it cannot be.
   subroutine find_increment(elastic, goal, is_new, newton, increment, failed)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      logical, intent(in) :: is_new
      type(newton_t), intent(inout) :: newton
      real(wp), intent(out) :: increment(:)
      logical, intent(out) :: failed
      real(wp) :: follow(size(increment)), unused
      real(wp), allocatable :: y(:, :)

      associate (state => newton%state, tangent => newton%tangent, rows => newton%rows, space => newton%space)
         call make_tangent(elastic, state%configuration, goal%gravity, tangent)
         call add_hessian(elastic, state, goal%gravity, tangent)
         call make_rows(elastic, state%configuration, tangent, rows)
         if (is_new) call make_space(elastic, rows, space)
         if (is_new) call make_operator(elastic, tangent, space, .true., newton%op)
         failed = space%failed .or. newton%op%failed
         if (failed) return
         increment = increment_between(elastic, state%configuration, goal%target)
         where (.not. elastic%is_held) increment = 0.0_wp
         call answer(space, elastic, errors_of(rows, tangent, state%configuration, goal%misfit, goal%target) &
                     + rows_times(rows, increment), follow, unused)
         increment = increment - follow
         allocate (y(space%motions, 1))
         y(:, 1) = reduced(space, elastic, forces_left(elastic, goal, tangent, increment))
         call solved(space, newton%op, y)
         increment = increment + expanded(space, elastic, y(:, 1))
         call turn_moments(elastic, goal%force, space, newton%op, increment)
      end associate
   end subroutine find_increment

   !> What moments add to an increment: those that stay as they are while a node turns by w make
   !> the derivative of the balance unsymmetric, by w x moment/2, since a spin behind another one
   !> is w + v + v x w/2 together. Found by solving again with the symmetric tangent.
   subroutine turn_moments(elastic, force, space, op, increment)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: force(:)
      type(space_t), intent(in) :: space
      type(operator_t), intent(in) :: op
      real(wp), intent(inout) :: increment(:)
      real(wp) :: first(size(increment)), next(size(increment)), moment(size(increment)), y(space%motions, 1), change, before
      integer :: round, node

      if (.not. any(elastic%is_turn .and. elastic%is_free .and. abs(force) > 0)) return
      first = increment
      before = huge(before)
      do round = 1, most_rounds
         moment = 0.0_wp
         do node = axes, size(increment), axes
            if (elastic%is_turn(node)) &
               moment(node - 2:node) = -cross(increment(node - 2:node), force(node - 2:node))/2
         end do
         y(:, 1) = reduced(space, elastic, moment)
         call solved(space, op, y)
         next = first + expanded(space, elastic, y(:, 1))
         change = norm2(elastic%scale*(next - increment))
         if (.not. change < before) exit
         increment = next
         if (change <= enough*norm2(elastic%scale*next)) return
         before = change
      end do
   end subroutine turn_moments

   !> Loads less the stresses after an increment, to first order.
   function forces_left(elastic, goal, tangent, increment) result(left)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: increment(:)
      real(wp) :: left(size(increment))

      left = goal%force + tangent%weight - hessian_times(elastic, tangent, increment) &
             - forces(elastic, tangent, stress_after(elastic, goal, tangent, increment))
   end function forces_left

   function stress_after(elastic, goal, tangent, increment) result(stress)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(tangent_t), intent(in) :: tangent
      real(wp), intent(in) :: increment(:)
      real(wp) :: stress(6, elastic%model%elements)

      stress = stiffness_times(elastic, tangent%deformation - goal%misfit + strains(elastic, tangent, increment))
   end function stress_after

   !> Go as far along an increment as turns are small, with stresses to first order.
   subroutine advance(elastic, goal, increment, newton)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      real(wp), intent(in) :: increment(:)
      type(newton_t), intent(inout) :: newton
      real(wp) :: part, stress(6, elastic%model%elements), reaction(3, elastic%model%nodes)

      associate (state => newton%state)
         part = min(1.0_wp, most_turn/max(extent(elastic, increment), tiny(part)))
         stress = stress_after(elastic, goal, newton%tangent, increment)
         reaction = state%reaction
         call keep_multipliers(newton%rows, multipliers_of(newton%space, elastic, &
                                                           forces_left(elastic, goal, newton%tangent, increment)), &
                               stress, reaction)
         call moved(elastic, part*increment, state%configuration)
         if (part >= 1) call put_supports(elastic, goal%target, state%configuration)
         state%stress = state%stress + part*(stress - state%stress)
         state%reaction = state%reaction + part*(reaction - state%reaction)
      end associate
   end subroutine advance

   !> Stresses and reactions where iterations have ended, and whether all is in equilibrium.
   subroutine settle(elastic, goal, newton)
      type(elastic_model_t), intent(in) :: elastic
      type(waypoint_t), intent(in) :: goal
      type(newton_t), intent(inout) :: newton
      real(wp), allocatable :: c(:)
      integer :: r

      associate (tangent => newton%tangent, rows => newton%rows, state => newton%state)
         call make_tangent(elastic, state%configuration, goal%gravity, tangent)
         call make_rows(elastic, state%configuration, tangent, rows)
         call make_space(elastic, rows, newton%space)
         state%stress = stiffness_times(elastic, tangent%deformation - goal%misfit)
         call balance(elastic, tangent, rows, newton%space, goal%force + tangent%weight, state, newton%left)
         newton%place = newton%left%place
         if (.not. newton%left%is_balanced) then
            newton%status = merge(step_unheld, step_diverges, size(newton%op%loose, 2) > 0)
            return
         end if
         c = errors_of(rows, tangent, state%configuration, goal%misfit, goal%target)
         newton%status = step_done
         if (all(abs(c) <= most_error*(elastic%length + maxval(abs(state%configuration))))) return
         r = maxloc(abs(c), 1)
         newton%status = step_inconsistent
         newton%place = rows%owner(2, r)
         if (rows%owner(1, r) > 0) newton%place = -(6*(rows%owner(1, r) - 1) + rows%owner(2, r))
      end associate
   end subroutine settle

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
