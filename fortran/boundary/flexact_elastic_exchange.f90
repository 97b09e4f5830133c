! SPDX-License-Identifier: BSD-3-Clause
!> Elastic analysis as flat arrays: what is given, and what comes back.
!>
!> of_elements: rows 1 to 6 ESTIFF, 7 to 11 EM, 12 to 17 notches; then what a procedure says.
!> of_nodes: rows 1 to 6 XM; then likewise.
module flexact_elastic_exchange
   use flexact_blas, only: blas_work_t, blas_begin, blas_end
   use flexact_elastic_errors, only: errors_t, find_errors
   use flexact_elastic_model, only: elastic_model_t, properties_t, make_elastic_model
   use flexact_elastic_operator, only: operator_t, make_operator
   use flexact_elastic_path, only: path_t, follow
   use flexact_elastic_reduced, only: matrices_t, find_matrices
   use flexact_elastic_response, only: base_t, response_t, make_base, respond
   use flexact_elastic_space, only: expanded
   use flexact_elastic_spectrum, only: modes_t, find_frequencies, find_multipliers
   use flexact_elastic_state, only: state_t, waypoint_t
   use flexact_exchange, only: unpack_model
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   implicit none
   private
   public :: give_stiffness, run_path, run_task, task_names

   character(len=24), parameter :: task_names(*) = &
                                   [character(len=24) :: 'linear', 'frequencies', 'multipliers', 'matrices', 'errors']

