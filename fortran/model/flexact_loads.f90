! SPDX-License-Identifier: BSD-3-Clause
!> Loads on a mechanism, as they were said. Whether it is exactly constrained does not
!> depend on them.
module flexact_loads
   use flexact_kinds, only: wp
   use flexact_slots, only: axes
   implicit none
   private
   public :: loads_t, make_loads

   !> Zero where nothing is given. A position node has forces along x, y, z [N], an
   !> orientation node moments about x, y, z [N m], a planar one about z alone.
   type :: loads_t
      !> (3, nodes) dead loads.
      real(wp), allocatable :: force(:, :)
      !> (3, nodes) what is added to them in the course of loading.
      real(wp), allocatable :: increment(:, :)
      !> Acceleration of free fall [m/s^2].
      real(wp) :: gravity(axes) = 0.0_wp
   end type loads_t

contains

   !> Of so many nodes no loads.
   pure function make_loads(nodes) result(loads)
      integer, intent(in) :: nodes
      type(loads_t) :: loads

      allocate (loads%force(axes, nodes), loads%increment(axes, nodes), source=0.0_wp)
   end function make_loads
end module flexact_loads
