! SPDX-License-Identifier: BSD-3-Clause
!> A model with stiffness and mass: what does not change with its state.
!>
!> A vector of the mechanism has three entries a node, axis by axis, for displacements and
!> spins (left increments of rotation), (3 nodes).
module flexact_elastic_model
   use flexact_configuration, only: element_reference
   use flexact_element_stiffness, only: element_stiffness, torsion_elongation
   use flexact_element_table, only: deformations_of
   use flexact_kinds, only: wp
   use flexact_model, only: model_t, class_none, class_fixed
   use flexact_pose, only: reference_t
   use flexact_slots, only: axes, is_position, most_deformations, node_orientation, slots
   implicit none
   private
   public :: elastic_model_t, properties_t, make_elastic_model, gathered, scatter
   public :: is_elastic, is_rigid, is_missing

   !> What a deformation is: not there, elastic, or held at its misfit by a multiplier.
   integer, parameter :: is_missing = 0, is_elastic = 1, is_rigid = 2

   !> Numbers of ESTIFF, (6, elements), of EM, (5, elements), of XM, (6, nodes), and
   !> stiffnesses of notches in series, (6, elements); NaN where nothing is given.
   type :: properties_t
      real(wp), allocatable :: stiffness(:, :), mass(:, :), node_mass(:, :), notch(:, :)
   end type properties_t

   type :: elastic_model_t
      type(model_t) :: model
      type(properties_t) :: given
      type(reference_t), allocatable :: reference(:)
      !> (6, 6, elements) elastic part, without rows and columns of rigid deformations.
      real(wp), allocatable :: stiffness(:, :, :)
      !> (6, elements) one of those above.
      integer, allocatable :: part(:, :)
      !> (12, elements) entry of a vector at each axis of each slot, 0 where there is none.
      integer, allocatable :: entry(:, :)
      !> (3 nodes) whether an entry moves freely, whether it is moved as a support is, and
      !> whether it is one component of an orientation that is held while others are free.
      logical, allocatable :: is_free(:), is_held(:), is_component(:)
      !> (3 nodes) whether it is a rotation.
      logical, allocatable :: is_turn(:)
      !> (3 nodes) length that makes a length of a rotation [m], 1 for displacements.
      real(wp), allocatable :: scale(:)
      !> A length of the elements [m].
      real(wp) :: length = 1.0_wp
   end type elastic_model_t

contains

   subroutine make_elastic_model(model, given, elastic)
      type(model_t), intent(in) :: model
      type(properties_t), intent(in) :: given
      type(elastic_model_t), intent(out) :: elastic
      integer :: k

      elastic%model = model
      elastic%given = given
      allocate (elastic%reference(model%elements), elastic%entry(axes*slots, model%elements))
      allocate (elastic%stiffness(6, 6, model%elements), elastic%part(most_deformations, model%elements))
      do k = 1, model%elements
         call element_reference(model, k, elastic%reference(k))
         call set_stiffness(elastic, k)
         call set_entries(model, k, elastic%entry(:, k))
      end do
      call set_coordinates(elastic)
      call set_scale(elastic)
   end subroutine make_elastic_model

   !> A fixed deformation is rigid, and with a notch in series as stiff as the notch.
   subroutine set_stiffness(elastic, k)
      type(elastic_model_t), intent(inout) :: elastic
      integer, intent(in) :: k
      integer :: i

      associate (kind => elastic%model%element_kind(k), class => elastic%model%deformation_class(:, k), &
                 s => elastic%stiffness(:, :, k), notch => elastic%given%notch(:, k))
         call element_stiffness(kind, elastic%reference(k)%length, elastic%given%stiffness(:, k), notch, s)
         elastic%reference(k)%c_t = torsion_elongation(kind, elastic%reference(k)%length, &
                                                       elastic%given%stiffness(:, k), elastic%given%mass(:, k))
         elastic%part(:, k) = is_missing
         do i = 1, deformations_of(kind)
            elastic%part(i, k) = is_elastic
            if (class(i) /= class_fixed) cycle
            s(i, :) = 0.0_wp
            s(:, i) = 0.0_wp
            if (notch(i) >= 0) then
               s(i, i) = notch(i)
            else
               elastic%part(i, k) = is_rigid
            end if
         end do
      end associate
   end subroutine set_stiffness

   pure subroutine set_entries(model, k, entry)
      type(model_t), intent(in) :: model
      integer, intent(in) :: k
      integer, intent(out) :: entry(:)
      integer :: slot, axis, node

      entry = 0
      do slot = 1, slots
         node = model%element_node(slot, k)
         if (node == 0) cycle
         do axis = 1, axes
            if (model%coordinate_class(axis, node) /= class_none) entry(axes*(slot - 1) + axis) = axes*(node - 1) + axis
         end do
      end do
   end subroutine set_entries

   !> An orientation of which all three are held is given as a whole.
   subroutine set_coordinates(elastic)
      type(elastic_model_t), intent(inout) :: elastic
      logical :: there(axes), fixed(axes)
      integer :: node, first

      associate (n => axes*elastic%model%nodes)
         allocate (elastic%is_free(n), elastic%is_held(n), elastic%is_component(n), source=.false.)
      end associate
      do node = 1, elastic%model%nodes
         first = axes*(node - 1)
         there = elastic%model%coordinate_class(:, node) /= class_none
         fixed = elastic%model%coordinate_class(:, node) == class_fixed
         if (elastic%model%node_kind(node) == node_orientation .and. any(fixed) .and. .not. all(fixed)) then
            elastic%is_component(first + 1:first + axes) = fixed
            elastic%is_free(first + 1:first + axes) = .true.
         else
            elastic%is_held(first + 1:first + axes) = fixed
            elastic%is_free(first + 1:first + axes) = there .and. .not. fixed
         end if
      end do
   end subroutine set_coordinates

   !> The root of the mean square of the lengths, so that sums of both kinds of entries make sense.
   subroutine set_scale(elastic)
      type(elastic_model_t), intent(inout) :: elastic
      real(wp) :: lengths(elastic%model%elements)
      integer :: i

      lengths = elastic%reference%length
      if (any(lengths > 0)) elastic%length = norm2(lengths)/sqrt(real(count(lengths > 0), wp))
      elastic%is_turn = [(.not. is_position(elastic%model%node_kind((i + 2)/axes)), i=1, axes*elastic%model%nodes)]
      elastic%scale = merge(elastic%length, 1.0_wp, elastic%is_turn)
   end subroutine set_scale

   !> The part of a vector that an element sees.
   pure function gathered(entry, vector) result(part)
      integer, intent(in) :: entry(12)
      real(wp), intent(in) :: vector(:)
      real(wp) :: part(12)
      integer :: i

      part = 0.0_wp
      do i = 1, size(entry)
         if (entry(i) > 0) part(i) = vector(entry(i))
      end do
   end function gathered

   !> Add what an element gives to a vector.
   pure subroutine scatter(entry, part, vector)
      integer, intent(in) :: entry(12)
      real(wp), intent(in) :: part(12)
      real(wp), intent(inout) :: vector(:)
      integer :: i

      do i = 1, size(entry)
         if (entry(i) > 0) vector(entry(i)) = vector(entry(i)) + part(i)
      end do
   end subroutine scatter
end module flexact_elastic_model
