! SPDX-License-Identifier: BSD-3-Clause
!> Rows of D(c) in the reference configuration as polynomials in the numbers of the
!> model, each up to a positive factor: lengths of vectors, which are roots, are
!> left out of it, so that nothing is rounded. They are rules on the roles of the
!> deformations, theory.md (10) to (16).
module flexact_exact_rows
   use flexact_configuration, only: stand_in
   use flexact_element_table, only: element_kinds, frame_none, frame_about, frame_planar
   use flexact_exact_number, only: arithmetic_t, number_t, number_of, whole, operator(+), operator(-), operator(*)
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_roles
   use flexact_slots, only: axes, node_planar_position
   implicit none
   private
   public :: exact_element_t, make_exact_element, exact_row

   !> The offset from p to q, and vectors along ex, ey, ez: x is the offset or the
   !> axis, z = x times the vector, y = z times x, where times is the cross product.
   type :: exact_element_t
      integer :: kind = 0
      type(number_t) :: offset(3), x(3), y(3), z(3)
      !> The square of the length, and the number one.
      type(number_t) :: square, one
   end type exact_element_t

contains

   !> place (3, nodes): node values as numbers, where many elements ask for them.
   pure subroutine make_exact_element(model, k, arithmetic, element, place)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(arithmetic_t), intent(in) :: arithmetic
      type(exact_element_t), intent(out) :: element
      type(number_t), intent(in), optional :: place(:, :)
      real(wp) :: chord(3)
      integer :: seen

      element%kind = model%element_kind(k)
      element%one = whole(1, arithmetic)
      chord = 0.0_wp
      associate (row => element_kinds(element%kind), p => model%element_node(1, k), q => model%element_node(3, k))
         if (p > 0 .and. q > 0) then
            ! A planar element sees x and y alone.
            seen = merge(2, 3, row%slot_kind(1) == node_planar_position)
            chord(:seen) = model%node_value(:seen, q) - model%node_value(:seen, p)
            if (present(place)) then
               element%offset(:seen) = place(:seen, q) - place(:seen, p)
            else
               element%offset(:seen) = number_of(model%node_value(:seen, q), arithmetic) &
                                       - number_of(model%node_value(:seen, p), arithmetic)
            end if
         end if
         if (all(row%role <= role_elongation)) return
         element%square = dot(element%offset, element%offset)
         call make_frame(row%frame, chord, model%element_vector(:, k), stand_in(model, k), arithmetic, element)
      end associate
   end subroutine make_exact_element

   !> Vectors along the axes of `element_frame`.
   pure subroutine make_frame(rule, chord, vector, axis, arithmetic, element)
      integer, intent(in) :: rule
      real(wp), intent(in) :: chord(3), vector(3), axis(3)
      type(arithmetic_t), intent(in) :: arithmetic
      type(exact_element_t), intent(inout) :: element
      real(wp) :: towards(3)

      if (rule == frame_none) return
      if (rule == frame_planar) then
         element%x = element%offset
         element%y(1) = -element%offset(2)
         element%y(2) = element%offset(1)
         return
      end if
      towards = vector
      element%x = element%offset
      if (rule == frame_about) then
         element%x = number_of(vector, arithmetic)
         towards = axis
      else if (.not. any(abs(chord) > 0)) then
         element%x = number_of([1.0_wp, 0.0_wp, 0.0_wp], arithmetic)
         towards = [0.0_wp, 1.0_wp, 0.0_wp]
      else if (.not. any(abs(vector) > 0)) then
         towards = axis
      end if
      element%z = cross(element%x, number_of(towards, arithmetic))
      element%y = cross(element%z, element%x)
   end subroutine make_frame

   !> The derivatives of deformation i by the position of p, the rotation of p, the
   !> position of q and the rotation of q.
   pure subroutine exact_row(element, i, row)
      type(exact_element_t), intent(in) :: element
      integer, intent(in) :: i
      type(number_t), intent(out) :: row(12)
      integer :: role

      role = element_kinds(element%kind)%role(i)
      associate (position_p => row(1:3), rotation_p => row(4:6), position_q => row(7:9), rotation_q => row(10:12))
         select case (role)
         case (role_elongation)
            position_q = element%offset
         case (role_torsion)
            rotation_q = element%offset
            rotation_p = -rotation_q
         case (role_bending_xz_p, role_bending_xz_q, role_bending_xy_p, role_bending_xy_q)
            call bend(element, role, position_q, rotation_p, rotation_q)
         case (role_planar_bending_p)
            position_q = -element%y
            rotation_p(3) = element%square
         case (role_planar_bending_q)
            position_q = element%y
            rotation_q(3) = -element%square
         case (role_offset_x:role_offset_z)
            position_q = axis(element, role - role_offset_x)
            rotation_p = cross(position_q, element%offset)
         case (role_rotation:role_tilt_z)
            rotation_q = axis(element, role - role_rotation)
            rotation_p = -rotation_q
         case (role_angle)
            rotation_q(3) = element%one
            rotation_p(3) = -element%one
         end select
         position_p = -position_q
      end associate
   end subroutine exact_row

   pure subroutine bend(element, role, position_q, rotation_p, rotation_q)
      type(exact_element_t), intent(in) :: element
      integer, intent(in) :: role
      type(number_t), intent(inout) :: position_q(3), rotation_p(3), rotation_q(3)

      select case (role)
      case (role_bending_xz_p)
         position_q = -element%z
         rotation_p = -element%y
      case (role_bending_xz_q)
         position_q = element%z
         rotation_q = element%y
      case (role_bending_xy_p)
         position_q = element%y
         rotation_p = -(element%square*element%z)
      case (role_bending_xy_q)
         position_q = -element%y
         rotation_q = element%square*element%z
      end select
   end subroutine bend

   !> Along ex, ey or ez: number 0, 1 or 2.
   pure function axis(element, number) result(along)
      type(exact_element_t), intent(in) :: element
      integer, intent(in) :: number
      type(number_t) :: along(axes)

      select case (number)
      case (0); along = element%x
      case (1); along = element%y
      case default; along = element%z
      end select
   end function axis

   pure function cross(a, b) result(c)
      type(number_t), intent(in) :: a(3), b(3)
      type(number_t) :: c(3)
      c = a([2, 3, 1])*b([3, 1, 2]) - a([3, 1, 2])*b([2, 3, 1])
   end function cross

   pure type(number_t) function dot(a, b) result(c)
      type(number_t), intent(in) :: a(3), b(3)
      c = a(1)*b(1) + a(2)*b(2) + a(3)*b(3)
   end function dot
end module flexact_exact_rows
