! SPDX-License-Identifier: BSD-3-Clause
!> How an element's part of D changes with its geometry; theory.md (20).
module flexact_variation
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_slots, only: has_axis, slots, most_deformations
   use flexact_element, only: reference_frame, element_deformation
   use flexact_configuration, only: element_reference, make_poses
   use flexact_element_table, only: element_kinds, deformations_of, frame_about, rule_along => frame_along
   use flexact_pose, only: pose_t, reference_t
   use flexact_scaled_norm, only: length_of
   use flexact_vectors, only: axis_across, cross, unit
   implicit none
   private
   public :: variation_t, make_variation, parameters

   !> The numbers of an element's geometry: the vector from p to q, and the y
   !> vector of a beam or the axis of a hinge.
   integer, parameter :: parameters = 6
   !> Of the length; central differences err by the square of it, and rounding
   !> by the inverse.
   real(wp), parameter :: relative_step = 1.0e-5_wp

   type :: variation_t
      !> The vector from p to q.
      real(wp) :: offset(3) = 0.0_wp
      integer :: deformations = 0
      !> Which numbers of the geometry there are.
      logical :: varies(parameters) = .false.
      !> Derivatives of the deformations by the coordinates of p and q, (6, 12),
      !> as `element_deformation` has them, by each of those numbers.
      real(wp) :: derivative(most_deformations, 12, parameters) = 0.0_wp
   end type variation_t

contains

   !> How the derivatives of element k change. The model of one element is work
   !> space that the caller keeps.
   pure subroutine make_variation(model, k, alone, variation)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(model_t), intent(inout) :: alone
      type(variation_t), intent(inout) :: variation
      real(wp) :: number(parameters), step(parameters), axis(3)
      integer :: i

      call take_out(model, k, alone)
      number = [alone%node_value(1:3, 3), alone%element_vector(:, 1)]
      axis = free_axis(alone)
      step(1:3) = relative_step*slant(alone%element_kind(1), number)*length_of(number(1:3))
      step(4:6) = relative_step*slant(alone%element_kind(1), number)*length_of(number(4:6))
      ! Without a length the frame stays, and e is linear in the offset.
      if (.not. step(1) > 0) step(1:3) = 1.0_wp
      do i = 1, 3
         if (.not. has_axis(alone%node_kind(3), i)) step(i) = 0.0_wp
      end do
      if (alone%node_kind(3) == 0) step(1:3) = 0.0_wp
      variation%deformations = deformations_of(model%element_kind(k))
      variation%offset = number(1:3)
      variation%varies = step > 0
      do i = 1, parameters
         if (step(i) > 0) call vary(alone, axis, number, i, step(i), variation%derivative(:, :, i))
      end do
   end subroutine make_variation

   !> Element k as a model of its own, with p in the origin. Bits that were lost
   !> far from the origin are not lost again.
   pure subroutine take_out(model, k, alone)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      type(model_t), intent(inout) :: alone
      integer :: slot

      if (.not. allocated(alone%node_kind)) then
         allocate (alone%node_kind(slots), alone%element_node(slots, 1), alone%element_kind(1))
         allocate (alone%node_value(4, slots), alone%element_vector(3, 1))
      end if
      alone%element_kind = model%element_kind(k)
      alone%element_vector(:, 1) = model%element_vector(:, k)
      alone%element_node = 0
      alone%node_kind = 0
      alone%node_value = 0.0_wp
      do slot = 1, slots
         associate (node => model%element_node(slot, k))
            if (node == 0) cycle
            alone%element_node(slot, 1) = slot
            alone%node_kind(slot) = model%node_kind(node)
            alone%node_value(:, slot) = model%node_value(:, node)
         end associate
      end do
      alone%node_value(:, 3) = alone%node_value(:, 3) - alone%node_value(:, 1)
      alone%node_value(:, 1) = 0.0_wp
   end subroutine take_out

   !> The global axis that stands in for a y vector where there is none: which
   !> one it is must not change with the geometry. Zeros where none does.
   pure function free_axis(alone) result(axis)
      type(model_t), intent(in) :: alone
      real(wp) :: axis(3)

      axis = 0.0_wp
      associate (vector => alone%element_vector(:, 1))
         select case (element_kinds(alone%element_kind(1))%frame)
         case (frame_about)
            axis = axis_across(vector)
         case (rule_along)
            if (.not. any(abs(vector) > 0)) axis = axis_across(alone%node_value(1:3, 3))
         end select
      end associate
   end function free_axis

   !> The sine of the angle between a beam and its y vector: as it falls, the
   !> frame turns the faster with either. 1 where there are not both.
   pure real(wp) function slant(kind, number)
      integer, intent(in) :: kind
      real(wp), intent(in) :: number(parameters)

      slant = 1.0_wp
      if (element_kinds(kind)%frame /= rule_along) return
      if (any(abs(number(1:3)) > 0) .and. any(abs(number(4:6)) > 0)) &
         slant = norm2(cross(unit(number(1:3)), unit(number(4:6))))
   end function slant

   !> The central difference of the derivatives of the deformations by one
   !> number of the geometry.
   pure subroutine vary(alone, axis, number, i, step, change)
      type(model_t), intent(inout) :: alone
      real(wp), intent(in) :: axis(3), number(parameters)
      integer, intent(in) :: i
      real(wp), intent(in) :: step
      real(wp), intent(out) :: change(:, :)
      real(wp), dimension(parameters) :: lower, upper
      real(wp), dimension(most_deformations, 12) :: before, after
      logical :: rigid

      rigid = .not. any(abs(number(1:3)) > 0)
      lower = number
      upper = number
      lower(i) = lower(i) - step
      upper(i) = upper(i) + step
      call derive(alone, axis, lower, rigid, before)
      call derive(alone, axis, upper, rigid, after)
      change = (after - before)/(upper(i) - lower(i))
   end subroutine vary

   !> The derivatives with other numbers for the geometry; where it is rigid,
   !> the frame is that of an element without length.
   pure subroutine derive(alone, axis, number, rigid, derivative)
      type(model_t), intent(inout) :: alone
      real(wp), intent(in) :: axis(3), number(parameters)
      logical, intent(in) :: rigid
      real(wp), intent(out) :: derivative(:, :)
      type(reference_t) :: reference
      type(pose_t) :: p, q
      real(wp) :: e(most_deformations)

      alone%node_value(1:3, 3) = number(1:3)
      alone%element_vector(:, 1) = number(4:6)
      call element_reference(alone, 1, reference)
      reference%frame = reference_frame(alone%element_kind(1), merge(0.0_wp, number(1:3), rigid), number(4:6), axis)
      call make_poses(alone, 1, alone%node_value, p, q)
      call element_deformation(alone%element_kind(1), reference, p, q, e, derivative)
   end subroutine derive
end module flexact_variation
