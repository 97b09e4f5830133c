! SPDX-License-Identifier: BSD-3-Clause
!> Where the matrices of elements and nodes stand in a sparse matrix of all free entries of a
!> vector: found once for a model.
module flexact_elastic_layout
   use flexact_elastic_model, only: elastic_model_t
   use flexact_kinds, only: wp
   use flexact_slots, only: axes, slots
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: layout_t, make_layout, free_part, whole_vector

   !> Columns are free entries, scaled so that all are lengths.
   type :: layout_t
      integer :: columns = 0
      !> The column of each entry of a vector, 0 where it is not free; the entry of each column.
      integer, allocatable :: column(:), entry(:)
      !> Both triangles; only the pattern counts.
      type(sparse_t) :: matrix
      !> (12, 12, elements) and (3, 3, nodes): places among its values, 0 where there is none.
      integer, allocatable :: of_element(:, :, :), of_node(:, :, :)
   end type layout_t

contains

   subroutine make_layout(elastic, layout)
      type(elastic_model_t), intent(in) :: elastic
      type(layout_t), intent(out) :: layout
      integer :: i

      layout%columns = count(elastic%is_free)
      layout%entry = pack([(i, i=1, size(elastic%is_free))], elastic%is_free)
      allocate (layout%column(size(elastic%is_free)), source=0)
      layout%column(layout%entry) = [(i, i=1, layout%columns)]
      call fill_pattern(elastic, layout)
   end subroutine make_layout

   !> Columns of a node all have the rows of all nodes that share an element with it.
   subroutine fill_pattern(elastic, layout)
      type(elastic_model_t), intent(in) :: elastic
      type(layout_t), intent(inout) :: layout
      integer, allocatable :: start(:), neighbour(:)
      integer :: node, axis, i, j, next

      call find_neighbours(elastic, start, neighbour)
      associate (n => layout%columns, matrix => layout%matrix)
         matrix%rows = n
         matrix%columns = n
         allocate (matrix%start(n + 1), matrix%place(axes*axes*size(neighbour)))
         next = 1
         do node = 1, elastic%model%nodes
            do axis = 1, axes
               j = layout%column(axes*(node - 1) + axis)
               if (j == 0) cycle
               matrix%start(j) = next
               do i = start(node), start(node + 1) - 1
                  call add_rows(layout, neighbour(i), next)
               end do
            end do
         end do
         matrix%start(n + 1) = next
         matrix%place = matrix%place(:next - 1)
         allocate (matrix%value(next - 1), source=0.0_wp)
      end associate
      call find_places(elastic, layout)
   end subroutine fill_pattern

   pure subroutine add_rows(layout, node, next)
      type(layout_t), intent(inout) :: layout
      integer, intent(in) :: node
      integer, intent(inout) :: next
      integer :: axis

      do axis = axes*(node - 1) + 1, axes*node
         if (layout%column(axis) == 0) cycle
         layout%matrix%place(next) = layout%column(axis)
         next = next + 1
      end do
   end subroutine add_rows

   !> The nodes that share an element with each node, itself first, in no order.
   subroutine find_neighbours(elastic, start, neighbour)
      type(elastic_model_t), intent(in) :: elastic
      integer, allocatable, intent(out) :: start(:), neighbour(:)
      integer :: seen(elastic%model%nodes), first(elastic%model%nodes + 1), node, i, slot, found, other
      integer, allocatable :: owner(:)

      associate (model => elastic%model)
         call find_owners(elastic, first, owner)
         allocate (start(model%nodes + 1), neighbour(model%nodes + slots*size(owner)))
         seen = 0
         found = 0
         do node = 1, model%nodes
            found = found + 1
            start(node) = found
            neighbour(found) = node
            seen(node) = node
            do i = first(node), first(node + 1) - 1
               do slot = 1, slots
                  other = model%element_node(slot, owner(i))
                  if (other == 0) cycle
                  if (seen(other) == node) cycle
                  seen(other) = node
                  found = found + 1
                  neighbour(found) = other
               end do
            end do
         end do
         start(model%nodes + 1) = found + 1
         neighbour = neighbour(:found)
      end associate
   end subroutine find_neighbours

   !> The elements at each node: those of node i from first(i) to first(i + 1) - 1.
   subroutine find_owners(elastic, first, owner)
      type(elastic_model_t), intent(in) :: elastic
      integer, intent(out) :: first(:)
      integer, allocatable, intent(out) :: owner(:)
      integer :: next(elastic%model%nodes), k, slot, node

      associate (nodes => elastic%model%nodes, of => elastic%model%element_node)
         first = 0
         do k = 1, size(of, 2)
            do slot = 1, slots
               if (of(slot, k) > 0) first(of(slot, k) + 1) = first(of(slot, k) + 1) + 1
            end do
         end do
         first(1) = 1
         do node = 1, nodes
            first(node + 1) = first(node) + first(node + 1)
         end do
         allocate (owner(first(nodes + 1) - 1))
         next = first(:nodes)
         do k = 1, size(of, 2)
            do slot = 1, slots
               node = of(slot, k)
               if (node == 0) cycle
               owner(next(node)) = k
               next(node) = next(node) + 1
            end do
         end do
      end associate
   end subroutine find_owners

   subroutine find_places(elastic, layout)
      type(elastic_model_t), intent(in) :: elastic
      type(layout_t), intent(inout) :: layout
      integer :: k, j, node, axis

      allocate (layout%of_element(axes*slots, axes*slots, elastic%model%elements))
      allocate (layout%of_node(axes, axes, elastic%model%nodes))
      do k = 1, elastic%model%elements
         do j = 1, axes*slots
            call places_in(layout, elastic%entry(:, k), elastic%entry(j, k), layout%of_element(:, j, k))
         end do
      end do
      do node = 1, elastic%model%nodes
         do axis = 1, axes
            call places_in(layout, axes*(node - 1) + [1, 2, 3], axes*(node - 1) + axis, layout%of_node(:, axis, node))
         end do
      end do
   end subroutine find_places

   !> Where some entries stand in the column of one.
   pure subroutine places_in(layout, rows, entry, place)
      type(layout_t), intent(in) :: layout
      integer, intent(in) :: rows(:), entry
      integer, intent(out) :: place(:)
      integer :: i, p

      place = 0
      if (entry == 0) return
      if (layout%column(entry) == 0) return
      do i = 1, size(rows)
         if (rows(i) == 0) cycle
         if (layout%column(rows(i)) == 0) cycle
         do p = layout%matrix%start(layout%column(entry)), layout%matrix%start(layout%column(entry) + 1) - 1
            if (layout%matrix%place(p) == layout%column(rows(i))) exit
         end do
         place(i) = p
      end do
   end subroutine places_in

   !> What a vector of forces has in the columns.
   pure function free_part(elastic, layout, f) result(part)
      type(elastic_model_t), intent(in) :: elastic
      type(layout_t), intent(in) :: layout
      real(wp), intent(in) :: f(:)
      real(wp) :: part(layout%columns)

      part = f(layout%entry)/elastic%scale(layout%entry)
   end function free_part

   !> The vector of displacements that is this in the columns, and zero elsewhere.
   pure function whole_vector(elastic, layout, part) result(v)
      type(elastic_model_t), intent(in) :: elastic
      type(layout_t), intent(in) :: layout
      real(wp), intent(in) :: part(:)
      real(wp) :: v(size(layout%column))

      v = 0.0_wp
      v(layout%entry) = part/elastic%scale(layout%entry)
   end function whole_vector
end module flexact_elastic_layout
