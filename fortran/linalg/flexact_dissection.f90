! SPDX-License-Identifier: BSD-3-Clause
!> A fill-reducing order by cuts through a graph (automatic nested dissection; George and Liu, SIAM
!> J. Numer. Anal. 15, 1978, pp. 1053-1069): what stands equally far from a vertex at its edge cuts
!> it in two, and is eliminated last; both halves are cut again, down to small pieces, which are
!> ordered by minimum degree. Hubs, which are joined with very many, would leave nothing to be cut:
!> they are taken out first, and eliminated last of all.
module flexact_dissection
   use flexact_kinds, only: wp
   use flexact_minimum_degree, only: minimum_degree_order
   use flexact_sparse, only: sparse_t
   implicit none
   private
   public :: dissection_order

   !> Vertices up to which a piece is not cut, and up to which one that cannot be cut is still
   !> ordered by minimum degree.
   integer, parameter :: small = 120, most_uncut = 4000
   !> A hub has more neighbours than so many, and than so many times the root of their number.
   integer, parameter :: few_neighbours = 16
   real, parameter :: many_neighbours = 10.0
   !> The part of a piece before a cut, at least.
   real, parameter :: least_part = 0.35
   !> Looks for a vertex farther away.
   integer, parameter :: most_looks = 4

   !> Pieces of the graph are stretches of a list of vertices; piece (n): that of each vertex.
   type :: cutting_t
      integer, allocatable :: vertex(:), piece(:), level(:), found(:), local(:)
   end type cutting_t

