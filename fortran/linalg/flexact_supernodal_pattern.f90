! SPDX-License-Identifier: BSD-3-Clause
!> Where the Cholesky factor of a symmetric matrix has entries: columns that stand side by side
!> and share their rows below (supernodes) are kept as one panel.
!>
!> Small supernodes are joined with the one that they change where that brings few zeros
!> (Ashcraft and Grimes, ACM Trans. Math. Softw. 15, 1989, pp. 291-309).
module flexact_supernodal_pattern
   use flexact_column_counts, only: column_counts
   use flexact_elimination_tree, only: elimination_tree, postorder
   use flexact_kinds, only: wp, long
   implicit none
   private
   public :: supernodal_t, make_pattern, columns_in, rows_in

   !> Up to so many columns in a joined supernode, so much of it may be zeros; of a wider one
   !> the last.
   integer, parameter :: columns_of_step(3) = [4, 16, 48]
   real(wp), parameter :: zeros_of_step(4) = [1.0_wp, 0.8_wp, 0.1_wp, 0.05_wp]

   type :: supernodal_t
      integer :: n = 0
      integer :: supernodes = 0
      !> Entries of the longest column, and of all, zeros that pad supernodes with them.
      integer :: widest = 0
      real(wp) :: entries = 0.0_wp
      !> Column of the matrix that stands at each place.
      integer, allocatable :: order(:)
      !> Places of supernode s: first(s) to first(s + 1) - 1, and the supernode it changes first.
      integer, allocatable :: first(:), parent(:)
      !> Its rows: row(rows_from(s)) to row(rows_from(s + 1) - 1), ascending, its places first.
      integer(long), allocatable :: rows_from(:)
      integer, allocatable :: row(:)
      !> Its panel, column by column: value(panel(s)) to value(panel(s + 1) - 1).
      integer(long), allocatable :: panel(:)
      !> The matrix at place j: rows entry_row(entry_from(j)) to entry_row(entry_from(j + 1) - 1),
      !> and which entries of the matrix these are.
      integer, allocatable :: entry_from(:), entry_row(:), entry(:)
   end type supernodal_t

