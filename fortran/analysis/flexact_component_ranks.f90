! SPDX-License-Identifier: BSD-3-Clause
!> The rank of each component from its complete decomposition, and where exact
!> arithmetic or more digits know better.
module flexact_component_ranks
   use flexact_bidiagonal, only: bidiagonal_t
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t
   use flexact_proof, only: proof_t, unknown
   use flexact_result, only: result_t
   use flexact_sorting, only: ascending
   use flexact_tiny_values, only: judgement_t, judge_zeros
   implicit none
   private
   public :: component_t, settle, merge_values

   !> Singular values of a component, descending, and all its singular vectors; of a
   !> long one, which stands upright, only as many left ones as there are columns. Values
   !> from rank + 1 on count as zero. As long as only the values are known, there is the form.
   type :: component_t
      logical :: is_transposed = .false.
      integer, allocatable :: row(:), column(:)
      real(wp), allocatable :: values(:), u(:, :), vt(:, :)
      type(bidiagonal_t), allocatable :: form
      integer :: rank = 0
   end type component_t

contains

   !> The rank of each component, where exact arithmetic or more digits know better than
   !> the values do; where a tolerance was given, it alone decides.
   subroutine settle(model, problem, proof, component, result)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      type(proof_t), intent(in) :: proof
      type(component_t), intent(inout) :: component(:)
      type(result_t), intent(inout) :: result
      logical :: is_raised
      integer :: i

      is_raised = .false.
      do i = 1, size(component)
         associate (item => component(i), proven => proof%rank(i))
            item%rank = count(item%values > result%decision%tolerance)
            if (result%decision%is_given .or. proven == item%rank) cycle
            if (proven /= unknown .and. proven < item%rank) then
               item%rank = proven
            else if (item%rank < size(item%values)) then
               call look_closer(model, problem, proof%as_typed, proven, item, is_raised, result)
            end if
         end associate
      end do
      if (.not. (is_raised .or. sum(component%rank) /= result%decision%rank)) return
      result%decision%rank = sum(component%rank)
      do i = 1, size(component)
         ! Between values far below rounding, what counts as zero is given as zero.
         if (is_raised) component(i)%values(component(i)%rank + 1:) = 0.0_wp
      end do
      call merge_values(component, result)
      result%decision%tolerance = max(0.0_wp, maxval([(component(i)%values(component(i)%rank + 1:), i=1, size(component))]))
   end subroutine settle

   !> What the small values of a component are in truth.
   subroutine look_closer(model, problem, as_typed, proven, item, is_raised, result)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      logical, intent(in) :: as_typed
      integer, intent(in) :: proven
      type(component_t), intent(inout) :: item
      logical, intent(inout) :: is_raised
      type(result_t), intent(inout) :: result
      type(judgement_t) :: judgement
      integer :: excess

      excess = merge(unknown, proven - item%rank, proven == unknown)
      ! Of a long component some of the left vectors are not there.
      if (size(item%u, 2) == size(item%u, 1)) call judge_zeros(model, problem, item%row, item%column, item%u, &
                                                               item%values, item%vt, item%rank, excess, as_typed, judgement)
      if (.not. judgement%is_made) then
         result%undecided = result%undecided + max(0, excess)
         if (proven == unknown) result%unjudged = .true.
         return
      end if
      result%undecided = result%undecided + judgement%undecided
      result%fading = result%fading + judgement%fading
      result%unseen = result%unseen + judgement%unseen
      if (judgement%left > result%left) then
         result%left = judgement%left
         result%explained = judgement%explained
      end if
      if (judgement%nonzero == 0) return
      is_raised = .true.
      item%values(item%rank + 1:) = judgement%zeros%value
      item%u(:, item%rank + 1:) = judgement%zeros%left
      item%vt(item%rank + 1:, :) = transpose(judgement%zeros%right)
      item%rank = item%rank + judgement%nonzero
   end subroutine look_closer

   !> Singular values of all components together, descending. Beside them stand the
   !> zeros of a matrix whose components are not all of full shape.
   pure subroutine merge_values(component, result)
      type(component_t), intent(in) :: component(:)
      type(result_t), intent(inout) :: result
      integer :: i, zeros

      zeros = min(sum([(size(component(i)%row), i=1, size(component))]), &
                  sum([(size(component(i)%column), i=1, size(component))])) &
              - sum([(size(component(i)%values), i=1, size(component))])
      result%scaled_values = [(component(i)%values, i=1, size(component)), (0.0_wp, i=1, zeros)]
      associate (values => result%scaled_values)
         if (size(component) > 1) values = values(ascending(-values))
      end associate
   end subroutine merge_values
end module flexact_component_ranks
