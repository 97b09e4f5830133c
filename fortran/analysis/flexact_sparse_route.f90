! SPDX-License-Identifier: BSD-3-Clause
!> Rank and null spaces component by component from pinned factorisations
!> (`flexact_low_end`).
module flexact_sparse_route
   use flexact_blas, only: blas_share, blas_unshare
   use flexact_components, only: shape_of
   use flexact_error, only: error_t, fail, is_kind, error_convergence, error_not_definite, error_not_found
   use flexact_kinds, only: wp
   use flexact_low_end, only: low_end_t, request_t, factorise_low_end, find_low_end, few, large
   use flexact_null_spaces, only: find_null_spaces
   use flexact_pinned, only: pinned_t, release
   use flexact_problem, only: problem_t
   use flexact_progress, only: stage_stresses
   use flexact_rank, only: rank_rule_t
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaled_basis, only: add_scaled, add_scaled_sparse, append_dense
   use flexact_smallest_values, only: offer_pairs
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t, operator_t, submatrix, transposed
   use flexact_sparse_basis, only: sparse_basis_t
   implicit none
   private
   public :: analyse_sparse

   !> A component, or its transpose, so that there are no fewer rows than columns, or
   !> only a few in a large one; but the other way round where one column meets so many
   !> rows, as at the hub of a star, that A'A would be full.
   type :: component_t
      logical :: is_transposed = .false.
      !> Not allocated where it is all of the problem's, as it stands there.
      type(operator_t), allocatable :: matrix
      !> Where the rows and columns of the matrix stand in D(c), and which of its
      !> columns belong to one node (or element).
      integer, allocatable :: row(:), column(:), group(:)
   end type component_t

   !> A'A may have this many times the entries of AA'.
   real(wp), parameter :: much_fuller = 100.0_wp

