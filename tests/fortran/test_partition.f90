! SPDX-License-Identifier: BSD-3-Clause
!> Counts, row and column order, and the Jacobian's entries on a small model
!> with every sort of node and class.
program test_partition
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_fixed, class_independent
   use flexact_slots, only: node_position, node_orientation
   use flexact_partition, only: model_count_t, partition_t, count_model, make_partition
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_element_table, only: find_element_kind
   use flexact_testing, only: tally_t
   use flexact_test_models, only: new_model, set_node, set_element, fix, release, twelve_trusses, fill_dense
   implicit none

   type(tally_t) :: tally

   call test_counts()
   call test_order()
   call test_empty_model()
   call test_trusses()
   call test_shared_orientation()
   call tally%finish()

contains

   !> A beam with its first end clamped and one released, one independent
   !> deformation; a truss from its far end, whose x is independent.
   function small_model() result(model)
      type(model_t) :: model

      model = new_model(5, 2)
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 2, node_orientation, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 3, node_position, [1.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 4, node_orientation, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 5, node_position, [1.0_wp, 1.0_wp, 0.0_wp])
      call fix(model, [1, 2])
      model%coordinate_class(1, 5) = class_independent
      model%coordinate_class(3, 5) = class_fixed
      call set_element(model, 1, find_element_kind('BEAM'), [1, 2, 3, 4])
      call set_element(model, 2, find_element_kind('TRUSS'), [3, 0, 5, 0])
      call release(model, 1, [2])
      model%deformation_class(5, 1) = class_independent
   end function small_model

   subroutine test_counts()
      type(model_count_t) :: counts
      type(model_t) :: model

      model = small_model()
      counts = count_model(model%coordinate_class, model%deformation_class)
      associate (x => counts%coordinates, e => counts%deformations)
         call tally%check(all([x%total, x%fixed, x%dependent, x%independent] == [15, 7, 7, 1]), 'coordinates')
         call tally%check(all([e%total, e%fixed, e%dependent, e%independent] == [7, 5, 1, 1]), 'deformations')
      end associate
      call tally%check(counts%rows == 6 .and. counts%columns == 7, 'rows and columns')
   end subroutine test_counts

   subroutine test_order()
      type(partition_t) :: partition
      integer, parameter :: rows(2, 6) = reshape([1, 1, 1, 3, 1, 4, 1, 5, 1, 6, 2, 1], [2, 6])
      integer, parameter :: columns(2, 7) = reshape([3, 1, 3, 2, 3, 3, 4, 1, 4, 2, 4, 3, 5, 2], [2, 7])

      call make_partition(small_model(), partition)
      call tally%check(all(partition%row_label == rows), 'row labels')
      call tally%check(all(partition%column_label == columns), 'column labels')
      call tally%check(all(partition%row_of(:, 1) == [1, 0, 2, 3, 4, 5]), 'rows of the beam')
      call tally%check(all(partition%row_of(:, 2) == [6, 0, 0, 0, 0, 0]), 'row of the truss')
      call tally%check(all(partition%column_of(:, 5) == [0, 7, 0]), 'columns of the last node')
   end subroutine test_order

   subroutine test_empty_model()
      type(partition_t) :: partition

      call make_partition(new_model(0, 0), partition)
      call tally%check(all(shape(partition%row_label) == [2, 0]) .and. &
                       all(shape(partition%column_label) == [2, 0]), 'empty model')
   end subroutine test_empty_model

   !> Rows 1 and 9 of the matrix that the paper prints.
   subroutine test_trusses()
      type(model_t) :: model
      type(partition_t) :: partition
      type(jacobian_t) :: jacobian
      real(wp), parameter :: r = sqrt(0.5_wp), o = 0.0_wp
      real(wp) :: dense(12, 12)

      model = twelve_trusses()
      call make_partition(model, partition)
      call make_jacobian(model, model%node_value, jacobian)
      call fill_dense(jacobian, partition, dense)
      call tally%near(dense(1, :), [r, o, r, o, o, o, o, o, o, o, o, o], 1.0e-15_wp, 'truss AE')
      call tally%near(dense(9, :), [-r, -r, o, r, r, o, o, o, o, o, o, o], 1.0e-15_wp, 'truss EF')
      call tally%check(jacobian%entries == 48, 'four entries a truss')
      call tally%near(jacobian%length, spread(sqrt(2.0_wp), 1, 12), 1.0e-15_wp, 'lengths')
   end subroutine test_trusses

   !> A beam on one orientation node at both ends: rotations about y and z add
   !> up, those about x cancel; the entries of a place are one.
   subroutine test_shared_orientation()
      type(model_t) :: model
      type(jacobian_t) :: jacobian
      type(partition_t) :: partition
      real(wp) :: dense(6, 3)

      model = new_model(3, 1)
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 2, node_orientation, [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 3, node_position, [2.0_wp, 0.0_wp, 0.0_wp])
      call fix(model, [1, 3])
      call set_element(model, 1, find_element_kind('BEAM'), [1, 2, 3, 2], [0.0_wp, 1.0_wp, 0.0_wp])
      call make_partition(model, partition)
      call make_jacobian(model, model%node_value, jacobian)
      call fill_dense(jacobian, partition, dense)
      call tally%near(dense(:, 1), [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp], 0.0_wp, 'no torsion')
      call tally%near(dense(:, 2), [0.0_wp, 0.0_wp, -2.0_wp, 2.0_wp, 0.0_wp, 0.0_wp], 1.0e-15_wp, 'about y')
      call tally%near(dense(:, 3), [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, -2.0_wp, 2.0_wp], 1.0e-15_wp, 'about z')
      call set_element(model, 1, find_element_kind('HINGE'), [0, 2, 0, 2], [1.0_wp, 0.0_wp, 0.0_wp])
      call make_jacobian(model, model%node_value, jacobian)
      call tally%check(jacobian%entries == 0, 'a hinge between a node and itself')
   end subroutine test_shared_orientation
end program test_partition
