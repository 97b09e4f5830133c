!> The table of the elements: what a statement's operands are and what the
!> deformations mean. The numerics stand in one file an element; a new element
!> is that file, a row here, and a case in flexact_element.
module flexact_element_table
   use flexact_model, only: node_planar_position, node_position, node_angle, node_orientation, &
                            slots, most_deformations
   implicit none
   private
   public :: element_kind_t, element_kinds, find_element_kind
   public :: kind_truss, kind_beam, kind_rbeam, kind_pinbody, kind_hinge
   public :: kind_pltruss, kind_plbeam, kind_plrbeam, kind_plhinge
   public :: vector_none, vector_optional, vector_required
   public :: dual_none, dual_force, dual_moment, dual_moment_over_length

   integer, parameter :: kind_truss = 1
   integer, parameter :: kind_beam = 2
   integer, parameter :: kind_rbeam = 3
   integer, parameter :: kind_pinbody = 4
   integer, parameter :: kind_hinge = 5
   integer, parameter :: kind_pltruss = 6
   integer, parameter :: kind_plbeam = 7
   integer, parameter :: kind_plrbeam = 8
   integer, parameter :: kind_plhinge = 9

   integer, parameter :: vector_none = 0
   integer, parameter :: vector_optional = 1
   integer, parameter :: vector_required = 2

   !> What the stress resultant of a deformation is: a force; a moment; or a
   !> moment divided by l0, because the deformation is l0 times an angle.
   integer, parameter :: dual_none = 0
   integer, parameter :: dual_force = 1
   integer, parameter :: dual_moment = 2
   integer, parameter :: dual_moment_over_length = 3

   type :: element_kind_t
      character(len=8) :: keyword
      !> Node kind of each slot (p, op, q, oq), 0 where the slot is unused.
      integer :: slot_kind(slots)
      integer :: deformations
      integer :: vector
      !> Whether p and q must be apart.
      logical :: needs_length
      integer :: dual(most_deformations)
   end type element_kind_t

   integer, parameter :: x2 = node_planar_position
   integer, parameter :: x3 = node_position
   integer, parameter :: r1 = node_angle
   integer, parameter :: r3 = node_orientation
   integer, parameter :: f = dual_force
   integer, parameter :: m = dual_moment
   integer, parameter :: b = dual_moment_over_length

   type(element_kind_t), parameter :: element_kinds(9) = [ &
                                      element_kind_t('TRUSS', [x3, 0, x3, 0], 1, vector_none, .true., [f, 0, 0, 0, 0, 0]), &
                                      element_kind_t('BEAM', [x3, r3, x3, r3], 6, vector_optional, .true., [f, b, b, b, b, b]), &
                                      element_kind_t('RBEAM', [x3, r3, x3, 0], 3, vector_optional, .true., [f, f, f, 0, 0, 0]), &
                                      element_kind_t('PINBODY', [x3, r3, x3, 0], 3, vector_none, .false., [f, f, f, 0, 0, 0]), &
                                      element_kind_t('HINGE', [0, r3, 0, r3], 3, vector_required, .false., [m, m, m, 0, 0, 0]), &
                                      element_kind_t('PLTRUSS', [x2, 0, x2, 0], 1, vector_none, .true., [f, 0, 0, 0, 0, 0]), &
                                      element_kind_t('PLBEAM', [x2, r1, x2, r1], 3, vector_none, .true., [f, b, b, 0, 0, 0]), &
                                      element_kind_t('PLRBEAM', [x2, r1, x2, 0], 2, vector_none, .true., [f, f, 0, 0, 0, 0]), &
                                      element_kind_t('PLHINGE', [0, r1, 0, r1], 1, vector_none, .false., [m, 0, 0, 0, 0, 0])]

contains

   !> The kind with this keyword in capitals, other spellings included; 0
   !> where there is none.
   pure integer function find_element_kind(keyword) result(kind)
      character(len=*), intent(in) :: keyword
      character(len=8) :: name

      select case (keyword)
      case ('PLTOR')
         name = 'PLHINGE'
      case ('BEAMNL')
         name = 'BEAM'
      case ('PLBEAMNL')
         name = 'PLBEAM'
      case default
         name = keyword
         if (len_trim(keyword) > len(name)) name = ''
      end select
      do kind = size(element_kinds), 1, -1
         if (element_kinds(kind)%keyword == name) return
      end do
   end function find_element_kind
end module flexact_element_table
