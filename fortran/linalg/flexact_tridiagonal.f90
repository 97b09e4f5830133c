! SPDX-License-Identifier: BSD-3-Clause
!> Some eigenvalues of a symmetric tridiagonal matrix by multisection: Sturm sequences at
!> several places at once (Lo, Philippe and Sameh, SIAM J. Sci. Stat. Comput. 8, 1987). LAPACK
!> finds all of them, or bisects one after the other.
module flexact_tridiagonal
   use flexact_kinds, only: wp
   implicit none
   private
   public :: some_eigenvalues

   !> So many places at once take hardly longer than one: each division waits for the last.
   integer, parameter :: places = 6

contains

   !> The eigenvalues with these numbers, six at most, counted upwards from 1, to `relative` of themselves
   !> and `absolute` of the largest of all. The matrix is positive semidefinite; d: its
   !> diagonal (n), e: beside it (n - 1).
   pure subroutine some_eigenvalues(d, e, number, relative, absolute, value)
      real(wp), intent(in) :: d(:), e(:), relative, absolute
      integer, intent(in) :: number(:)
      real(wp), intent(out) :: value(:)
      real(wp), dimension(size(number)) :: lower, upper
      real(wp) :: x(places), squares(size(d)), top
      integer :: below(places), k, i
      logical :: is_narrower

      squares = [0.0_wp, max(tiny(e), e**2)]
      top = bound_of(d, e)
      lower = -epsilon(1.0_wp)*top
      upper = top
      is_narrower = .true.
      do while (is_narrower .and. any(upper - lower > max(absolute*top, relative*upper)))
         do i = 1, places
            k = mod(i - 1, size(number)) + 1
            x(i) = lower(k) + (upper(k) - lower(k))*(real((i - 1)/size(number) + 1, wp)/((places - k)/size(number) + 2))
         end do
         call count_below(d, squares, x, below)
         call narrow(number, x, below, lower, upper, is_narrower)
      end do
      value = max(0.0_wp, lower/2 + upper/2)
   end subroutine some_eigenvalues

   !> No eigenvalue is above (Gershgorin).
   pure real(wp) function bound_of(d, e) result(bound)
      real(wp), intent(in) :: d(:), e(:)
      bound = (maxval(d + [abs(e), 0.0_wp] + [0.0_wp, abs(e)]))*(1 + 8*epsilon(1.0_wp))
   end function bound_of

   !> How many eigenvalues are below each place: so many pivots are negative. A pivot of zero
   !> makes the next one minus infinity, and that counts in its place.
   pure subroutine count_below(d, squares, x, below)
      real(wp), intent(in) :: d(:), squares(:), x(places)
      integer, intent(out) :: below(places)
      real(wp) :: pivot(places), counted(places)
      integer :: i

      pivot = 1.0_wp
      counted = 0.0_wp
      do i = 1, size(d)
         pivot = (d(i) - x) - squares(i)/pivot
         counted = counted + merge(1.0_wp, 0.0_wp, pivot < 0)
      end do
      below = nint(counted)
   end subroutine count_below

   !> Take in what the counts say.
   pure subroutine narrow(number, x, below, lower, upper, is_narrower)
      integer, intent(in) :: number(:), below(:)
      real(wp), intent(in) :: x(:)
      real(wp), intent(inout) :: lower(:), upper(:)
      logical, intent(out) :: is_narrower
      real(wp) :: before
      integer :: k, i

      is_narrower = .false.
      do k = 1, size(number)
         before = upper(k) - lower(k)
         do i = 1, size(x)
            if (below(i) < number(k)) then
               lower(k) = max(lower(k), x(i))
            else
               upper(k) = min(upper(k), x(i))
            end if
         end do
         is_narrower = is_narrower .or. upper(k) - lower(k) < before
      end do
   end subroutine narrow
end module flexact_tridiagonal
