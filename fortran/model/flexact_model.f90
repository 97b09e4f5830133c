!> The model: nodes, elements and classes as arrays.
!>
!> Every node has three axes: x, y, z of a position node, the rotations about
!> x, y, z of an orientation node. A class of `class_none` says that the node
!> has no such coordinate (z of a planar position; all but rz of an angle).
module flexact_model
   use flexact_kinds, only: wp
   implicit none
   private
   public :: model_t
   public :: node_planar_position, node_position, node_angle, node_orientation
   public :: class_none, class_fixed, class_dependent, class_independent
   public :: slots, most_deformations
   public :: is_position, has_axis

   integer, parameter :: node_planar_position = 1
   integer, parameter :: node_position = 2
   integer, parameter :: node_angle = 3
   integer, parameter :: node_orientation = 4

   integer, parameter :: class_none = 0
   integer, parameter :: class_fixed = 1
   integer, parameter :: class_dependent = 2
   integer, parameter :: class_independent = 3

   !> The node slots of an element: position p, orientation p, position q,
   !> orientation q.
   integer, parameter :: slots = 4
   integer, parameter :: most_deformations = 6

   type :: model_t
      integer :: nodes = 0
      integer :: elements = 0
      !> Node: number in the deck, kind, and reference value: a position
      !> x, y, z; four Euler parameters; or an angle in value(1).
      integer, allocatable :: node_number(:)
      integer, allocatable :: node_kind(:)
      real(wp), allocatable :: node_value(:, :)
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

contains

   pure logical function is_position(kind)
      integer, intent(in) :: kind
      is_position = kind == node_planar_position .or. kind == node_position
   end function is_position

   !> Whether a node of this kind has a coordinate along or about the axis.
   pure logical function has_axis(kind, axis)
      integer, intent(in) :: kind, axis
      select case (kind)
      case (node_planar_position)
         has_axis = axis <= 2
      case (node_angle)
         has_axis = axis == 3
      case default
         has_axis = .true.
      end select
   end function has_axis
end module flexact_model
