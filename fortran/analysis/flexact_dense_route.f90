! SPDX-License-Identifier: BSD-3-Clause
!> Rank and null spaces component by component from complete decompositions.
!>
!> Of a component that is many times as long as wide no square of its longer side is
!> made: time and memory stay in proportion to its entries.
module flexact_dense_route
   use flexact_bidiagonal, only: is_worth_steps, bidiagonalise, find_all_vectors, find_lowest_vectors
   use flexact_complement, only: add_complement
   use flexact_component_ranks, only: component_t, settle, merge_values
   use flexact_components, only: shape_of
   use flexact_decomposition, only: is_feasible, decompose_by, method_svd, singular_values_by
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_problem, only: problem_t
   use flexact_proof, only: proof_t, unknown
   use flexact_rank, only: rank_rule_t, decide_rank
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaled_basis, only: add_scaled, add_scaled_sparse
   use flexact_smallest_values, only: offer_pairs
   use flexact_sparse, only: sparse_t
   use flexact_sparse_basis, only: sparse_basis_t, new_sparse_basis
   implicit none
   private
   public :: analyse_dense, operations, entries_of_bases

   !> From this length on, and this many times its width, a component is long. What is
   !> shorter takes less than half a second, whatever its width.
   integer, parameter :: least_long = 1000, many = 4

