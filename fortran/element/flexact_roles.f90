! SPDX-License-Identifier: BSD-3-Clause
!> What a deformation is to its element. Words, forms, stress resultants and
!> units are rules on these roles.
module flexact_roles
   implicit none
   private
   public :: role_names, dual_names, dual_of
   public :: role_elongation, role_torsion
   public :: role_bending_xz_p, role_bending_xz_q, role_bending_xy_p, role_bending_xy_q
   public :: role_planar_bending_p, role_planar_bending_q
   public :: role_offset_x, role_offset_y, role_offset_z
   public :: role_rotation, role_tilt_y, role_tilt_z, role_angle
   public :: dual_none, dual_force, dual_moment, dual_moment_over_length

   !> Elongation of the line from p to q; torsion about it; bending at p or q in
   !> a local plane, each l0 times an angle. Planar bending has the other sign.
   integer, parameter :: role_elongation = 1
   integer, parameter :: role_torsion = 2
   integer, parameter :: role_bending_xz_p = 3
   integer, parameter :: role_bending_xz_q = 4
   integer, parameter :: role_bending_xy_p = 5
   integer, parameter :: role_bending_xy_q = 6
   integer, parameter :: role_planar_bending_p = 7
   integer, parameter :: role_planar_bending_q = 8
   !> Displacement of q in the frame that turns with p.
   integer, parameter :: role_offset_x = 9
   integer, parameter :: role_offset_y = 10
   integer, parameter :: role_offset_z = 11
   !> Rotation of q against p about the axis ex, and of that axis about ey and
   !> ez; in the plane the one angle.
   integer, parameter :: role_rotation = 12
   integer, parameter :: role_tilt_y = 13
   integer, parameter :: role_tilt_z = 14
   integer, parameter :: role_angle = 15
   character(len=24), parameter :: role_names(0:15) = [character(len=24) :: &
                                                       'none', 'elongation', 'torsion', 'bending xz p', 'bending xz q', &
                                                       'bending xy p', 'bending xy q', 'planar bending p', 'planar bending q', &
                                                       'offset x', 'offset y', 'offset z', 'rotation', 'tilt y', 'tilt z', &
                                                       'angle']

   !> What the stress resultant of a deformation is: a force; a moment; or a
   !> moment divided by l0, because the deformation is l0 times an angle.
   integer, parameter :: dual_none = 0
   integer, parameter :: dual_force = 1
   integer, parameter :: dual_moment = 2
   integer, parameter :: dual_moment_over_length = 3
   character(len=24), parameter :: dual_names(0:3) = [character(len=24) :: &
                                                      'none', 'force', 'moment', 'moment over length']

contains

   elemental integer function dual_of(role) result(dual)
      integer, intent(in) :: role

      select case (role)
      case (role_elongation, role_offset_x, role_offset_y, role_offset_z)
         dual = dual_force
      case (role_rotation, role_tilt_y, role_tilt_z, role_angle)
         dual = dual_moment
      case (role_torsion:role_planar_bending_q)
         dual = dual_moment_over_length
      case default
         dual = dual_none
      end select
   end function dual_of
end module flexact_roles