contains

   pure recursive integer function columns_in(pattern, s)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s
      columns_in = pattern%first(s + 1) - pattern%first(s)
   end function columns_in

   pure recursive integer function rows_in(pattern, s)
      type(supernodal_t), intent(in) :: pattern
      integer, intent(in) :: s
      rows_in = int(pattern%rows_from(s + 1) - pattern%rows_from(s))
   end function rows_in

   !> start, place: the lower triangle, column by column; order: columns as they are eliminated;
   !> all count from 0. info: not 0 where memory does not suffice.
   subroutine make_pattern(start, place, order, pattern, info)
      integer, intent(in) :: start(:), place(:), order(:)
      type(supernodal_t), intent(out) :: pattern
      integer, intent(out) :: info
      integer, allocatable :: parent(:), count(:), from(:), column(:), entry(:)
      integer :: j

      pattern%n = size(order)
      allocate (pattern%order(pattern%n), parent(pattern%n), count(pattern%n), stat=info)
      if (info /= 0) return
      do j = 1, pattern%n
         pattern%order(j) = order(j) + 1
      end do
      call order_by_tree(start, place, pattern%order, parent, info)
      if (info /= 0) return
      call rows_of(start, place, pattern%order, from, column, entry, info)
      if (info /= 0) return
      call turn(from, column, entry, pattern, info)
      deallocate (entry)
      if (info == 0) call column_counts(parent, pattern%entry_from, pattern%entry_row, count, info)
      if (info == 0) call join_columns(parent, count, pattern, info)
      if (info == 0) call list_rows(from, column, pattern, info)
   end subroutine make_pattern

   !> Move columns such that those whose elimination changes one stand right before it.
   !> parent: of each place then.
   pure subroutine order_by_tree(start, place, order, parent, info)
      integer, intent(in) :: start(:), place(:)
      integer, intent(inout) :: order(:)
      integer, intent(out) :: parent(:), info
      integer, allocatable :: from(:), column(:), entry(:), old(:), moved(:), new(:)
      integer :: j

      call rows_of(start, place, order, from, column, entry, info)
      if (info == 0) allocate (old(size(order)), moved(size(order)), new(0:size(order)), stat=info)
      if (info /= 0) return
      call elimination_tree(from, column, old, moved)
      call postorder(old, moved, new, parent)
      new(0) = 0
      do j = 1, size(order)
         new(moved(j)) = j
      end do
      do j = 1, size(order)
         parent(new(j)) = new(old(j))
      end do
      old = order
      do j = 1, size(order)
         order(j) = old(moved(j))
      end do
   end subroutine order_by_tree

   !> The matrix in an order, by rows of its lower triangle with the diagonal.
   pure subroutine rows_of(start, place, order, from, column, entry, info)
      integer, intent(in) :: start(:), place(:), order(:)
      integer, allocatable, intent(out) :: from(:), column(:), entry(:)
      integer, intent(out) :: info
      integer, allocatable :: place_of(:), next(:)
      integer :: i, j, e, r

      allocate (from(size(order) + 1), column(size(place)), entry(size(place)), place_of(size(order)), &
                next(size(order) + 1), stat=info)
      if (info /= 0) return
      do j = 1, size(order)
         place_of(order(j)) = j
      end do
      next = 0
      do j = 1, size(order)
         do e = start(j) + 1, start(j + 1)
            r = max(place_of(place(e) + 1), place_of(j))
            next(r) = next(r) + 1
         end do
      end do
      call to_starts(next, from)
      next = from
      do i = 1, size(order)
         j = order(i)
         do e = start(j) + 1, start(j + 1)
            r = max(place_of(place(e) + 1), i)
            column(next(r)) = min(place_of(place(e) + 1), i)
            entry(next(r)) = e
            next(r) = next(r) + 1
         end do
      end do
   end subroutine rows_of

   !> From the counts of lists to where each begins.
   pure subroutine to_starts(count, from)
      integer, intent(in) :: count(:)
      integer, intent(out) :: from(:)
      integer :: j

      from(1) = 1
      do j = 2, size(from)
         from(j) = from(j - 1) + count(j - 1)
      end do
   end subroutine to_starts

   !> The same matrix by columns.
   pure subroutine turn(from, column, entry, pattern, info)
      integer, intent(in) :: from(:), column(:), entry(:)
      type(supernodal_t), intent(inout) :: pattern
      integer, intent(out) :: info
      integer, allocatable :: next(:)
      integer :: i, e, j

      allocate (pattern%entry_from(pattern%n + 1), pattern%entry_row(size(column)), pattern%entry(size(column)), &
                next(pattern%n + 1), stat=info)
      if (info /= 0) return
      next = 0
      do e = 1, size(column)
         next(column(e)) = next(column(e)) + 1
      end do
      call to_starts(next, pattern%entry_from)
      next = pattern%entry_from
      do i = 1, pattern%n
         do e = from(i), from(i + 1) - 1
            j = column(e)
            pattern%entry_row(next(j)) = i
            pattern%entry(next(j)) = entry(e)
            next(j) = next(j) + 1
         end do
      end do
   end subroutine turn

   !> Columns that share their rows below become supernodes, and small ones are joined; parents
   !> are of places before, of supernodes after.
   subroutine join_columns(parent, count, pattern, info)
      integer, intent(in) :: parent(:), count(:)
      type(supernodal_t), intent(inout) :: pattern
      integer, intent(out) :: info
      integer, allocatable :: of_place(:), rows(:)
      integer :: j, s

      allocate (pattern%first(pattern%n + 1), rows(pattern%n), of_place(0:pattern%n), stat=info)
      if (info /= 0) return
      s = 0
      do j = 1, pattern%n
         if (.not. continues(j)) then
            s = s + 1
            pattern%first(s) = j
            rows(s) = count(j)
         end if
      end do
      pattern%first(s + 1) = pattern%n + 1
      call relax(parent, pattern%first, rows, s)
      pattern%supernodes = s
      allocate (pattern%rows_from(s + 1), pattern%panel(s + 1), pattern%parent(s), stat=info)
      if (info /= 0) return
      of_place(0) = 0
      pattern%rows_from(1) = 1
      pattern%panel(1) = 1
      do s = 1, pattern%supernodes
         of_place(pattern%first(s):pattern%first(s + 1) - 1) = s
         pattern%rows_from(s + 1) = pattern%rows_from(s) + rows(s)
         pattern%panel(s + 1) = pattern%panel(s) + int(rows(s), long)*columns_in(pattern, s)
         pattern%widest = max(pattern%widest, rows(s))
         pattern%entries = pattern%entries + real(columns_in(pattern, s), wp)*(rows(s) - 0.5_wp*(columns_in(pattern, s) - 1))
      end do
      do s = 1, pattern%supernodes
         pattern%parent(s) = of_place(parent(pattern%first(s + 1) - 1))
      end do
   contains
      pure logical function continues(j)
         integer, intent(in) :: j
         continues = .false.
         if (j > 1) continues = parent(j - 1) == j .and. count(j - 1) == count(j) + 1
      end function continues
   end subroutine join_columns

   !> Join each supernode with the one right after it where that is the one it changes first, and
   !> where few zeros come in. rows: of each.
   subroutine relax(parent, first, rows, supernodes)
      integer, intent(in) :: parent(:)
      integer, intent(inout) :: first(:), rows(:), supernodes
      real(wp) :: zeros, more
      integer :: s, next

      ! From the last to the first; those that remain are moved to the end, from `next` on.
      next = supernodes + 1
      zeros = 0.0_wp
      do s = supernodes, 1, -1
         if (is_joined(s)) then
            rows(next) = first(next) - first(s) + rows(next)
            zeros = more
         else
            next = next - 1
            rows(next) = rows(s)
            zeros = 0.0_wp
         end if
         first(next) = first(s)
      end do
      supernodes = supernodes - next + 1
      do s = 1, supernodes
         first(s) = first(next + s - 1)
         rows(s) = rows(next + s - 1)
      end do
      first(supernodes + 1) = size(parent) + 1
   contains
      !> Whether s is joined with the one at `next`, of which `more` are zeros then.
      logical function is_joined(s)
         integer, intent(in) :: s
         integer :: own, width

         is_joined = .false.
         if (next > supernodes) return
         if (parent(first(next) - 1) == 0 .or. parent(first(next) - 1) >= first(next + 1)) return
         own = first(next) - first(s)
         width = first(next + 1) - first(s)
         more = real(own, wp)*(rows(next) + own - rows(s))
         is_joined = .not. more > 0
         more = more + zeros
         is_joined = is_joined .or. more <= zeros_of_step(1 + count(width > columns_of_step)) &
                     *(0.5_wp*width*(width + 1) + real(width, wp)*(rows(next) + own - width))
      end function is_joined
   end subroutine relax

   !> The rows of each supernode: row i stands in those on the ways from its entries up to its own.
   pure subroutine list_rows(from, column, pattern, info)
      integer, intent(in) :: from(:), column(:)
      type(supernodal_t), intent(inout) :: pattern
      integer, intent(out) :: info
      integer, allocatable :: of_place(:), mark(:)
      integer(long), allocatable :: next(:)
      integer :: s, i, e

      allocate (pattern%row(pattern%rows_from(pattern%supernodes + 1) - 1), of_place(pattern%n), &
                mark(pattern%supernodes), next(pattern%supernodes), stat=info)
      if (info /= 0) return
      do s = 1, pattern%supernodes
         mark(s) = 0
         next(s) = pattern%rows_from(s)
         do i = pattern%first(s), pattern%first(s + 1) - 1
            of_place(i) = s
            pattern%row(next(s)) = i
            next(s) = next(s) + 1
         end do
      end do
      do i = 1, pattern%n
         do e = from(i), from(i + 1) - 1
            s = of_place(column(e))
            do while (s /= of_place(i))
               if (mark(s) == i) exit
               mark(s) = i
               pattern%row(next(s)) = i
               next(s) = next(s) + 1
               s = pattern%parent(s)
            end do
         end do
      end do
   end subroutine list_rows
end module flexact_supernodal_pattern
