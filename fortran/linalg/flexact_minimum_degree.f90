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

   !> Of which the first `count` are there.
   type :: list_t
      integer :: count = 0
      integer, allocatable :: item(:)
   end type list_t

   !> Groups not yet eliminated: which are joined with each directly (near), and through
   !> which eliminated ones (through); which are joined by each eliminated one (joined).
   type :: quotient_t
      type(list_t), allocatable :: near(:), through(:), joined(:)
      integer, allocatable :: weight(:), degree(:), mark(:)
      logical, allocatable :: is_gone(:), is_swallowed(:)
      integer :: stamp = 0
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
         associate (joined => graph%joined(of_groups(i))%item)
            parent(i) = 0
            if (size(joined) > 0) parent(i) = minval(place_of(joined))
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
      integer :: j, g, entry, found, list(groups)

      allocate (graph%near(groups), graph%through(groups), graph%joined(groups))
      allocate (graph%weight(groups), graph%degree(groups), graph%mark(groups), source=0)
      allocate (graph%is_gone(groups), graph%is_swallowed(groups), source=.false.)
      do j = 1, size(group)
         graph%weight(group(j)) = graph%weight(group(j)) + 1
      end do
      do j = 1, size(group)
         g = group(j)
         if (allocated(graph%near(g)%item)) cycle
         found = 0
         graph%mark(g) = j
         do entry = pattern%start(j), pattern%start(j + 1) - 1
            call meet(group(pattern%place(entry)), j, graph%mark, list, found)
         end do
         graph%near(g) = list_t(found, list(:found))
         ! Each that joins takes the place of one.
         graph%through(g) = list_t(0, list(:found))
      end do
      graph%stamp = size(group)
      do g = 1, groups
         graph%degree(g) = sum(graph%weight(graph%near(g)%item))
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
      integer :: reach(size(graph%weight)), found, i

      call collect(graph, pivot, reach, found)
      graph%is_gone(pivot) = .true.
      graph%is_swallowed(graph%through(pivot)%item(:graph%through(pivot)%count)) = .true.
      graph%joined(pivot) = list_t(found, reach(:found))
      do i = 1, found
         associate (near => graph%near(reach(i)), through => graph%through(reach(i)))
            ! What the new list joins needs no entry of its own.
            call keep(graph%mark(near%item(:near%count)) /= graph%stamp, near)
            call keep(.not. graph%is_swallowed(through%item(:through%count)), through)
            through%count = through%count + 1
            through%item(through%count) = pivot
         end associate
      end do
      do i = 1, found
         call find_degree(graph, reach(i))
      end do
   end subroutine eliminate

   pure subroutine keep(is_kept, list)
      logical, intent(in) :: is_kept(:)
      type(list_t), intent(inout) :: list
      integer :: i

      list%count = 0
      do i = 1, size(is_kept)
         if (.not. is_kept(i)) cycle
         list%count = list%count + 1
         list%item(list%count) = list%item(i)
      end do
   end subroutine keep

   !> All groups that one is joined with, itself left out; they are marked, and so is it.
   pure subroutine collect(graph, g, reach, found)
      type(quotient_t), intent(inout) :: graph
      integer, intent(in) :: g
      integer, intent(inout) :: reach(:)
      integer, intent(out) :: found
      integer :: i, k

      graph%stamp = graph%stamp + 1
      graph%mark(g) = graph%stamp
      found = 0
      do i = 1, graph%near(g)%count
         call meet(graph%near(g)%item(i), graph%stamp, graph%mark, reach, found)
      end do
      do k = 1, graph%through(g)%count
         associate (joined => graph%joined(graph%through(g)%item(k))%item)
            do i = 1, size(joined)
               if (.not. graph%is_gone(joined(i))) call meet(joined(i), graph%stamp, graph%mark, reach, found)
            end do
         end associate
      end do
   end subroutine collect

   pure subroutine find_degree(graph, g)
      type(quotient_t), intent(inout) :: graph
      integer, intent(in) :: g
      integer :: reach(size(graph%weight)), found

      call collect(graph, g, reach, found)
      graph%degree(g) = sum(graph%weight(reach(:found)))
   end subroutine find_degree
end module flexact_minimum_degree
