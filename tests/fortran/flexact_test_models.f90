! SPDX-License-Identifier: BSD-3-Clause
!> Small models made by hand for the unit tests, and their D(c) as a dense matrix.
module flexact_test_models
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_none, class_fixed, class_dependent
   use flexact_slots, only: node_position, node_orientation, has_axis
   use flexact_element_table, only: element_kinds, find_element_kind, deformations_of
   use flexact_partition, only: partition_t
   use flexact_jacobian, only: jacobian_t
   implicit none
   private
   public :: new_model, set_node, set_element, fix, release
   public :: twelve_trusses, folded_sheet, parallel_guide
   public :: fill_dense

contains

   !> Room for nodes and elements.
   function new_model(nodes, elements) result(model)
      integer, intent(in) :: nodes, elements
      type(model_t) :: model
      integer :: i

      model%nodes = nodes
      model%elements = elements
      allocate (model%node_number(nodes), source=[(i, i=1, nodes)])
      allocate (model%node_kind(nodes), source=node_position)
      allocate (model%node_value(4, nodes), source=0.0_wp)
      allocate (model%coordinate_class(3, nodes), source=class_none)
      allocate (model%element_number(elements), source=[(i, i=1, elements)])
      allocate (model%element_kind(elements), source=0)
      allocate (model%element_node(4, elements), source=0)
      allocate (model%element_vector(3, elements), source=0.0_wp)
      allocate (model%deformation_class(6, elements), source=class_none)
      allocate (model%element_origin(elements), source=0)
   end function new_model

   !> Kind and value of a node; all its coordinates are dependent.
   subroutine set_node(model, node, kind, value)
      type(model_t), intent(inout) :: model
      integer, intent(in) :: node, kind
      real(wp), intent(in) :: value(:)
      integer :: axis

      model%node_kind(node) = kind
      model%node_value(:, node) = 0.0_wp
      model%node_value(:size(value), node) = value
      do axis = 1, 3
         model%coordinate_class(axis, node) = merge(class_dependent, class_none, has_axis(kind, axis))
      end do
   end subroutine set_node

   !> Kind, nodes by slot and vector of an element; all its deformations are
   !> fixed.
   subroutine set_element(model, element, kind, node, vector)
      type(model_t), intent(inout) :: model
      integer, intent(in) :: element, kind, node(4)
      real(wp), intent(in), optional :: vector(3)

      model%element_kind(element) = kind
      model%element_node(:, element) = node
      if (present(vector)) model%element_vector(:, element) = vector
      model%deformation_class(:, element) = class_none
      model%deformation_class(:deformations_of(kind), element) = class_fixed
   end subroutine set_element

   !> Fix all coordinates of some nodes.
   subroutine fix(model, nodes)
      type(model_t), intent(inout) :: model
      integer, intent(in) :: nodes(:)

      where (model%coordinate_class(:, nodes) /= class_none)
         model%coordinate_class(:, nodes) = class_fixed
      end where
   end subroutine fix

   !> Release some deformations of an element.
   subroutine release(model, element, deformations)
      type(model_t), intent(inout) :: model
      integer, intent(in) :: element, deformations(:)
      model%deformation_class(deformations, element) = class_dependent
   end subroutine release

   !> Fig. 2 of the paper: nodes A to D, 1 to 4, fixed, E to H, 5 to 8, free.
   function twelve_trusses() result(model)
      type(model_t) :: model
      integer, parameter :: place(3, 8) = reshape([-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, &
                                                   0, -1, 1, 1, 0, 1, 0, 1, 1, -1, 0, 1], [3, 8])
      integer, parameter :: ends(2, 12) = reshape([1, 5, 2, 5, 2, 6, 3, 6, 3, 7, 4, 7, 4, 8, 1, 8, &
                                                   5, 6, 6, 7, 7, 8, 8, 5], [2, 12])
      integer :: i

      model = new_model(8, 12)
      do i = 1, 8
         call set_node(model, i, node_position, real(place(:, i), wp))
      end do
      call fix(model, [1, 2, 3, 4])
      do i = 1, 12
         call set_element(model, i, find_element_kind('TRUSS'), [ends(1, i), 0, ends(2, i), 0])
      end do
   end function twelve_trusses

   !> Two sheets in series, at right angles, clamped at both ends; local z
   !> lies in the plane of the sheets. Lengths in units of `size`.
   function folded_sheet(size) result(model)
      real(wp), intent(in) :: size
      type(model_t) :: model
      real(wp), parameter :: upright(4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      integer :: i

      model = new_model(6, 2)
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 3, node_position, [size, 0.0_wp, 0.0_wp])
      call set_node(model, 5, node_position, [size, size, 0.0_wp])
      do i = 2, 6, 2
         call set_node(model, i, node_orientation, upright)
      end do
      call fix(model, [1, 2, 5, 6])
      call set_element(model, 1, find_element_kind('BEAM'), [1, 2, 3, 4], [0.0_wp, 1.0_wp, 0.0_wp])
      call set_element(model, 2, find_element_kind('BEAM'), [3, 4, 5, 6], [1.0_wp, 0.0_wp, 0.0_wp])
      call release(model, 1, [2, 5, 6])
      call release(model, 2, [2, 5, 6])
   end function folded_sheet

   !> Two parallel sheets along x, a distance apart in y, that carry one body
   !> (their far ends share an orientation and are joined by a rigid beam);
   !> local z lies in the plane of the sheets.
   function parallel_guide(size) result(model)
      real(wp), intent(in) :: size
      type(model_t) :: model
      real(wp), parameter :: upright(4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp), parameter :: y(3) = [0.0_wp, 1.0_wp, 0.0_wp]
      integer :: i

      model = new_model(7, 3)
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 2, node_position, [size, 0.0_wp, 0.0_wp])
      call set_node(model, 3, node_position, [0.0_wp, size/3, 0.0_wp])
      call set_node(model, 4, node_position, [size, size/3, 0.0_wp])
      do i = 5, 7
         call set_node(model, i, node_orientation, upright)
      end do
      call fix(model, [1, 3, 5, 6])
      call set_element(model, 1, find_element_kind('BEAM'), [1, 5, 2, 7], y)
      call set_element(model, 2, find_element_kind('BEAM'), [3, 6, 4, 7], y)
      call release(model, 1, [2, 5, 6])
      call release(model, 2, [2, 5, 6])
      call set_element(model, 3, find_element_kind('RBEAM'), [2, 7, 4, 0])
   end function parallel_guide

   !> D(c), eq. (11), as a dense matrix (rows, columns).
   pure subroutine fill_dense(jacobian, partition, dense)
      type(jacobian_t), intent(in) :: jacobian
      type(partition_t), intent(in) :: partition
      real(wp), intent(out) :: dense(:, :)
      integer :: entry, i, j

      dense = 0.0_wp
      do entry = 1, jacobian%entries
         i = partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
         j = partition%column_of(jacobian%column(2, entry), jacobian%column(1, entry))
         if (i > 0 .and. j > 0) dense(i, j) = jacobian%value(entry)
      end do
   end subroutine fill_dense
end module flexact_test_models