contains

   subroutine analyse_sparse(problem, options, rule, result)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(rank_rule_t), intent(in) :: rule
      type(result_t), intent(inout) :: result
      type(request_t) :: request
      integer :: i, missing
      real(wp) :: estimate(problem%components%count)
      integer, allocatable :: new_row(:), lowest(:)
      real(wp), allocatable :: zeros(:)
      logical :: is_once

      request = request_t(rule, options%memory, options%progress, options%only_plain_values)
      allocate (zeros(0))
      result%bound = huge(result%bound)
      allocate (new_row(max(problem%matrix%by_column%rows, problem%matrix%by_column%columns)), source=0)
      ! Of many small components only those with the smallest values are worth a second
      ! look, with more values and more care.
      do i = 1, size(estimate)
         is_once = size(estimate) <= most_pairs .or. minval(shape_of(problem%components, i)) >= large
         request%values = merge(most_pairs, 1, is_once)
         call take_component(problem, request, i, .true., new_row, result, zeros, estimate(i))
         if (allocated(result%error)) return
         if (is_once) estimate(i) = huge(estimate)
      end do
      request%values = most_pairs
      lowest = ascending(estimate)
      do i = 1, min(most_pairs, size(lowest))
         if (.not. estimate(lowest(i)) < huge(estimate)) exit
         call take_component(problem, request, lowest(i), .false., new_row, result, zeros, estimate(lowest(i)))
         if (allocated(result%error)) return
      end do
      ! Where there is nothing to factorise, nothing is in doubt.
      if (.not. result%bound < huge(result%bound)) result%bound = 0.0_wp
      ! Zeros of a matrix whose components are not all of full shape.
      missing = min(problem%matrix%by_column%rows, problem%matrix%by_column%columns) &
                - sum([(minval(shape_of(problem%components, i)), i=1, size(estimate))])
      result%scaled_values = [result%pair_value(size(result%pair_value):1:-1), zeros(ascending(-zeros)), &
                              [(0.0_wp, i=1, missing)]]
   end subroutine analyse_sparse

   !> Count the zeros of component i, add its modes, and offer its smallest non-zero
   !> values, where more than one is asked for; else only estimate the smallest.
   !> first_time: the zeros and modes have not been taken yet.
   subroutine take_component(problem, request, i, first_time, new_row, result, zeros, estimate)
      type(problem_t), intent(in) :: problem
      type(request_t), intent(in) :: request
      integer, intent(in) :: i
      logical, intent(in) :: first_time
      integer, intent(inout) :: new_row(:)
      type(result_t), intent(inout) :: result
      real(wp), allocatable, intent(inout) :: zeros(:)
      real(wp), intent(out) :: estimate
      type(component_t) :: component

      estimate = huge(estimate)
      call make_component(problem, i, new_row, component)
      if (size(component%column) == 0) then
         if (first_time) call add_unit(component, result)
      else if (allocated(component%matrix)) then
         call take_matrix(component%matrix, problem, request, component, first_time, result, zeros, estimate)
      else
         call take_matrix(problem%matrix, problem, request, component, first_time, result, zeros, estimate)
      end if
   end subroutine take_component

   !> The same for its matrix, wherever that stands.
   subroutine take_matrix(matrix, problem, request, component, first_time, result, zeros, estimate)
      type(operator_t), intent(in) :: matrix
      type(problem_t), intent(in) :: problem
      type(request_t), intent(in) :: request
      type(component_t), intent(in) :: component
      logical, intent(in) :: first_time
      type(result_t), intent(inout) :: result
      real(wp), allocatable, intent(inout) :: zeros(:)
      real(wp), intent(inout) :: estimate
      type(pinned_t) :: pinned
      type(low_end_t) :: low

      call factorise_low_end(matrix, component%group, request, pinned, low, result%error)
      ! Vectors gain nothing by the threads of BLAS, which take the time of ours while they wait for more.
      call blas_share()
      if (.not. allocated(result%error)) then
         call find_low_end(matrix, request, pinned, low, result%error)
         if (.not. allocated(result%error) .and. first_time .and. .not. request%values_only) &
            call add_null_spaces(matrix, problem, request, component, pinned, low, result)
      end if
      call blas_unshare()
      result%confirmed = result%confirmed .and. low%confirmed
      result%bound = min(result%bound, low%bound)
      result%bytes = pinned%bytes
      call release(pinned)
      if (is_kind(result%error, error_not_found) .or. is_kind(result%error, error_not_definite)) &
         call fail(error_convergence, result%error)
      if (allocated(result%error)) return
      if (first_time) call count_zeros(component, low, result, zeros)
      associate (values => low%values, tolerance => low%decision%tolerance)
         if (any(values > tolerance)) estimate = minval(values, values > tolerance)
      end associate
      if (request%values > 1) call offer_all(component, low, result)
   end subroutine take_matrix

   subroutine count_zeros(component, low, result, zeros)
      type(component_t), intent(in) :: component
      type(low_end_t), intent(in) :: low
      type(result_t), intent(inout) :: result
      real(wp), allocatable, intent(inout) :: zeros(:)
      real(wp), allocatable :: found(:)
      integer :: k

      allocate (found, source=[[(0.0_wp, k=1, low%local%vectors)], pack(low%values, low%values <= low%decision%tolerance)])
      associate (decision => result%decision, columns => size(component%column))
         decision%rank = decision%rank + columns - size(found)
         decision%noise = max(decision%noise, low%decision%noise)
         decision%tolerance = max(decision%tolerance, low%decision%tolerance)
         ! Columns beyond the number of rows have no singular values.
         zeros = [zeros, found(max(0, columns - size(component%row)) + 1:)]
      end associate
   end subroutine count_zeros

   !> Cut component i out of the scaled matrix, unless it is the whole.
   pure subroutine make_component(problem, i, new_row, component)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i
      integer, intent(inout) :: new_row(:)
      type(component_t), intent(out) :: component
      integer, allocatable :: row(:), column(:)

      associate (c => problem%components)
         row = c%row(c%row_start(i):c%row_start(i + 1) - 1)
         column = c%column(c%column_start(i):c%column_start(i + 1) - 1)
      end associate
      component%is_transposed = size(row) < size(column)
      if (size(row) >= large .and. size(column) - size(row) <= few) component%is_transposed = .false.
      associate (by_row => terms(problem%matrix%by_row, row), by_column => terms(problem%matrix%by_column, column))
         if (size(row) >= large .and. component%is_transposed) component%is_transposed = by_column <= much_fuller*by_row
      end associate
      if (component%is_transposed) then
         call cut(problem%matrix%by_row, problem%partition%row_label(1, row), column, row, new_row, component)
      else
         call cut(problem%matrix%by_column, problem%partition%column_label(1, column), row, column, new_row, component)
      end if
   end subroutine make_component

   !> Terms of the products of some columns with themselves, side by side: A'A for the
   !> rows of A, AA' for its columns.
   pure real(wp) function terms(matrix, column)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: column(:)

      terms = sum(real(matrix%start(column + 1) - matrix%start(column), wp)**2)
   end function terms

   !> label (columns): node (or element) of each column.
   pure subroutine cut(matrix, label, row, column, new_row, component)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: label(:), row(:), column(:)
      integer, intent(inout) :: new_row(:)
      type(component_t), intent(inout) :: component
      integer :: j

      component%row = row
      component%column = column
      component%group = number_runs(label)
      if (.not. component%is_transposed .and. size(row) == matrix%rows .and. size(column) == matrix%columns) return
      new_row(row) = [(j, j=1, size(row))]
      allocate (component%matrix)
      call submatrix(matrix, size(row), column, new_row, component%matrix%by_column)
      call transposed(component%matrix%by_column, component%matrix%by_row)
   end subroutine cut

   !> Number the runs of equal labels.
   pure function number_runs(label) result(number)
      integer, intent(in) :: label(:)
      integer :: number(size(label)), j

      number = 1
      do j = 2, size(label)
         number(j) = number(j - 1) + merge(0, 1, label(j) == label(j - 1))
      end do
   end function number_runs

   !> A row without columns is a self-stress by itself, a column without rows a motion.
   pure subroutine add_unit(component, result)
      type(component_t), intent(in) :: component
      type(result_t), intent(inout) :: result

      if (component%is_transposed) then
         call result%motions%add(component%row, [1.0_wp])
      else
         call result%stresses%add(component%row, [1.0_wp])
      end if
   end subroutine add_unit

   !> Add the vectors of both null spaces to the result.
   subroutine add_null_spaces(matrix, problem, request, component, pinned, low, result)
      type(operator_t), intent(in) :: matrix
      type(problem_t), intent(in) :: problem
      type(request_t), intent(in) :: request
      type(component_t), intent(in) :: component
      type(pinned_t), intent(in) :: pinned
      type(low_end_t), intent(inout) :: low
      type(result_t), intent(inout) :: result
      real(wp), allocatable :: right(:, :), left(:, :)
      type(sparse_basis_t) :: many

      if (pinned%n >= large) call request%progress%report(stage_stresses)
      call find_null_spaces(matrix, pinned, low, right, left, many, result%error)
      if (allocated(result%error)) return
      associate (row => component%row, column => component%column, scaling => problem%scaling)
         if (component%is_transposed) then
            call add_both(low%local, right, column, scaling%row(column), result%stresses, result%error)
            if (allocated(result%error)) return
            call add_both(many, left, row, scaling%column(row), result%motions, result%error)
         else
            call add_both(low%local, right, column, scaling%column(column), result%motions, result%error)
            if (allocated(result%error)) return
            call add_both(many, left, row, scaling%row(row), result%stresses, result%error)
         end if
      end associate
   end subroutine add_null_spaces

   subroutine add_both(sparse, dense, place, scale, basis, error)
      type(sparse_basis_t), intent(in) :: sparse
      real(wp), intent(in) :: dense(:, :)
      integer, intent(in) :: place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      type(sparse_basis_t) :: both

      if (sparse%vectors == 0) then
         call add_scaled(dense, place, scale, basis, error)
      else
         both = sparse
         call append_dense(dense, both)
         call add_scaled_sparse(both, place, scale, basis, error)
      end if
   end subroutine add_both

   pure subroutine offer_all(component, low, result)
      type(component_t), intent(in) :: component
      type(low_end_t), intent(in) :: low
      type(result_t), intent(inout) :: result
      integer, allocatable :: which(:)
      integer :: k

      which = pack([(k, k=1, size(low%values))], low%values > low%decision%tolerance)
      associate (row => component%row, column => component%column)
         if (component%is_transposed) then
            call offer_pairs(result, which, low%values, row, low%images, column, low%vectors)
         else
            call offer_pairs(result, which, low%values, column, low%vectors, row, low%images)
         end if
      end associate
   end subroutine offer_all
end module flexact_sparse_route
