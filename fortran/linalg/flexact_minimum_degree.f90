! SPDX-License-Identifier: BSD-3-Clause
!> A fill-reducing order of a symmetric matrix: the column that is joined with the fewest
!> others is eliminated first (minimum degree; George and Liu, SIAM Review 31, 1989,
!> pp. 1-19), on groups of columns that share their pattern, in a quotient graph: what an
!> elimination joins is kept as one list, and those that it swallows are dropped.
module flexact_minimum_degree
   use flexact_elimination_tree, only: postorder
   use flexact_sorting, only: by_number
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: minimum_degree_order, column_groups

   !> Lists in one array: the items of list g are `count(g)` from `start(g)` on.
   type :: lists_t
      integer, allocatable :: start(:), count(:), item(:)
   end type lists_t

   !> Groups not yet eliminated: which are joined with each directly (near), and through
   !> which eliminated ones (through); which are joined by each eliminated one (joined).
   type :: quotient_t
      type(lists_t) :: near, through, joined
      integer, allocatable :: weight(:), degree(:), mark(:)
      logical, allocatable :: is_gone(:), is_swallowed(:)
      !> What a group is joined with, the one that was looked at last.
      integer, allocatable :: reach(:)
      integer :: found = 0, stamp = 0, used = 0
   end type quotient_t

