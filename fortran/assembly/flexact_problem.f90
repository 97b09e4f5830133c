! SPDX-License-Identifier: BSD-3-Clause
!> The scaled D(c) of a model as a sparse matrix, its scales and its connected
!> components.
module flexact_problem
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_partition, only: partition_t, make_partition
   use flexact_components, only: components_t, find_components
   use flexact_scaling, only: scaling_t, make_scaling
   use flexact_sparse, only: sparse_t, operator_t, compress, transposed
   implicit none
   private
   public :: problem_t, make_problem

   type :: problem_t
      type(partition_t) :: partition
      type(scaling_t) :: scaling
      !> Reference length of each element [m], (elements).
      real(wp), allocatable :: length(:)
      !> The scaled matrix.
      type(operator_t) :: matrix
      type(components_t) :: components
   end type problem_t

contains

   !> is_plain: all scales are one.
   pure subroutine make_problem(model, is_plain, problem)
      type(model_t), intent(in) :: model
      logical, intent(in) :: is_plain
      type(problem_t), intent(out) :: problem
      type(jacobian_t) :: jacobian
      integer, allocatable :: row(:), column(:)
      integer :: entry

      call make_partition(model, problem%partition)
      call make_jacobian(model, model%node_value, jacobian)
      allocate (row(jacobian%entries), column(jacobian%entries))
      do entry = 1, jacobian%entries
         row(entry) = problem%partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
         column(entry) = problem%partition%column_of(jacobian%column(2, entry), jacobian%column(1, entry))
      end do
      associate (count => problem%partition%count)
         call compress(count%rows, count%columns, row, column, jacobian%value(:jacobian%entries), problem%matrix%by_column)
      end associate
      call transposed(problem%matrix%by_column, problem%matrix%by_row)
      call find_components(problem%matrix, problem%components)
      call make_scaling(model, problem%partition, jacobian, problem%components, problem%scaling)
      call move_alloc(jacobian%length, problem%length)
      if (is_plain) then
         problem%scaling%row = 1.0_wp
         problem%scaling%column = 1.0_wp
      end if
      call apply_scales(problem%scaling%row, problem%scaling%column, problem%matrix%by_column)
      call apply_scales(problem%scaling%column, problem%scaling%row, problem%matrix%by_row)
   end subroutine make_problem

   pure subroutine apply_scales(of_row, of_column, matrix)
      real(wp), intent(in) :: of_row(:), of_column(:)
      type(sparse_t), intent(inout) :: matrix
      integer :: j, entry

      do j = 1, matrix%columns
         do entry = matrix%start(j), matrix%start(j + 1) - 1
            matrix%value(entry) = matrix%value(entry)*(of_row(matrix%place(entry))*of_column(j))
         end do
      end do
   end subroutine apply_scales
end module flexact_problem
