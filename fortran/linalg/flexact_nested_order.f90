! SPDX-License-Identifier: BSD-3-Clause
!> A fill-reducing order of the columns of A'A, found on groups of columns that
!> share their rows: a graph several times smaller.
module flexact_nested_order
   use flexact_cholmod, only: cholmod_order
   use flexact_error, only: error_t, fail, error_memory
   use flexact_gram, only: gram_t, group_graph
   use flexact_sparse, only: operator_t
   implicit none
   private
   public :: nested_order

contains

   !> group (columns) ascends; the order counts from 0.
   subroutine nested_order(a, group, order, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      integer, allocatable, intent(out) :: order(:)
      type(error_t), allocatable, intent(out) :: error
      type(gram_t) :: graph
      integer, allocatable :: of_groups(:), first(:)
      integer :: groups, i, j, g

      groups = group(size(group))
      call group_graph(a, group, groups, graph)
      allocate (of_groups(groups), order(size(group)), first(groups + 1))
      if (cholmod_order(groups, graph%start, graph%place, of_groups) /= 0) then
         call fail(error_memory, error)
         return
      end if
      first(groups + 1) = size(group) + 1
      do j = size(group), 1, -1
         first(group(j)) = j
      end do
      i = 0
      do g = 1, groups
         do j = first(of_groups(g) + 1), first(of_groups(g) + 2) - 1
            i = i + 1
            order(i) = j - 1
         end do
      end do
   end subroutine nested_order
end module flexact_nested_order
