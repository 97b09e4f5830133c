! SPDX-License-Identifier: BSD-3-Clause
!> Which of many short texts are equal.
module flexact_equal_texts
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_diagnostics, only: span_t
   implicit none
   private
   public :: find_equal_texts

   !> Times the factor of a hash, this fits 64 bits.
   integer(int64), parameter :: lower_bits = 2_int64**50 - 1

contains

   !> The number of each text's group, from 1 in the order of their first members, 0
   !> for an empty one; and how many groups there are. Texts are spans of one text.
   pure subroutine find_equal_texts(text, span, group, groups)
      character(len=*), intent(in) :: text
      type(span_t), intent(in) :: span(:)
      integer, intent(out) :: group(:), groups
      !> An open table of the first members.
      integer :: first(0:2*size(span)), i, slot

      first = 0
      groups = 0
      do i = 1, size(span)
         group(i) = 0
         if (span(i)%first < 1 .or. span(i)%last < span(i)%first) cycle
         associate (word => text(span(i)%first:span(i)%last))
            slot = int(modulo(hash_of(word), size(first, kind=int64)))
            do while (first(slot) > 0)
               associate (other => span(first(slot)))
                  if (text(other%first:other%last) == word .and. other%last - other%first == span(i)%last - span(i)%first) exit
               end associate
               slot = modulo(slot + 1, size(first))
            end do
         end associate
         if (first(slot) == 0) then
            groups = groups + 1
            first(slot) = i
            group(i) = groups
         else
            group(i) = group(first(slot))
         end if
      end do
   end subroutine find_equal_texts

   pure integer(int64) function hash_of(word) result(hash)
      character(len=*), intent(in) :: word
      integer :: i

      hash = 0
      do i = 1, len(word)
         hash = iand(hash*8191 + iachar(word(i:i)) + 1, lower_bits)
      end do
   end function hash_of
end module flexact_equal_texts
