! SPDX-License-Identifier: BSD-3-Clause
!> What elements join: kinds of nodes, their axes, and the slots of an element.
!>
!> Every node has three axes: x, y, z of a position node, the rotations about
!> x, y, z of an orientation node, not all of which need be coordinates.
module flexact_slots
   implicit none
   private
   public :: node_planar_position, node_position, node_angle, node_orientation, node_kind_names
   public :: axes, slots, most_deformations
   public :: is_position, has_axis

   integer, parameter :: node_planar_position = 1
   integer, parameter :: node_position = 2
   integer, parameter :: node_angle = 3
   integer, parameter :: node_orientation = 4
   character(len=24), parameter :: node_kind_names(0:4) = [character(len=24) :: &
                                                           'none', 'planar position', 'position', 'angle', 'orientation']

   !> How many axes a node has, whether or not there is a coordinate on them.
   integer, parameter :: axes = 3
   !> The node slots of an element: position p, orientation p, position q,
   !> orientation q.
   integer, parameter :: slots = 4
   integer, parameter :: most_deformations = 6

contains

   elemental logical function is_position(kind)
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
end module flexact_slots
