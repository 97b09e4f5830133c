! SPDX-License-Identifier: BSD-3-Clause
!> Some rows of D(c) by exact arithmetic, row by row.
module flexact_exact_matrix
   use flexact_exact_number, only: arithmetic_t, number_t
   use flexact_exact_rows, only: exact_element_t, make_exact_element, exact_row
   use flexact_model, only: model_t
   use flexact_partition, only: partition_t
   use flexact_slots, only: axes, slots
   implicit none
   private
   public :: exact_matrix_t, make_exact_matrix

   type :: exact_matrix_t
      !> Entries start(i) to start(i + 1) - 1 belong to row i.
      integer, allocatable :: start(:)
      !> Columns of D(c), and what stands there.
      integer, allocatable :: column(:)
      type(number_t), allocatable :: entry(:)
   end type exact_matrix_t

contains

   !> rows: which ones, ascending. place (3, nodes): node values as numbers, where there are many.
   pure subroutine make_exact_matrix(model, partition, rows, arithmetic, matrix, place)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      integer, intent(in) :: rows(:)
      type(arithmetic_t), intent(in) :: arithmetic
      type(exact_matrix_t), intent(out) :: matrix
      type(number_t), intent(in), optional :: place(:, :)
      type(exact_element_t) :: element
      type(number_t) :: row(axes*slots)
      integer :: i, used, most, latest

      most = 0
      do i = 1, size(rows)
         most = most + columns_of(model, partition, partition%row_label(1, rows(i)))
      end do
      allocate (matrix%start(size(rows) + 1), matrix%column(most), matrix%entry(most))
      used = 0
      latest = 0
      do i = 1, size(rows)
         associate (k => partition%row_label(1, rows(i)), deformation => partition%row_label(2, rows(i)))
            if (k /= latest) call make_exact_element(model, k, arithmetic, element, place)
            latest = k
            call exact_row(element, deformation, row)
            matrix%start(i) = used + 1
            call add_row(model, partition, k, row, matrix, used)
         end associate
      end do
      matrix%start(size(rows) + 1) = used + 1
      if (used == most) return
      matrix%column = matrix%column(:used)
      matrix%entry = matrix%entry(:used)
   end subroutine make_exact_matrix

   !> Columns of D(c) that an element meets.
   pure integer function columns_of(model, partition, k) result(columns)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      integer, intent(in) :: k
      integer :: slot

      columns = 0
      do slot = 1, slots
         associate (node => model%element_node(slot, k))
            if (node > 0) columns = columns + count(partition%column_of(:, node) > 0)
         end associate
      end do
   end function columns_of

   !> Keep what stands in columns of D(c) and is not zero.
   pure subroutine add_row(model, partition, k, row, matrix, used)
      type(model_t), intent(in) :: model
      type(partition_t), intent(in) :: partition
      integer, intent(in) :: k
      type(number_t), intent(in) :: row(:)
      type(exact_matrix_t), intent(inout) :: matrix
      integer, intent(inout) :: used
      integer :: slot, axis, column

      do slot = 1, slots
         associate (node => model%element_node(slot, k))
            if (node == 0) cycle
            do axis = 1, axes
               column = partition%column_of(axis, node)
               associate (entry => row(axes*(slot - 1) + axis))
                  if (column == 0 .or. (entry%residue == 0 .and. .not. abs(entry%value) > 0)) cycle
                  used = used + 1
                  matrix%column(used) = column
                  matrix%entry(used) = entry
               end associate
            end do
         end associate
      end do
   end subroutine add_row
end module flexact_exact_matrix