contains

   !> graph: both triangles with the diagonal. order: vertices as they are eliminated. widest:
   !> vertices of the largest cut, and where that has more than `most`, no order is sought any
   !> more. info: not 0 where memory does not suffice.
   subroutine dissection_order(graph, order, widest, info, most)
      type(sparse_t), intent(in) :: graph
      integer, intent(out) :: order(:), widest, info
      real(wp), intent(in), optional :: most
      type(cutting_t) :: cutting
      integer, allocatable :: waiting(:, :)
      integer :: n, from, to, middle, cut, count

      widest = 0
      n = graph%columns
      allocate (cutting%vertex(n), cutting%piece(n), cutting%level(n), cutting%found(n), cutting%local(n), &
                waiting(2, n + 1), stat=info)
      if (info /= 0) return
      count = 0
      call take_out_hubs(graph, cutting, to)
      call add_components(1, to)
      do while (count > 0)
         from = waiting(1, count)
         to = waiting(2, count)
         count = count - 1
         call cut_in_two(graph, from, to, cutting, middle, cut)
         widest = max(widest, to - cut)
         if (present(most)) then
            if (widest > most) exit
         end if
         if (middle < from) then
            if (to - from >= 4*small) widest = max(widest, to - from + 1)
            call order_piece(graph, from, to, cutting, info)
            if (info /= 0) return
            cycle
         end if
         call add_components(from, middle)
         call add_components(middle + 1, cut)
      end do
      order = cutting%vertex
   contains
      !> What is joined becomes a piece, to be cut again; small ones side by side share one. None is
      !> met twice, and so their number is at most n.
      subroutine add_components(from, to)
         integer, intent(in) :: from, to
         integer :: i, first, last, reached

         if (to < from) return
         cutting%piece(cutting%vertex(from:to)) = -from
         last = from - 1
         first = from
         do i = from, to
            if (cutting%piece(cutting%vertex(i)) /= -from) cycle
            call reach(graph, cutting%vertex(i), -from, last + 1, cutting, reached)
            if (last >= first .and. reached - first >= small) then
               call add(first, last)
               first = last + 1
            end if
            last = reached
         end do
         call add(first, last)
         cutting%vertex(from:to) = cutting%found(from:to)
      end subroutine add_components

      subroutine add(first, last)
         integer, intent(in) :: first, last

         cutting%piece(cutting%found(first:last)) = first
         count = count + 1
         waiting(:, count) = [first, last]
      end subroutine add
   end subroutine dissection_order

   !> Hubs stand at the end of the list, after the first `others`.
   subroutine take_out_hubs(graph, cutting, others)
      type(sparse_t), intent(in) :: graph
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: others
      integer :: i, n, hubs

      n = graph%columns
      others = 0
      hubs = 0
      do i = 1, n
         cutting%piece(i) = 0
         if (graph%start(i + 1) - graph%start(i) > max(real(few_neighbours), many_neighbours*sqrt(real(n)))) then
            cutting%vertex(n - hubs) = i
            hubs = hubs + 1
         else
            others = others + 1
            cutting%vertex(others) = i
         end if
      end do
   end subroutine take_out_hubs

   !> All that is joined with a vertex within its piece: found(first:last), and of no piece then.
   subroutine reach(graph, start, piece, first, cutting, last)
      type(sparse_t), intent(in) :: graph
      integer, intent(in) :: start, piece, first
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: last
      integer :: done, entry, other

      cutting%found(first) = start
      cutting%piece(start) = 0
      last = first
      done = first - 1
      do while (done < last)
         done = done + 1
         associate (v => cutting%found(done))
            do entry = graph%start(v), graph%start(v + 1) - 1
               other = graph%place(entry)
               if (cutting%piece(other) /= piece) cycle
               cutting%piece(other) = 0
               last = last + 1
               cutting%found(last) = other
            end do
         end associate
      end do
   end subroutine reach

   !> Sort the vertices of a piece: one half up to `middle`, the other up to `cut`, then the cut,
   !> which belongs to no piece any more. middle: below from where the piece is left whole.
   subroutine cut_in_two(graph, from, to, cutting, middle, cut)
      type(sparse_t), intent(in) :: graph
      integer, intent(in) :: from, to
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: middle, cut
      integer :: start, reached, levels, before, look

      middle = from - 1
      cut = to
      if (to - from < small) return
      start = cutting%vertex(from)
      before = 0
      do look = 1, most_looks
         call find_levels(graph, start, from, cutting, reached, levels)
         if (levels <= before) exit
         before = levels
         start = cutting%found(reached)
      end do
      ! Small components that share a piece are not cut.
      if (levels > 2 .and. reached == to - from + 1) then
         call cut_at(graph, best_level(cutting, reached, levels), from, to, cutting, middle, cut)
      end if
   end subroutine cut_in_two

   !> Distances from a vertex within its piece: those that are reached, from near to far.
   subroutine find_levels(graph, start, piece, cutting, reached, levels)
      type(sparse_t), intent(in) :: graph
      integer, intent(in) :: start, piece
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: reached, levels
      integer :: done, entry, other

      ! Vertices of the piece that are reached are taken out of it, and put back at the end.
      cutting%found(1) = start
      cutting%level(start) = 1
      cutting%piece(start) = -piece
      reached = 1
      done = 0
      do while (done < reached)
         done = done + 1
         associate (v => cutting%found(done))
            do entry = graph%start(v), graph%start(v + 1) - 1
               other = graph%place(entry)
               if (cutting%piece(other) /= piece) cycle
               cutting%piece(other) = -piece
               cutting%level(other) = cutting%level(v) + 1
               reached = reached + 1
               cutting%found(reached) = other
            end do
         end associate
      end do
      levels = cutting%level(cutting%found(reached))
      cutting%piece(cutting%found(:reached)) = piece
   end subroutine find_levels

   !> The smallest level near the middle.
   integer function best_level(cutting, reached, levels) result(best)
      type(cutting_t), intent(in) :: cutting
      integer, intent(in) :: reached, levels
      integer :: i, from, least

      best = (levels + 1)/2
      least = reached + 1
      from = 1
      do i = 2, reached
         if (cutting%level(cutting%found(i)) == cutting%level(cutting%found(from))) cycle
         if (from > least_part*reached .and. i < (1 - least_part)*reached .and. i - from < least) then
            least = i - from
            best = cutting%level(cutting%found(from))
         end if
         from = i
      end do
      if (least > reached) best = cutting%level(cutting%found((reached + 1)/2))
      best = min(max(best, 2), levels - 1)
   end function best_level

   !> Of this level, only what touches the next one is the cut.
   subroutine cut_at(graph, level, from, to, cutting, middle, cut)
      type(sparse_t), intent(in) :: graph
      integer, intent(in) :: level, from, to
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: middle, cut
      integer :: i, entry

      do i = from, to
         cutting%local(i) = merge(1, 2, cutting%level(cutting%vertex(i)) <= level)
         if (cutting%level(cutting%vertex(i)) /= level) cycle
         associate (v => cutting%vertex(i))
            do entry = graph%start(v), graph%start(v + 1) - 1
               if (cutting%piece(graph%place(entry)) /= from) cycle
               if (cutting%level(graph%place(entry)) > level) cutting%local(i) = 3
            end do
         end associate
      end do
      middle = from - 1 + count(cutting%local(from:to) == 1)
      cut = middle + count(cutting%local(from:to) == 2)
      do i = from, to
         if (cutting%local(i) == 3) cutting%piece(cutting%vertex(i)) = 0
      end do
      call sort_in_three(cutting, from, to)
   end subroutine cut_at

   !> By what `local` says, 1 to 3.
   subroutine sort_in_three(cutting, from, to)
      type(cutting_t), intent(inout) :: cutting
      integer, intent(in) :: from, to
      integer :: next(3), i

      next(1) = from
      next(2) = next(1) + count(cutting%local(from:to) == 1)
      next(3) = next(2) + count(cutting%local(from:to) == 2)
      do i = from, to
         associate (place => next(cutting%local(i)))
            cutting%found(place) = cutting%vertex(i)
            place = place + 1
         end associate
      end do
      cutting%vertex(from:to) = cutting%found(from:to)
   end subroutine sort_in_three

   !> A piece that is not cut, by minimum degree within it.
   subroutine order_piece(graph, from, to, cutting, info)
      type(sparse_t), intent(in) :: graph
      integer, intent(in) :: from, to
      type(cutting_t), intent(inout) :: cutting
      integer, intent(out) :: info
      type(sparse_t) :: inside
      integer, allocatable :: order(:)
      integer :: i, entry, entries

      cutting%piece(cutting%vertex(from:to)) = -from
      entries = 0
      do i = from, to
         cutting%local(cutting%vertex(i)) = i - from + 1
         entries = entries + graph%start(cutting%vertex(i) + 1) - graph%start(cutting%vertex(i))
      end do
      inside%columns = to - from + 1
      inside%rows = inside%columns
      allocate (inside%start(inside%columns + 1), inside%place(entries), order(inside%columns), stat=info)
      if (info /= 0) return
      entries = 0
      inside%start(1) = 1
      do i = from, to
         associate (v => cutting%vertex(i))
            do entry = graph%start(v), graph%start(v + 1) - 1
               if (cutting%piece(graph%place(entry)) /= -from) cycle
               entries = entries + 1
               inside%place(entries) = cutting%local(graph%place(entry))
            end do
         end associate
         inside%start(i - from + 2) = entries + 1
      end do
      if (inside%columns <= most_uncut) then
         call minimum_degree_order(inside, order)
         cutting%found(from:to) = cutting%vertex(from + order - 1)
         cutting%vertex(from:to) = cutting%found(from:to)
      end if
   end subroutine order_piece
end module flexact_dissection
