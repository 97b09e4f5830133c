! SPDX-License-Identifier: BSD-3-Clause
!> Whether singular values that a decomposition cannot tell from zero are zero: they
!> are computed with more than 30 digits and compared with what half a unit of the
!> last digit printed, or of the last bit, of every number makes of them; theory.md (22)
!> and (23).
module flexact_tiny_values
   use flexact_error, only: error_t
   use flexact_exact_matrix, only: exact_matrix_t, make_exact_matrix
   use flexact_exact_number, only: many_digits
   use flexact_kinds, only: wp, qp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t
   use flexact_refined_zeros, only: many_digits_t, refined_zeros_t, refine_zeros, least_told
   use flexact_scaled_norm, only: length_of
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   implicit none
   private
   public :: judgement_t, judge_zeros

   !> A value this many times larger than what half units make of it is not zero; one
   !> that they explain, of first order and so with a little to spare, was meant to be.
   real(wp), parameter :: clearly = 30.0_wp, plainly = 0.9_wp
   !> What components of a vector that fades are to its largest: vectors have 30 digits.
   real(wp), parameter :: faded(2) = [1.0e-28_wp, 1.0e-7_wp]
   !> Products of numbers of many digits that are spent at most, a good tenth of a second.
   real(wp), parameter :: most_products = 2.0e6_wp

   type :: judgement_t
      !> Whether there was something to judge, and it was not too much.
      logical :: is_made = .false.
      type(refined_zeros_t) :: zeros
      !> The first are not zero; of these the last were not seen by the digits, but by
      !> exact arithmetic alone. The next may or may not be.
      integer :: nonzero = 0, unseen = 0, undecided = 0
      !> So many of the undecided are so because their vectors fade, though no digits show them.
      integer :: fading = 0
      !> The largest of those that may be zero, and what storing the geometry makes of it.
      real(wp) :: left = 0.0_wp, explained = 0.0_wp
   end type judgement_t

contains

   !> row, column: those of a component; u, values, vt: its decomposition, of which
   !> the values from rank + 1 on are small. excess: so many of them are not zero in
   !> exact arithmetic; negative where that is not known.
   subroutine judge_zeros(model, problem, row, column, u, values, vt, rank, excess, as_typed, judgement)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: row(:), column(:), rank, excess
      real(wp), intent(in) :: u(:, :), values(:), vt(:, :)
      logical, intent(in) :: as_typed
      type(judgement_t), intent(out) :: judgement
      type(many_digits_t) :: matrix
      type(error_t), allocatable :: error
      real(wp), allocatable :: lift(:)
      integer :: asked

      associate (left => real(size(row) - rank, wp), right => real(size(column) - rank, wp))
         if (precision(1.0_qp) == precision(1.0_wp)) return
         if (left*right*size(row) + 100*(left*size(row) + right*size(column)) > most_products) return
      end associate
      call make_many_digits(model, problem, row, column, as_typed, matrix)
      call refine_zeros(matrix, u, values, vt, rank, judgement%zeros, error)
      if (allocated(error)) return
      judgement%is_made = .true.
      asked = count(judgement%zeros%value > least_told)
      if (excess >= 0) asked = excess
      call find_lifts(model, problem, row, column, judgement%zeros, asked, lift)
      call compare(judgement%zeros%value(:asked), lift, judgement)
      if (excess < 0) call doubt_fading(asked, judgement)
   end subroutine judge_zeros

   !> Values that are not zero in exact arithmetic, descending, with what storing makes of them.
   pure subroutine compare(value, lift, judgement)
      real(wp), intent(in) :: value(:), lift(:)
      type(judgement_t), intent(inout) :: judgement
      integer :: k, seen

      do k = 1, size(value)
         if (.not. value(k) > max(least_told, clearly*lift(k))) exit
         judgement%nonzero = k
      end do
      seen = judgement%nonzero
      do k = seen + 1, size(value)
         if (value(k) > least_told .or. lift(k) > least_told) exit
         judgement%nonzero = k
      end do
      judgement%unseen = judgement%nonzero - seen
      judgement%zeros%value(seen + 1:judgement%nonzero) = least_told
      if (judgement%nonzero == size(value)) return
      judgement%left = value(judgement%nonzero + 1)
      judgement%explained = lift(judgement%nonzero + 1)
      do k = judgement%nonzero + 1, size(value)
         if (value(k) > plainly*lift(k)) judgement%undecided = k - judgement%nonzero
      end do
   end subroutine compare

   !> Where exact arithmetic is not at hand, a value that no digits show may be tiny, if its
   !> vectors fade: each element passes on a part of the motion of the last.
   pure subroutine doubt_fading(asked, judgement)
      integer, intent(in) :: asked
      type(judgement_t), intent(inout) :: judgement
      integer :: k, shown

      shown = judgement%undecided
      do k = asked + 1, size(judgement%zeros%value)
         if (fades(judgement%zeros%left(:, k)) .and. fades(judgement%zeros%right(:, k))) &
            judgement%undecided = k - judgement%nonzero
      end do
      judgement%fading = judgement%undecided - shown
   end subroutine doubt_fading

   !> Whether components are small, but not by rounding.
   pure logical function fades(vector)
      real(wp), intent(in) :: vector(:)
      associate (part => abs(vector)/maxval(abs(vector)))
         fades = any(part > faded(1) .and. part < faded(2))
      end associate
   end function fades

   !> The rows of a component, scaled as the problem's.
   pure subroutine make_many_digits(model, problem, row, column, as_typed, matrix)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: row(:), column(:)
      logical, intent(in) :: as_typed
      type(many_digits_t), intent(out) :: matrix
      type(exact_matrix_t) :: exact
      integer :: place(problem%partition%count%columns), i

      place = 0
      place(column) = [(i, i=1, size(column))]
      call make_exact_matrix(model, problem%partition, row, many_digits(as_typed), exact)
      matrix%columns = size(column)
      matrix%start = exact%start
      associate (entries => exact%start(size(row) + 1) - 1)
         ! What rounding has made zero may reach beyond the component.
         matrix%place = max(1, place(exact%column(:entries)))
         matrix%value = merge(exact%entry(:entries)%value, 0.0_qp, place(exact%column(:entries)) > 0) &
                        *problem%scaling%column(exact%column(:entries))
      end associate
      do i = 1, size(row)
         associate (of_row => matrix%value(matrix%start(i):matrix%start(i + 1) - 1), &
                    scaled => problem%matrix%by_row%value(problem%matrix%by_row%start(row(i)): &
                                                          problem%matrix%by_row%start(row(i) + 1) - 1))
            if (any(abs(of_row) > 0)) of_row = of_row*(length_of(scaled)/length_of(real(of_row, wp)))
         end associate
      end do
   end subroutine make_many_digits

   !> What half units make of each of the first values.
   subroutine find_lifts(model, problem, row, column, zeros, asked, lift)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: row(:), column(:), asked
      type(refined_zeros_t), intent(in) :: zeros
      real(wp), allocatable, intent(out) :: lift(:)
      real(wp), allocatable :: left(:, :), right(:, :)
      type(sensitivity_t) :: found(asked)
      integer :: k

      allocate (left(problem%partition%count%rows, asked), right(problem%partition%count%columns, asked), source=0.0_wp)
      do k = 1, asked
         left(row, k) = problem%scaling%row(row)*zeros%left(:, k)
         right(column, k) = problem%scaling%column(column)*zeros%right(:, k)
      end do
      call find_sensitivities(model, left, right, reshape([(k, k, k=1, asked)], [2, asked]), found)
      lift = found%lift_of_storing
   end subroutine find_lifts
end module flexact_tiny_values
