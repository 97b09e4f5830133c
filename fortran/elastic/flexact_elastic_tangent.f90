! SPDX-License-Identifier: BSD-3-Clause
!> A mechanism linearised at a state: deformations, their derivatives, second derivatives
!> under the stress, gravity, and mass, element by element.
module flexact_elastic_tangent
   use flexact_configuration, only: make_poses
   use flexact_elastic_model, only: elastic_model_t, scatter
   use flexact_elastic_state, only: state_t, unit_parameters
   use flexact_element, only: element_deformation
   use flexact_element_curvature, only: element_curvature
   use flexact_element_gravity, only: element_gravity
   use flexact_element_mass, only: element_mass, node_mass
   use flexact_kinds, only: wp
   use flexact_pose, only: pose_t
   use flexact_slots, only: axes, is_position, node_planar_position, node_orientation, node_angle
   use flexact_vectors, only: cross
   implicit none
   private
   public :: tangent_t, make_tangent, add_hessian, add_mass, component_row

   type :: tangent_t
      !> (6, elements), (6, 12, elements).
      real(wp), allocatable :: deformation(:, :), derivative(:, :, :)
      !> (12, 12, elements) of the stress and of gravity; (3, 3, nodes) of reactions on spins.
      real(wp), allocatable :: hessian(:, :, :), node_hessian(:, :, :)
      !> (12, 12, elements), (3, 3, nodes).
      real(wp), allocatable :: mass(:, :, :), node_mass(:, :, :)
      !> (3 nodes) of gravity.
      real(wp), allocatable :: weight(:)
   end type tangent_t

