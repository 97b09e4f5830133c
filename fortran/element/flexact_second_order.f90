! SPDX-License-Identifier: BSD-3-Clause
!> Second derivatives with respect to positions and spins.
!>
!> A spin w turns a vector a of a body into a + w x a + 1/2 w x (w x a), the series
!> of exp(w) to second order. Second derivatives in w are therefore symmetric.
!> First derivatives that are differenced along turns made one after the other are
!> not: a second turn v adds 1/2 m.(w x v) to them, m the first derivative.
module flexact_second_order
   use flexact_kinds, only: wp
   use flexact_vectors, only: identity
   implicit none
   private
   public :: skew, turned_once, turned_apart, at_ends, apart, spin_p, spin_q

   !> Where a second derivative (9, 9) of what an element measures has the vector from
   !> p to q, the spin of p and that of q: the first of three places each.
   integer, parameter :: apart = 1
   integer, parameter :: spin_p = 4
   integer, parameter :: spin_q = 7

contains

   !> The matrix of a x.
   pure function skew(a) result(matrix)
      real(wp), intent(in) :: a(3)
      real(wp) :: matrix(3, 3)

      matrix(:, 1) = [0.0_wp, a(3), -a(2)]
      matrix(:, 2) = [-a(3), 0.0_wp, a(1)]
      matrix(:, 3) = [a(2), -a(1), 0.0_wp]
   end function skew

   !> Of a.c, where the spin turns one of the two and the other stays:
   !> (a c' + c a')/2 - (a.c) I.
   pure function turned_once(a, c) result(second)
      real(wp), intent(in) :: a(3), c(3)
      real(wp) :: second(3, 3)
      integer :: i

      do i = 1, 3
         second(:, i) = (a*c(i) + c*a(i))/2
      end do
      second = second - dot_product(a, c)*identity
   end function turned_once

   !> Of a.b, once with respect to the spin of a (rows) and once to that of b
   !> (columns): (a.b) I - b a'.
   pure function turned_apart(a, b) result(second)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: second(3, 3)
      integer :: i

      do i = 1, 3
         second(:, i) = -b*a(i)
      end do
      second = second + dot_product(a, b)*identity
   end function turned_apart

   !> The same for positions: rows and columns of p have the other sign of those of q.
   pure function at_ends(second) result(h)
      real(wp), intent(in) :: second(9, 9)
      real(wp) :: h(12, 12)
      integer, parameter :: place(9) = [7, 8, 9, 4, 5, 6, 10, 11, 12]

      h = 0.0_wp
      h(place, place) = second
      h(1:3, :) = -h(7:9, :)
      h(:, 1:3) = -h(:, 7:9)
   end function at_ends
end module flexact_second_order
