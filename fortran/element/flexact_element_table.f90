! SPDX-License-Identifier: BSD-3-Clause
!> The table of the elements, which all that depends on an element's kind reads:
!> the deck, the checks, frames, and, by way of the boundary, Python. The numerics
!> stand in one file an element; see docs/adding_an_element.md.
module flexact_element_table
   use flexact_roles, only: role_elongation, role_torsion, role_bending_xz_p, role_bending_xz_q, &
                            role_bending_xy_p, role_bending_xy_q, role_planar_bending_p, role_planar_bending_q, &
                            role_offset_x, role_offset_y, role_offset_z, role_rotation, role_tilt_y, role_tilt_z, role_angle
   use flexact_slots, only: node_planar_position, node_position, node_angle, node_orientation, &
                            axes, slots, most_deformations, has_axis
   implicit none
   private
   public :: element_kind_t, element_kinds, find_element_kind, deformations_of, coordinates_of, listed_numbers, beam_with_warping
   public :: frame_none, frame_along, frame_about, frame_planar, frame_names
   public :: vector_none, vector_optional, vector_required, vector_names
   public :: member_bar, member_beam, member_link, member_hinge, member_names

   !> Where ex points: nowhere; from p to q with ey towards the vector; along the
   !> vector; from p to q in the xy plane.
   integer, parameter :: frame_none = 0
   integer, parameter :: frame_along = 1
   integer, parameter :: frame_about = 2
   integer, parameter :: frame_planar = 3
   character(len=24), parameter :: frame_names(0:3) = [character(len=24) :: 'none', 'along', 'about', 'planar']

   integer, parameter :: vector_none = 0
   integer, parameter :: vector_optional = 1
   integer, parameter :: vector_required = 2
   character(len=24), parameter :: vector_names(0:2) = [character(len=24) :: 'none', 'optional', 'required']

   !> What an element is in the mechanism: straight and without bending; a beam;
   !> an arm of the body of p; a joint without extent.
   integer, parameter :: member_bar = 1
   integer, parameter :: member_beam = 2
   integer, parameter :: member_link = 3
   integer, parameter :: member_hinge = 4
   character(len=24), parameter :: member_names(0:4) = [character(len=24) :: 'none', 'bar', 'beam', 'link', 'hinge']

   type :: element_kind_t
      character(len=8) :: keyword
      !> Another spelling in decks, blank without one.
      character(len=8) :: synonym
      !> Node kind of each slot (p, op, q, oq), 0 where the slot is unused.
      integer :: slot_kind(slots)
      integer :: frame
      !> Whether a vector follows the nodes in a statement.
      integer :: vector
      !> Whether p and q must be apart.
      logical :: needs_length
      integer :: member
      !> Role of each deformation, 0 beyond the last.
      integer :: role(most_deformations)
      !> What it is, in Markdown.
      character(len=96) :: says
      !> What the numbers of ESTIFF and of EM mean, each with its unit in brackets and a comma
      !> between two; blank where they have no meaning.
      character(len=224) :: stiffness
      character(len=96) :: mass
   end type element_kind_t

   !> A beam with a warping node behind each orientation, which decks may state.
   character(len=*), parameter :: beam_with_warping = 'BEAMW'

   integer, parameter :: x2 = node_planar_position, x3 = node_position, r1 = node_angle, r3 = node_orientation
   integer, parameter :: no = vector_none, may = vector_optional, must = vector_required
   integer, parameter :: none = frame_none, along = frame_along, about = frame_about, plane = frame_planar
   integer, parameter :: bar = member_bar, beam = member_beam, link = member_link, hinge = member_hinge
   integer, parameter :: stretch(6) = [role_elongation, 0, 0, 0, 0, 0]
   integer, parameter :: bend(6) = [role_elongation, role_torsion, role_bending_xz_p, role_bending_xz_q, &
                                    role_bending_xy_p, role_bending_xy_q]
   integer, parameter :: offset(6) = [role_offset_x, role_offset_y, role_offset_z, 0, 0, 0]
   integer, parameter :: turn(6) = [role_rotation, role_tilt_y, role_tilt_z, 0, 0, 0]
   integer, parameter :: move(6) = [offset(:3), turn(:3)]
   integer, parameter :: bend_2d(6) = [role_elongation, role_planar_bending_p, role_planar_bending_q, 0, 0, 0]
   integer, parameter :: offset_2d(6) = [role_offset_x, role_offset_y, 0, 0, 0, 0]
   integer, parameter :: turn_2d(6) = [role_angle, 0, 0, 0, 0, 0]

   character(len=*), parameter :: axial = 'EA (N)'
   character(len=*), parameter :: bending = 'EA (N), G It (N m^2), E Iy (N m^2), E Iz (N m^2), '// &
                                  'shear E Iy/(G A k) (m^2), shear E Iz/(G A k) (m^2)'
   character(len=*), parameter :: bending_2d = 'EA (N), EI (N m^2), shear EI/(G A k) (m^2)'
   character(len=*), parameter :: turning_2d = 'stiffness about its axis (N m/rad)'
   character(len=*), parameter :: turning = turning_2d//', stiffness of its first tilt (N m/rad), '// &
                                  'stiffness of its second tilt (N m/rad)'
   character(len=*), parameter :: moving = 'stiffness along x (N/m), stiffness along y (N/m), stiffness along z (N/m), '//turning
   character(len=*), parameter :: line_mass = 'mass per length (kg/m)'
   character(len=*), parameter :: body_mass = line_mass//', Jxx (kg m), Jyy (kg m), Jzz (kg m), Jyz (kg m)'
   character(len=*), parameter :: body_mass_2d = line_mass//', moment of inertia (kg m)'

   type(element_kind_t), parameter :: element_kinds(*) = [ &
                                      element_kind_t('TRUSS', '', [x3, 0, x3, 0], along, no, .true., bar, stretch, &
                                                     'a bar, which only a normal force strains', axial, line_mass), &
                                      element_kind_t('BEAM', 'BEAMNL', [x3, r3, x3, r3], along, may, .true., beam, bend, &
                                                     'a flexible beam in space: a wire, a sheet, '// &
                                                     'or what is rigid where nothing is released', &
                                                     bending, body_mass), &
                                      element_kind_t('RBEAM', '', [x3, r3, x3, 0], along, may, .true., link, offset, &
                                                     'a rigid arm: it holds q to the body that turns with p', '', body_mass), &
                                      element_kind_t('PINBODY', '', [x3, r3, x3, 0], along, no, .false., link, offset, &
                                                     'a point of a rigid body, which turns with p; q may be where p is', &
                                                     '', body_mass), &
                                      element_kind_t('HINGE', '', [0, r3, 0, r3], about, must, .false., hinge, turn, &
                                                     'a hinge between two orientations', turning, ''), &
                                      element_kind_t('PLTRUSS', '', [x2, 0, x2, 0], plane, no, .true., bar, stretch, &
                                                     'a bar in the xy plane', axial, line_mass), &
                                      element_kind_t('PLBEAM', 'PLBEAMNL', [x2, r1, x2, r1], plane, no, .true., beam, bend_2d, &
                                                     'a flexible beam in the xy plane', bending_2d, body_mass_2d), &
                                      element_kind_t('PLRBEAM', '', [x2, r1, x2, 0], plane, no, .true., link, offset_2d, &
                                                     'a rigid arm in the xy plane', '', body_mass_2d), &
                                      element_kind_t('PLHINGE', 'PLTOR', [0, r1, 0, r1], none, no, .false., hinge, turn_2d, &
                                                     'a hinge in the xy plane', turning_2d, ''), &
                                      element_kind_t('BEARING', '', [x3, r3, x3, r3], about, must, .false., hinge, move, &
                                                     'a bearing: how a body moves against another, in the frame of an axis', &
                                                     moving, '')]

