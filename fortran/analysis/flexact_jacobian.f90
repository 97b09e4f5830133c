!> The Jacobian D_x of all deformations with respect to all coordinates,
!> eq. (8), as a list of entries, and D(c), eq. (11), as a dense matrix.
module flexact_jacobian
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_none, most_deformations
   use flexact_pose, only: pose_t, reference_t
   use flexact_element, only: make_reference, make_poses, element_deformation
   use flexact_element_table, only: element_kinds
   use flexact_partition, only: partition_t, model_count_t, count_model, axes
   implicit none
   private
   public :: jacobian_t, make_jacobian, fill_dense

   !> Entry i stands at deformation row(2, i) of element row(1, i) and at axis
   !> column(2, i) of node column(1, i). No place occurs twice; the entries of
   !> one row stand together; exact zeros are left out.
   type :: jacobian_t
      integer :: entries = 0
      integer, allocatable :: row(:, :)
      integer, allocatable :: column(:, :)
      real(wp), allocatable :: value(:)
      !> Deformations, (6, elements), and reference lengths [m], (elements).
      real(wp), allocatable :: deformation(:, :)
      real(wp), allocatable :: length(:)
   end type jacobian_t

contains

   !> Deformations and D_x in a configuration given as node values (4, nodes);
   !> c_t (elements) is the constant in e1 of eq. (3), zero without it.
   pure subroutine make_jacobian(model, configuration, jacobian, c_t)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: configuration(:, :)
      type(jacobian_t), intent(out) :: jacobian
      real(wp), intent(in), optional :: c_t(:)
      type(model_count_t) :: counts
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: derivative(most_deformations, 12)
      integer :: k

      call count_model(model, counts)
      allocate (jacobian%row(2, counts%entries), jacobian%column(2, counts%entries), &
                jacobian%value(counts%entries))
      allocate (jacobian%deformation(most_deformations, model%elements), jacobian%length(model%elements))
      do k = 1, model%elements
         call make_reference(model, k, reference)
         if (present(c_t)) reference%c_t = c_t(k)
         call make_poses(model, k, configuration, p, q)
         call element_deformation(model%element_kind(k), reference, p, q, &
                                  jacobian%deformation(:, k), derivative)
         jacobian%length(k) = reference%length
         call add_element(model, k, derivative, jacobian)
      end do
   end subroutine make_jacobian

   !> Append the entries of element k.
   pure subroutine add_element(model, k, derivative, jacobian)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp), intent(inout) :: derivative(:, :)
      type(jacobian_t), intent(inout) :: jacobian
      integer :: i, slot, axis, node

      call join_ends(model%element_node(:, k), derivative)
      do i = 1, element_kinds(model%element_kind(k))%deformations
         do slot = 1, 4
            node = model%element_node(slot, k)
            if (node == 0) cycle
            do axis = 1, axes
               associate (value => derivative(i, axes*(slot - 1) + axis))
                  if (model%coordinate_class(axis, node) == class_none .or. .not. abs(value) > 0) cycle
                  call add_entry(jacobian, [k, i], [node, axis], value)
               end associate
            end do
         end do
      end do
   end subroutine add_element

   !> Where both ends share a node, its derivative is the sum of the two.
   pure subroutine join_ends(node, derivative)
      integer, intent(in) :: node(:)
      real(wp), intent(inout) :: derivative(:, :)

      if (node(1) == node(3)) then
         derivative(:, 1:3) = derivative(:, 1:3) + derivative(:, 7:9)
         derivative(:, 7:9) = 0.0_wp
      end if
      if (node(2) == node(4)) then
         derivative(:, 4:6) = derivative(:, 4:6) + derivative(:, 10:12)
         derivative(:, 10:12) = 0.0_wp
      end if
   end subroutine join_ends

   pure subroutine add_entry(jacobian, row, column, value)
      type(jacobian_t), intent(inout) :: jacobian
      integer, intent(in) :: row(2), column(2)
      real(wp), intent(in) :: value

      jacobian%entries = jacobian%entries + 1
      jacobian%row(:, jacobian%entries) = row
      jacobian%column(:, jacobian%entries) = column
      jacobian%value(jacobian%entries) = value
   end subroutine add_entry

   !> D(c) as a dense matrix (rows, columns) with its rows multiplied by
   !> row_scale and its columns by column_scale where they are given.
   pure subroutine fill_dense(jacobian, partition, dense, row_scale, column_scale)
      type(jacobian_t), intent(in) :: jacobian
      type(partition_t), intent(in) :: partition
      real(wp), intent(out) :: dense(:, :)
      real(wp), intent(in), optional :: row_scale(:), column_scale(:)
      real(wp) :: value
      integer :: entry, i, j

      dense = 0.0_wp
      do entry = 1, jacobian%entries
         i = partition%row_of(jacobian%row(2, entry), jacobian%row(1, entry))
         j = partition%column_of(jacobian%column(2, entry), jacobian%column(1, entry))
         if (i == 0 .or. j == 0) cycle
         value = jacobian%value(entry)
         if (present(column_scale)) value = value*column_scale(j)
         if (present(row_scale)) value = value*row_scale(i)
         dense(i, j) = value
      end do
   end subroutine fill_dense
end module flexact_jacobian
