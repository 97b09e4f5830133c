! SPDX-License-Identifier: BSD-3-Clause
!> Rank and null spaces component by component from complete decompositions.
module flexact_dense_route
   use flexact_components, only: shape_of
   use flexact_decomposition, only: is_feasible, decompose_by, singular_values_by
   use flexact_error, only: error_t, fail, error_memory
   use flexact_kinds, only: wp
   use flexact_problem, only: problem_t
   use flexact_rank, only: rank_rule_t, decide_rank
   use flexact_result, only: options_t, result_t, most_pairs
   use flexact_scaled_basis, only: add_scaled
   use flexact_smallest_values, only: offer_pair
   use flexact_sorting, only: ascending
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: analyse_dense

   !> Singular values of a component, descending, and all its singular vectors.
   type :: component_t
      integer, allocatable :: row(:), column(:)
      real(wp), allocatable :: values(:), u(:, :), vt(:, :)
   end type component_t

contains

   subroutine analyse_dense(problem, options, rule, result)
      type(problem_t), intent(in) :: problem
      type(options_t), intent(in) :: options
      type(rank_rule_t), intent(in) :: rule
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
         call decompose_component(problem, i, options, result%method, component(i), result%error)
         if (allocated(result%error)) return
      end do
      call merge_values(component, result)
      if (options%only_plain_values) return
      result%decision = decide_rank(rule, result%scaled_values)
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
      integer :: sides(2), i

      bytes = 0.0_wp
      work = 0.0_wp
      do i = 1, problem%components%count
         sides = shape_of(problem%components, i)
         m = sides(1)
         n = sides(2)
         bytes = bytes + 8*(m*m + n*n)
         work = max(work, 8*(2*m*n + 4*min(m, n)**2 + 7*min(m, n) + 64*max(m, n)))
      end do
      bytes = bytes + work
   end function bytes_needed

   subroutine decompose_component(problem, i, options, method, component, error)
      type(problem_t), intent(in) :: problem
      integer, intent(in) :: i, method
      type(options_t), intent(in) :: options
      type(component_t), intent(out) :: component
      type(error_t), allocatable, intent(out) :: error
      real(wp), allocatable :: dense(:, :)
      integer :: m, n

      associate (c => problem%components)
         component%row = c%row(c%row_start(i):c%row_start(i + 1) - 1)
         component%column = c%column(c%column_start(i):c%column_start(i + 1) - 1)
      end associate
      m = size(component%row)
      n = size(component%column)
      if (.not. is_feasible(m, n)) then
         call fail(error_memory, error)
         return
      end if
      allocate (dense(m, n), component%values(min(m, n)))
      call fill(problem%matrix%by_column, component, dense)
      if (options%only_plain_values) then
         call singular_values_by(method, dense, component%values, error)
      else
         allocate (component%u(m, m), component%vt(n, n))
         call decompose_by(method, dense, component%values, component%u, component%vt, error)
      end if
   end subroutine decompose_component

   !> The rows and columns of a component with their zeros. Rows ascend.
   pure subroutine fill(matrix, component, dense)
      type(sparse_t), intent(in) :: matrix
      type(component_t), intent(in) :: component
      real(wp), intent(out) :: dense(:, :)
      integer :: j, entry, i

      dense = 0.0_wp
      do j = 1, size(component%column)
         i = 1
         do entry = matrix%start(component%column(j)), matrix%start(component%column(j) + 1) - 1
            do while (component%row(i) < matrix%place(entry))
               i = i + 1
            end do
            dense(i, j) = matrix%value(entry)
         end do
      end do
   end subroutine fill

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

   !> Add the modes of a component to the result, and offer its smallest non-zero values.
   subroutine take_modes(problem, component, result)
      type(problem_t), intent(in) :: problem
      type(component_t), intent(in) :: component
      type(result_t), intent(inout) :: result
      integer :: rank, k

      rank = count(component%values > result%decision%tolerance)
      associate (row => component%row, column => component%column, scaling => problem%scaling)
         call add_scaled(transpose(component%vt(rank + 1:, :)), column, scaling%column(column), result%motions, result%error)
         if (allocated(result%error)) return
         call add_scaled(component%u(:, rank + 1:), row, scaling%row(row), result%stresses, result%error)
         do k = rank, max(1, rank - most_pairs + 1), -1
            call offer_pair(result, component%values(k), column, component%vt(k, :), row, component%u(:, k))
         end do
      end associate
   end subroutine take_modes
end module flexact_dense_route