contains

   !> The kind with this keyword in capitals, other spellings included; 0
   !> where there is none. A beam with warping is a beam.
   pure integer function find_element_kind(keyword) result(kind)
      character(len=*), intent(in) :: keyword

      do kind = size(element_kinds), 1, -1
         if (element_kinds(kind)%keyword == keyword) return
         if (element_kinds(kind)%synonym == keyword .and. keyword /= '') return
         if (element_kinds(kind)%keyword == 'BEAM' .and. keyword == beam_with_warping) return
      end do
   end function find_element_kind

   !> How many deformations an element of this kind has.
   elemental integer function deformations_of(kind) result(deformations)
      integer, intent(in) :: kind
      deformations = count(element_kinds(kind)%role /= 0)
   end function deformations_of

   !> How many numbers a column of the table lists.
   pure integer function listed_numbers(meanings) result(numbers)
      character(len=*), intent(in) :: meanings
      integer :: i

      numbers = 0
      if (meanings /= '') numbers = 1 + count([(meanings(i:i) == ',', i=1, len(meanings))])
   end function listed_numbers

   !> Whether an element of this kind has each of the coordinates x, y, z of the
   !> position of p, rotation of p, position of q, rotation of q.
   pure function coordinates_of(kind) result(has)
      integer, intent(in) :: kind
      logical :: has(axes*slots)
      integer :: slot, axis

      do slot = 1, slots
         do axis = 1, axes
            associate (node_kind => element_kinds(kind)%slot_kind(slot))
               has(axes*(slot - 1) + axis) = node_kind /= 0 .and. has_axis(node_kind, axis)
            end associate
         end do
      end do
   end function coordinates_of
end module flexact_element_table
