! SPDX-License-Identifier: BSD-3-Clause
!> The pattern and the values of A'A, and which groups of columns share rows.
module flexact_gram
   use flexact_kinds, only: wp
   use flexact_sparse, only: operator_t
   implicit none
   private
   public :: gram_t, make_gram, most_bytes, group_graph

   !> The lower triangle of A'A column by column; indices count from 0.
   type :: gram_t
      integer, allocatable :: start(:)
      integer, allocatable :: place(:)
      real(wp), allocatable :: value(:)
      !> Where the diagonal entry of each column stands.
      integer, allocatable :: diagonal(:)
   end type gram_t

   !> Its place and its value.
   real(wp), parameter :: bytes_of_entry = 12.0_wp
   !> A guard: default integers count them.
   real(wp), parameter :: most_entries = 0.5_wp*huge(1)

contains

   !> The lower triangle of A'A, unless it needs more bytes than there are, or has
   !> more entries than default integers count: then nothing is allocated.
   pure subroutine make_gram(a, memory, gram, bytes)
      type(operator_t), intent(in) :: a
      real(wp), intent(in) :: memory
      type(gram_t), intent(out) :: gram
      real(wp), intent(out) :: bytes
      integer :: mark(a%by_column%columns), list(a%by_column%columns)
      real(wp) :: total(a%by_column%columns), entries
      integer :: j, found, info

      mark = 0
      entries = 0.0_wp
      allocate (gram%start(a%by_column%columns + 1), gram%diagonal(a%by_column%columns), source=0)
      do j = 1, a%by_column%columns
         call multiply_column(a, j, mark, list, found)
         entries = entries + found
         if (entries < most_entries) gram%start(j + 1) = int(entries)
      end do
      bytes = bytes_of_entry*entries
      if (bytes > memory .or. entries >= most_entries) return
      allocate (gram%place(int(entries)), gram%value(int(entries)), stat=info)
      if (info /= 0) return
      mark = 0
      do j = 1, a%by_column%columns
         call multiply_column(a, j, mark, list, found, total)
         gram%place(gram%start(j) + 1:gram%start(j) + found) = list(:found) - 1
         gram%value(gram%start(j) + 1:gram%start(j) + found) = total(list(:found))
         gram%diagonal(j) = gram%start(j) + 1
      end do
   end subroutine make_gram

   !> No less than the bytes that the lower triangle of A'A needs.
   pure real(wp) function most_bytes(a)
      type(operator_t), intent(in) :: a

      associate (start => a%by_row%start, rows => a%by_row%columns)
         ! The diagonal is there where nothing else is.
         most_bytes = bytes_of_entry*(a%by_column%columns + &
                                      sum((start(2:rows + 1) - start(:rows))*real(start(2:rows + 1) - start(:rows) + 1, wp)/2))
      end associate
   end function most_bytes

   !> Places, and values where they are wanted, of column j of A'A from the
   !> diagonal on, which comes first.
   pure subroutine multiply_column(a, j, mark, list, found, total)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: j
      integer, intent(inout) :: mark(:), list(:)
      integer, intent(out) :: found
      real(wp), intent(inout), optional :: total(:)
      integer :: entry, other, i, k

      found = 1
      list(1) = j
      mark(j) = j
      if (present(total)) total(j) = 0.0_wp
      do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
         i = a%by_column%place(entry)
         do other = a%by_row%start(i + 1) - 1, a%by_row%start(i), -1
            k = a%by_row%place(other)
            if (k < j) exit
            if (mark(k) /= j) then
               mark(k) = j
               found = found + 1
               list(found) = k
               if (present(total)) total(k) = 0.0_wp
            end if
            if (present(total)) total(k) = total(k) + a%by_column%value(entry)*a%by_row%value(other)
         end do
      end do
   end subroutine multiply_column

   !> Which groups of columns share a row: the pattern of a lower triangle. The
   !> groups of columns ascend.
   pure subroutine group_graph(a, group, groups, graph)
      type(operator_t), intent(in) :: a
      integer, intent(in) :: group(:), groups
      type(gram_t), intent(out) :: graph
      integer, allocatable :: longer(:)
      integer :: mark(groups), j, entry, next, other, entries

      mark = 0
      allocate (graph%start(groups + 1), source=0)
      allocate (graph%place(8*groups + 64))
      entries = 0
      do j = 1, a%by_column%columns
         do entry = a%by_column%start(j), a%by_column%start(j + 1) - 1
            do next = a%by_row%start(a%by_column%place(entry) + 1) - 1, a%by_row%start(a%by_column%place(entry)), -1
               other = group(a%by_row%place(next))
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
