! SPDX-License-Identifier: BSD-3-Clause
!> Increments at a state under small loads, misfits and moves of supports.
module flexact_elastic_response
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_operator, only: operator_t, solved
   use flexact_elastic_products, only: strains, stiffness_times, forces, hessian_times
   use flexact_elastic_rows, only: rows_t, make_rows, rows_times, values_at_rows, keep_multipliers
   use flexact_elastic_space, only: space_t, make_space, reduced, expanded, answer, multipliers_of
   use flexact_elastic_state, only: state_t
   use flexact_elastic_tangent, only: tangent_t, make_tangent, add_hessian
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: base_t, response_t, make_base, respond

   !> A solution is refined with the elements' own products until corrections are that small, and
   !> no more often than that.
   real(wp), parameter :: small_correction = 1.0e-12_wp
   integer, parameter :: most_solutions = 5

   !> A state, linearised.
   type :: base_t
      type(tangent_t) :: tangent
      type(rows_t) :: rows
      type(space_t) :: space
   end type base_t

   !> An answer: displacements and spins (3 nodes), stress (6, elements), reactions (3, nodes),
   !> and the relative part of what was asked of rigid rows that they do not follow.
   type :: response_t
      real(wp), allocatable :: displacement(:), stress(:, :), reaction(:, :)
      real(wp) :: mismatch = 0.0_wp
   end type response_t

contains

   subroutine make_base(elastic, state, gravity, base)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3)
      type(base_t), intent(out) :: base

      call make_tangent(elastic, state%configuration, gravity, base%tangent)
      call add_hessian(elastic, state, gravity, base%tangent)
      call make_rows(elastic, state%configuration, base%tangent, base%rows)
      call make_space(elastic, base%rows, base%space)
   end subroutine make_base

   !> force (3 nodes), misfit (6, elements); shift (3 nodes): displacements and spins of supports,
   !> twice the change of a single component of an orientation.
   subroutine respond(elastic, base, op, force, misfit, shift, response)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      type(operator_t), intent(in) :: op
      real(wp), intent(in) :: force(:), misfit(:, :), shift(:)
      type(response_t), intent(out) :: response
      real(wp), allocatable :: left(:), c(:), m(:), y(:, :)
      real(wp) :: follow(size(shift))
      logical :: is_fine
      integer :: i

      is_fine = .false.
      allocate (response%displacement(size(shift)))
      associate (v => response%displacement)
         v = shift
         where (.not. elastic%is_held) v = 0.0_wp
         c = values_at_rows(base%rows, misfit, shift)
         call answer(base%space, elastic, c - rows_times(base%rows, v), follow, response%mismatch)
         v = v + follow
         allocate (y(base%space%motions, 1))
         do i = 0, most_solutions
            response%stress = stiffness_times(elastic, strains(elastic, base%tangent, v) - misfit)
            left = force - forces(elastic, base%tangent, response%stress) - hessian_times(elastic, base%tangent, v)
            if (i == most_solutions .or. is_fine) exit
            y(:, 1) = reduced(base%space, elastic, left)
            call solved(base%space, op, y)
            follow = expanded(base%space, elastic, y(:, 1))
            v = v + follow
            is_fine = norm2(elastic%scale*follow) <= small_correction*norm2(elastic%scale*v)
         end do
         m = multipliers_of(base%space, elastic, left)
         allocate (response%reaction(axes, elastic%model%nodes), source=0.0_wp)
         call keep_multipliers(base%rows, m, response%stress, response%reaction)
         left = force - forces(elastic, base%tangent, response%stress) - hessian_times(elastic, base%tangent, v)
         do i = 1, size(left)
            if (elastic%is_held(i)) response%reaction(i - axes*((i - 1)/axes), (i + 2)/axes) = -left(i)
         end do
      end associate
   end subroutine respond
end module flexact_elastic_response
