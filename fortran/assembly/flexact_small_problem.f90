! SPDX-License-Identifier: BSD-3-Clause
!> The scaled D(c) of a small model as a dense matrix, in less time than its components
!> take to be found.
module flexact_small_problem
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t
   use flexact_scaling, only: scaling_t, make_single_scaling
   implicit none
   private
   public :: small_problem_t, make_small_problem, plain_matrix

   type :: small_problem_t
      type(scaling_t) :: scaling
      !> (rows, columns).
      real(wp), allocatable :: matrix(:, :)
   end type small_problem_t

contains

   !> is_made: whether one length scales it all; else there is no matrix.
   pure subroutine make_small_problem(model, partition, problem, is_made)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      type(small_problem_t), intent(out) :: problem
      logical, intent(out) :: is_made
      type(jacobian_t) :: jacobian
      integer :: entry, i, j

      call make_jacobian(model, model%node_value, jacobian)
      call make_single_scaling(model, partition, jacobian, problem%scaling, is_made)
      if (.not. is_made) return
      allocate (problem%matrix(partition%count%rows, partition%count%columns), source=0.0_wp)
      do entry = 1, jacobian%entries
         i = partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
         j = partition%column_of(jacobian%column(2, entry), jacobian%column(1, entry))
         if (i == 0 .or. j == 0) cycle
         problem%matrix(i, j) = jacobian%value(entry)*(problem%scaling%row(i)*problem%scaling%column(j))
      end do
   end subroutine make_small_problem

   !> D(c) itself.
   pure function plain_matrix(problem) result(plain)
      type(small_problem_t), intent(in) :: problem
      real(wp) :: plain(size(problem%matrix, 1), size(problem%matrix, 2))
      integer :: j

      do j = 1, size(plain, 2)
         plain(:, j) = problem%matrix(:, j)/(problem%scaling%row*problem%scaling%column(j))
      end do
   end function plain_matrix
end module flexact_small_problem
