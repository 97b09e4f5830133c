! SPDX-License-Identifier: BSD-3-Clause
!> What elements and nodes are made of, as it was said: stiffness, mass, strength and others.
!> Whether a mechanism is exactly constrained does not depend on them.
module flexact_properties
   use, intrinsic :: ieee_arithmetic, only: ieee_value, ieee_quiet_nan
   use flexact_kinds, only: wp
   use flexact_slots, only: is_position, node_angle
   implicit none
   private
   public :: properties_t, make_properties
   public :: stiffness_numbers, mass_numbers, strength_numbers, node_mass_numbers
   public :: node_mass_meant

   !> How many numbers each has at most.
   integer, parameter :: stiffness_numbers = 6
   integer, parameter :: mass_numbers = 5
   integer, parameter :: strength_numbers = 2
   integer, parameter :: node_mass_numbers = 6

   !> In the order of the deck language; NaN where not given.
   type :: properties_t
      !> (6, elements) EA, G It, E Iy, E Iz, shear of a beam.
      real(wp), allocatable :: stiffness(:, :)
      !> (5, elements) mass and moments of inertia per length.
      real(wp), allocatable :: mass(:, :)
      !> (2, elements) stress at which the material yields or breaks, and the one that it bears for good.
      real(wp), allocatable :: strength(:, :)
      !> (1, elements) expansion of the material with temperature, and radius of fillets at the ends.
      real(wp), allocatable :: expansion(:, :), fillet(:, :)
      !> (6, nodes) mass of a position, moments of inertia of an orientation.
      real(wp), allocatable :: node_mass(:, :)
   end type properties_t

contains

   !> Of so many elements and nodes nothing is given.
   pure function make_properties(elements, nodes) result(properties)
      integer, intent(in) :: elements, nodes
      type(properties_t) :: properties
      real(wp) :: not_given

      not_given = ieee_value(1.0_wp, ieee_quiet_nan)
      allocate (properties%stiffness(stiffness_numbers, elements), source=not_given)
      allocate (properties%mass(mass_numbers, elements), source=not_given)
      allocate (properties%strength(strength_numbers, elements), source=not_given)
      allocate (properties%expansion(1, elements), properties%fillet(1, elements), source=not_given)
      allocate (properties%node_mass(node_mass_numbers, nodes), source=not_given)
   end function make_properties

   !> How many numbers of XM do at a node of this kind.
   pure integer function node_mass_meant(kind) result(numbers)
      integer, intent(in) :: kind
      numbers = merge(1, node_mass_numbers, is_position(kind) .or. kind == node_angle)
   end function node_mass_meant
end module flexact_properties
