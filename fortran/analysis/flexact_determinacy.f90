!> Kinematic and static determinacy, section 3 of the paper: the rank of D(c),
!> the motions that it leaves free and the self-stresses that it admits.
module flexact_determinacy
   use flexact_answer, only: options_t, answer_t, method_auto, method_svd, method_sparse
   use flexact_basis, only: new_basis
   use flexact_cholmod, only: cholmod_is_there
   use flexact_decomposition, only: status_fine
   use flexact_dense_route, only: analyse_dense
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t, make_problem
   use flexact_sparse_route, only: analyse_sparse
   implicit none
   private
   public :: analyse

   !> Parts up to this size are decomposed completely where no method is asked for,
   !> if there are not too many of them.
   integer, parameter :: small_part = 200
   integer, parameter :: small_whole = 600

contains

   !> Analyse the reference configuration.
   subroutine analyse(model, options, problem, answer)
      type(model_t), intent(in) :: model
      type(options_t), intent(in) :: options
      type(problem_t), intent(out) :: problem
      type(answer_t), intent(out) :: answer

      call make_problem(model, problem)
      answer%method = options%method
      if (options%method == method_auto) answer%method = choice(problem)
      call prepare(problem, answer)
      if (answer%method == method_sparse) then
         call analyse_sparse(problem, options, answer)
      else
         call analyse_dense(problem, options, answer)
      end if
   end subroutine analyse

   pure subroutine prepare(problem, answer)
      type(problem_t), intent(in) :: problem
      type(answer_t), intent(inout) :: answer

      answer%status = status_fine
      call new_basis(answer%motions)
      call new_basis(answer%stresses)
      allocate (answer%pair_value(0), answer%pair_motion(problem%by_column%columns, 0), &
                answer%pair_stress(problem%by_column%rows, 0))
   end subroutine prepare

   !> Complete decompositions where they are quick, sparse ones else.
   integer function choice(problem)
      type(problem_t), intent(in) :: problem
      integer :: i, largest, whole

      largest = 0
      whole = 0
      associate (parts => problem%parts)
         do i = 1, parts%count
            associate (shorter => min(parts%row_start(i + 1) - parts%row_start(i), &
                                      parts%column_start(i + 1) - parts%column_start(i)))
               largest = max(largest, shorter)
               whole = whole + shorter
            end associate
         end do
      end associate
      choice = method_sparse
      if ((largest <= small_part .and. whole <= small_whole) .or. cholmod_is_there() == 0) choice = method_svd
   end function choice
end module flexact_determinacy
