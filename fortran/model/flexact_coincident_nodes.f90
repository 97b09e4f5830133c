! SPDX-License-Identifier: BSD-3-Clause
!> Position nodes at one place that nothing joins.
module flexact_coincident_nodes
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_diagnostics, only: span_t, diagnostics_t
   use flexact_kinds, only: wp
   use flexact_labels, only: names_t, node_label
   use flexact_model, only: model_t
   use flexact_rigid_bodies, only: find_bodies, is_ground, is_rigid
   use flexact_slots, only: is_position
   use flexact_sorting, only: by_number, root_of, join
   use flexact_vectors, only: unit
   implicit none
   private
   public :: check_coincident_nodes

   !> Nodes are at one place that are nearer than this part of the model's extent.
   real(wp), parameter :: nearness = 1.0e-9_wp
   !> Cosine of the largest bend of a row of elements.
   real(wp), parameter :: straight = 0.9_wp

   !> A table of places, cell by cell.
   type :: table_t
      !> (3, nodes) positions over the largest coordinate.
      real(wp), allocatable :: position(:, :)
      real(wp) :: nearness, cell
      !> First node of each slot of the table, and the next one after each node.
      integer, allocatable :: first(:), next(:)
   end type table_t

contains

   !> Warn of each node that has another one at its place, where neither an element
   !> nor a rigid body joins them; not of two inner nodes, which may well pass each
   !> other, as those of crossed sheets do.
   subroutine check_coincident_nodes(model, names, diagnostics)
      type(model_t), intent(in) :: model
      type(names_t), intent(in) :: names
      type(diagnostics_t), intent(inout) :: diagnostics
      integer :: place(model%nodes), set(model%nodes), i, root
      logical :: told(model%nodes), inner(model%nodes)

      call find_places(model, place)
      if (all(place == 0)) return
      call find_sets(model, place, set)
      call find_inner(model, place, inner)
      told = .false.
      do i = 1, model%nodes
         if (place(i) == 0 .or. place(i) == i) cycle
         call root_of(set, place(i), root)
         told(root) = .true.
         call root_of(set, i, root)
         if (told(root)) cycle
         if (inner(i) .and. inner(place(i))) cycle
         told(root) = .true.
         call diagnostics%warning('coincident-nodes', span_t(model%node_origin(i), 0), node_label(model, names, place(i))// &
                                  ' and '//node_label(model, names, i)//' are at one place, and nothing joins them', &
                                  'nothing joins the two', 'use one node for both, or join them, as by a rigid body or a hinge', &
                                  span_t(model%node_origin(place(i)), 0))
      end do
   end subroutine check_coincident_nodes

   !> The first node at the place of each position node that shares it; 0 of others.
   subroutine find_places(model, place)
      type(model_t), intent(in) :: model
      integer, intent(out) :: place(:)
      type(table_t) :: table
      integer :: i, found

      place = 0
      call make_table(model, table)
      do i = 1, model%nodes
         if (.not. is_position(model%node_kind(i))) cycle
         call find(table, i, found)
         if (found == 0) cycle
         place(i) = found
         place(found) = found
      end do
   end subroutine find_places

   pure subroutine make_table(model, table)
      type(model_t), intent(in) :: model
      type(table_t), intent(out) :: table
      real(wp) :: largest, low(3), high(3)
      integer :: i

      allocate (table%position(3, model%nodes), source=0.0_wp)
      do i = 1, model%nodes
         if (is_position(model%node_kind(i))) table%position(:, i) = model%node_value(:3, i)
      end do
      largest = maxval(abs(table%position))
      if (largest > 0.0_wp) table%position = table%position/largest
      low = 1.0_wp
      high = -1.0_wp
      do i = 1, model%nodes
         if (.not. is_position(model%node_kind(i))) cycle
         low = min(low, table%position(:, i))
         high = max(high, table%position(:, i))
      end do
      table%nearness = max(nearness*maxval(high - low), 4*epsilon(1.0_wp))
      table%cell = 16*table%nearness
      allocate (table%first(0:2*model%nodes), source=0)
      allocate (table%next(model%nodes), source=0)
   end subroutine make_table

   !> A node before i at its place; where there is none it is 0, and i is entered.
   pure subroutine find(table, i, found)
      type(table_t), intent(inout) :: table
      integer, intent(in) :: i
      integer, intent(out) :: found
      integer(int64) :: own(3), beside(3)
      integer :: x, y, z, slot

      associate (position => table%position(:, i))
         own = floor((position + 1.0_wp)/table%cell, int64)
         ! What is as near as that may stand in the cell beside this one.
         beside = floor((position + 1.0_wp - 2*table%nearness)/table%cell, int64)
         where (beside == own) beside = floor((position + 1.0_wp + 2*table%nearness)/table%cell, int64)
      end associate
      do x = 0, merge(1, 0, beside(1) /= own(1))
         do y = 0, merge(1, 0, beside(2) /= own(2))
            do z = 0, merge(1, 0, beside(3) /= own(3))
               found = table%first(slot_of(table, merge(own, beside, [x, y, z] == 0)))
               do while (found > 0)
                  if (all(abs(table%position(:, found) - table%position(:, i)) <= table%nearness)) return
                  found = table%next(found)
               end do
            end do
         end do
      end do
      slot = slot_of(table, own)
      table%next(i) = table%first(slot)
      table%first(slot) = i
   end subroutine find

   pure integer function slot_of(table, cell) result(slot)
      type(table_t), intent(in) :: table
      integer(int64), intent(in) :: cell(3)
      !> Primes; their products with what is below the first, and the sum, fit 64 bits.
      integer(int64), parameter :: modulus = 2147483647_int64
      integer(int64), parameter :: factor(3) = [73856093_int64, 19349663_int64, 83492791_int64]

      slot = int(modulo(sum(modulo(cell, modulus)*factor), size(table%first, kind=int64)))
   end function slot_of

   !> Sets of nodes at one place that belong together: an element joins them, or they
   !> are of one rigid body, or of the ground.
   subroutine find_sets(model, place, set)
      type(model_t), intent(in) :: model
      integer, intent(in) :: place(:)
      integer, intent(out) :: set(:)
      integer :: body(model%nodes + 1), i, k

      set = [(i, i=1, model%nodes)]
      do k = 1, model%elements
         associate (p => model%element_node(1, k), q => model%element_node(3, k))
            if (p == 0 .or. q == 0) cycle
            if (place(p) > 0 .and. place(p) == place(q)) call join(set, p, q)
         end associate
      end do
      call find_bodies(model, body)
      call join_bodies(model, place, body, set)
   end subroutine find_sets

   !> Join nodes at one place that are of one body.
   subroutine join_bodies(model, place, body, set)
      type(model_t), intent(in) :: model
      integer, intent(in) :: place(:), body(:)
      integer, intent(inout) :: set(:)
      !> Nodes that share a place, and the bodies that they are of.
      integer, allocatable :: node(:), of_body(:), order(:)
      integer :: count, i, k, slot

      allocate (node(2*model%elements + model%nodes), of_body(2*model%elements + model%nodes))
      count = 0
      do i = 1, model%nodes
         if (place(i) > 0) then
            if (is_ground(model, i)) call add(i, body(model%nodes + 1))
         end if
      end do
      do k = 1, model%elements
         if (model%element_node(2, k) == 0) cycle
         if (.not. is_rigid(model, k)) cycle
         do slot = 1, 3, 2
            i = model%element_node(slot, k)
            if (i == 0) cycle
            if (place(i) > 0) call add(i, body(model%element_node(2, k)))
         end do
      end do
      order = by_number(of_body(:count), size(body))
      order = order(by_number(place(node(order)), model%nodes))
      do k = 2, count
         associate (one => order(k - 1), two => order(k))
            if (of_body(one) == of_body(two) .and. place(node(one)) == place(node(two))) call join(set, node(one), node(two))
         end associate
      end do

   contains

      subroutine add(i, its_body)
         integer, intent(in) :: i, its_body

         count = count + 1
         node(count) = i
         of_body(count) = its_body
      end subroutine add
   end subroutine join_bodies

   !> Whether two elements of one kind meet in a node in a row and nothing else does, or
   !> rigid ones alone; asked of nodes that share a place.
   subroutine find_inner(model, place, inner)
      type(model_t), intent(in) :: model
      integer, intent(in) :: place(:)
      logical, intent(out) :: inner(:)
      integer :: users(model%nodes), user(2, model%nodes), i, k, slot
      logical :: all_rigid(model%nodes)

      users = 0
      all_rigid = .true.
      do k = 1, model%elements
         do slot = 1, 3, 2
            i = model%element_node(slot, k)
            if (i == 0) cycle
            if (place(i) == 0) cycle
            users(i) = users(i) + 1
            if (users(i) <= 2) user(users(i), i) = k
            all_rigid(i) = all_rigid(i) .and. is_rigid(model, k)
         end do
      end do
      do i = 1, model%nodes
         inner(i) = users(i) >= 2 .and. all_rigid(i)
         if (users(i) == 2) inner(i) = inner(i) .or. is_row(model, i, user(1, i), user(2, i))
      end do
   end subroutine find_inner

   pure logical function is_row(model, node, one, two)
      type(model_t), intent(in) :: model
      integer, intent(in) :: node, one, two

      is_row = model%element_kind(one) == model%element_kind(two)
      if (is_row) is_row = dot_product(away(one), away(two)) < -straight
   contains
      !> The direction in which an element leaves the node.
      pure function away(k)
         integer, intent(in) :: k
         real(wp) :: away(3)

         associate (p => model%element_node(1, k), q => model%element_node(3, k))
            away = unit(model%node_value(:3, p + q - node)/2 - model%node_value(:3, node)/2)
         end associate
      end function away
   end function is_row
end module flexact_coincident_nodes
