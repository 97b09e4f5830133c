!> Cholesky factorisation of a small or narrow symmetric matrix that is kept row
!> by row from its first entry to the diagonal (its envelope), with pivots that
!> vanish pinned as they are met.
module flexact_envelope
   use flexact_kinds, only: wp
   implicit none
   private
   public :: envelope_t, factorise, solve

   type :: envelope_t
      integer :: n = 0
      !> Row i holds columns first(i) to i; entry (i, j) is value(base(i) + j).
      integer, allocatable :: first(:), base(:)
      real(wp), allocatable :: value(:)
   end type envelope_t

contains

   !> L L' = G + E E', in place: where a pivot comes out below `least`, one is
   !> added to it and its number joins the list of pins.
   pure subroutine factorise(matrix, least, pinned, pins)
      type(envelope_t), intent(inout) :: matrix
      real(wp), intent(in) :: least
      integer, intent(inout) :: pinned(:)
      integer, intent(out) :: pins
      real(wp) :: pivot
      integer :: i, j, from

      pins = 0
      associate (l => matrix%value, base => matrix%base, first => matrix%first)
         do i = 1, matrix%n
            do j = first(i), i - 1
               from = max(first(i), first(j))
               l(base(i) + j) = (l(base(i) + j) - dot_product(l(base(i) + from:base(i) + j - 1), &
                                                              l(base(j) + from:base(j) + j - 1)))/l(base(j) + j)
            end do
            pivot = l(base(i) + i) - sum(l(base(i) + first(i):base(i) + i - 1)**2)
            if (pivot < least) then
               pins = pins + 1
               pinned(pins) = i
               pivot = pivot + 1.0_wp
            end if
            l(base(i) + i) = sqrt(pivot)
         end do
      end associate
   end subroutine factorise

   !> Solve L L' x = b in place, column by column.
   pure subroutine solve(matrix, x)
      type(envelope_t), intent(in) :: matrix
      real(wp), intent(inout), contiguous :: x(:, :)
      integer :: i, k

      associate (l => matrix%value, base => matrix%base, first => matrix%first)
         do k = 1, size(x, 2)
            do i = 1, matrix%n
               x(i, k) = (x(i, k) - dot_product(l(base(i) + first(i):base(i) + i - 1), x(first(i):i - 1, k)))/l(base(i) + i)
            end do
            do i = matrix%n, 1, -1
               x(i, k) = x(i, k)/l(base(i) + i)
               x(first(i):i - 1, k) = x(first(i):i - 1, k) - x(i, k)*l(base(i) + first(i):base(i) + i - 1)
            end do
         end do
      end associate
   end subroutine solve
end module flexact_envelope
