! SPDX-License-Identifier: BSD-3-Clause
!> The model: nodes, elements and classes as arrays.
!>
!> A class of `class_none` says that a node has no such coordinate (z of a planar
!> position; all but rz of an angle), or an element no such deformation.
module flexact_model
   use flexact_kinds, only: wp
   implicit none
   private
   public :: model_t
   public :: class_none, class_fixed, class_dependent, class_independent, class_names

   integer, parameter :: class_none = 0
   integer, parameter :: class_fixed = 1
   integer, parameter :: class_dependent = 2
   integer, parameter :: class_independent = 3

   character(len=24), parameter :: class_names(0:3) = [character(len=24) :: 'none', 'fixed', 'dependent', 'independent']

   type :: model_t
      integer :: nodes = 0
      integer :: elements = 0
      !> Node: number in the deck, kind, and reference value: a position
      !> x, y, z; four Euler parameters; or an angle in value(1).
      integer, allocatable :: node_number(:)
      integer, allocatable :: node_kind(:)
      real(wp), allocatable :: node_value(:, :)
      !> Where the node's X statement starts in the deck's text; 0 without one.
      integer, allocatable :: node_origin(:)
      !> Class of each axis of each node, (3, nodes).
      integer, allocatable :: coordinate_class(:, :)
      !> Element: number in the deck, kind (a row of the element table), node
      !> indices by slot with 0 for an unused one, (4, elements), and the y
      !> vector of a beam or the axis of a hinge, zero where none was given.
      integer, allocatable :: element_number(:)
      integer, allocatable :: element_kind(:)
      integer, allocatable :: element_node(:, :)
      real(wp), allocatable :: element_vector(:, :)
      !> Class of each deformation, (6, elements); class_none beyond the last.
      integer, allocatable :: deformation_class(:, :)
      !> Where the element's statement starts in the deck's text; 0 without one.
      integer, allocatable :: element_origin(:)
   end type model_t
end module flexact_model