contains

   !> The columns in the order of elimination, in which those that change a column stand right
   !> before it. Pattern: both triangles with the diagonal.
   pure subroutine minimum_degree_order(pattern, order)
      type(sparse_t), intent(in) :: pattern
      integer, intent(out) :: order(:)
      type(quotient_t) :: graph
      integer :: group(size(order)), groups, of_groups(size(order)), place_of(size(order)), i

      call column_groups(pattern, group, groups)
      call make_quotient(pattern, group, groups, graph)
      do i = 1, groups
         of_groups(i) = next_group(graph)
         place_of(of_groups(i)) = i
         call eliminate(graph, of_groups(i))
      end do
      call bring_together(graph, of_groups(:groups), place_of(:groups))
      order = by_number(place_of(group), groups)
   end subroutine minimum_degree_order

   !> Move groups such that those whose elimination changes one stand right before it. A group is
   !> changed by those that it is the first to be joined with.
   pure subroutine bring_together(graph, of_groups, place_of)
      type(quotient_t), intent(in) :: graph
      integer, intent(in) :: of_groups(:)
      integer, intent(inout) :: place_of(:)
      integer :: parent(size(of_groups)), order(size(of_groups)), room(2*size(of_groups) + 1), i

      do i = 1, size(of_groups)
         associate (first => graph%joined%start(of_groups(i)), count => graph%joined%count(of_groups(i)))
            parent(i) = 0
            if (count > 0) parent(i) = minval(place_of(graph%joined%item(first:first + count - 1)))
         end associate
      end do
      call postorder(parent, order, room(:size(order) + 1), room(size(order) + 2:))
      place_of(of_groups(order)) = [(i, i=1, size(order))]
   end subroutine bring_together

   !> The group of each column, numbered as they are met; those of one have the same pattern,
   !> and so each stands in the patterns of the others.
   pure subroutine column_groups(pattern, group, groups)
      type(sparse_t), intent(in) :: pattern
      integer, intent(out) :: group(:), groups
      integer :: key(size(group)), i, j, entry

      do j = 1, size(group)
         key(j) = sum(pattern%place(pattern%start(j):pattern%start(j + 1) - 1)/(pattern%start(j + 1) - pattern%start(j)))
      end do
      group = 0
      groups = 0
      do j = 1, size(group)
         if (group(j) /= 0) cycle
         groups = groups + 1
         group(j) = groups
         do entry = pattern%start(j), pattern%start(j + 1) - 1
            i = pattern%place(entry)
            if (group(i) /= 0 .or. key(i) /= key(j)) cycle
            if (is_same(pattern, i, j)) group(i) = groups
         end do
      end do
   end subroutine column_groups

   pure logical function is_same(pattern, i, j)
      type(sparse_t), intent(in) :: pattern
      integer, intent(in) :: i, j

      is_same = pattern%start(i + 1) - pattern%start(i) == pattern%start(j + 1) - pattern%start(j)
      if (is_same) is_same = all(pattern%place(pattern%start(i):pattern%start(i + 1) - 1) &
                                 == pattern%place(pattern%start(j):pattern%start(j + 1) - 1))
   end function is_same

   pure subroutine make_quotient(pattern, group, groups, graph)
      type(sparse_t), intent(in) :: pattern
      integer, intent(in) :: group(:), groups
      type(quotient_t), intent(out) :: graph
      integer :: j, g, k, entry

      allocate (graph%weight(groups), graph%degree(groups), graph%mark(groups), graph%reach(groups), source=0)
      allocate (graph%is_gone(groups), graph%is_swallowed(groups), source=.false.)
      allocate (graph%near%start(groups), graph%near%count(groups), graph%through%count(groups), &
                graph%joined%start(groups), graph%joined%count(groups), source=0)
      allocate (graph%near%item(size(pattern%place)), graph%joined%item(size(pattern%place)))
      do j = 1, size(group)
         graph%weight(group(j)) = graph%weight(group(j)) + 1
      end do
      k = 0
      do j = 1, size(group)
         g = group(j)
         if (graph%near%start(g) > 0) cycle
         graph%found = 0
         graph%mark(g) = j
         do entry = pattern%start(j), pattern%start(j + 1) - 1
            call meet(group(pattern%place(entry)), j, graph%mark, graph%reach, graph%found)
         end do
         graph%near%start(g) = k + 1
         graph%near%count(g) = graph%found
         graph%near%item(k + 1:k + graph%found) = graph%reach(:graph%found)
         k = k + graph%found
      end do
      ! Each that joins takes the place of one.
      graph%through%start = graph%near%start
      graph%through%item = graph%near%item
      graph%stamp = size(group)
      do g = 1, groups
         do k = graph%near%start(g), graph%near%start(g) + graph%near%count(g) - 1
            graph%degree(g) = graph%degree(g) + graph%weight(graph%near%item(k))
         end do
      end do
   end subroutine make_quotient

   !> Append what is met for the first time.
   pure subroutine meet(what, stamp, mark, list, found)
      integer, intent(in) :: what, stamp
      integer, intent(inout) :: mark(:), list(:), found

      if (mark(what) == stamp) return
      mark(what) = stamp
      found = found + 1
      list(found) = what
   end subroutine meet

   pure integer function next_group(graph) result(next)
      type(quotient_t), intent(in) :: graph

      next = minloc(graph%degree, 1,.not. graph%is_gone)
   end function next_group

   pure subroutine eliminate(graph, pivot)
      type(quotient_t), intent(inout) :: graph
      integer, intent(in) :: pivot
      integer :: i, k, g, kept

      call collect(graph, pivot)
      graph%is_gone(pivot) = .true.
      do k = graph%through%start(pivot), graph%through%start(pivot) + graph%through%count(pivot) - 1
         graph%is_swallowed(graph%through%item(k)) = .true.
      end do
      call keep_joined(graph, pivot)
      do i = 1, graph%found
         g = graph%reach(i)
         ! What the new list joins needs no entry of its own.
         kept = graph%near%start(g) - 1
         do k = graph%near%start(g), kept + graph%near%count(g)
            if (graph%mark(graph%near%item(k)) == graph%stamp) cycle
            kept = kept + 1
            graph%near%item(kept) = graph%near%item(k)
         end do
         graph%near%count(g) = kept + 1 - graph%near%start(g)
         kept = graph%through%start(g) - 1
         do k = graph%through%start(g), kept + graph%through%count(g)
            if (graph%is_swallowed(graph%through%item(k))) cycle
            kept = kept + 1
            graph%through%item(kept) = graph%through%item(k)
         end do
         graph%through%item(kept + 1) = pivot
         graph%through%count(g) = kept + 2 - graph%through%start(g)
      end do
      do k = graph%joined%start(pivot), graph%joined%start(pivot) + graph%joined%count(pivot) - 1
         g = graph%joined%item(k)
         call collect(graph, g)
         graph%degree(g) = 0
         do i = 1, graph%found
            graph%degree(g) = graph%degree(g) + graph%weight(graph%reach(i))
         end do
      end do
   end subroutine eliminate

   !> What was collected is what an eliminated group joins.
   pure subroutine keep_joined(graph, pivot)
      type(quotient_t), intent(inout) :: graph
      integer, intent(in) :: pivot
      integer, allocatable :: longer(:)

      if (graph%used + graph%found > size(graph%joined%item)) then
         allocate (longer(2*(graph%used + graph%found)))
         longer(:graph%used) = graph%joined%item(:graph%used)
         call move_alloc(longer, graph%joined%item)
      end if
      graph%joined%start(pivot) = graph%used + 1
      graph%joined%count(pivot) = graph%found
      graph%joined%item(graph%used + 1:graph%used + graph%found) = graph%reach(:graph%found)
      graph%used = graph%used + graph%found
   end subroutine keep_joined

   !> All groups that one is joined with, itself left out; they are marked, and so is it.
   pure subroutine collect(graph, g)
      type(quotient_t), intent(inout) :: graph
      integer, intent(in) :: g
      integer :: i, k, other

      graph%stamp = graph%stamp + 1
      graph%mark(g) = graph%stamp
      graph%found = 0
      do i = graph%near%start(g), graph%near%start(g) + graph%near%count(g) - 1
         call meet(graph%near%item(i), graph%stamp, graph%mark, graph%reach, graph%found)
      end do
      do k = graph%through%start(g), graph%through%start(g) + graph%through%count(g) - 1
         other = graph%through%item(k)
         do i = graph%joined%start(other), graph%joined%start(other) + graph%joined%count(other) - 1
            if (graph%is_gone(graph%joined%item(i))) cycle
            call meet(graph%joined%item(i), graph%stamp, graph%mark, graph%reach, graph%found)
         end do
      end do
   end subroutine collect
end module flexact_minimum_degree
