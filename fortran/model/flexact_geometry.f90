! SPDX-License-Identifier: BSD-3-Clause
!> What may be wrong with the places of an element's ends.
module flexact_geometry
   use, intrinsic :: ieee_arithmetic, only: ieee_is_finite
   use flexact_element_table, only: element_kinds, vector_optional
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_slots, only: node_planar_position
   use flexact_vectors, only: coincide, length_of, unit
   implicit none
   private
   public :: fault_of, is_sound
   public :: fault_none, fault_not_finite, fault_zero_length, fault_out_of_range, fault_vector_not_finite, fault_parallel

   integer, parameter :: fault_none = 0, fault_not_finite = 1, fault_zero_length = 2, fault_out_of_range = 3
   integer, parameter :: fault_vector_not_finite = 4, fault_parallel = 5

   !> Sine of the angle below which a vector counts as parallel to its beam.
   real(wp), parameter :: parallel_sine = 1.0e-6_wp
   !> Lengths whose cubes and quotients stay within the range of numbers.
   real(wp), parameter :: shortest = 1.0e-90_wp
   real(wp), parameter :: longest = 1.0e90_wp

contains

   !> Whether every element stands as it may.
   pure logical function is_sound(model)
      type(model_t), intent(in) :: model
      integer :: k

      is_sound = .false.
      do k = 1, model%elements
         if (fault_of(model, k) /= fault_none) return
      end do
      is_sound = .true.
   end function is_sound

   !> What is wrong with element k, the first that is: one of those above.
   pure integer function fault_of(model, k) result(fault)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      real(wp) :: half(3), length
      integer :: axes

      fault = fault_none
      associate (kind => element_kinds(model%element_kind(k)), p => model%element_node(1, k), &
                 q => model%element_node(3, k))
         if (p == 0 .or. q == 0) return
         ! A planar element sees x and y alone.
         axes = merge(2, 3, kind%slot_kind(1) == node_planar_position)
         if (.not. all(ieee_is_finite(model%node_value(:axes, [p, q])))) then
            fault = fault_not_finite
            return
         end if
         ! Halved, because a difference may overflow.
         half = 0.0_wp
         half(:axes) = model%node_value(:axes, q)/2 - model%node_value(:axes, p)/2
         length = 2*min(length_of(half), huge(length)/2)
         if (coincide(model%node_value(:axes, p), model%node_value(:axes, q))) then
            if (kind%needs_length) fault = fault_zero_length
         else if (length > longest .or. length < shortest) then
            fault = fault_out_of_range
         else if (kind%vector == vector_optional .and. .not. all(abs(model%element_vector(:, k)) <= 0)) then
            fault = fault_of_vector(model%element_vector(:, k), unit(half))
         end if
      end associate
   end function fault_of

   !> Of the y vector of an element along ex.
   pure integer function fault_of_vector(vector, ex) result(fault)
      real(wp), intent(in) :: vector(3), ex(3)
      real(wp) :: direction(3)

      fault = fault_none
      if (.not. all(ieee_is_finite(vector))) then
         fault = fault_vector_not_finite
         return
      end if
      direction = unit(vector)
      if (norm2(direction - dot_product(direction, ex)*ex) < parallel_sine) fault = fault_parallel
   end function fault_of_vector
end module flexact_geometry