contains

   subroutine give_stiffness(nodes, places, elements, vectors, of_elements, stiffness, c_t)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), of_elements(:, :)
      real(wp), intent(out) :: stiffness(:, :, :), c_t(:)
      type(elastic_model_t) :: elastic
      real(wp) :: none(6, size(nodes, 2))

      none = 0.0_wp
      call unpack(nodes, places, elements, vectors, none, of_elements, .true., elastic)
      stiffness = elastic%stiffness
      c_t = elastic%reference%c_t
   end subroutine give_stiffness

   !> free: whether fixed deformations are elastic too.
   subroutine unpack(nodes, places, elements, vectors, of_nodes, of_elements, free, elastic)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), of_nodes(:, :), of_elements(:, :)
      logical, intent(in) :: free
      type(elastic_model_t), intent(out) :: elastic
      type(model_t) :: model
      type(properties_t) :: given

      call unpack_model(nodes, places, elements, vectors, model)
      if (free) model%deformation_class = 0
      ! Assigned one by one: gfortran 12 copies sections wrongly in a constructor.
      given%stiffness = of_elements(:6, :)
      given%mass = of_elements(7:11, :)
      given%notch = of_elements(12:17, :)
      given%node_mass = of_nodes(:6, :)
      call make_elastic_model(model, given, elastic)
   end subroutine unpack

   !> Configuration, reactions and stress as they stand in of_nodes and of_elements.
   pure subroutine take_state(of_nodes, of_elements, state)
      real(wp), intent(in) :: of_nodes(:, :), of_elements(:, :)
      type(state_t), intent(out) :: state

      state%configuration = of_nodes(7:10, :)
      state%reaction = of_nodes(11:13, :)
      state%stress = of_elements(18:23, :)
   end subroutine take_state

   !> of_nodes (7): target and force.
   pure subroutine take_waypoint(of_nodes, misfit, gravity, waypoint)
      real(wp), intent(in) :: of_nodes(:, :), misfit(:, :), gravity(:)
      type(waypoint_t), intent(out) :: waypoint

      waypoint%target = of_nodes(:4, :)
      waypoint%force = reshape(of_nodes(5:7, :), [3*size(of_nodes, 2)])
      waypoint%misfit = misfit
      waypoint%gravity = gravity
   end subroutine take_waypoint

   !> of_nodes: from row 7 configuration (4) and reaction (3) of the start, then target (4) and
   !> force (3) of the beginning and of the end; of_elements: from row 18 stress of the start,
   !> misfits of the beginning and of the end, 6 each. gravity (3, 2). facts: status (-1 where memory does not suffice), part of the
   !> way, iterations, steps, residual, place as of independent coordinates.
   subroutine run_path(nodes, places, elements, vectors, of_nodes, of_elements, gravity, configuration, reaction, stress, facts)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), of_nodes(:, :), of_elements(:, :), gravity(:, :)
      real(wp), intent(out) :: configuration(:, :), reaction(:, :), stress(:, :), facts(:)
      type(elastic_model_t) :: elastic
      type(waypoint_t) :: begin, end
      type(path_t) :: path
      type(state_t) :: state
      type(blas_work_t) :: work

      configuration = of_nodes(7:10, :)
      reaction = of_nodes(11:13, :)
      stress = of_elements(18:23, :)
      facts = -1.0_wp
      if (blas_begin(1, 0.0_wp, work) /= 0) return
      call unpack(nodes, places, elements, vectors, of_nodes, of_elements, .false., elastic)
      call take_waypoint(of_nodes(14:20, :), of_elements(24:29, :), gravity(:, 1), begin)
      call take_waypoint(of_nodes(21:27, :), of_elements(30:35, :), gravity(:, 2), end)
      call take_state(of_nodes, of_elements, state)
      call follow(elastic, state, begin, end, path)
      configuration = path%state%configuration
      reaction = path%state%reaction
      stress = path%state%stress
      facts = [real(path%status, wp), path%reached, real(path%iterations, wp), real(path%steps, wp), path%residual, &
               real(path%place - 1, wp)]
      ! Entries count from 0 and deformations from -1 on.
      if (path%place < 0) facts(6) = path%place
      call blas_end(work)
   end subroutine run_path

   !> At a state: of_nodes from row 7 configuration and reaction, of_elements from row 18 stress.
   !> wishes: task, count, gravity (3). given, answer: columns of force (3 nodes), misfit (6
   !> elements) and shift (3 nodes), of displacement, stress and reaction; modes are
   !> displacements alone, and of matrices given(1, :) has the coordinates and answer(:q, :3q)
   !> three matrices. For errors given(1, 1) has the square, given(2, :) lengths, and the rows of misfits have stresses;
   !> answer(:2, :) the errors below and above zero. Behind answers stand motions without
   !> stiffness, as many as there is room for. values: mismatches, or the values of modes. facts: answers, motions without stiffness,
   !> negative stiffnesses, 1 where coordinates determine all others or
   !> no mode is missing, 1 where the arithmetic fails.
   subroutine run_task(nodes, places, elements, vectors, of_nodes, of_elements, wishes, given, answer, values, facts)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), of_nodes(:, :), of_elements(:, :), wishes(:), given(:, :)
      real(wp), intent(inout) :: answer(:, :), values(:)
      real(wp), intent(out) :: facts(:)
      type(elastic_model_t) :: elastic
      type(state_t) :: state
      type(base_t) :: base
      type(blas_work_t) :: work

      facts = [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]
      if (blas_begin(1, 0.0_wp, work) /= 0) return
      facts(5) = 0.0_wp
      call unpack(nodes, places, elements, vectors, of_nodes, of_elements, .false., elastic)
      call take_state(of_nodes, of_elements, state)
      call make_base(elastic, state, wishes(3:5), base)
      select case (nint(wishes(1)))
      case (1); call run_linear(elastic, base, given, answer, values, facts)
      case (2, 3); call run_modes(elastic, state, base, wishes, answer, values, facts)
      case (4); call run_matrices(elastic, state, wishes(3:5), base, nint(given(1, :)), answer, facts)
      case (5); call run_errors(elastic, state, wishes(3:5), base, given, answer, facts)
      end select
      call blas_end(work)
   end subroutine run_task

   subroutine run_linear(elastic, base, given, answer, values, facts)
      type(elastic_model_t), intent(in) :: elastic
      type(base_t), intent(in) :: base
      real(wp), intent(in) :: given(:, :)
      real(wp), intent(inout) :: answer(:, :), values(:)
      real(wp), intent(inout) :: facts(:)
      type(operator_t) :: op
      type(response_t) :: response
      integer :: i, n, m, many

      n = size(elastic%scale)
      m = 6*elastic%model%elements
      call make_operator(elastic, base%tangent, base%space, .true., op)
      facts(5) = merge(1.0_wp, 0.0_wp, base%space%failed .or. op%failed)
      if (facts(5) > 0) return
      do i = 1, size(given, 2)
         call respond(elastic, base, op, given(:n, i), reshape(given(n + 1:n + m, i), [6, m/6]), given(n + m + 1:, i), response)
         answer(:, i) = [response%displacement, reshape(response%stress, [m]), reshape(response%reaction, [n])]
         values(i) = response%mismatch
      end do
      many = size(op%loose, 2)
      facts(:3) = [size(given, 2), many, op%negative]
      do i = 1, min(many, size(answer, 2) - size(given, 2))
         answer(:n, size(given, 2) + i) = expanded(base%space, elastic, op%loose(:, i))
      end do
   end subroutine run_linear

   subroutine run_modes(elastic, state, base, wishes, answer, values, facts)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      type(base_t), intent(inout) :: base
      real(wp), intent(in) :: wishes(:)
      real(wp), intent(inout) :: answer(:, :), values(:), facts(:)
      type(modes_t) :: modes
      integer :: most, k

      most = min(nint(wishes(2)), size(values))
      if (nint(wishes(1)) == 2) then
         call find_frequencies(elastic, state%configuration, base, most, modes)
      else
         call find_multipliers(elastic, base, most, modes)
      end if
      facts(5) = merge(1.0_wp, 0.0_wp, base%space%failed .or. modes%failed)
      if (facts(5) > 0) return
      k = size(modes%value)
      values(:k) = modes%value
      answer(:size(modes%mode, 1), :k) = modes%mode
      facts(:4) = [k, modes%loose, modes%negative, merge(1, 0, modes%is_complete)]
   end subroutine run_modes

   subroutine run_matrices(elastic, state, gravity, base, independent, answer, facts)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3)
      type(base_t), intent(inout) :: base
      integer, intent(in) :: independent(:)
      real(wp), intent(inout) :: answer(:, :), facts(:)
      type(matrices_t) :: matrices
      integer :: q

      call find_matrices(elastic, state, gravity, base, independent, matrices)
      q = size(independent)
      answer(:q, :q) = matrices%mass
      answer(:q, q + 1:2*q) = matrices%stiffness
      answer(:q, 2*q + 1:3*q) = matrices%geometric
      facts(1) = q
      facts(4) = merge(1.0_wp, 0.0_wp, matrices%is_determined)
   end subroutine run_matrices

   subroutine run_errors(elastic, state, gravity, base, given, answer, facts)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3), given(:, :)
      type(base_t), intent(inout) :: base
      real(wp), intent(inout) :: answer(:, :), facts(:)
      type(errors_t) :: errors
      integer :: first, k

      first = size(elastic%scale)
      k = 6*elastic%model%elements
      call find_errors(elastic, state, gravity, base, given(1, 1), &
                       reshape(given(first + 1:first + k, :), [6, k/6, size(given, 2)]), given(2, :), errors)
      facts(5) = merge(1.0_wp, 0.0_wp, base%space%failed .or. errors%failed)
      if (facts(5) > 0) return
      facts(:3) = [size(given, 2), errors%loose, errors%negative]
      if (errors%negative + errors%loose > 0) return
      answer(1, :size(given, 2)) = errors%below
      answer(2, :size(given, 2)) = errors%above
   end subroutine run_errors
end module flexact_elastic_exchange