contains

   !> Deformations and their first derivatives, and weights.
   subroutine make_tangent(elastic, configuration, gravity, tangent)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :), gravity(3)
      type(tangent_t), intent(inout) :: tangent
      type(pose_t) :: p, q
      real(wp) :: f(12), h(12, 12)
      integer :: k

      associate (model => elastic%model)
         if (.not. allocated(tangent%deformation)) then
            allocate (tangent%deformation(6, model%elements), tangent%derivative(6, 12, model%elements))
            allocate (tangent%hessian(12, 12, model%elements), tangent%node_hessian(axes, axes, model%nodes))
            allocate (tangent%weight(axes*model%nodes))
         end if
         tangent%weight = 0.0_wp
         if (any(abs(gravity) > 0)) call weigh_nodes(elastic, gravity, tangent%weight)
         do k = 1, model%elements
            call make_poses(model, k, configuration, p, q)
            call element_deformation(model%element_kind(k), elastic%reference(k), p, q, tangent%deformation(:, k), &
                                     tangent%derivative(:, :, k))
            if (.not. any(abs(gravity) > 0)) cycle
            call element_gravity(model%element_kind(k), elastic%reference(k), p, q, elastic%given%mass(:, k), gravity, f, h)
            call scatter(elastic%entry(:, k), f, tangent%weight)
         end do
      end associate
   end subroutine make_tangent

   subroutine weigh_nodes(elastic, gravity, weight)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: gravity(3)
      real(wp), intent(inout) :: weight(:)
      real(wp) :: m(3, 3)
      integer :: node

      do node = 1, elastic%model%nodes
         if (.not. is_position(elastic%model%node_kind(node))) cycle
         call node_mass(elastic%model%node_kind(node), elastic%model%node_value(:, node), &
                        elastic%given%node_mass(:, node), m)
         weight(axes*node - 2:axes*node) = matmul(m, gravity)
      end do
   end subroutine weigh_nodes

   !> Second derivatives under the stress and the reactions of a state, and of gravity. A reaction
   !> where nothing is held any more stays as a constant moment on the angle of its Euler parameter,
   !> or, where it says so, as a constant force on the parameter itself.
   subroutine add_hessian(elastic, state, gravity, tangent, on_parameters)
      type(elastic_model_t), intent(in) :: elastic
      type(state_t), intent(in) :: state
      real(wp), intent(in) :: gravity(3)
      type(tangent_t), intent(inout) :: tangent
      logical, intent(in), optional :: on_parameters
      type(pose_t) :: p, q
      real(wp) :: f(12), h(12, 12)
      logical :: on_angles
      integer :: k, node

      do k = 1, elastic%model%elements
         associate (kind => elastic%model%element_kind(k))
            call make_poses(elastic%model, k, state%configuration, p, q)
            tangent%hessian(:, :, k) = 0.0_wp
            if (any(abs(state%stress(:, k)) > 0)) &
               call element_curvature(kind, elastic%reference(k), p, q, state%stress(:, k), tangent%hessian(:, :, k))
            if (.not. any(abs(gravity) > 0)) cycle
            call element_gravity(kind, elastic%reference(k), p, q, elastic%given%mass(:, k), gravity, f, h)
            tangent%hessian(:, :, k) = tangent%hessian(:, :, k) + h
         end associate
      end do
      on_angles = .true.
      if (present(on_parameters)) on_angles = .not. on_parameters
      tangent%node_hessian = 0.0_wp
      do node = 1, elastic%model%nodes
         if (elastic%model%node_kind(node) /= node_orientation .or. .not. elastic%is_free(axes*node)) cycle
         if (.not. any(abs(state%reaction(:, node)) > 0)) cycle
         tangent%node_hessian(:, :, node) = &
            reaction_hessian(unit_parameters(state%configuration(:, node)), state%reaction(:, node), &
                             on_angles .and. .not. elastic%is_component(axes*node - 2:axes*node))
      end do
   end subroutine add_hessian

   !> Minus the second derivatives of 2 lambda_i by the spin, times reactions; of angles
   !> 2 asin(lambda_i), times the moments reaction_i cos(angle_i/2), where on_angle says so.
   pure function reaction_hessian(euler, reaction, on_angle) result(h)
      real(wp), intent(in) :: euler(4), reaction(3)
      logical, intent(in) :: on_angle(3)
      real(wp) :: h(3, 3)
      real(wp) :: row(3), part
      integer :: axis, i

      h = 0.0_wp
      do axis = 1, axes
         part = reaction(axis)*euler(1 + axis)/2
         do i = 1, axes
            h(i, i) = h(i, i) + part
         end do
         row = component_row(euler, axis)
         ! Twice the row has the length of the cosine: 0 at half a turn, where the angle ends.
         if (on_angle(axis) .and. any(abs(row) > 0)) &
            h = h - part*spread(row, 2, axes)*spread(row, 1, axes)/dot_product(row, row)
      end do
   end function reaction_hessian

   subroutine add_mass(elastic, configuration, tangent)
      type(elastic_model_t), intent(in) :: elastic
      real(wp), intent(in) :: configuration(:, :)
      type(tangent_t), intent(inout) :: tangent
      type(pose_t) :: p, q
      integer :: k, node

      associate (model => elastic%model)
         allocate (tangent%mass(12, 12, model%elements), tangent%node_mass(3, 3, model%nodes))
         do k = 1, model%elements
            call make_poses(model, k, configuration, p, q)
            call element_mass(model%element_kind(k), elastic%reference(k), p, q, elastic%given%mass(:, k), tangent%mass(:, :, k))
         end do
         do node = 1, model%nodes
            call node_mass(model%node_kind(node), configuration(:, node), elastic%given%node_mass(:, node), &
                           tangent%node_mass(:, :, node))
         end do
      end associate
   end subroutine add_mass

   !> Derivative of component `axis` of the Euler parameters with respect to the spin.
   pure function component_row(euler, axis) result(row)
      real(wp), intent(in) :: euler(4)
      integer, intent(in) :: axis
      real(wp) :: row(3)
      real(wp) :: e(3)

      e = 0.0_wp
      e(axis) = 1.0_wp
      row = (euler(1)*e + cross(euler(2:), e))/2
   end function component_row
end module flexact_elastic_tangent
