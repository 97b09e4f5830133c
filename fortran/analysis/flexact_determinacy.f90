! SPDX-License-Identifier: BSD-3-Clause
!> Kinematic and static determinacy, section 3 of the paper: the rank of D(c),
!> the motions that it leaves free and the self-stresses that it admits.
module flexact_determinacy
   use flexact_components, only: largest_component, component_of_columns, shape_of
   use flexact_dense_route, only: analyse_dense, operations, entries_of_bases
   use flexact_error, only: is_kind, error_convergence
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t, make_problem
   use flexact_progress, only: stage_assembling, stage_exact_rank
   use flexact_proof, only: prove, no_proof, unknown, prove_by_cost, prove_always
   use flexact_rank, only: rank_rule_t
   use flexact_result, only: options_t, result_t, method_auto, method_svd, method_sparse
   use flexact_scaling, only: rank_rule_of
   use flexact_smallest_values, only: settle_equal
   use flexact_sparse_basis, only: new_sparse_basis
   use flexact_sparse_route, only: analyse_sparse
   implicit none
   private
   public :: analyse

   !> Components up to this size are decomposed completely where no method is asked
   !> for, if there are not too many of them: all values in some 50 ms, though the
   !> sparse route is as quick from a hundred columns on.
   integer, parameter :: small_component = 200
   integer, parameter :: small_whole = 600
   !> And if bases of their null spaces do not have more entries than these: a
   !> fraction of a second, but a hundred megabytes as text.
   real(wp), parameter :: most_entries = 2.0e6_wp
   !> Up to this cost, some half a minute, components are decomposed completely where
   !> the sparse route leaves doubt.
   real(wp), parameter :: feasible = 3.0e10_wp
   !> Up to this cost, a tenth of a second, zeros that exact arithmetic has not seen are judged
   !> with more digits, which takes a complete decomposition.
   real(wp), parameter :: soon_judged = 1.0e8_wp

contains

   !> Analyse the reference configuration.
   subroutine analyse(model, options, problem, result)
      type(model_t), intent(in) :: model
      type(options_t), intent(in) :: options
      type(problem_t), intent(out) :: problem
      type(result_t), intent(out) :: result
      type(rank_rule_t) :: rule
      integer :: method

      call options%progress%report(stage_assembling)
      call make_problem(model, options%only_plain_values, problem)
      rule = rank_rule_of(problem%scaling, options%tolerance)
      method = options%method
      if (method == method_auto) method = choice(problem)
      call prepare(problem, method, result)
      if (options%only_plain_values) then
         call no_proof(problem%components%count, result%proof)
      else
         call options%progress%report(stage_exact_rank)
         call prove(model, problem, options%prove, options%as_stored, options%memory, result%proof)
      end if
      if (result%method == method_sparse) then
         call analyse_sparse(problem, options, rule, result)
         if (.not. options%only_plain_values) call look_again(model, problem, options, rule, result)
      else
         call analyse_dense(model, problem, options, rule, result%proof, result)
      end if
      if (.not. allocated(result%error)) call settle_equal(result%pair_value, result%pair_motion, result%pair_stress)
   end subroutine analyse

   !> A complete decomposition where the sparse route leaves doubt, if it is feasible.
   subroutine look_again(model, problem, options, rule, result)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(rank_rule_t), intent(in) :: rule
      type(result_t), intent(inout) :: result
      type(result_t) :: complete
      logical :: is_wanted

      if (is_in_doubt(result) .and. .not. result%proof%is_complete() .and. options%prove == prove_by_cost &
          .and. operations(problem) > feasible) &
         call prove(model, problem, prove_always, options%as_stored, options%memory, result%proof)
      result%unjudged = .not. result%proof%is_complete()
      is_wanted = is_in_doubt(result) .or. disagrees(problem, result)
      if (is_wanted .and. operations(problem) > feasible .and. result%proof%is_complete()) then
         ! What exact arithmetic says is offered beside the counts.
         result%undecided = max(0, result%proof%total() - result%decision%rank)
         result%confirmed = result%confirmed .and. result%proof%total() >= result%decision%rank
         if (result%proof%total() < result%decision%rank) call count_unseen(result%proof%total(), result)
      end if
      if (operations(problem) > merge(feasible, soon_judged, is_wanted) .or. .not. (is_wanted .or. is_unseen(result))) return
      call prepare(problem, method_svd, complete)
      complete%proof = result%proof
      call analyse_dense(model, problem, options, rule, result%proof, complete)
      if (.not. allocated(complete%error)) result = complete
   end subroutine look_again

   !> Count the zeros that exact arithmetic knows of and whose vectors were not found.
   pure subroutine count_unseen(rank, result)
      integer, intent(in) :: rank
      type(result_t), intent(inout) :: result
      integer :: k

      result%scaled_values = [result%scaled_values, [(0.0_wp, k=rank + 1, result%decision%rank)]]
      result%decision%rank = rank
   end subroutine count_unseen

   !> Whether exact arithmetic has another rank than the sparse route for some component.
   pure logical function disagrees(problem, result)
      type(problem_t), intent(in) :: problem
      type(result_t), intent(in) :: result
      integer :: motions(problem%components%count), component_of(problem%partition%count%columns), i

      motions = 0
      component_of = component_of_columns(problem%components)
      do i = 1, result%motions%vectors
         associate (here => component_of(result%motions%place(result%motions%start(i))))
            motions(here) = motions(here) + 1
         end associate
      end do
      disagrees = .false.
      do i = 1, problem%components%count
         if (result%proof%rank(i) == unknown) cycle
         associate (sides => shape_of(problem%components, i))
            if (result%proof%rank(i) /= sides(2) - motions(i)) disagrees = .true.
         end associate
      end do
   end function disagrees

   !> Whether the sparse route gave no count, or one that is not confirmed.
   pure logical function is_in_doubt(result)
      type(result_t), intent(in) :: result
      is_in_doubt = is_kind(result%error, error_convergence) .or. &
                    .not. (allocated(result%error) .or. result%confirmed)
   end function is_in_doubt

   !> Whether there are zeros, with both vectors, that neither exact arithmetic nor more
   !> digits have seen.
   pure logical function is_unseen(result)
      type(result_t), intent(in) :: result
      is_unseen = result%unjudged .and. min(result%motions%vectors, result%stresses%vectors) > 0
   end function is_unseen

   !> A result with nothing in it but the method.
   pure subroutine prepare(problem, method, result)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: method
      type(result_t), intent(out) :: result

      result%method = method
      call new_sparse_basis(result%motions)
      call new_sparse_basis(result%stresses)
      allocate (result%pair_value(0), result%pair_motion(problem%matrix%by_column%columns, 0), &
                result%pair_stress(problem%matrix%by_column%rows, 0))
   end subroutine prepare

   !> Complete decompositions where they are quick, sparse ones else.
   integer function choice(problem)
      type(problem_t), intent(in) :: problem

      choice = method_sparse
      if (minval(largest_component(problem%components)) <= small_component .and. &
          min(problem%matrix%by_column%rows, problem%matrix%by_column%columns) <= small_whole .and. &
          entries_of_bases(problem) <= most_entries) choice = method_svd
   end function choice
end module flexact_determinacy
