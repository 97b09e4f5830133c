!> Kinematic and static determinacy, section 3 of the paper: the rank of D(c),
!> the motions that it leaves free and the self-stresses that it admits.
module flexact_determinacy
   use flexact_answer, only: options_t, answer_t, method_auto, method_svd, method_sparse, status_no_library, &
                             stage_assembling
   use flexact_basis, only: new_basis
   use flexact_cholmod, only: cholmod_is_there
   use flexact_kinds, only: wp
   use flexact_decomposition, only: status_fine, status_no_convergence
   use flexact_dense_route, only: analyse_dense
   use flexact_model, only: model_t
   use flexact_parts, only: shape_of, largest_part
   use flexact_problem, only: problem_t, make_problem
   use flexact_sparse_route, only: analyse_sparse
   implicit none
   private
   public :: analyse

   !> Parts up to this size are decomposed completely where no method is asked for,
   !> if there are not too many of them.
   integer, parameter :: small_part = 200
   integer, parameter :: small_whole = 600
   !> Up to this cost, some half a minute, parts are decomposed completely where the
   !> sparse route leaves doubt.
   real(wp), parameter :: feasible = 3.0e10_wp

contains

   !> Analyse the reference configuration.
   subroutine analyse(model, options, problem, answer)
      type(model_t), intent(in) :: model
      type(options_t), intent(in) :: options
      type(problem_t), intent(out) :: problem
      type(answer_t), intent(out) :: answer
      type(answer_t) :: complete

      call options%tell(stage_assembling, 0, 1)
      call make_problem(model, options%only_plain_values, problem)
      answer%method = options%method
      if (options%method == method_auto) answer%method = choice(problem)
      call prepare(problem, answer)
      if (answer%method == method_sparse .and. cholmod_is_there() == 0) then
         answer%status = status_no_library
      else if (answer%method == method_sparse) then
         call analyse_sparse(problem, options, answer)
         if (.not. is_in_doubt(answer) .or. cost(problem) > feasible .or. options%only_plain_values) return
         complete%method = method_svd
         call prepare(problem, complete)
         call analyse_dense(problem, options, complete)
         if (complete%status == status_fine) answer = complete
      else
         call analyse_dense(problem, options, answer)
      end if
   end subroutine analyse

   !> Operations of a complete decomposition, but for a factor.
   pure real(wp) function cost(problem)
      type(problem_t), intent(in) :: problem
      integer :: i

      cost = 0.0_wp
      do i = 1, problem%parts%count
         associate (sides => real(shape_of(problem%parts, i), wp))
            cost = cost + product(sides)*maxval(sides)
         end associate
      end do
   end function cost

   !> Whether the sparse route gave no count, or one that is not confirmed.
   pure logical function is_in_doubt(answer)
      type(answer_t), intent(in) :: answer
      is_in_doubt = answer%status == status_no_convergence .or. &
                    (answer%status == status_fine .and. .not. answer%confirmed)
   end function is_in_doubt

   !> An answer with nothing in it but the method.
   pure subroutine prepare(problem, answer)
      type(problem_t), intent(in) :: problem
      type(answer_t), intent(inout) :: answer
      integer :: method

      method = answer%method
      answer = answer_t()
      answer%method = method
      answer%status = status_fine
      call new_basis(answer%motions)
      call new_basis(answer%stresses)
      allocate (answer%pair_value(0), answer%pair_motion(problem%by_column%columns, 0), &
                answer%pair_stress(problem%by_column%rows, 0))
   end subroutine prepare

   !> Complete decompositions where they are quick, sparse ones else.
   integer function choice(problem)
      type(problem_t), intent(in) :: problem

      choice = method_sparse
      if (cholmod_is_there() == 0 .or. (minval(largest_part(problem%parts)) <= small_part .and. &
                                        min(problem%by_column%rows, problem%by_column%columns) <= small_whole)) &
         choice = method_svd
   end function choice
end module flexact_determinacy