contains

   subroutine analyse_dense(model, problem, options, rule, proof, result)
      type(model_t), intent(in) :: model
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(rank_rule_t), intent(in) :: rule
      type(proof_t), intent(in) :: proof
      type(result_t), intent(inout) :: result
      type(component_t), allocatable :: component(:)
      integer :: i

      result%bytes = bytes_needed(problem)
      if (result%bytes > options%memory) then
         call fail(error_memory, result%error)
         return
      end if
      allocate (component(problem%components%count))
      do i = 1, size(component)
         call decompose_component(problem, i, proof%rank(i), options, result%method, component(i), result%error)
         if (allocated(result%error)) return
      end do
      call merge_values(component, result)
      if (options%only_plain_values) return
      result%decision = decide_rank(rule, result%scaled_values)
      do i = 1, size(component)
         call find_vectors(result%decision%tolerance, component(i), result%error)
         if (allocated(result%error)) return
      end do
      call settle(model, problem, proof, component, result)
      result%bound = result%decision%noise
      do i = 1, size(component)
         call take_modes(problem, component(i), result)
         if (allocated(result%error)) return
      end do
   end subroutine analyse_dense

   !> Bytes for U, V and the matrices of all components, and for the work on the
   !> largest.
   pure real(wp) function bytes_needed(problem) result(bytes)
      type(problem_t), intent(in) :: problem
      real(wp) :: m, n, work
      integer :: i

      bytes = 0.0_wp
      work = 0.0_wp
      do i = 1, problem%components%count
         associate (sides => shape_of(problem%components, i))
            m = maxval(sides)
            n = minval(sides)
            ! Of a long component the sparse vectors stand twice for a while.
            bytes = bytes + merge(8*m*n + 24*m*(n + 1), 8*m*m, is_long(sides)) + 8*n*n
         end associate
         work = max(work, 8*(2*m*n + 4*min(m, n)**2 + 7*min(m, n) + 64*max(m, n)))
      end do
      bytes = bytes + work
   end function bytes_needed

   pure logical function is_long(sides)
      integer, intent(in) :: sides(2)
      is_long = maxval(sides) > least_long .and. maxval(sides)/many > minval(sides)
   end function is_long

   !> Operations for all components, but for a factor: their values, and bases of
   !> their null spaces.
   pure real(wp) function operations(problem)
      type(problem_t), intent(in) :: problem
      real(wp) :: m, n
      integer :: i

      operations = 0.0_wp
      do i = 1, problem%components%count
         associate (sides => shape_of(problem%components, i))
            m = maxval(sides)
            n = minval(sides)
            operations = operations + m*n*merge(n, m, is_long(sides))
            if (.not. is_long(sides)) operations = operations + m*(m - n)**2
         end associate
      end do
   end function operations

   !> How many entries the bases of both null spaces may have.
   pure real(wp) function entries_of_bases(problem) result(entries)
      type(problem_t), intent(in) :: problem
      real(wp) :: m, n
      integer :: i

      entries = 0.0_wp
      do i = 1, problem%components%count
         associate (sides => shape_of(problem%components, i))
            m = maxval(sides)
            n = minval(sides)
            entries = entries + merge(m*(n + 1), m*m, is_long(sides)) + n*n
         end associate
      end do
   end function entries_of_bases

   !> Of a square one that may be regular only the values, if few vectors will do then.
   subroutine decompose_component(problem, i, proven, options, method, component, error)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i, proven, method
      type(options_t), intent(in) :: options
      type(component_t), intent(out) :: component
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: dense(:, :)
      logical :: in_steps
      integer :: m, n, left

      associate (c => problem%components)
         component%row = c%row(c%row_start(i):c%row_start(i + 1) - 1)
         component%column = c%column(c%column_start(i):c%column_start(i + 1) - 1)
      end associate
      m = size(component%row)
      n = size(component%column)
      left = m
      if (is_long([m, n])) then
         component%is_transposed = n > m
         m = max(size(component%row), size(component%column))
         n = min(size(component%row), size(component%column))
         left = n
      end if
      if (.not. is_feasible(m, n, left < m)) then
         call fail(error_memory, error)
         return
      end if
      allocate (dense(m, n), component%values(min(m, n)))
      if (component%is_transposed) then
         call fill(problem%matrix%by_row, component%column, component%row, dense)
      else
         call fill(problem%matrix%by_column, component%row, component%column, dense)
      end if
      in_steps = method == method_svd .and. (proven == n .or. proven == unknown) .and. is_worth_steps(dense)
      if (options%only_plain_values) then
         call singular_values_by(method, dense, component%values, error)
      else if (in_steps) then
         allocate (component%form)
         call bidiagonalise(dense, component%form, component%values, error)
      else
         allocate (component%u(m, left), component%vt(n, n))
         call decompose_by(method, dense, component%values, component%u, component%vt, error)
      end if
   end subroutine decompose_component

   !> The vectors of a component of which only the values are known: if it is regular those of the
   !> smallest ones, where they are no choice; else all.
   subroutine find_vectors(tolerance, component, error)
      real(wp), intent(in) :: tolerance
      type(component_t), intent(inout) :: component
      type(error_t), allocatable, intent(out) :: error
      logical :: is_found

      if (.not. allocated(component%form)) return
      associate (n => size(component%values))
         allocate (component%u(n, n), component%vt(n, n))
         is_found = component%values(n) > tolerance
      end associate
      if (is_found) call find_lowest_vectors(component%form, component%values, component%u, component%vt, is_found)
      if (.not. is_found) call find_all_vectors(component%form, component%u, component%vt, error)
      deallocate (component%form)
   end subroutine find_vectors

   !> The rows and columns of a component with their zeros. Rows ascend.
   pure subroutine fill(matrix, row, column, dense)
      type(sparse_t), intent(in) :: matrix
      integer, intent(in) :: row(:), column(:)
      real(wp), intent(out) :: dense(:, :)
      integer :: j, entry, i

      dense = 0.0_wp
      do j = 1, size(column)
         i = 1
         do entry = matrix%start(column(j)), matrix%start(column(j) + 1) - 1
            do while (row(i) < matrix%place(entry))
               i = i + 1
            end do
            dense(i, j) = matrix%value(entry)
         end do
      end do
   end subroutine fill

   !> Add the modes of a component to the result, and offer its smallest non-zero values.
   subroutine take_modes(problem, component, result)
      type(problem_t), intent(in) :: problem
      type(component_t), intent(in) :: component
      type(result_t), intent(inout) :: result
      integer :: first, k

      associate (rank => component%rank, row => component%row, column => component%column, scaling => problem%scaling, &
                 u => component%u, vt => component%vt)
         if (component%is_transposed) then
            call add_left(u, rank, column, scaling%column(column), result%motions, result%error)
            if (allocated(result%error)) return
            call add_scaled(transpose(vt(rank + 1:, :)), row, scaling%row(row), result%stresses, result%error)
         else
            call add_scaled(transpose(vt(rank + 1:, :)), column, scaling%column(column), result%motions, result%error)
            if (allocated(result%error)) return
            call add_left(u, rank, row, scaling%row(row), result%stresses, result%error)
         end if
         first = max(1, rank - most_pairs + 1)
         associate (values => component%values(first:rank), left => u(:, first:rank), right => transpose(vt(first:rank, :)))
            if (component%is_transposed) then
               call offer_pairs(result, [(k, k=size(values), 1, -1)], values, column, left, row, right)
            else
               call offer_pairs(result, [(k, k=size(values), 1, -1)], values, column, right, row, left)
            end if
         end associate
      end associate
   end subroutine take_modes

   !> Add what the columns of U beyond the rank span, whether they are there or not.
   subroutine add_left(u, rank, place, scale, basis, error)
      real(wp), intent(in) :: u(:, :)
      integer, intent(in) :: rank, place(:)
      real(wp), intent(in) :: scale(:)
      type(sparse_basis_t), intent(inout) :: basis
      type(error_t), allocatable, intent(out) :: error
      type(sparse_basis_t) :: complement

      if (size(u, 2) == size(u, 1)) then
         call add_scaled(u(:, rank + 1:), place, scale, basis, error)
         return
      end if
      call new_sparse_basis(complement)
      call add_complement(u(:, :rank), complement, error)
      if (.not. allocated(error)) call add_scaled_sparse(complement, place, scale, basis, error)
   end subroutine add_left
end module flexact_dense_route
