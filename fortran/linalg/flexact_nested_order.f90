! SPDX-License-Identifier: BSD-3-Clause
!> Orders in which the columns of A'A are eliminated: along a band where it is narrow, else one
!> that keeps the fill low, found on groups of columns that share their rows: a graph several
!> times smaller.
module flexact_nested_order
   use flexact_components, only: breadth_first_order
   use flexact_dissection, only: dissection_order
   use flexact_error, only: error_t, fail, error_memory
   use flexact_gram, only: gram_t, group_graph
   use flexact_kinds, only: wp
   use flexact_metis, only: metis_is_there, metis_order
   use flexact_sparse, only: sparse_t, operator_t
   implicit none
   private
   public :: elimination_order, envelope, nested_order, own_order

   !> Cuts of what is flat have about the root of the number of vertices, and there our own order is
   !> as good as that of METIS, and found in a third of the time; where they have this many times as
   !> much, as in lattices in space, METIS finds better ones: see methods.md.
   real(wp), parameter :: broad = 3.0_wp

   !> Entries of the envelope a column up to which columns are taken along the band: no order then
   !> costs less to find and to work with, tried from 5 to 40 entries.
   real(wp), parameter :: narrow = 40.0_wp

contains

   !> group (columns) ascends; the order counts from 0.
   subroutine elimination_order(a, group, order, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      integer, allocatable, intent(out) :: order(:)
      type(error_t), allocatable, intent(out) :: error

      logical :: is_narrow

      allocate (order(size(group)))
      call breadth_first_order(a, order, narrow*size(order), is_narrow)
      if (is_narrow) is_narrow = envelope(a%by_row, order) <= narrow*size(order)
      if (is_narrow) then
         order = order - 1
      else
         call nested_order(a, group, order, error)
      end if
   end subroutine elimination_order

   !> Entries of A'A in an order, from the first of each row to its diagonal, all between included.
   pure real(wp) function envelope(by_row, order) result(entries)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: order(:)
      integer :: place_of(size(order)), first(size(order)), i, a, leftmost

      do i = 1, size(order)
         place_of(order(i)) = i
         first(i) = i
      end do
      do i = 1, by_row%columns
         associate (column => by_row%place(by_row%start(i):by_row%start(i + 1) - 1))
            leftmost = size(order)
            do a = 1, size(column)
               leftmost = min(leftmost, place_of(column(a)))
            end do
            do a = 1, size(column)
               first(place_of(column(a))) = min(first(place_of(column(a))), leftmost)
            end do
         end associate
      end do
      entries = 0.0_wp
      do i = 1, size(order)
         entries = entries + (i - first(i) + 1)
      end do
   end function envelope

   !> group (columns) ascends; the order counts from 0.
   subroutine nested_order(a, group, order, error)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:)
      integer, allocatable, intent(out) :: order(:)
      type(error_t), allocatable, intent(out) :: error
      type(gram_t) :: graph
      integer, allocatable :: of_groups(:), first(:)
      integer :: groups, i, j, g, info

      groups = group(size(group))
      call group_graph(a, group, groups, graph)
      allocate (of_groups(groups), order(size(group)), first(groups + 1), stat=info)
      if (info == 0) call order_of_groups(groups, graph%start, graph%place, of_groups, info)
      if (info /= 0) then
         call fail(error_memory, error)
         return
      end if
      first(groups + 1) = size(group) + 1
      do j = size(group), 1, -1
         first(group(j)) = j
      end do
      i = 0
      do g = 1, groups
         do j = first(of_groups(g) + 1), first(of_groups(g) + 2) - 1
            i = i + 1
            order(i) = j - 1
         end do
      end do
   end subroutine nested_order

   !> That of METIS where a cut of our own is broad; our own stays where METIS gives up.
   subroutine order_of_groups(n, start, place, order, info)
      integer, intent(in) :: n, start(:), place(:)
      integer, intent(out) :: order(:), info
      real(wp) :: most
      integer :: widest

      most = merge(broad*sqrt(real(n, wp)), huge(most), metis_is_there() /= 0)
      call own_order(n, start, place, order, widest, info, most)
      if (info /= 0 .or. widest <= most) return
      if (metis_order(n, start, place, order) /= 0) call own_order(n, start, place, order, widest, info)
   end subroutine order_of_groups

   !> Of a graph given by its lower triangle, which counts from 0, as the order does. widest: vertices
   !> of the largest cut; where that has more than `most` there is no order. info: not 0 where memory
   !> does not suffice.
   subroutine own_order(n, start, place, order, widest, info, most)
      integer, intent(in) :: n, start(:), place(:)
      integer, intent(out) :: order(:), widest, info
      real(wp), intent(in), optional :: most
      type(sparse_t) :: graph

      call both_triangles(n, start, place, graph, info)
      if (info == 0) call dissection_order(graph, order, widest, info, most)
      if (info == 0) order = order - 1
   end subroutine own_order

   !> The graph with the diagonal; places ascend in each column.
   subroutine both_triangles(n, start, place, graph, info)
      integer, intent(in) :: n, start(:), place(:)
      type(sparse_t), intent(out) :: graph
      integer, intent(out) :: info
      integer, allocatable :: next(:), above(:), above_start(:)
      integer :: j, entry

      graph%rows = n
      graph%columns = n
      info = 1
      if (real(n, wp) + 2.0_wp*start(n + 1) >= huge(n)) return
      allocate (graph%start(n + 1), graph%place(n + 2*start(n + 1)), next(n + 1), above(start(n + 1)), &
                above_start(n + 1), stat=info)
      if (info /= 0) return
      ! The upper triangle first, column by column: its places ascend, as columns are met in order.
      call count_starts(place(:start(n + 1)) + 1, above_start)
      next = above_start
      do j = 1, n
         do entry = start(j) + 1, start(j + 1)
            associate (at => next(place(entry) + 1))
               above(at) = j
               at = at + 1
            end associate
         end do
      end do
      ! Each column meets those before it, itself, and those of whose columns it is a row.
      graph%start(1) = 1
      do j = 1, n
         graph%start(j + 1) = graph%start(j) + above_start(j + 1) - above_start(j) + 1 + start(j + 1) - start(j)
         next(j) = graph%start(j) + above_start(j + 1) - above_start(j)
         graph%place(graph%start(j):next(j) - 1) = above(above_start(j):above_start(j + 1) - 1)
         graph%place(next(j)) = j
         next(j) = next(j) + 1
      end do
      do j = 1, n
         do entry = above_start(j), above_start(j + 1) - 1
            associate (at => next(above(entry)))
               graph%place(at) = j
               at = at + 1
            end associate
         end do
      end do
   end subroutine both_triangles

   !> Where the entries of each column begin, from which column each is.
   pure subroutine count_starts(column, start)
      integer, intent(in) :: column(:)
      integer, intent(out) :: start(:)
      integer :: j

      start = 0
      do j = 1, size(column)
         start(column(j) + 1) = start(column(j) + 1) + 1
      end do
      start(1) = 1
      do j = 2, size(start)
         start(j) = start(j) + start(j - 1)
      end do
   end subroutine count_starts
end module flexact_nested_order
