! SPDX-License-Identifier: BSD-3-Clause
!> Small vectors and right-handed frames.
module flexact_vectors
   use flexact_kinds, only: wp
   use flexact_scaled_norm, only: length_of
   implicit none
   private
   public :: identity, cross, length_of, coincide, unit, axis_across, frame_along, planar_frame_along, planar_turn

   real(wp), parameter :: identity(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, &
                                                    0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])

contains

   pure function cross(a, b) result(c)
      real(wp), intent(in) :: a(3), b(3)
      real(wp) :: c(3)
      c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
   end function cross

   !> Whether two points are one up to the rounding of their coordinates.
   pure logical function coincide(a, b)
      real(wp), intent(in) :: a(:), b(:)

      ! Halved, because a difference may overflow.
      coincide = length_of(b/2 - a/2) <= 2*epsilon(1.0_wp)*max(maxval(abs(a)), maxval(abs(b)))
   end function coincide

   !> The direction of a vector of any magnitude; zero for the zero vector.
   pure function unit(vector) result(direction)
      real(wp), intent(in) :: vector(3)
      real(wp) :: direction(3)

      direction = scale(vector, -exponent(maxval(abs(vector))))
      if (any(abs(direction) > 0)) direction = direction/norm2(direction)
   end function unit

   !> Columns ex, ey, ez with ex along the first vector and ey as near to the
   !> hint as can be. Where the hint is zero or parallel to ex, it is the
   !> global axis along which |ex| is smallest. A zero first vector gives the
   !> global axes.
   pure function frame_along(vector, hint) result(frame)
      real(wp), intent(in) :: vector(3), hint(3)
      real(wp) :: frame(3, 3)

      frame(:, 1) = unit(vector)
      if (.not. any(abs(frame(:, 1)) > 0)) then
         frame = identity
         return
      end if
      frame(:, 2) = across(frame(:, 1), unit(hint))
      if (.not. any(abs(frame(:, 2)) > 0)) frame(:, 2) = across(frame(:, 1), axis_across(vector))
      frame(:, 3) = cross(frame(:, 1), frame(:, 2))
   end function frame_along

   !> The global axis along which the unit vector of a vector is smallest.
   pure function axis_across(vector) result(axis)
      real(wp), intent(in) :: vector(3)
      real(wp) :: axis(3)

      axis = 0.0_wp
      axis(minloc(abs(unit(vector)), 1)) = 1.0_wp
   end function axis_across

   !> The direction of that part of a unit vector that is perpendicular to ex;
   !> zero where nothing but rounding is left. Projecting twice keeps ey
   !> perpendicular to ex although the two vectors may be nearly parallel.
   pure function across(ex, vector) result(ey)
      real(wp), intent(in) :: ex(3), vector(3)
      real(wp) :: ey(3)

      ey = vector - dot_product(ex, vector)*ex
      if (norm2(ey) < 8*epsilon(1.0_wp)) then
         ey = 0.0_wp
      else
         ey = unit(ey)
         ey = unit(ey - dot_product(ex, ey)*ex)
      end if
   end function across

   !> As `frame_along` in the xy plane: ez is the global z axis.
   pure function planar_frame_along(vector) result(frame)
      real(wp), intent(in) :: vector(3)
      real(wp) :: frame(3, 3)

      frame = 0.0_wp
      frame(:, 1) = unit([vector(1:2), 0.0_wp])
      frame(:, 2) = [-frame(2, 1), frame(1, 1), 0.0_wp]
      frame(3, 3) = 1.0_wp
   end function planar_frame_along

   !> A vector turned about the global z axis by an angle in radians.
   pure function planar_turn(angle, vector) result(turned)
      real(wp), intent(in) :: angle, vector(3)
      real(wp) :: turned(3)
      turned = [cos(angle)*vector(1) - sin(angle)*vector(2), &
                sin(angle)*vector(1) + cos(angle)*vector(2), vector(3)]
   end function planar_turn
end module flexact_vectors
