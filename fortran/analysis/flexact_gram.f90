!> The pattern and the values of A'A, and orders of its columns.
module flexact_gram
   use flexact_kinds, only: wp
   use flexact_sparse, only: sparse_t
   use flexact_envelope, only: envelope_t
   implicit none
   private
   public :: gram_t, breadth_first_order, envelope_size, fill_envelope, make_gram, group_graph

   !> The lower triangle of A'A column by column; indices count from 0.
   type :: gram_t
      integer, allocatable :: start(:)
      integer, allocatable :: place(:)
      real(wp), allocatable :: value(:)
      !> Where the diagonal entry of each column stands.
      integer, allocatable :: diagonal(:)
   end type gram_t

contains

   !> The columns of a connected matrix in the order in which a search spreads
   !> from one that is far out: columns that share a row come close together.
   pure subroutine breadth_first_order(by_column, by_row, order)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(out) :: order(:)

      if (size(order) == 0) return
      call spread_from(1, by_column, by_row, order)
      call spread_from(order(size(order)), by_column, by_row, order)
   end subroutine breadth_first_order

   pure subroutine spread_from(first, by_column, by_row, order)
      integer, intent(in) :: first
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(inout) :: order(:)
      logical :: met_row(by_row%columns), met(by_column%columns)
      integer :: head, tail, a, b, i, j

      met_row = .false.
      met = .false.
      met(first) = .true.
      order(1) = first
      tail = 1
      do head = 1, size(order)
         do a = by_column%start(order(head)), by_column%start(order(head) + 1) - 1
            i = by_column%place(a)
            if (met_row(i)) cycle
            met_row(i) = .true.
            do b = by_row%start(i), by_row%start(i + 1) - 1
               j = by_row%place(b)
               if (met(j)) cycle
               met(j) = .true.
               tail = tail + 1
               order(tail) = j
            end do
         end do
      end do
   end subroutine spread_from

   !> First column of each row of the envelope of A'A in an order, and how many
   !> entries the envelope has.
   pure subroutine envelope_size(by_row, place_of, first, entries)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: place_of(:)
      integer, intent(out) :: first(:)
      real(wp), intent(out) :: entries
      integer :: i, a, leftmost

      do i = 1, size(first)
         first(i) = i
      end do
      do i = 1, by_row%columns
         leftmost = size(first) + 1
         do a = by_row%start(i), by_row%start(i + 1) - 1
            leftmost = min(leftmost, place_of(by_row%place(a)))
         end do
         do a = by_row%start(i), by_row%start(i + 1) - 1
            associate (p => place_of(by_row%place(a)))
               first(p) = min(first(p), leftmost)
            end associate
         end do
      end do
      entries = 0.0_wp
      do i = 1, size(first)
         entries = entries + (i - first(i) + 1)
      end do
   end subroutine envelope_size

   !> A'A - shift I in the envelope that `envelope_size` has found.
   pure subroutine fill_envelope(by_row, place_of, first, shift, matrix)
      type(sparse_t), intent(in) :: by_row
      integer, intent(in) :: place_of(:), first(:)
      real(wp), intent(in) :: shift
      type(envelope_t), intent(out) :: matrix
      integer :: i, a, b, entries

      matrix%n = size(first)
      allocate (matrix%first, source=first)
      allocate (matrix%base(size(first)))
      entries = 0
      do i = 1, size(first)
         matrix%base(i) = entries + 1 - first(i)
         entries = entries + i - first(i) + 1
      end do
      allocate (matrix%value(entries), source=0.0_wp)
      do i = 1, by_row%columns
         do a = by_row%start(i), by_row%start(i + 1) - 1
            associate (p => place_of(by_row%place(a)))
               do b = by_row%start(i), by_row%start(i + 1) - 1
                  associate (q => place_of(by_row%place(b)))
                     if (q <= p) matrix%value(matrix%base(p) + q) = matrix%value(matrix%base(p) + q) &
                                                                    + by_row%value(a)*by_row%value(b)
                  end associate
               end do
            end associate
         end do
      end do
      do i = 1, size(first)
         matrix%value(matrix%base(i) + i) = matrix%value(matrix%base(i) + i) - shift
      end do
   end subroutine fill_envelope

   !> The lower triangle of A'A, unless it needs more bytes than there are, or has
   !> more entries than default integers count: then nothing is allocated.
   pure subroutine make_gram(by_column, by_row, memory, gram, bytes)
      type(sparse_t), intent(in) :: by_column, by_row
      real(wp), intent(in) :: memory
      type(gram_t), intent(out) :: gram
      real(wp), intent(out) :: bytes
      integer :: mark(by_column%columns), list(by_column%columns)
      real(wp) :: total(by_column%columns), entries
      integer :: j, found, info

      mark = 0
      entries = 0.0_wp
      allocate (gram%start(by_column%columns + 1), gram%diagonal(by_column%columns), source=0)
      do j = 1, by_column%columns
         call multiply_column(by_column, by_row, j, mark, list, found)
         entries = entries + found
         if (entries < huge(1)/2) gram%start(j + 1) = int(entries)
      end do
      bytes = 12*entries
      if (bytes > memory .or. entries >= huge(1)/2) return
      allocate (gram%place(int(entries)), gram%value(int(entries)), stat=info)
      if (info /= 0) return
      mark = 0
      do j = 1, by_column%columns
         call multiply_column(by_column, by_row, j, mark, list, found, total)
         gram%place(gram%start(j) + 1:gram%start(j) + found) = list(:found) - 1
         gram%value(gram%start(j) + 1:gram%start(j) + found) = total(list(:found))
         gram%diagonal(j) = gram%start(j) + 1
      end do
   end subroutine make_gram

   !> Places, and values where they are wanted, of column j of A'A from the
   !> diagonal on, which comes first.
   pure subroutine multiply_column(by_column, by_row, j, mark, list, found, total)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(in) :: j
      integer, intent(inout) :: mark(:), list(:)
      integer, intent(out) :: found
      real(wp), intent(inout), optional :: total(:)
      integer :: a, b, i, k

      found = 1
      list(1) = j
      mark(j) = j
      if (present(total)) total(j) = 0.0_wp
      do a = by_column%start(j), by_column%start(j + 1) - 1
         i = by_column%place(a)
         do b = by_row%start(i + 1) - 1, by_row%start(i), -1
            k = by_row%place(b)
            if (k < j) exit
            if (mark(k) /= j) then
               mark(k) = j
               found = found + 1
               list(found) = k
               if (present(total)) total(k) = 0.0_wp
            end if
            if (present(total)) total(k) = total(k) + by_column%value(a)*by_row%value(b)
         end do
      end do
   end subroutine multiply_column

   !> Which groups of columns share a row: the pattern of a lower triangle. The
   !> groups of columns ascend.
   pure subroutine group_graph(by_column, by_row, group, groups, graph)
      type(sparse_t), intent(in) :: by_column, by_row
      integer, intent(in) :: group(:), groups
      type(gram_t), intent(out) :: graph
      integer, allocatable :: longer(:)
      integer :: mark(groups), j, a, b, other, entries

      mark = 0
      allocate (graph%start(groups + 1), source=0)
      allocate (graph%place(8*groups + 64))
      entries = 0
      do j = 1, by_column%columns
         do a = by_column%start(j), by_column%start(j + 1) - 1
            do b = by_row%start(by_column%place(a) + 1) - 1, by_row%start(by_column%place(a)), -1
               other = group(by_row%place(b))
               if (other <= group(j)) exit
               if (mark(other) == group(j)) cycle
               mark(other) = group(j)
               if (entries == size(graph%place)) then
                  allocate (longer(2*entries))
                  longer(:entries) = graph%place
                  call move_alloc(longer, graph%place)
               end if
               entries = entries + 1
               graph%place(entries) = other - 1
            end do
         end do
         graph%start(group(j) + 1) = entries
      end do
   end subroutine group_graph
end module flexact_gram
