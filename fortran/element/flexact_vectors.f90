! SPDX-License-Identifier: BSD-3-Clause
!> Small vectors and right-handed frames.
module flexact_vectors
   use, intrinsic :: iso_fortran_env, only: int64
   use flexact_kinds, only: wp
   use flexact_rounding, only: typed, typed_t
   use flexact_scaled_norm, only: length_of, tiny_entry, huge_entry
   implicit none
   private
   public :: identity, cross, length_of, coincide, unit, axis_across, is_near_tie, frame_along, planar_frame_along, planar_turn

   real(wp), parameter :: identity(3, 3) = reshape([1.0_wp, 0.0_wp, 0.0_wp, &
                                                    0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], [3, 3])
   !> Components of a vector between two points whose coordinates are no decimals are equal
   !> in size up to this part of the coordinates: what turning, scaling and moving cost.
   real(wp), parameter :: bits_of_tie = 16*epsilon(1.0_wp)
   !> Components that differ by less than this part of the vector are hardly meant to differ.
   real(wp), parameter :: nearness = 1.0e-9_wp

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
      real(wp) :: direction(3), largest

      largest = maxval(abs(vector))
      direction = vector
      if (.not. (largest > tiny_entry .and. largest < huge_entry)) direction = scale(vector, -exponent(largest))
      if (largest > 0) direction = direction/sqrt(dot_product(direction, direction))
   end function unit

   !> Columns ex, ey, ez with ex along the first vector and ey as near to the
   !> hint as can be. Where the hint is zero or parallel to ex, it is the
   !> global axis across ex. A zero first vector gives the global axes.
   pure function frame_along(vector, hint) result(frame)
      real(wp), intent(in) :: vector(3), hint(3)
      real(wp) :: frame(3, 3)

      frame(:, 1) = unit(vector)
      if (.not. any(abs(frame(:, 1)) > 0)) then
         frame = identity
         return
      end if
      frame(:, 2) = across(frame(:, 1), unit(hint))
      if (.not. any(abs(frame(:, 2)) > 0)) frame(:, 2) = across(frame(:, 1), axis_across([0.0_wp, 0.0_wp, 0.0_wp], vector))
      frame(:, 3) = cross(frame(:, 1), frame(:, 2))
   end function frame_along

   !> The global axis along which the vector from p to q is smallest, the first of those
   !> along which it is equally small: as decimals, where all six coordinates are such;
   !> otherwise up to rounding.
   pure function axis_across(p, q) result(axis)
      real(wp), intent(in) :: p(3), q(3)
      real(wp) :: axis(3)
      logical :: near(3)
      integer :: chosen, i

      near = abs(q - p) <= minval(abs(q - p)) + tie_of(p, q)
      chosen = findloc(near, .true., 1)
      if (count(near) > 1) then
         if (all_decimals(p, q)) then
            do i = chosen + 1, 3
               if (near(i) .and. size_order(p, q, i, chosen) < 0) chosen = i
            end do
         end if
      end if
      axis = 0.0_wp
      axis(chosen) = 1.0_wp
   end function axis_across

   !> Whether another component of the vector from p to q is nearly as small as that along
   !> `axis_across`, and not as small: hardly a difference that is meant.
   pure logical function is_near_tie(p, q)
      real(wp), intent(in) :: p(3), q(3)
      real(wp) :: sizes(3), least
      integer :: chosen, i

      sizes = abs(q - p)
      chosen = maxloc(axis_across(p, q), 1)
      least = sizes(chosen)
      is_near_tie = .false.
      do i = 1, 3
         if (i == chosen .or. abs(sizes(i) - least) > max(nearness*maxval(sizes), tie_of(p, q))) cycle
         if (all_decimals(p, q)) then
            is_near_tie = is_near_tie .or. size_order(p, q, i, chosen) /= 0
         else
            is_near_tie = is_near_tie .or. abs(sizes(i) - least) > 0
         end if
      end do
   end function is_near_tie

   pure logical function all_decimals(p, q)
      real(wp), intent(in) :: p(3), q(3)
      type(typed_t) :: number(6)

      number = typed([p, q])
      all_decimals = all(number%short)
   end function all_decimals

   !> The sign of |q(i) - p(i)| - |q(j) - p(j)| of decimals.
   pure integer function size_order(p, q, i, j)
      real(wp), intent(in) :: p(3), q(3)
      integer, intent(in) :: i, j
      type(typed_t) :: term(4)

      ! Reading keeps the order of decimals, so that the sign of a difference is known.
      term = typed([max(p(i), q(i)), min(p(j), q(j)), min(p(i), q(i)), max(p(j), q(j))])
      term(3:4)%mantissa = -term(3:4)%mantissa
      size_order = sign_of_sum(term)
   end function size_order

   !> The sign of a sum of decimals, digit by digit from the left: once the sum exceeds what
   !> mantissas of fifteen digits can take from it, the rest does not matter.
   pure integer function sign_of_sum(term)
      type(typed_t), intent(in) :: term(:)
      integer(int64) :: total
      integer :: place

      total = 0
      place = maxval(term%place)
      do
         total = total + sum(term%mantissa, term%place == place)
         if (.not. any(term%place < place) .or. abs(total) > size(term)*10_int64**15) exit
         if (total == 0) then
            place = maxval(term%place, term%place < place)
         else
            place = place - 1
            total = 10*total
         end if
      end do
      sign_of_sum = int(sign(min(1_int64, abs(total)), total))
   end function sign_of_sum

   pure real(wp) function tie_of(p, q)
      real(wp), intent(in) :: p(3), q(3)
      tie_of = bits_of_tie*max(maxval(abs(p)), maxval(abs(q)))
   end function tie_of

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
