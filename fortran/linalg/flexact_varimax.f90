! SPDX-License-Identifier: BSD-3-Clause
!> Of all orthonormal bases of a space one that can be read: its vectors are
!> rotated until each has few large entries.
module flexact_varimax
   use flexact_kinds, only: wp
   use flexact_sorting, only: ascending
   implicit none
   private
   public :: varimax

   !> Wider bases are left as they are: a sweep costs their width squared, and
   !> nobody reads so many vectors one by one.
   integer, parameter :: widest = 64
   !> A guard against cycling.
   integer, parameter :: most_sweeps = 30
   !> A rotation by less than this [rad] changes nothing that anyone reads.
   real(wp), parameter :: small_angle = 1.0e-10_wp

contains

   !> Rotate the columns (n, k) among themselves by the varimax criterion (Kaiser,
   !> Psychometrika 23, 1958), which looks at entries divided by scale (n); the
   !> space stays, and an orthonormal basis stays one. Then order the columns by
   !> the place of their largest entry, so divided, and make that positive.
   pure subroutine varimax(basis, scale)
      real(wp), intent(inout) :: basis(:, :)
      real(wp), intent(in) :: scale(:)
      real(wp) :: angle, largest_angle
      integer :: sweep, p, q

      if (size(basis, 2) <= widest) then
         do sweep = 1, most_sweeps
            largest_angle = 0.0_wp
            do p = 1, size(basis, 2) - 1
               do q = p + 1, size(basis, 2)
                  angle = best_angle(basis(:, p)/scale, basis(:, q)/scale)
                  call rotate(basis(:, p), basis(:, q), angle)
                  largest_angle = max(largest_angle, abs(angle))
               end do
            end do
            if (largest_angle < small_angle) exit
         end do
         basis = basis(:, ascending([(real(largest_entry(basis(:, p)/scale), wp), p=1, size(basis, 2))]))
      end if
      do p = 1, size(basis, 2)
         associate (vector => basis(:, p))
            if (size(vector) > 0) vector = sign(1.0_wp, vector(largest_entry(vector/scale)))*vector
         end associate
      end do
   end subroutine varimax

   !> The angle by which x and y are best rotated in their plane; entries are
   !> brought to order one first, since their fourth powers are summed.
   pure real(wp) function best_angle(x, y) result(angle)
      real(wp), intent(in) :: x(:), y(:)
      real(wp) :: u(size(x)), v(size(x)), unit, above, below

      angle = 0.0_wp
      unit = max(maxval(abs(x)), maxval(abs(y)))
      if (.not. unit > 0) return
      u = (x/unit)**2 - (y/unit)**2
      v = 2*(x/unit)*(y/unit)
      above = 2*(sum(u*v) - sum(u)*sum(v)/size(x))
      below = sum(u**2 - v**2) - (sum(u)**2 - sum(v)**2)/size(x)
      ! A plane in which all directions are as good is left alone.
      if (hypot(above, below) > 1.0e-8_wp) angle = atan2(above, below)/4
   end function best_angle

   pure subroutine rotate(x, y, angle)
      real(wp), intent(inout) :: x(:), y(:)
      real(wp), intent(in) :: angle
      real(wp) :: old(size(x))

      old = x
      x = cos(angle)*x + sin(angle)*y
      y = cos(angle)*y - sin(angle)*old
   end subroutine rotate

   !> The entry of largest magnitude, the first among equals.
   pure integer function largest_entry(vector) result(entry)
      real(wp), intent(in) :: vector(:)
      real(wp), parameter :: equal = 1.0e-9_wp
      real(wp) :: largest

      largest = (1 - equal)*maxval(abs(vector))
      do entry = 1, size(vector) - 1
         if (abs(vector(entry)) >= largest) return
      end do
   end function largest_entry
end module flexact_varimax
