!> Of all orthonormal bases of a null space one that can be read: its vectors
!> are turned until each has few large parts.
module flexact_localise
   use flexact_kinds, only: wp
   implicit none
   private
   public :: localise

   !> Wider bases are left as they are: turning costs their width squared.
   integer, parameter :: widest = 64
   integer, parameter :: most_sweeps = 30
   !> A turn below this angle [rad] changes nothing that anyone reads.
   real(wp), parameter :: small_turn = 1.0e-10_wp

contains

   !> Turn the columns (n, k) among themselves by the varimax criterion (Kaiser,
   !> Psychometrika 23, 1958), which looks at entries divided by scale (n); the
   !> space stays, and an orthonormal basis stays one. Then order the columns by
   !> the place of their largest entry, so divided, and make that positive.
   pure subroutine localise(basis, scale)
      real(wp), intent(inout) :: basis(:, :)
      real(wp), intent(in) :: scale(:)
      real(wp) :: angle, largest_turn
      integer :: sweep, p, q

      if (size(basis, 2) <= widest) then
         do sweep = 1, most_sweeps
            largest_turn = 0.0_wp
            do p = 1, size(basis, 2) - 1
               do q = p + 1, size(basis, 2)
                  angle = best_turn(basis(:, p)/scale, basis(:, q)/scale)
                  call turn(basis(:, p), basis(:, q), angle)
                  largest_turn = max(largest_turn, abs(angle))
               end do
            end do
            if (largest_turn < small_turn) exit
         end do
         call order_columns(basis, scale)
      end if
      do p = 1, size(basis, 2)
         associate (vector => basis(:, p))
            if (size(vector) > 0) vector = sign(1.0_wp, vector(largest_entry(vector/scale)))*vector
         end associate
      end do
   end subroutine localise

   !> The angle by which x and y are best turned in their plane; entries are
   !> brought to order one first, since their fourth powers are summed.
   pure real(wp) function best_turn(x, y) result(angle)
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
   end function best_turn

   pure subroutine turn(x, y, angle)
      real(wp), intent(inout) :: x(:), y(:)
      real(wp), intent(in) :: angle
      real(wp) :: old(size(x))

      old = x
      x = cos(angle)*x + sin(angle)*y
      y = cos(angle)*y - sin(angle)*old
   end subroutine turn

   pure subroutine order_columns(basis, scale)
      real(wp), intent(inout) :: basis(:, :)
      real(wp), intent(in) :: scale(:)
      real(wp) :: moving(size(basis, 1))
      integer :: i, j

      do i = 2, size(basis, 2)
         moving = basis(:, i)
         do j = i - 1, 1, -1
            if (largest_entry(basis(:, j)/scale) <= largest_entry(moving/scale)) exit
            basis(:, j + 1) = basis(:, j)
         end do
         basis(:, j + 1) = moving
      end do
   end subroutine order_columns

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
end module flexact_localise
