! SPDX-License-Identifier: BSD-3-Clause
!> Elastic analysis as flat arrays, which bindings.f90 explains: what is given, and what comes back.
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
   public :: study_t, begin_study, end_study
   public :: give_stiffness, give_path, give_response, give_modes, give_matrices, give_errors

   !> An elastic model in a state, between begin_study and end_study.
   type :: study_t
      private
      !> Where memory does not suffice nothing is ready.
      logical :: is_ready = .false.
      type(elastic_model_t) :: elastic
      type(state_t) :: state
      type(blas_work_t) :: work
   end type study_t

contains

   subroutine begin_study(nodes, places, elements, vectors, stiffness, mass, notch, node_mass, configuration, stress, reaction, &
                          study)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), stiffness(:, :), mass(:, :), notch(:, :), node_mass(:, :)
      real(wp), intent(in) :: configuration(:, :), stress(:, :), reaction(:, :)
      type(study_t), intent(out) :: study
      type(model_t) :: model
      type(properties_t) :: given

      study%is_ready = blas_begin(1, 0.0_wp, study%work) == 0
      if (.not. study%is_ready) return
      call unpack_model(nodes, places, elements, vectors, model)
      ! Assigned one by one: gfortran 12 copies sections wrongly in a constructor.
      given%stiffness = stiffness
      given%mass = mass
      given%notch = notch
      given%node_mass = node_mass
      call make_elastic_model(model, given, study%elastic)
      study%state%configuration = configuration
      study%state%stress = stress
      study%state%reaction = reaction
   end subroutine begin_study

   subroutine end_study(study)
      type(study_t), intent(inout) :: study
      if (study%is_ready) call blas_end(study%work)
   end subroutine end_study

   !> Fixed deformations count as elastic here.
   subroutine give_stiffness(nodes, places, elements, vectors, stiffness, notch, element_stiffness, c_t)
      integer, intent(in) :: nodes(:, :), elements(:, :)
      real(wp), intent(in) :: places(:, :), vectors(:, :), stiffness(:, :), notch(:, :)
      real(wp), intent(out) :: element_stiffness(:, :, :), c_t(:)
      type(model_t) :: model
      type(properties_t) :: given
      type(elastic_model_t) :: elastic

      call unpack_model(nodes, places, elements, vectors, model)
      model%deformation_class = 0
      given%stiffness = stiffness
      given%notch = notch
      allocate (given%mass(5, model%elements), given%node_mass(6, model%nodes), source=0.0_wp)
      call make_elastic_model(model, given, elastic)
      element_stiffness = elastic%stiffness
      c_t = elastic%reference%c_t
   end subroutine give_stiffness

   subroutine give_path(study, target, misfit, force, gravity, configuration, stress, reaction, status, reached, iterations, &
                        steps, residual, place)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: target(:, :, :), misfit(:, :, :), force(:, :, :), gravity(:, :)
      real(wp), intent(inout) :: configuration(:, :), stress(:, :), reaction(:, :)
      integer, intent(out) :: status, iterations, steps, place
      real(wp), intent(out) :: reached, residual
      type(waypoint_t) :: waypoint(2)
      type(path_t) :: path
      integer :: i

      status = -1
      iterations = 0
      steps = 0
      place = 0
      reached = 0
      residual = 0
      if (.not. study%is_ready) return
      do i = 1, 2
         waypoint(i)%target = target(:, :, i)
         waypoint(i)%force = reshape(force(:, :, i), [size(force(:, :, i))])
         waypoint(i)%misfit = misfit(:, :, i)
         waypoint(i)%gravity = gravity(:, i)
      end do
      call follow(study%elastic, study%state, waypoint(1), waypoint(2), path)
      configuration = path%state%configuration
      stress = path%state%stress
      reaction = path%state%reaction
      status = path%status
      reached = path%reached
      iterations = path%iterations
      steps = path%steps
      residual = path%residual
      ! Entries count from 0 and deformations from -1 on.
      place = merge(path%place, path%place - 1, path%place < 0)
   end subroutine give_path

   subroutine give_response(study, gravity, force, misfit, shift, displacement, stress, reaction, mismatch, loose, unheld, &
                            negative, failed)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: gravity(:), force(:, :, :), misfit(:, :, :), shift(:, :, :)
      real(wp), intent(out) :: displacement(:, :, :), stress(:, :, :), reaction(:, :, :), mismatch(:), loose(:, :, :)
      integer, intent(out) :: unheld, negative, failed
      type(base_t) :: base
      type(operator_t) :: op
      type(response_t) :: response
      integer :: i, n

      displacement = 0
      stress = 0
      reaction = 0
      mismatch = 0
      loose = 0
      unheld = 0
      negative = 0
      failed = 1
      if (.not. study%is_ready) return
      associate (elastic => study%elastic)
         call make_base(elastic, study%state, gravity, base)
         call make_operator(elastic, base%tangent, base%space, .true., op)
         if (base%space%failed .or. op%failed) return
         failed = 0
         n = size(elastic%scale)
         do i = 1, size(mismatch)
            call respond(elastic, base, op, reshape(force(:, :, i), [n]), misfit(:, :, i), reshape(shift(:, :, i), [n]), response)
            displacement(:, :, i) = reshape(response%displacement, [3, n/3])
            stress(:, :, i) = response%stress
            reaction(:, :, i) = reshape(response%reaction, [3, n/3])
            mismatch(i) = response%mismatch
         end do
         unheld = size(op%loose, 2)
         negative = op%negative
         do i = 1, min(unheld, size(loose, 3))
            loose(:, :, i) = reshape(expanded(base%space, elastic, op%loose(:, i)), [3, n/3])
         end do
      end associate
   end subroutine give_response

   subroutine give_modes(study, gravity, of_buckling, value, mode, found, unheld, negative, complete, failed)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: gravity(:)
      logical, intent(in) :: of_buckling
      real(wp), intent(out) :: value(:), mode(:, :, :)
      integer, intent(out) :: found, unheld, negative, complete, failed
      type(base_t) :: base
      type(modes_t) :: modes

      value = 0
      mode = 0
      found = 0
      unheld = 0
      negative = 0
      complete = 0
      failed = 1
      if (.not. study%is_ready) return
      call make_base(study%elastic, study%state, gravity, base)
      if (of_buckling) then
         call find_multipliers(study%elastic, base, size(value), modes)
      else
         call find_frequencies(study%elastic, study%state%configuration, base, size(value), modes)
      end if
      if (base%space%failed .or. modes%failed) return
      failed = 0
      found = size(modes%value)
      value(:found) = modes%value
      mode(:, :, :found) = reshape(modes%mode, [3, size(mode, 2), found])
      unheld = modes%loose
      negative = modes%negative
      complete = merge(1, 0, modes%is_complete)
   end subroutine give_modes

   subroutine give_matrices(study, gravity, independent, mass, stiffness, geometric, determined, failed)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: gravity(:)
      integer, intent(in) :: independent(:)
      real(wp), intent(out) :: mass(:, :), stiffness(:, :), geometric(:, :)
      integer, intent(out) :: determined, failed
      type(base_t) :: base
      type(matrices_t) :: matrices

      mass = 0
      stiffness = 0
      geometric = 0
      determined = 0
      failed = 1
      if (.not. study%is_ready) return
      failed = 0
      call make_base(study%elastic, study%state, gravity, base)
      call find_matrices(study%elastic, study%state, gravity, base, independent, matrices)
      mass = matrices%mass
      stiffness = matrices%stiffness
      geometric = matrices%geometric
      determined = merge(1, 0, matrices%is_determined)
   end subroutine give_matrices

   subroutine give_errors(study, gravity, square, stress, length, below, above, unheld, negative, failed)
      type(study_t), intent(in) :: study
      real(wp), intent(in) :: gravity(:), square(:), stress(:, :, :), length(:)
      real(wp), intent(out) :: below(:, :), above(:, :)
      integer, intent(out) :: unheld, negative, failed
      type(base_t) :: base
      type(errors_t) :: errors

      below = 0
      above = 0
      unheld = 0
      negative = 0
      failed = 1
      if (.not. study%is_ready) return
      call make_base(study%elastic, study%state, gravity, base)
      call find_errors(study%elastic, study%state, gravity, base, square, stress, length, errors)
      if (base%space%failed .or. errors%failed) return
      failed = 0
      unheld = errors%loose
      negative = errors%negative
      if (negative + unheld > 0) return
      below = errors%below
      above = errors%above
   end subroutine give_errors
end module flexact_elastic_exchange
