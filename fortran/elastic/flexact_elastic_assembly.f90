! SPDX-License-Identifier: BSD-3-Clause
!> Sparse matrices of the elements: stiffness with second derivatives, and mass.
module flexact_elastic_assembly
   use flexact_elastic_layout, only: layout_t
   use flexact_elastic_model, only: elastic_model_t
   use flexact_elastic_tangent, only: tangent_t
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: assemble_stiffness, assemble_hessian, assemble_mass

contains

   !> D'S D, and H where it is wanted. least: what the terms of each diagonal entry sum up to in
   !> magnitude.
   subroutine assemble_stiffness(elastic, tangent, layout, with_hessian, matrix, least)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(layout_t), intent(in) :: layout
      logical, intent(in) :: with_hessian
      type(sparse_t), intent(inout) :: matrix
      real(wp), allocatable, intent(out) :: least(:)
      ! Of fixed size, so that products are made in place.
      real(wp) :: block(12, 12), terms(12), d(6, 12), s(6, 6), stressed(6, 12)
      integer :: k, i

      call clear(layout, matrix)
      allocate (least(layout%columns), source=0.0_wp)
      do k = 1, elastic%model%elements
         d = tangent%derivative(:, :, k)
         s = elastic%stiffness(:, :, k)
         stressed = matmul(s, d)
         block = matmul(transpose(d), stressed)
         terms = [(abs(block(i, i)), i=1, 12)]
         if (with_hessian) then
            block = block + tangent%hessian(:, :, k)
            terms = terms + [(abs(tangent%hessian(i, i, k)), i=1, 12)]
         end if
         call add_block(elastic, layout%of_element(:, :, k), elastic%entry(:, k), block, matrix)
         do i = 1, 12
            if (elastic%entry(i, k) == 0) cycle
            associate (j => layout%column(elastic%entry(i, k)))
               if (j > 0) least(j) = least(j) + terms(i)/elastic%scale(elastic%entry(i, k))**2
            end associate
         end do
      end do
      if (with_hessian) call add_nodes(elastic, tangent, layout, matrix, least)
   end subroutine assemble_stiffness

   !> H alone.
   subroutine assemble_hessian(elastic, tangent, layout, matrix)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(layout_t), intent(in) :: layout
      type(sparse_t), intent(inout) :: matrix
      real(wp) :: unused(layout%columns)
      integer :: k

      call clear(layout, matrix)
      do k = 1, elastic%model%elements
         call add_block(elastic, layout%of_element(:, :, k), elastic%entry(:, k), tangent%hessian(:, :, k), matrix)
      end do
      unused = 0.0_wp
      call add_nodes(elastic, tangent, layout, matrix, unused)
   end subroutine assemble_hessian

   subroutine assemble_mass(elastic, tangent, layout, matrix)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(layout_t), intent(in) :: layout
      type(sparse_t), intent(inout) :: matrix
      integer :: k, node

      call clear(layout, matrix)
      do k = 1, elastic%model%elements
         call add_block(elastic, layout%of_element(:, :, k), elastic%entry(:, k), tangent%mass(:, :, k), matrix)
      end do
      do node = 1, elastic%model%nodes
         call add_block(elastic, layout%of_node(:, :, node), axes*(node - 1) + [1, 2, 3], tangent%node_mass(:, :, node), matrix)
      end do
   end subroutine assemble_mass

   pure subroutine clear(layout, matrix)
      type(layout_t), intent(in) :: layout
      type(sparse_t), intent(inout) :: matrix

      if (.not. allocated(matrix%value)) matrix = layout%matrix
      matrix%value = 0.0_wp
   end subroutine clear

   pure subroutine add_nodes(elastic, tangent, layout, matrix, least)
      type(elastic_model_t), intent(in) :: elastic
      type(tangent_t), intent(in) :: tangent
      type(layout_t), intent(in) :: layout
      type(sparse_t), intent(inout) :: matrix
      real(wp), intent(inout) :: least(:)
      integer :: node, i

      do node = 1, elastic%model%nodes
         if (.not. any(abs(tangent%node_hessian(:, :, node)) > 0)) cycle
         do i = 1, axes
            associate (j => layout%column(axes*(node - 1) + i), scale => elastic%scale(axes*node))
               if (j > 0) least(j) = least(j) + abs(tangent%node_hessian(i, i, node))/scale**2
            end associate
         end do
         call add_block(elastic, layout%of_node(:, :, node), axes*(node - 1) + [1, 2, 3], tangent%node_hessian(:, :, node), &
                        matrix)
      end do
   end subroutine add_nodes

   pure subroutine add_block(elastic, place, entry, block, matrix)
      type(elastic_model_t), intent(in) :: elastic
      integer, intent(in) :: place(:, :), entry(:)
      real(wp), intent(in) :: block(:, :)
      type(sparse_t), intent(inout) :: matrix
      real(wp) :: unit(size(entry))
      integer :: i, j

      unit = 1.0_wp
      do i = 1, size(entry)
         if (entry(i) > 0) unit(i) = 1/elastic%scale(entry(i))
      end do
      do j = 1, size(entry)
         do i = 1, size(entry)
            if (place(i, j) > 0) matrix%value(place(i, j)) = matrix%value(place(i, j)) + block(i, j)*unit(i)*unit(j)
         end do
      end do
   end subroutine add_block
end module flexact_elastic_assembly
