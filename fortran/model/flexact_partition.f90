! SPDX-License-Identifier: BSD-3-Clause
!> The partition of coordinates and deformations into fixed (o), dependent (c)
!> and independent (m), eqs. (6), (7) and (13) to (15), and the order of the
!> rows and columns of D(c), eq. (11).
module flexact_partition
   use flexact_model, only: model_t, class_none, class_fixed, class_dependent, class_independent
   implicit none
   private
   public :: class_count_t, model_count_t, partition_t
   public :: count_model, make_partition

   type :: class_count_t
      integer :: total = 0
      integer :: fixed = 0
      integer :: dependent = 0
      integer :: independent = 0
   end type class_count_t

   type :: model_count_t
      type(class_count_t) :: coordinates
      !> A released deformation counts as dependent.
      type(class_count_t) :: deformations
      !> Rows of D(c), fixed and independent deformations, and its columns,
      !> dependent coordinates: the two sides of eq. (13).
      integer :: rows = 0
      integer :: columns = 0
   end type model_count_t

   !> Rows: elements in order, deformations in order. Columns: nodes in order,
   !> axes in order.
   type :: partition_t
      type(model_count_t) :: count
      !> Element and deformation of each row, (2, rows).
      integer, allocatable :: row_label(:, :)
      !> Node and axis of each column, (2, columns).
      integer, allocatable :: column_label(:, :)
      !> Row of each deformation, (6, elements), and column of each coordinate,
      !> (3, nodes); 0 where it is not in D(c).
      integer, allocatable :: row_of(:, :)
      integer, allocatable :: column_of(:, :)
   end type partition_t

contains

   !> Count the classes of all coordinates and deformations, and the rows and
   !> columns that follow from them.
   pure function count_model(coordinate_class, deformation_class) result(counts)
      integer, intent(in) :: coordinate_class(:, :), deformation_class(:, :)
      type(model_count_t) :: counts

      counts%coordinates = count_classes(coordinate_class)
      counts%deformations = count_classes(deformation_class)
      counts%rows = counts%deformations%fixed + counts%deformations%independent
      counts%columns = counts%coordinates%dependent
   end function count_model

   pure type(class_count_t) function count_classes(class) result(counts)
      integer, intent(in) :: class(:, :)
      counts%total = count(class /= class_none)
      counts%fixed = count(class == class_fixed)
      counts%dependent = count(class == class_dependent)
      counts%independent = count(class == class_independent)
   end function count_classes

   !> Count the model and number the rows and columns of D(c).
   pure subroutine make_partition(model, partition)
      type(model_t), intent(in) :: model
      type(partition_t), intent(out) :: partition

      partition%count = count_model(model%coordinate_class, model%deformation_class)
      call number_classes(model%deformation_class, [class_fixed, class_independent], &
                          partition%count%rows, partition%row_of, partition%row_label)
      call number_classes(model%coordinate_class, [class_dependent, class_dependent], &
                          partition%count%columns, partition%column_of, partition%column_label)
   end subroutine make_partition

   !> Number what belongs to one of two classes, column by column.
   pure subroutine number_classes(class, wanted, total, number_of, label)
      integer, intent(in) :: class(:, :), wanted(2), total
      integer, allocatable, intent(out) :: number_of(:, :), label(:, :)
      integer :: i, j, number

      allocate (number_of(size(class, 1), size(class, 2)), source=0)
      allocate (label(2, total))
      number = 0
      do j = 1, size(class, 2)
         do i = 1, size(class, 1)
            if (.not. any(class(i, j) == wanted)) cycle
            number = number + 1
            number_of(i, j) = number
            label(:, number) = [j, i]
         end do
      end do
   end subroutine number_classes
end module flexact_partition
